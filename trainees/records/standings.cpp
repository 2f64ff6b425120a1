#include "trainees/records/standings.h"

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/signing.h"

namespace trocar {
namespace {

constexpr std::size_t kLongestStandingReason = 200;

bool is_active(sqlite3* connection, std::int64_t trainee) {
  sql::Statement row(
      connection,
      "SELECT active FROM standing WHERE trainee_id = ? AND row_holds('standing', id) ORDER BY uuid DESC LIMIT 1");
  return !row.bind(trainee).step() || row.integer(0) != 0;
}

}  // namespace

int StandingStore::set_active(const std::set<std::string>& codes, bool active, const std::string& reason,
                              const Author& author) {
  if (!reason.empty()) check_printed("reason", reason, kLongestStandingReason);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  int changed = 0;
  for (const std::string& code : codes) {
    sql::Statement who(connection, "SELECT trainee_id FROM person WHERE code = ?");
    if (!who.bind(code).step()) throw InputError("trainee \"" + code + "\": there is none");
    const std::int64_t trainee = who.integer(0);
    require_person(connection, trainee, code);
    if (is_active(connection, trainee) == active) continue;
    sql::Statement running(connection, "SELECT 1 FROM attempt WHERE status = 'running' AND trainee_id = ?");
    if (!active && running.bind(trainee).step())
      throw InputError("trainee \"" + code + "\": an attempt is running; deactivate when it has ended");
    const std::string uuid = next_row_uuid(connection, "standing");
    sql::Statement insert(connection,
                          "INSERT INTO standing (uuid, trainee_id, active, reason, author, printed, utc)"
                          " VALUES (?, ?, ?, ?, ?, ?, ?)");
    insert.bind(uuid).bind(trainee).bind(active).bind(reason).bind(author.account_uuid).bind(author.printed);
    insert.bind(utc_now()).run();
    seal_row(connection, "standing", uuid, author.account_uuid);
    ++changed;
  }
  if (changed > 0) transaction.commit();
  return changed;
}

Standing StandingStore::of(const std::string& code) const {
  sql::Statement row(
      database_->connection(),
      "SELECT active, reason, printed, s.utc FROM standing s JOIN person p ON p.trainee_id = s.trainee_id"
      " WHERE p.code = ? AND row_holds('standing', s.id) ORDER BY s.uuid DESC LIMIT 1");
  if (!row.bind(code).step()) return {};
  return {row.integer(0) != 0, row.text(1), row.text(2), row.text(3)};
}

std::set<std::int64_t> deactivated(sqlite3* connection) {
  std::set<std::int64_t> out;
  // Of the columns beside max() SQLite takes those of the row that has it.
  sql::Statement rows(
      connection,
      "SELECT trainee_id, active, max(uuid) FROM standing WHERE row_holds('standing', id) GROUP BY trainee_id");
  while (rows.step())
    if (rows.integer(1) == 0) out.insert(rows.integer(0));
  return out;
}

void require_active(sqlite3* connection, std::int64_t trainee) {
  if (is_active(connection, trainee)) return;
  sql::Statement who(connection, "SELECT code FROM known_trainee WHERE id = ?");
  who.bind(trainee).step();
  throw InputError("trainee \"" + who.text(0) + "\": is deactivated; an instructor can reactivate them at the desk");
}

}  // namespace trocar
