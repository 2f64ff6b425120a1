#include "trainees/records/consents.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/signing.h"

namespace trocar {
namespace {

bool known_trainee(sqlite3* connection, const std::string& code) {
  return sql::Statement(connection, "SELECT 1 FROM person WHERE code = ?").bind(code).step();
}

}  // namespace

Consent ConsentStore::record(const std::string& trainee, const std::string& purpose, bool given,
                             const std::string& text, const Author& author) {
  check_printed("purpose", purpose, 64);
  check_prose("consent", text);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  const Consent consent{next_row_uuid(connection, "consent"), purpose, text, author.account_uuid, utc_now(), given};
  if (!given && known_trainee(connection, trainee) && !holds(trainee, purpose))
    throw InputError("consent of " + trainee + " to \"" + purpose + "\": none is given, so none can be withdrawn");
  {
    sql::Statement person(connection, "SELECT trainee_id FROM person WHERE code = ?");
    if (person.bind(trainee).step()) require_person(connection, person.integer(0), trainee);
    sql::Statement insert(connection,
                          "INSERT INTO consent (uuid, trainee_id, purpose, given, text, author, utc)"
                          " SELECT ?, trainee_id, ?, ?, ?, ?, ? FROM person WHERE code = ? RETURNING 1");
    insert.bind(consent.uuid).bind(purpose).bind(given).bind(text).bind(consent.author).bind(consent.utc).bind(trainee);
    if (!insert.step()) throw InputError("trainee \"" + trainee + "\": there is none");
    insert.run();
  }
  seal_row(connection, "consent", consent.uuid, author.account_uuid);
  transaction.commit();
  return consent;
}

std::vector<Consent> ConsentStore::of(const std::string& trainee) const {
  std::vector<Consent> consents;
  sql::Statement rows(database_->connection(),
                      "SELECT c.uuid, purpose, text, author, utc, given FROM consent c JOIN person p ON p.trainee_id = "
                      "c.trainee_id WHERE p.code = ? AND row_holds('consent', c.id)" +
                          newest_first("consent", "c", "trainee_id"));
  rows.bind(trainee);
  while (rows.step())
    consents.push_back({rows.text(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.integer(5) != 0});
  return consents;
}

bool ConsentStore::holds(const std::string& trainee, const std::string& purpose) const {
  const auto consents = of(trainee);
  const auto newest = std::find_if(consents.begin(), consents.end(),
                                   [&](const Consent& consent) { return consent.purpose == purpose; });
  return newest != consents.end() && newest->given;
}

}  // namespace trocar
