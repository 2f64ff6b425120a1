#include "app/cli/records/db_command.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/progress_display.h"
#include "app/cli/records/central_command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/records/store_json.h"
#include "app/session/keeping/recording_check.h"
#include "haptics/input_error.h"
#include "trainees/exchange/sync/synchronise.h"
#include "trainees/files/size_text.h"
#include "trainees/files/write_file.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/witness.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/record_backup.h"

namespace trocar {

namespace {

constexpr int kProblemsFound = 2;

std::filesystem::path default_backup(const Database& database) {
  std::string time = utc_now();
  std::replace(time.begin(), time.end(), ':', '-');  // colons are not allowed in names on every file system
  return database.file().string() + "." + time + ".backup";
}

std::string key_since(const Database& database) {
  const auto keys = station_keys(database);
  if (keys.empty()) return "";
  return ", key " + key_words(keys.back().public_key) + " since entry " + std::to_string(keys.back().position);
}

std::vector<std::string> told_by_witness(const Database& database, const DbOptions& options) {
  if (options.witness.empty()) return {};
  if (options.witness.find("://") == std::string::npos) return check_witness(database, options.witness);
  return check_central_witness(database, {options.witness, options.password_file, options.weak_tls});
}

}  // namespace

int db_check(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const AttemptStore attempts(database);
  std::vector<std::string> problems = database.check();
  for (const std::string& problem : attempts.check_recordings()) problems.push_back(problem);
  if (!options.quick) {
    ProgressDisplay progress(err, error_is_terminal());
    const auto going = [&](std::size_t done, std::size_t all) {
      progress.show("recordings", static_cast<double>(done) / static_cast<double>(all));
      return true;
    };
    for (const std::string& problem : check_by_recordings(database, {0, going})) problems.push_back(problem);
  }
  for (const std::string& problem : told_by_witness(database, options)) problems.push_back(problem);
  const std::vector<std::string> remarks = audit_remarks(database.connection());
  if (options.json) {
    out << problems_json(database, problems, remarks);
    return problems.empty() ? 0 : kProblemsFound;
  }
  if (problems.empty()) {
    out << database.file().string() << ": sound (schema " << database.schema_version() << ", " << attempts.list().size()
        << " attempts, head " << database.head() << key_since(database) << ")\n";
  } else {
    for (const std::string& problem : problems) out << problem << '\n';
  }
  for (const std::string& remark : remarks) out << "remark: " << remark << '\n';
  return problems.empty() ? 0 : kProblemsFound;
}

int db_backup(const DbOptions& options, std::ostream& out, std::ostream& err) {
  const Database database = open_database(options.database, OpenMode::kExisting, err);
  const auto target = options.output.empty() ? default_backup(database) : options.output;
  const BackupReport made =
      back_up(database, target, options.leave_recordings ? BackedUp::kWithoutRecordings : BackedUp::kWithRecordings);
  out << target.string() << '\n';
  if (options.leave_recordings)
    err << "without its recordings (" << size_text(recordings_size(database))
        << "): elsewhere the copy has scores and no motion, and db check says that they are missing\n";
  else if (!made.recordings.empty())
    err << made.recordings.string() << ": " << made.files << " recordings, " << size_text(made.bytes)
        << "; they belong to the copy and move with it\n";
  for (const std::filesystem::path& file : made.missing)
    err << file.string() << ": an attempt names this recording, but it is not there and in no backup made now\n";
  return 0;
}

int db_anchor(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  database.renew_anchor();
  out << "anchored at " << database.head() << '\n';
  return 0;
}

int db_key(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  if (options.renew) renew_station_key(database);
  const auto keys = station_keys(database);
  if (keys.empty()) throw InputError(database.file().string() + ": has no key yet; trocar db key --renew makes one");
  out << keys.back().public_key << '\n';
  return 0;
}

int db_head(const DbOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const std::string text = exported_head(database);
  if (options.output.empty()) {
    out << text;
    return 0;
  }
  write_file(options.output, text);
  out << options.output.string() << '\n';
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

void add_db_upkeep(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<DbOptions>();
  DbOptions& o = *given;
  CLI::App* check =
      add_command(parent, "check", "File, schema, references, hash chain, audit trail, what people wrote, recordings",
                  chosen, [given] { return db_check(*given, std::cout, std::cerr); });
  check->add_flag("--json", o.json, "As JSON");
  check->add_flag("--quick", o.quick, "Recordings by their digests, not graded again");
  check->add_option("--witness", o.witness,
                    "A head that 'db head --export' wrote before, or postgresql://USER@HOST/DATABASE of a central"
                    " database");
  add_central_access(*check, o.password_file, o.weak_tls);
  CLI::App* backup = add_command(parent, "backup", "Consistent copy, recordings included", chosen,
                                 [given] { return db_backup(*given, std::cout, std::cerr); });
  backup->add_option("-o,--out", o.output, "File (default: beside the database)")->check(writable_path());
  backup->add_flag("--without-recordings", o.leave_recordings,
                   "Leave out the recordings, which are most of a record's size");
  CLI::App* migrate = add_command(parent, "migrate", "Bring to this program's schema", chosen,
                                  [given] { return db_migrate(*given, std::cout, std::cerr); });
  CLI::App* anchor = add_command(parent, "anchor", "Begin a new anchor file where the old one was lost", chosen,
                                 [given] { return db_anchor(*given, std::cout, std::cerr); });
  CLI::App* key = add_command(parent, "key", "The station's public key", chosen,
                              [given] { return db_key(*given, std::cout, std::cerr); });
  key->add_flag("--renew", o.renew, "A new one, where the old one was lost or seen by others");
  CLI::App* head = add_command(parent, "head", "Head of the audit trail, signed: to be kept elsewhere as a witness",
                               chosen, [given] { return db_head(*given, std::cout, std::cerr); });
  head->add_option("--export", o.output, "File")->check(writable_path());
  CLI::App* rubric = add_command(parent, "rubric", "Print the exercise file that attempts were graded by", chosen,
                                 [given] { return db_rubric(*given, std::cout, std::cerr); });
  rubric->add_option("sha256", o.rubric, "At least 4 digits of its sha256")->required();
  for (CLI::App* command : {check, backup, migrate, anchor, key, head, rubric})
    command->add_option("--db", o.database, "Database file");
}

}  // namespace trocar
