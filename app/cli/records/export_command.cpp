#include "app/cli/records/export_command.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/command.h"
#include "app/cli/records/lrs_command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/text_table.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "trainees/exchange/export/jigsaws.h"
#include "trainees/exchange/export/table_export.h"
#include "trainees/exchange/export/trace_tables.h"
#include "trainees/exchange/export/xapi_export.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/cohort.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using Shape = PendingExport::Shape;

std::string bytes_of(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw InputError(file.string() + ": no such file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw EnvironmentError(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// By the rules that the attempt was graded with, which an older program may have written.
std::optional<double> pass_mark(const std::string& toml, const std::string& level) {
  try {
    return find_level(parse_exercise(toml, "ruleset"), level).rubric.pass_at;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string file_name_of(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
  return name;
}

/// The recording that an attempt was graded from. @throws InputError: none, or another one.
Recording recording_of(const AttemptResult& attempt) {
  if (attempt.recording_path.empty()) throw InputError("it was not recorded");
  Recording recording = read_recording(attempt.recording_path);
  if (recording.sha256 != attempt.recording_sha256)
    throw InputError("its recording is not the one that was graded (its sha256 differs)");
  return recording;
}

/// @param write an attempt's files; what it throws leaves the attempt out. @return attempts written
/// @throws InputError: none
template <class Write>
int each_recording(Database& database, const ExportChoice& choice, std::ostream& err, Write write) {
  int written = 0;
  for (const std::int64_t row : choice.attempts) {
    const AttemptResult attempt = AttemptStore(database).load(row);
    try {
      write(attempt, recording_of(attempt));
      ++written;
    } catch (const InputError& error) {
      err << "trocar: attempt " << attempt.uuid << " is left out: " << error.what() << '\n';
    }
  }
  if (written == 0) throw InputError("none of the attempts has a recording to export");
  return written;
}

/// All that a score is made from, for another program to make it again.
int write_traces(Database& database, const ExportChoice& choice, PendingExport& folder, std::ostream& err) {
  return each_recording(database, choice, err, [&](const AttemptResult& attempt, const Recording& recording) {
    if (!recording.end) throw InputError("its recording was cut off");
    require_name_of_attempt(attempt.uuid);
    const RecordedSetup recorded = parse_scene_json(recording.session, attempt.recording_path);
    const Exercise& exercise = recorded.setup.exercise;
    const std::string at = file_name_of(attempt.exercise_id) + "_" + attempt.uuid + "/";
    write_trace_csv(rebuild_trace(recording.ticks, recording.rate_hz), folder.file(at + "trace.csv"));
    write_events_csv(recording.events, folder.file(at + "events.csv"));
    folder.file(at + "context.json") << recording.end->summary_json << '\n';
    folder.file(at + "rubric.json") << rubric_json(rubric_for(find_level(exercise, recorded.setup.level), recorded.daq))
                                    << '\n';
    folder.file(at + "exercise.toml") << exercise.text;
    folder.file(at + "result.json") << attempt_json(attempt);
  });
}

void check_options(const ExportOptions& options) {
  const std::string& f = options.format;
  if (f != "csv" && f != "json" && f != "xapi" && f != "traces")
    throw InputError("export " + f + ": csv, json, xapi and traces are known");
  if (f != "xapi" && (!options.home_page.empty() || !options.cmi5.empty()))
    throw InputError("--home-page and --cmi5 belong to xapi");
  if (!options.home_page.empty() && !options.cmi5.empty())
    throw InputError("with --cmi5 the home page is that of the launch");
}

void write_statements(const ExportOptions& options, Database& database, const ExportChoice& choice,
                      std::ostream& file) {
  if (!options.cmi5.empty()) {
    const Cmi5Launch launch = parse_cmi5_launch(bytes_of(options.cmi5), options.cmi5.string());
    return write_cmi5(database, choice, launch, remembered_pass_mark(), file);
  }
  XapiSetting setting;
  if (!options.home_page.empty()) setting.home_page = options.home_page;
  write_xapi(database, choice, setting, remembered_pass_mark(), file);
}

}  // namespace

PassMark remembered_pass_mark() {
  using Ruleset = std::pair<std::string, std::string>;
  return
      [known = std::map<Ruleset, std::optional<double>>()](const std::string& toml, const std::string& level) mutable {
        const auto [at, fresh] = known.try_emplace({toml, level});
        if (fresh) at->second = pass_mark(toml, level);
        return at->second;
      };
}

void add_export_filter(CLI::App& command, ExportFilter& filter) {
  command.add_option("--trainee", filter.trainee, "One trainee only");
  command.add_option("--group", filter.group, "One group only");
  command.add_option("--exercise", filter.exercise, "One exercise only, by its id");
  command.add_option("--attempt", filter.attempt, "One attempt only: its number, a part of its UUID, or 'latest'");
}

/// Rows that were changed are exported as they are, which is said.
void tell_changed(Database& database, const ExportChoice& choice, std::ostream& err) {
  int changed = 0;
  for (const std::int64_t row : choice.attempts) {
    if (attempt_vouched(database.connection(), row)) continue;
    if (++changed == 1) err << "trocar: attempt " << AttemptStore(database).load(row).uuid;
  }
  if (changed > 1) err << " and " << changed - 1 << " more of " << choice.attempts.size();
  if (changed > 0)
    err << ": not as when finished, or the entry is not signed; exported as the database has it, see trocar db check\n";
}

int export_command(const ExportOptions& options, std::ostream& out, std::ostream& err) {
  check_options(options);
  const bool folder = options.format != "json" && options.format != "xapi";
  PendingExport pending(options.out, folder ? Shape::kFolder : Shape::kFile);  // before minutes of work
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const sql::ReadSnapshot snapshot(database.connection());
  const ExportChoice choice = choose_attempts(database, options.filter);
  std::size_t attempts = options.cmi5.empty() ? choice.attempts.size() : 1;
  if (options.format == "csv") write_csv_files(database, choice, pending);
  if (options.format == "json") write_json(database, choice, pending.file());
  if (options.format == "xapi") write_statements(options, database, choice, pending.file());
  if (options.format != "xapi") tell_changed(database, choice, err);
  if (options.format == "traces") attempts = static_cast<std::size_t>(write_traces(database, choice, pending, err));
  pending.commit();
  if (const int erased = people_erased(database); erased > 0) err << erased << " erased and left out\n";
  out << attempts << (attempts == 1 ? " attempt in " : " attempts in ") << options.out.string() << '\n';
  return 0;
}

int kinematics_command(const KinematicsOptions& options, std::ostream& out) {
  if (options.side != "right" && options.side != "left")
    throw InputError("--jigsaws " + options.side + ": right or left");
  const JigsawsSide side = options.side == "right" ? JigsawsSide::kRight : JigsawsSide::kLeft;
  const Trace trace = parse_jigsaws(bytes_of(options.file), options.file.string(), side);
  const std::vector<Metric> metrics = kinematic_metrics(trace);
  if (options.json) {
    nlohmann::ordered_json json = {{"file", options.file.string()},
                                   {"side", options.side},
                                   {"rate_hz", trace.rate_hz},
                                   {"samples", trace.samples.size()},
                                   {"metrics", nlohmann::ordered_json::object()}};
    for (const Metric& metric : metrics)
      json["metrics"][metric.name] = {{"value", *metric.value}, {"unit", metric.unit}};
    out << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
    return 0;
  }
  TextTable table({{"metric"}, {"value", TextTable::Align::kRight}, {"unit"}});
  for (const Metric& metric : metrics) {
    char value[32];
    std::snprintf(value, sizeof value, "%.6g", *metric.value);
    table.add({metric.name, value, metric.unit});
  }
  table.print(out);
  return 0;
}

void add_export(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ExportOptions>();
  ExportOptions& o = *given;
  CLI::App* command =
      add_command(parent, "export", "Attempts for other programs: tables, one document, xAPI statements, traces",
                  chosen, [given] { return export_command(*given, std::cout, std::cerr); });
  command->add_option("format", o.format, "csv, json, xapi or traces")
      ->required()
      ->check(CLI::IsMember({"csv", "json", "xapi", "traces"}));
  command->add_option("--out", o.out, "Folder (csv, traces) or file (json, xapi) that does not exist yet")->required();
  add_export_filter(*command, o.filter);
  command->add_option("--home-page", o.home_page,
                      "xapi: URL of who runs the simulator, of which the trainees' UUIDs are accounts");
  command->add_option("--cmi5", o.cmi5, "xapi: JSON with the data of a cmi5 launch, which the newest attempt answers");
  command->add_option("--db", o.database, "Database file");
  add_lrs(parent, chosen);
}

}  // namespace trocar
