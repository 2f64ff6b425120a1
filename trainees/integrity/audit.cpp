#include "trainees/integrity/audit.h"

#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <unordered_set>
#include <utility>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

std::string hash_of(const std::string& previous, std::int64_t position, const std::string& utc,
                    const std::string& actor, const std::string& action, const std::string& subject,
                    const std::string& detail) {
  return digest::of_bytes("trocar-audit-1\n" + previous + "\n" + std::to_string(position) + "\n" + utc + "\n" + actor +
                          "\n" + action + "\n" + subject + "\n" + detail);
}

/// The hash joins fields by line breaks: with one in a field, an entry could be read as another one.
bool divides(const std::string& field) {
  return std::any_of(field.begin(), field.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

bool is_hash(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Columns 1 to 6 of position, utc, actor, action, subject, detail, prev_hash.
bool can_be_divided(const sql::Statement& row) {
  for (int column = 1; column <= 5; ++column)
    if (divides(row.text(column))) return false;
  return row.text(6).empty() ? row.integer(0) == 1 : is_hash(row.text(6));
}

/// @param after, @param up_to entries between which it is looked at.
void check_links(sqlite3* connection, std::vector<std::string>& problems, std::int64_t after = 0,
                 std::int64_t up_to = std::numeric_limits<std::int64_t>::max()) {
  sql::Statement rows(connection,
                      "SELECT position, utc, actor, action, subject, detail, prev_hash, row_hash FROM audit"
                      " WHERE position > ? AND position <= ? ORDER BY position");
  rows.bind(after == 0 ? std::numeric_limits<std::int64_t>::min() : after).bind(up_to);
  std::string previous = after > 0 ? audit_hash(connection, after) : "";
  std::int64_t expected = after + 1;
  while (rows.step()) {
    const std::int64_t position = rows.integer(0);
    const std::string name = "entry " + std::to_string(position) + " (" + rows.text(3) + ")";
    if (position < 1) {
      problems.push_back(name + " stands before the first: it came in by another way");
      continue;
    }
    if (position != expected)
      problems.push_back("before " + name + ": entries are missing");
    else if (rows.text(6) != previous)
      problems.push_back(name + " does not follow the entry before it");
    if (!can_be_divided(rows))
      problems.push_back(name + " has a line break in a field, or no hash before it: it could be read as another one");
    if (hash_of(rows.text(6), position, rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5)) !=
        rows.text(7)) {
      problems.push_back(name + " was changed");
    }
    previous = rows.text(7);
    expected = position + 1;
  }
}

/// Every entry by the key that the trail named last before it. The last one's signature holds all before it as well,
/// but says nothing of who wrote them: the program goes on from what it finds.
void check_signatures(sqlite3* connection, std::vector<std::string>& problems) {
  const std::vector<AnnouncedKey> keys = announced_keys(connection);
  if (keys.empty() && *sqlite3_db_filename(connection, "main") != '\0')
    problems.push_back(
        "no entry names the station's key, as the first of every record on disk does: it was taken away");
  auto next = keys.begin();
  std::string holder;
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> bad;  // words: the first such entry, how many follow
  const auto tell = [&bad](const std::string& words, std::int64_t position) {
    const auto [at, first] = bad.try_emplace(words, position, 0);
    if (!first) ++at->second.second;
  };
  sql::Statement rows(connection, "SELECT position, row_hash, signature FROM audit ORDER BY position");
  while (rows.step()) {
    for (; next != keys.end() && next->position <= rows.integer(0); ++next) holder = next->public_key;
    if (holder.empty()) continue;  // of before schema 2
    if (rows.text(2).empty())
      tell("is not signed with the station's key", rows.integer(0));
    else if (!signature_holds(holder, head_text(rows.text(1)), rows.text(2)))
      tell("was not signed with the station's key", rows.integer(0));
  }
  for (const auto& [words, entries] : bad)
    problems.push_back("entry " + std::to_string(entries.first) + " " + words +
                       (entries.second > 0 ? ", nor " + std::to_string(entries.second) + " of those after it" : ""));
  const auto here = station_key(connection);
  if (here && !keys.empty() && here->public_key() != keys.back().public_key)
    problems.push_back("the key beside the database is not the one that the trail names last");
}

void check_attempts(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement gone(connection,
                      "SELECT subject, utc FROM audit u WHERE action IN (?, ?) AND NOT EXISTS"
                      " (SELECT 1 FROM attempt a WHERE a.uuid = u.subject AND a.row_hash = u.detail)");
  gone.bind(kActionFinished).bind(kActionReplicated);
  while (gone.step()) {
    problems.push_back("attempt " + gone.text(0) + ", finished " + gone.text(1) + ", is missing or was changed");
  }
  sql::Statement unknown(connection,
                         "SELECT uuid FROM attempt a WHERE status <> 'running' AND NOT EXISTS"
                         " (SELECT 1 FROM audit u WHERE u.action IN (?, ?) AND u.subject = a.uuid)");
  unknown.bind(kActionFinished).bind(kActionReplicated);
  while (unknown.step()) problems.push_back("attempt " + unknown.text(0) + " has no entry");
  // That each entry is signed is looked at for all of them.
  sql::Statement elsewhere(connection,
                           "SELECT uuid FROM attempt a WHERE id IN (SELECT attempt_id FROM replica) AND (NOT EXISTS"
                           " (SELECT 1 FROM audit u WHERE u.subject = a.uuid AND u.action = ?1) OR EXISTS"
                           " (SELECT 1 FROM audit u WHERE u.subject = a.uuid AND u.action = ?2)) ORDER BY id");
  elsewhere.bind(kActionReplicated).bind(kActionBegun);
  while (elsewhere.step())
    problems.push_back("attempt " + elsewhere.text(0) +
                       " is kept as another station's, and no signed entry says that it came from there");
}

/// Begun attempts stay, and each that ended or runs since the first such entry has one. A row that ended was compared
/// with what it began with, and is sealed; one that was cut off was not.
void check_begun(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement gone(connection,
                      "SELECT subject, utc FROM audit u WHERE action = ? AND NOT EXISTS"
                      " (SELECT 1 FROM attempt a WHERE a.uuid = u.subject)");
  gone.bind(kActionBegun);
  while (gone.step()) problems.push_back("attempt " + gone.text(0) + ", begun " + gone.text(1) + ", is missing");
  sql::Statement rows(connection,
                      "SELECT uuid FROM attempt a WHERE id NOT IN (SELECT attempt_id FROM replica) AND (cut_off ="
                      " 1 OR NOT EXISTS (SELECT 1 FROM audit u WHERE u.subject = a.uuid AND u.action = ?1)) AND"
                      " (status = 'running' OR (SELECT max(position) FROM audit u WHERE u.subject = a.uuid AND"
                      " u.action = ?2) > (SELECT min(position) FROM audit WHERE action = ?1)) ORDER BY id");
  rows.bind(kActionBegun).bind(kActionFinished);
  while (rows.step())
    if (const std::string problem = begun_problem(connection, rows.text(0)); !problem.empty())
      problems.push_back("attempt " + rows.text(0) + ": " + problem);
}

std::string begun_digest(sqlite3* connection, const std::string& uuid) {
  return digest::of_bytes(identity_of(connection, uuid, ""));
}

/// What else stays as it is while an attempt runs.
std::string running_digest(sqlite3* connection, const std::string& uuid) {
  sql::Statement row(connection,
                     "SELECT exercise_version, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit,"
                     " started_utc, owner_pid, owner_boot, owner_start, recording_path, program, assists, hash_version,"
                     " (SELECT uuid FROM session WHERE id = session_id),"
                     " (SELECT sha256 FROM device_calibration WHERE id = calibration_id) FROM attempt WHERE uuid = ?");
  std::string content = "trocar-running-1\n";
  if (row.bind(uuid).step())
    for (int column = 0; column < row.columns(); ++column) row.append_canonical(column, content);
  return digest::of_bytes(content);
}

/// signature_holds(), a tenth of a millisecond, once for the same three: lists ask of the same entries again and again.
bool held_before(const std::string& holder, const std::string& row_hash, const std::string& signature) {
  constexpr std::size_t kMost = 100000;
  static std::mutex mutex;
  static std::unordered_set<std::string> held;
  const std::string all = holder + '\n' + row_hash + '\n' + signature;
  {
    const std::lock_guard lock(mutex);
    if (held.contains(all)) return true;
  }
  if (!signature_holds(holder, head_text(row_hash), signature)) return false;
  const std::lock_guard lock(mutex);
  if (held.size() >= kMost) held.clear();
  held.insert(all);
  return true;
}

/// Whether that key has signed what the entry says, a row of kEntryColumns.
bool is_signed(const sql::Statement& row, const std::string& key) {
  if (!can_be_divided(row)) return false;
  // The signature is of the hash: what the entry says must be what was hashed.
  const std::string hash =
      hash_of(row.text(6), row.integer(0), row.text(1), row.text(2), row.text(3), row.text(4), row.text(5));
  return hash == row.text(7) && held_before(key, hash, row.text(8));
}

bool signed_by(sqlite3* connection, std::int64_t position, const std::string& key) {
  sql::Statement row(connection, std::string("SELECT ") + kEntryColumns + " FROM audit WHERE position = ?");
  return position >= 1 && row.bind(position).step() && is_signed(row, key);
}

/// Whether the trail up to there is whole: then who signed its last entry vouches for what the others say. Once for the
/// same keys, for it reads all of it.
bool whole_up_to(sqlite3* connection, const std::vector<AnnouncedKey>& keys) {
  static std::mutex mutex;
  static std::set<std::string> whole;
  std::string all = audit_hash(connection, keys.back().position);
  for (const AnnouncedKey& key : keys) all += '\n' + std::to_string(key.position) + ' ' + key.public_key;
  const std::lock_guard lock(mutex);
  if (whole.contains(all)) return true;
  std::vector<std::string> problems;
  check_links(connection, problems, 0, keys.back().position);
  if (problems.empty()) whole.insert(all);
  return problems.empty();
}

/// The keys that count: of those that signed the entry that names them, the ones up to that which lies beside the
/// database. It vouches for those before it; what somebody announced after it is not the station's.
std::vector<AnnouncedKey> trusted_keys(sqlite3* connection) {
  std::vector<AnnouncedKey> keys = announced_keys(connection);
  std::erase_if(keys, [&](const AnnouncedKey& key) { return !signed_by(connection, key.position, key.public_key); });
  const auto here = station_key(connection);
  if (!here) return keys;
  const std::string own = here->public_key();
  while (!keys.empty() && keys.back().public_key != own) keys.pop_back();
  const bool vouched = !keys.empty() && (keys.back().position == 1 || whole_up_to(connection, keys));
  return vouched ? keys : std::vector<AnnouncedKey>{{1, own}};
}

/// The last of them that was named up to that entry; "": none.
std::string key_among(const std::vector<AnnouncedKey>& keys, std::int64_t position) {
  std::string holder;
  for (const AnnouncedKey& key : keys)
    if (key.position <= position) holder = key.public_key;
  return holder;
}

/// Entry of the attempt that began; position 0: none.
struct Beginning {
  std::int64_t position = 0;
  std::string digests;
};

/// Whether the row is still what the entry tells.
bool row_is(sqlite3* connection, const std::string& uuid, const Beginning& began) {
  const std::string now = begun_digest(connection, uuid);
  if (began.digests.size() == now.size()) return began.digests == now;  // an earlier program told the first only
  if (!began.digests.starts_with(now + " ") || !is_hash(began.digests.substr(now.size() + 1))) return false;
  sql::Statement running(connection, "SELECT 1 FROM attempt WHERE uuid = ? AND status = 'running'");
  return !running.bind(uuid).step() || began.digests == now + " " + running_digest(connection, uuid);
}

/// Whether what is written now is signed with a key that the trail names.
bool signs(sqlite3* connection) {
  const auto here = station_key(connection);
  return here && is_named(*here, announced_keys(connection));
}

bool stands_before_the_first(sqlite3* connection) {
  return sql::query_integer(connection, "SELECT EXISTS (SELECT 1 FROM audit WHERE position < 1)") != 0;
}

Beginning beginning_of(sqlite3* connection, const std::string& uuid) {
  sql::Statement entry(connection, "SELECT position, detail FROM audit WHERE subject = ? AND action = ?");
  if (!entry.bind(uuid).bind(kActionBegun).step()) return {};
  return {entry.integer(0), entry.text(1)};
}

std::string field_at(sqlite3* connection, const char* query, std::int64_t position) {
  sql::Statement row(connection, query);
  return row.bind(position).step() ? row.text(0) : "";
}

}  // namespace

std::string head_text(const std::string& row_hash) { return "trocar-audit-head-1\n" + row_hash; }

void append_audit(sqlite3* connection, const std::string& action, const std::string& subject, const std::string& detail,
                  const std::string& actor) {
  if (stands_before_the_first(connection))
    throw InputError("audit trail: entries stand before the first, so nothing is written; see trocar db check");
  const AuditHead head = audit_head(connection);
  if (head.position > 0) require_hash(head.row_hash, "the trail's last entry");
  for (const std::string& field : {action, subject, detail, actor})
    if (divides(field)) throw InputError("audit trail, \"" + action + "\": a control character in what it is about");
  const std::string utc = utc_now();
  sql::Statement insert(connection, "INSERT INTO audit VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  const std::string hash = hash_of(head.row_hash, head.position + 1, utc, actor, action, subject, detail);
  const auto key = station_key(connection);
  insert.bind(head.position + 1).bind(utc).bind(actor).bind(action).bind(subject).bind(detail).bind(head.row_hash);
  insert.bind(hash).bind(key ? key->sign(head_text(hash)) : "").run();
}

void audit_begun(sqlite3* connection, const std::string& uuid) {
  append_audit(connection, kActionBegun, uuid, begun_digest(connection, uuid) + " " + running_digest(connection, uuid));
}

std::string begun_problem(sqlite3* connection, const std::string& uuid) {
  sql::Statement any(connection, "SELECT 1 FROM audit WHERE action = ? LIMIT 1");
  if (!any.bind(kActionBegun).step()) return "";
  const Beginning began = beginning_of(connection, uuid);
  if (began.position == 0) return "no entry says that it began: its row was put in";
  if (!entry_signed(connection, began.position))
    return "the entry of its beginning is not signed with the station's key";
  return row_is(connection, uuid, began) ? "" : "its row is not as it began: it was changed";
}

bool as_begun(sqlite3* connection, const std::string& uuid) {
  const std::string problem = begun_problem(connection, uuid);
  if (problem.empty()) return true;
  const Beginning began = beginning_of(connection, uuid);
  return began.position > 0 && !signs(connection) && row_is(connection, uuid, began);
}

bool began_here(sqlite3* connection, const std::string& uuid) { return beginning_of(connection, uuid).position > 0; }

bool came_from_elsewhere(sqlite3* connection, const std::string& uuid) {
  sql::Statement entry(connection, "SELECT position FROM audit WHERE subject = ? AND action = ?");
  return !began_here(connection, uuid) && entry.bind(uuid).bind(kActionReplicated).step() &&
         entry_signed(connection, entry.integer(0));
}

void require_hash(const std::string& hash, const std::string& whose) {
  if (!is_hash(hash)) throw InputError(whose + " has no hash: nothing is built on it; see trocar db check");
}

bool trail_whole(sqlite3* connection, std::int64_t after) {
  std::vector<std::string> problems;
  check_links(connection, problems, after);
  const std::int64_t last = audit_head(connection).position;
  return problems.empty() && !stands_before_the_first(connection) &&
         (last == 0 || !station_key(connection) || entry_signed(connection, last));
}

bool trail_goes_on(sqlite3* connection) {
  const std::string file = sqlite3_db_filename(connection, "main");
  if (file.empty()) return true;
  static std::mutex mutex;
  static std::map<std::string, AuditHead> farthest;  // by file and first entry: another record may come to lie there
  const std::lock_guard lock(mutex);
  AuditHead& seen = farthest[file + '\n' + audit_hash(connection, 1)];
  if (seen.position > 0 && audit_hash(connection, seen.position) != seen.row_hash) return false;
  seen = audit_head(connection);
  return true;
}

AuditHead audit_head(sqlite3* connection) {
  sql::Statement last(connection, "SELECT position, row_hash FROM audit ORDER BY position DESC LIMIT 1");
  if (!last.step()) return {};
  return {last.integer(0), last.text(1)};
}

std::string key_at(sqlite3* connection, std::int64_t position) { return key_among(trusted_keys(connection), position); }

std::string key_of_attempt(sqlite3* connection, const std::string& uuid) {
  const std::int64_t began = beginning_of(connection, uuid).position;
  return began > 0 ? key_at(connection, began) : "";
}

bool entry_signed(sqlite3* connection, std::int64_t position) {
  if (position < 1) return false;
  const std::string holder = key_at(connection, position);
  if (holder.empty()) return true;
  return signed_by(connection, position, holder);
}

bool SignedEntries::contains(const sql::Statement& entry) {
  if (entry.integer(0) < 1) return false;
  if (!keys_) keys_ = trusted_keys(connection_);
  const std::string holder = key_among(*keys_, entry.integer(0));
  return holder.empty() || is_signed(entry, holder);
}

std::string audit_hash(sqlite3* connection, std::int64_t position) {
  return field_at(connection, "SELECT row_hash FROM audit WHERE position = ?", position);
}

std::string audit_action(sqlite3* connection, std::int64_t position) {
  return field_at(connection, "SELECT action FROM audit WHERE position = ?", position);
}

std::vector<ClockSetBack> clock_set_back(sqlite3* connection) {
  std::vector<ClockSetBack> out;
  sql::Statement rows(connection,
                      "SELECT position, before, utc FROM (SELECT position, utc, lag(utc) OVER (ORDER BY position) AS"
                      " before FROM audit) WHERE utc < before AND (julianday(before) - julianday(utc)) * 86400 > ?"
                      " ORDER BY position");
  rows.bind(kClockStep_s);
  while (rows.step()) out.push_back({rows.integer(0), rows.text(1), rows.text(2)});
  return out;
}

std::vector<std::string> audit_remarks(sqlite3* connection) {
  std::vector<std::string> out;
  for (const ClockSetBack& step : clock_set_back(connection))
    out.push_back("the clock was set back before entry " + std::to_string(step.position) + ", from " + step.before_utc +
                  " to " + step.utc + ": entries and decisions hold in their order, whatever times they bear");
  sql::Statement older(connection, "SELECT position FROM audit WHERE action = ? AND detail GLOB '*' || ?");
  older.bind(kActionMigrated).bind(kKeyLayThere);
  while (older.step())
    out.push_back("when entry " + std::to_string(older.integer(0)) +
                  " was made the station's key lay there already, and the record was of before signatures: so looks"
                  " one that somebody put in the place of the station's (or a migration that was broken off before)");
  return out;
}

std::vector<std::string> check_audit(sqlite3* connection) {
  std::vector<std::string> problems;
  check_links(connection, problems);
  check_signatures(connection, problems);
  check_attempts(connection, problems);
  check_begun(connection, problems);
  // AUTOINCREMENT counts every attempt that was ever begun, also one that never finished.
  if (sql::query_integer(connection,
                         "SELECT coalesce((SELECT seq FROM sqlite_sequence WHERE name = 'attempt'), 0) >"
                         " coalesce((SELECT max(id) FROM attempt), 0)") != 0) {
    problems.push_back("the newest attempts were deleted: the counter of attempts is ahead of them");
  }
  return problems;
}

}  // namespace trocar
