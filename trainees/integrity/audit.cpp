#include "trainees/integrity/audit.h"

#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <utility>

#include "haptics/digest/digest.h"
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

void check_links(sqlite3* connection, std::vector<std::string>& problems) {
  sql::Statement rows(connection,
                      "SELECT position, utc, actor, action, subject, detail, prev_hash, row_hash FROM audit"
                      " ORDER BY position");
  std::string previous;
  std::int64_t expected = 1;
  while (rows.step()) {
    const std::int64_t position = rows.integer(0);
    const std::string name = "entry " + std::to_string(position) + " (" + rows.text(3) + ")";
    if (position != expected)
      problems.push_back("before " + name + ": entries are missing");
    else if (rows.text(6) != previous)
      problems.push_back(name + " does not follow the entry before it");
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

std::string field_at(sqlite3* connection, const char* query, std::int64_t position) {
  sql::Statement row(connection, query);
  return row.bind(position).step() ? row.text(0) : "";
}

}  // namespace

std::string head_text(const std::string& row_hash) { return "trocar-audit-head-1\n" + row_hash; }

void append_audit(sqlite3* connection, const std::string& action, const std::string& subject, const std::string& detail,
                  const std::string& actor) {
  const AuditHead head = audit_head(connection);
  const std::string utc = utc_now();
  sql::Statement insert(connection, "INSERT INTO audit VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  const std::string hash = hash_of(head.row_hash, head.position + 1, utc, actor, action, subject, detail);
  const auto key = station_key(connection);
  insert.bind(head.position + 1).bind(utc).bind(actor).bind(action).bind(subject).bind(detail).bind(head.row_hash);
  insert.bind(hash).bind(key ? key->sign(head_text(hash)) : "").run();
}

void audit_begun(sqlite3* connection, const std::string& uuid) {
  append_audit(connection, kActionBegun, uuid, begun_digest(connection, uuid));
}

std::string begun_problem(sqlite3* connection, const std::string& uuid) {
  sql::Statement any(connection, "SELECT 1 FROM audit WHERE action = ? LIMIT 1");
  if (!any.bind(kActionBegun).step()) return "";
  sql::Statement entry(connection, "SELECT detail, position FROM audit WHERE subject = ? AND action = ?");
  if (!entry.bind(uuid).bind(kActionBegun).step()) return "no entry says that it began: its row was put in";
  if (!entry_signed(connection, entry.integer(1)))
    return "the entry of its beginning is not signed with the station's key";
  return entry.text(0) == begun_digest(connection, uuid) ? "" : "its row is not as it began: it was changed";
}

AuditHead audit_head(sqlite3* connection) {
  sql::Statement last(connection, "SELECT position, row_hash FROM audit ORDER BY position DESC LIMIT 1");
  if (!last.step()) return {};
  return {last.integer(0), last.text(1)};
}

bool entry_signed(sqlite3* connection, std::int64_t position) {
  const std::vector<AnnouncedKey> keys = announced_keys(connection);
  if (keys.empty() || position < keys.front().position) return true;
  sql::Statement row(connection, "SELECT row_hash, signature FROM audit WHERE position = ?");
  return row.bind(position).step() && std::any_of(keys.begin(), keys.end(), [&row](const AnnouncedKey& key) {
           return signature_holds(key.public_key, head_text(row.text(0)), row.text(1));
         });
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
