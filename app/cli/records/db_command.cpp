#include "app/cli/records/db_command.h"

#include <algorithm>
#include <ostream>

#include "app/cli/records/open_database.h"
#include "app/cli/records/store_json.h"
#include "trainees/records/attempt_identity.h"

namespace trocar {

namespace {

constexpr int kProblemsFound = 2;

std::filesystem::path default_backup(const Database& database) {
  std::string time = utc_now();
  std::replace(time.begin(), time.end(), ':', '-');  // colons are not allowed in names on every file system
  return database.file().string() + "." + time + ".backup";
}

}  // namespace

int db_check(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const AttemptStore attempts(database);
  std::vector<std::string> problems = database.check();
  for (const std::string& problem : attempts.check_recordings()) problems.push_back(problem);
  if (options.json) {
    out << problems_json(database, problems);
  } else if (problems.empty()) {
    out << database.file().string() << ": sound (schema " << database.schema_version() << ", " << attempts.list().size()
        << " attempts, head " << database.head() << ")\n";
  } else {
    for (const std::string& problem : problems) out << problem << '\n';
  }
  return problems.empty() ? 0 : kProblemsFound;
}

int db_backup(const DbOptions& options, std::ostream& out, std::ostream& err) {
  const Database database = open_database(options.database, OpenMode::kExisting, err);
  const auto target = options.output.empty() ? default_backup(database) : options.output;
  database.backup(target);
  out << target.string() << '\n';
  return 0;
}

int db_anchor(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  database.renew_anchor();
  out << "anchored at " << database.head() << '\n';
  return 0;
}

int db_rubric(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  out << AttemptStore(database).exercise_text(options.rubric);
  return 0;
}

int db_migrate(const DbOptions& options, std::ostream& out, std::ostream& err) {
  const Database database = open_database(options.database, OpenMode::kExisting, err);
  const MigrationReport& migration = database.migration();
  if (migration.from == migration.to) {
    out << "schema " << migration.to << ", up to date\n";
  } else {
    out << "schema " << migration.from << " -> " << migration.to << '\n';
  }
  return 0;
}

}  // namespace trocar
