#include "trainees/records/programmes.h"

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/signing.h"

namespace trocar {
namespace {

constexpr std::size_t kLongestWithdrawal = 200;
constexpr const char* kRulesCurriculum = "standard";  // the rules of progress in force

constexpr const char* kAssignments =
    "SELECT a.uuid, a.programme, coalesce(t.code, ''), a.group_name, a.due, a.printed, a.utc, coalesce(w.utc, ''),"
    " coalesce(w.printed, ''), coalesce(w.reason, '') FROM assignment a LEFT JOIN known_trainee t ON t.id = "
    "a.trainee_id"
    " LEFT JOIN withdrawal w ON w.assignment_id = a.id AND row_holds('withdrawal', w.id)"
    " WHERE row_holds('assignment', a.id)";

Assignment assignment_of(const sql::Statement& row) {
  return {row.text(0), row.text(1), row.text(2), row.text(3), row.text(4),
          row.text(5), row.text(6), row.text(7), row.text(8), row.text(9)};
}

void insert_withdrawal(sqlite3* connection, const std::string& assignment, const std::string& reason,
                       const Author& author) {
  const std::string uuid = next_row_uuid(connection, "withdrawal");
  sql::Statement insert(connection,
                        "INSERT INTO withdrawal (uuid, assignment_id, reason, author, printed, utc)"
                        " SELECT ?, id, ?, ?, ?, ? FROM assignment WHERE uuid = ?");
  insert.bind(uuid).bind(reason).bind(author.account_uuid).bind(author.printed).bind(utc_now()).bind(assignment).run();
  seal_row(connection, "withdrawal", uuid, author.account_uuid);
}

/// What holds of the programme for exactly these.
std::optional<Assignment> held(sqlite3* connection, const std::string& programme, const std::string& trainee,
                               const std::string& group) {
  sql::Statement row(connection, std::string(kAssignments) +
                                     " AND w.id IS NULL AND a.programme = ? AND coalesce(t.code, '') = ? COLLATE NOCASE"
                                     " AND a.group_name = ?");
  if (!row.bind(programme).bind(trainee).bind(group).step()) return std::nullopt;
  return assignment_of(row);
}

}  // namespace

Curriculum ProgrammeStore::save(const std::string& name, const std::string& toml, const Author& author,
                                const CurriculumStore::Check& check) {
  read_programme(toml, name);
  return CurriculumStore(*database_).add(name, toml, author, [&](const std::optional<Curriculum>& last) {
    if (name == kRulesCurriculum || (last && !is_programme(last->toml)))
      throw InputError("\"" + name + "\": is the name of rules of progress; give the programme another");
    if (check) check(last);
  });
}

std::vector<KeptProgramme> ProgrammeStore::list() const {
  std::vector<KeptProgramme> out;
  sql::Statement names(database_->connection(), "SELECT DISTINCT name FROM curriculum ORDER BY name");
  while (names.step()) {
    const auto newest = CurriculumStore(*database_).newest(names.text(0));
    if (!newest || !is_programme(newest->toml)) continue;
    KeptProgramme kept{*newest, {}, ""};
    try {
      kept.programme = read_programme(newest->toml, newest->name);
    } catch (const InputError& error) {
      kept.problem = error.what();
    }
    out.push_back(std::move(kept));
  }
  return out;
}

Programme ProgrammeStore::find(const std::string& name) const {
  const auto newest = CurriculumStore(*database_).newest(name);
  if (!newest || !is_programme(newest->toml)) throw InputError("programme \"" + name + "\": there is none");
  return read_programme(newest->toml, name);
}

Assignment ProgrammeStore::assign(const std::string& programme, const std::string& trainee, const std::string& group,
                                  const std::string& due, const Author& author) {
  if (trainee.empty() == group.empty()) throw InputError("assign: to one person or to one group");
  if (!due.empty()) end_of_day(due);
  require_key(*database_);  // first: under another key no programme holds
  find(programme);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  sql::Statement person(connection, "SELECT trainee_id FROM person WHERE code = ?");
  if (!trainee.empty() && !person.bind(trainee).step()) throw InputError("trainee \"" + trainee + "\": there is none");
  if (!trainee.empty()) require_person(connection, person.integer(0), trainee);
  sql::Statement member(connection, "SELECT 1 FROM membership WHERE group_name = ? LIMIT 1");
  if (!group.empty() && !member.bind(group).step()) throw InputError("group \"" + group + "\": nobody is in it");
  if (const auto before = held(connection, programme, trainee, group)) {
    if (before->due == due) throw InputError("\"" + programme + "\": is assigned so already");
    insert_withdrawal(connection, before->uuid, "replaced", author);
  }
  const std::string uuid = next_row_uuid(connection, "assignment");
  sql::Statement insert(connection,
                        "INSERT INTO assignment (uuid, trainee_id, group_name, programme, due, author, printed, utc)"
                        " VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(uuid);
  if (trainee.empty())
    insert.bind_null();
  else
    insert.bind(person.integer(0));
  insert.bind(group).bind(programme).bind(due).bind(author.account_uuid).bind(author.printed).bind(utc_now()).run();
  seal_row(connection, "assignment", uuid, author.account_uuid);
  const Assignment given = held(connection, programme, trainee, group).value();
  transaction.commit();
  return given;
}

void ProgrammeStore::withdraw(const std::string& uuid, const std::string& reason, const Author& author) {
  if (!reason.empty()) check_printed("reason", reason, kLongestWithdrawal);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  sql::Statement known(
      connection,
      "SELECT w.id FROM assignment a LEFT JOIN withdrawal w ON w.assignment_id = a.id AND row_holds('withdrawal', w.id)"
      " WHERE a.uuid = ?");
  if (!known.bind(uuid).step()) throw InputError("assignment " + uuid + ": there is none");
  if (!known.is_null(0)) throw InputError("assignment " + uuid + ": was withdrawn before");
  insert_withdrawal(connection, uuid, reason, author);
  transaction.commit();
}

std::vector<Assignment> ProgrammeStore::assignments() const {
  std::vector<Assignment> out;
  sql::Statement rows(database_->connection(), std::string(kAssignments) + " ORDER BY a.uuid DESC");
  while (rows.step()) out.push_back(assignment_of(rows));
  return out;
}

}  // namespace trocar
