#include "trainees/integrity/kept_rows.h"

#include <array>
#include <cstdio>
#include <random>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr const char* kTrainee = "SELECT uuid, created_utc FROM trainee WHERE uuid = ?";
constexpr const char* kPerson =
    "SELECT p.salt, t.uuid, p.code, p.name, p.email FROM person p JOIN trainee t ON t.id = p.trainee_id WHERE t.uuid = "
    "?";
constexpr const char* kExercise = "SELECT id, number, title FROM exercise WHERE id = ?";

std::string digest_of(sqlite3* connection, const char* table, const char* query, const std::string& key) {
  sql::Statement row(connection, query);
  if (!row.bind(key).step()) return "";
  std::string content = std::string("trocar-row-1\n") + table + "\n";
  for (int column = 0; column < row.columns(); ++column) content += row.canonical(column);
  return digest::of_bytes(content);
}

std::string kept_actor_of(const std::string& author) { return author.empty() ? "trocar" : author; }

bool has_entry(sqlite3* connection, const std::string& subject, const char* action) {
  sql::Statement entry(connection, "SELECT 1 FROM audit WHERE subject = ? AND action = ?");
  return entry.bind(subject).bind(action).step();
}

std::string random_salt() {
  std::random_device random;
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%08x%08x%08x%08x", random(), random(), random(), random());
  return text.data();
}

/// A table whose rows have each a newest entry with a digest.
struct KeptTable {
  const char *name, *row, *keys, *actions;  ///< actions: as in IN (...)
};
constexpr KeptTable kTables[] = {
    {"trainee", kTrainee, "SELECT uuid FROM trainee ORDER BY uuid", "'trainee added'"},
    {"person", kPerson, "SELECT t.uuid FROM person p JOIN trainee t ON t.id = p.trainee_id ORDER BY t.uuid",
     "'person added', 'person changed'"},
    {"exercise", kExercise, "SELECT id FROM exercise ORDER BY id", "'exercise kept'"},
};

std::string named_row(const KeptTable& table, const std::string& key) {
  const std::string name = table.name;
  return name == "person" ? "person of trainee " + key : name + " " + key;
}

std::vector<std::string> keys_of(sqlite3* connection, const KeptTable& table) {
  std::vector<std::string> keys;
  sql::Statement rows(connection, table.keys);
  while (rows.step()) keys.push_back(rows.text(0));
  return keys;
}

/// Digest of the newest entry, "" without one.
std::string newest_digest(sqlite3* connection, const KeptTable& table, const std::string& key) {
  sql::Statement entry(connection, std::string("SELECT detail FROM audit WHERE subject = ? AND action IN (") +
                                       table.actions + ") ORDER BY position DESC LIMIT 1");
  return entry.bind(key).step() ? entry.text(0) : "";
}

bool erased(sqlite3* connection, const std::string& trainee_uuid) {
  sql::Statement row(connection,
                     "SELECT 1 FROM erasure e JOIN trainee t ON t.id = e.trainee_id WHERE t.uuid = ? AND"
                     " row_holds('erasure', e.id)");
  return row.bind(trainee_uuid).step();
}

void check_kept_table(sqlite3* connection, const KeptTable& table, std::vector<std::string>& problems) {
  const bool person = std::string(table.name) == "person";
  for (const std::string& key : keys_of(connection, table)) {
    const std::string kept = newest_digest(connection, table, key);
    const bool other = !kept.empty() && kept != digest_of(connection, table.name, table.row, key);
    if (person && erased(connection, key))
      problems.push_back(named_row(table, key) + " stands here although it was erased");
    else if (kept.empty())
      problems.push_back(named_row(table, key) + " has no entry in the audit trail: it came in by another way");
    else if (other)
      problems.push_back(named_row(table, key) + " was changed by another way");
  }
  sql::Statement entries(
      connection, std::string("SELECT DISTINCT subject FROM audit WHERE action IN (") + table.actions + ") ORDER BY 1");
  while (entries.step()) {
    const std::string key = entries.text(0);
    if (!digest_of(connection, table.name, table.row, key).empty() || (person && erased(connection, key))) continue;
    problems.push_back(named_row(table, key) + " is missing");
  }
}

void check_groups(sqlite3* connection, std::vector<std::string>& problems) {
  // The newest word on each trainee and group, beside the row; an erasure ends all of them.
  sql::Statement told(connection, R"sql(
WITH word AS (
  SELECT subject AS uuid, detail AS name, action LIKE 'group joined%' AS joined, max(position) FROM audit
  WHERE action IN ('group joined', 'group left', 'group joined elsewhere', 'group left elsewhere') GROUP BY subject, detail
), wanted AS (
  SELECT uuid, name FROM word WHERE joined
  AND uuid NOT IN (SELECT t.uuid FROM erasure e JOIN trainee t ON t.id = e.trainee_id WHERE row_holds('erasure', e.id))
), present AS (
  SELECT t.uuid, m.group_name AS name FROM membership m JOIN trainee t ON t.id = m.trainee_id
)
SELECT uuid, name, 'is missing' FROM (SELECT * FROM wanted EXCEPT SELECT * FROM present)
UNION ALL SELECT uuid, name, 'came in by another way' FROM (SELECT * FROM present EXCEPT SELECT * FROM wanted) ORDER BY 1, 2)sql");
  while (told.step())
    problems.push_back("membership of trainee " + told.text(0) + " in \"" + told.text(1) + "\" " + told.text(2));
}

void check_seen(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement rows(
      connection,
      "SELECT n.uuid, coalesce(s.utc, ''), coalesce((SELECT CASE WHEN max(detail = s.utc) THEN s.utc ELSE min(detail)"
      " END FROM audit WHERE subject = n.uuid AND action = 'note seen'), '') FROM note n LEFT JOIN note_seen s ON"
      " s.note_id = n.id ORDER BY n.uuid");
  while (rows.step()) {
    const std::string seen = rows.text(1), kept = rows.text(2), name = "note " + rows.text(0);
    if (seen == kept) continue;
    problems.push_back(kept.empty()   ? name + " counts as met, which has no entry in the audit trail"
                       : seen.empty() ? name + " was met on " + kept + ": that is missing"
                                      : name + " was met on " + kept + ", not on " + seen);
  }
}

/// Nothing here scores again yet, so nothing but revision 0 can have come from it.
void check_revisions(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement rows(
      connection,
      "SELECT a.uuid, s.revision FROM score s JOIN attempt a ON a.id = s.attempt_id WHERE s.revision <> 0"
      " ORDER BY a.uuid, s.revision");
  while (rows.step())
    problems.push_back("score of attempt " + rows.text(0) + ", revision " + rows.text(1) + ", came in by another way");
}

void check_sessions(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement rows(connection,
                      "SELECT DISTINCT s.uuid FROM session s JOIN attempt a ON a.session_id = s.id"
                      " WHERE a.trainee_id <> s.trainee_id ORDER BY s.uuid");
  while (rows.step()) problems.push_back("session " + rows.text(0) + " is not of the trainee who made its attempts");
}

void check_station(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement made(connection, "SELECT subject, detail FROM audit WHERE action = ? ORDER BY position DESC LIMIT 1");
  const bool kept = made.bind(kActionStation).step();
  sql::Statement own(connection, "SELECT uuid, name FROM station WHERE own = 1");
  const bool stands = own.step();
  if (kept != stands || (kept && (made.text(0) != own.text(0) || made.text(1) != own.text(1)))) {
    problems.push_back("station: which one this database is was changed by another way");
  }
}

}  // namespace

void keep_trainee(sqlite3* connection, const std::string& uuid, const std::string& author) {
  append_audit(connection, "trainee added", uuid, digest_of(connection, "trainee", kTrainee, uuid),
               kept_actor_of(author));
  sql::Statement known(connection, "SELECT 1 FROM person p JOIN trainee t ON t.id = p.trainee_id WHERE t.uuid = ?");
  if (known.bind(uuid).step()) keep_person(connection, uuid, author);
}

void keep_person(sqlite3* connection, const std::string& trainee_uuid, const std::string& author) {
  sql::Statement salt(connection,
                      "UPDATE person SET salt = ? WHERE trainee_id = (SELECT id FROM trainee WHERE uuid = ?)");
  salt.bind(random_salt()).bind(trainee_uuid).run();
  const char* action = newest_digest(connection, kTables[1], trainee_uuid).empty() ? "person added" : "person changed";
  append_audit(connection, action, trainee_uuid, digest_of(connection, "person", kPerson, trainee_uuid),
               kept_actor_of(author));
}

bool person_holds(sqlite3* connection, const std::string& trainee_uuid) {
  sql::Statement entry(connection, std::string("SELECT position, detail FROM audit WHERE subject = ? AND action IN (") +
                                       kTables[1].actions + ") ORDER BY position DESC LIMIT 1");
  return entry.bind(trainee_uuid).step() && entry_signed(connection, entry.integer(0)) &&
         entry.text(1) == digest_of(connection, "person", kPerson, trainee_uuid);
}

void require_person(sqlite3* connection, std::int64_t trainee, const std::string& code) {
  sql::Statement row(connection, "SELECT uuid FROM trainee WHERE id = ?");
  if (!row.bind(trainee).step() || !person_holds(connection, row.text(0)))
    throw InputError("trainee \"" + code + "\": was changed by another way; see trocar db check");
}

void keep_exercise(sqlite3* connection, const std::string& id) {
  append_audit(connection, "exercise kept", id, digest_of(connection, "exercise", kExercise, id));
}

void keep_exercise_once(sqlite3* connection, const std::string& id) {
  if (!has_entry(connection, id, "exercise kept")) keep_exercise(connection, id);
}

bool keep_note_seen(sqlite3* connection, const std::string& note_uuid, const std::string& utc,
                    const std::string& author) {
  if (!SeenEntries(connection).when(note_uuid).empty()) return false;
  sql::Statement insert(connection,
                        "INSERT OR IGNORE INTO note_seen SELECT id, ? FROM note WHERE uuid = ? RETURNING 1");
  const bool fresh = insert.bind(utc).bind(note_uuid).step();
  insert.run();
  sql::Statement there(connection, "SELECT 1 FROM note_seen s JOIN note n ON n.id = s.note_id WHERE n.uuid = ?");
  if (!there.bind(note_uuid).step()) return false;
  if (!fresh && !lost_key(connection).empty()) return false;  // once is enough of what cannot be signed
  append_audit(connection, "note seen", note_uuid, utc, kept_actor_of(author));
  return true;
}

SeenEntries::SeenEntries(sqlite3* connection)
    : entries_(connection, std::string("SELECT ") + kEntryColumns +
                               " FROM audit WHERE subject = ? AND action = 'note seen' ORDER BY position"),
      signed_(connection) {}

std::string SeenEntries::when(const std::string& note_uuid) {
  std::string utc;
  entries_.bind(note_uuid);
  while (utc.empty() && entries_.step())
    if (signed_.contains(entries_)) utc = entries_.text(5);
  entries_.run();
  return utc;
}

std::vector<std::string> check_kept_rows(sqlite3* connection) {
  std::vector<std::string> problems;
  for (const KeptTable& table : kTables) check_kept_table(connection, table, problems);
  check_groups(connection, problems);
  check_seen(connection, problems);
  check_revisions(connection, problems);
  check_sessions(connection, problems);
  check_station(connection, problems);
  return problems;
}

}  // namespace trocar
