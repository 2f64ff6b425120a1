#include "trainees/desk/queries/record_views.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <filesystem>
#include <tuple>

#include "trainees/integrity/audit.h"
#include "trainees/progress/programme.h"
#include "trainees/records/erasure.h"
#include "trainees/records/record_backup.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDays = 36500;

std::uintmax_t bytes_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : size;
}

std::uintmax_t bytes_within(const fs::path& folder) {
  std::uintmax_t out = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file(error)) out += bytes_of(it->path());
  return out;
}

std::string utc_of(const fs::path& file) {
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  if (error) return "";
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::file_clock::to_sys(changed)));
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::vector<BackupFile> backups_of(const fs::path& database) {
  std::vector<BackupFile> out;
  const std::string beginning = database.filename().string() + ".";
  std::error_code error;
  for (fs::directory_iterator it(database.parent_path(), error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(beginning) && name.ends_with(".backup"))
      out.push_back({name, utc_of(it->path()), bytes_of(it->path()) + bytes_within(recordings_folder(it->path()))});
  }
  std::sort(out.begin(), out.end(),
            [](const BackupFile& a, const BackupFile& b) { return std::tie(b.utc, b.name) < std::tie(a.utc, a.name); });
  return out;
}

constexpr const char* kMatching = " WHERE (?1 = '' OR u.actor = ?1) AND (?2 = '' OR u.action = ?2)";

std::string name_of_actor(const std::string& actor, const std::string& known) {
  if (actor == "trocar") return "the program";
  return known.empty() ? "an account that is gone (" + actor.substr(0, 8) + ")" : known;
}

/// By the subject's UUID: words, and a page. What was erased keeps a code that tells nobody.
constexpr const char* kSubjects[] = {
    "SELECT 'attempt no. ' || a.id || ' of ' || k.code, '/attempt/' || a.uuid FROM attempt a JOIN known_trainee k ON"
    " k.id = a.trainee_id WHERE a.uuid = ?",
    "SELECT k.code, '/trainee/' || k.code FROM trainee t JOIN known_trainee k ON k.id = t.id WHERE t.uuid = ?",
    "SELECT 'signature on no. ' || a.id || ' of ' || k.code, '/attempt/' || a.uuid FROM signature s JOIN attempt a ON"
    " a.id = s.attempt_id JOIN known_trainee k ON k.id = a.trainee_id WHERE s.uuid = ?",
    "SELECT 'note to ' || k.code, '/trainee/' || k.code || '#notes' FROM note n JOIN known_trainee k ON"
    " k.id = n.trainee_id WHERE n.uuid = ?",
    "SELECT 'decision on no. ' || a.id || ' of ' || k.code, '/attempt/' || a.uuid FROM verdict_override o JOIN attempt "
    "a"
    " ON a.id = o.attempt_id JOIN known_trainee k ON k.id = a.trainee_id WHERE o.uuid = ?",
    "SELECT 'rating of no. ' || a.id || ' of ' || k.code, '/attempt/' || a.uuid FROM rating r JOIN attempt a ON"
    " a.id = r.attempt_id JOIN known_trainee k ON k.id = a.trainee_id WHERE r.uuid = ?",
    "SELECT 'certificate of ' || k.code || ', ' || c.exercise_id || ' ' || c.level, '/trainee/' || k.code ||"
    " '#certificates' FROM certificate c JOIN known_trainee k ON k.id = c.trainee_id WHERE c.uuid = ?",
    "SELECT 'certificate of ' || k.code || ', ' || c.exercise_id || ' ' || c.level, '/trainee/' || k.code ||"
    " '#certificates' FROM revocation r JOIN certificate c ON c.id = r.certificate_id JOIN known_trainee k ON"
    " k.id = c.trainee_id WHERE r.uuid = ?",
    "SELECT 'account ' || login, '/accounts' FROM account WHERE uuid = ?",
    "SELECT name || ', version ' || version, '/curriculum', toml, name FROM curriculum WHERE uuid = ?",
    "SELECT 'benchmark of ' || exercise_id || ' ' || level, '/curriculum' FROM benchmark WHERE uuid = ?",
    "SELECT CASE active WHEN 1 THEN 'reactivated: ' ELSE 'deactivated: ' END || k.code, '/trainee/' || k.code FROM"
    " standing s JOIN known_trainee k ON k.id = s.trainee_id WHERE s.uuid = ?",
    "SELECT 'programme ' || programme || ' for ' || coalesce(k.code, 'group ' || group_name), '/programmes' FROM"
    " assignment a LEFT JOIN known_trainee k ON k.id = a.trainee_id WHERE a.uuid = ?",
    "SELECT 'programme ' || programme || ' for ' || coalesce(k.code, 'group ' || group_name), '/programmes' FROM"
    " withdrawal w JOIN assignment a ON a.id = w.assignment_id LEFT JOIN known_trainee k ON k.id = a.trainee_id"
    " WHERE w.uuid = ?",
    "SELECT 'consent of ' || k.code, '/trainee/' || k.code FROM consent c JOIN known_trainee k ON k.id = c.trainee_id"
    " WHERE c.uuid = ?"};

void add_subjects(sqlite3* connection, std::vector<AuditEntry>& entries) {
  constexpr std::size_t kUuid = 36;
  std::deque<sql::Statement> queries;
  for (const char* query : kSubjects) queries.emplace_back(connection, query);
  for (AuditEntry& entry : entries) {
    if (entry.subject.size() != kUuid) continue;
    for (sql::Statement& query : queries) {
      if (query.bind(entry.subject).step()) {
        entry.words = query.text(0);
        entry.page = query.text(1);
        if (entry.page == "/curriculum" && entry.action == "curriculum added" && is_programme(query.text(2))) {
          entry.words = "programme " + entry.words;
          entry.page = "/programme?name=" + url_part(query.text(3));
        }
      }
      query.run();
      if (!entry.words.empty()) break;
    }
  }
}

constexpr const char* kActorName =
    "coalesce((SELECT a.name || ', ' || a.login FROM account a WHERE a.uuid = u.actor), '')";

}  // namespace

AccountsView accounts_view(const Database& database, const std::string& own_login) {
  AccountsView out;
  sqlite3* connection = database.connection();
  sql::Statement rows(
      connection,
      "SELECT a.uuid, a.login, a.name, a.role, coalesce(t.code, ''), a.created_utc, coalesce(a.disabled_utc, '')"
      " FROM account a LEFT JOIN known_trainee t ON t.id = a.trainee_id ORDER BY a.login");
  while (rows.step())
    out.accounts.push_back({rows.text(0), rows.text(1), rows.text(2), role_named(rows.text(3)).value_or(Role::kTrainee),
                            rows.text(4), rows.text(5), rows.text(6)});
  sql::Statement codes(
      connection,
      "SELECT code FROM person p WHERE NOT EXISTS (SELECT 1 FROM account a WHERE a.trainee_id = p.trainee_id)"
      " ORDER BY code");
  while (codes.step()) out.without.push_back(codes.text(0));
  out.own_login = own_login;
  out.first = sql::query_integer(connection,
                                 "SELECT NOT EXISTS (SELECT 1 FROM account WHERE role = 'administrator'"
                                 " AND password <> '' AND disabled_utc IS NULL)") != 0;
  return out;
}

RecordView record_view(const Database& database, const std::string& program) {
  RecordView out;
  out.program = program;
  out.schema = database.schema_version();
  out.head = database.head();
  sqlite3* connection = database.connection();
  out.set_back = clock_set_back(connection).size();
  const std::pair<const char*, const char*> kCounts[] = {
      {"trainees", "SELECT count(*) FROM person"},
      {"attempts", "SELECT count(*) FROM attempt WHERE status <> 'running'"},
      {"attempts running", "SELECT count(*) FROM attempt WHERE status = 'running'"},
      {"notes", "SELECT count(*) FROM note"},
      {"signatures", "SELECT count(*) FROM signature"},
      {"certificates", "SELECT count(*) FROM certificate"},
      {"accounts", "SELECT count(*) FROM account"},
      {"entries of the audit trail", "SELECT count(*) FROM audit"}};
  for (const auto& [what, query] : kCounts) out.counts.emplace_back(what, sql::query_integer(connection, query));
  if (database.in_memory()) return out;
  out.file = database.file().filename().string();
  out.database_bytes = bytes_of(database.file()) + bytes_of(database.file().string() + "-wal");
  out.recordings_bytes = recordings_size(database);
  out.backups = backups_of(database.file());
  return out;
}

AuditView audit_view(const Database& database, const AuditQuestion& asked) {
  AuditView out;
  out.asked = asked;
  sqlite3* connection = database.connection();
  {
    sql::Statement count(connection, std::string("SELECT count(*) FROM audit u") + kMatching);
    if (count.bind(asked.person).bind(asked.action).step()) out.total = count.integer(0);
  }
  const std::int64_t pages = std::max<std::int64_t>(1, (out.total + kAuditOnPage - 1) / kAuditOnPage);
  out.asked.page = static_cast<int>(std::clamp<std::int64_t>(asked.page, 1, pages));
  constexpr int kName = 9;  // after those of kEntryColumns
  sql::Statement rows(connection, std::string("SELECT ") + kEntryColumns + ", " + kActorName + " FROM audit u" +
                                      kMatching + " ORDER BY u.position DESC LIMIT ?3 OFFSET ?4");
  rows.bind(asked.person).bind(asked.action).bind(kAuditOnPage).bind((out.asked.page - 1) * kAuditOnPage);
  SignedEntries entries(connection);
  while (rows.step()) {
    out.entries.push_back({rows.integer(0), rows.text(1), name_of_actor(rows.text(2), rows.text(kName)), rows.text(3),
                           rows.text(4), rows.text(5), !rows.text(kName).empty()});
    out.entries.back().is_signed = entries.contains(rows);
  }
  add_subjects(connection, out.entries);
  const std::vector<ClockSetBack> steps = clock_set_back(connection);
  out.set_back = steps.size();
  for (const ClockSetBack& step : steps) {
    const auto entry = std::find_if(out.entries.begin(), out.entries.end(),
                                    [&](const AuditEntry& e) { return e.position == step.position; });
    if (entry != out.entries.end()) entry->before_utc = step.before_utc;
  }
  sql::Statement persons(connection, "SELECT u.actor, " + std::string(kActorName) +
                                         " FROM (SELECT DISTINCT actor FROM audit) u ORDER BY 2, 1");
  while (persons.step()) out.persons.emplace_back(persons.text(0), name_of_actor(persons.text(0), persons.text(1)));
  sql::Statement actions(connection, "SELECT DISTINCT action FROM audit ORDER BY 1");
  while (actions.step()) out.actions.push_back(actions.text(0));
  return out;
}

RetentionView retention_view(Database& database, const std::string& days, const std::string& now_utc) {
  RetentionView out;
  if (!days.empty()) {
    char* end = nullptr;
    const long number = std::strtol(days.c_str(), &end, 10);
    if (end == days.c_str() || *end != '\0' || number < 1 || number > kMostDays) {
      out.problem = "Give a number of days from 1 to " + std::to_string(kMostDays) + ".";
      return out;
    }
    out.days = static_cast<int>(number);
  }
  const TraineeStore trainees(database);
  for (const std::string& code : older_than(database, out.days, now_utc))
    if (const auto trainee = trainees.find(code))
      out.lines.push_back({trainee->code, trainee->last_utc, trainee->created_utc, trainee->attempts});
  return out;
}

}  // namespace trocar::review
