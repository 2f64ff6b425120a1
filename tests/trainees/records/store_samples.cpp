#include "tests/trainees/records/store_samples.h"

#include <sqlite3.h>
#include <unistd.h>

#include "trainees/store/sqlite_handle.h"

namespace trocar {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  static int count = 0;
  folder_ = fs::temp_directory_path() / ("trocar_store_" + std::to_string(getpid()) + "_" + std::to_string(++count));
  fs::create_directories(folder_);
}

TemporaryFolder::~TemporaryFolder() { fs::remove_all(folder_); }

AttemptStart sample_start(const std::string& trainee) {
  AttemptStart start;
  start.trainee = trainee;
  start.exercise_id = "surface-touch";
  start.exercise_version = "1.0";
  start.exercise_text = "id = \"surface-touch\"\n";
  start.level = "L1";
  start.seed = -7;
  start.board = 3;
  start.hand = "expert";
  start.assists = "plumb";
  start.organ_name = "liver";
  start.organ_source = "phantom.mha";
  start.organ_sha256 = std::string(64, 'a');
  start.organ_credit = "Synthetic phantom, CC0-1.0";
  start.organ_synthetic = true;
  return start;
}

AttemptResult sample_result(double score) {
  AttemptResult result;
  result.grade.status = AttemptStatus::kCompleted;
  result.grade.score = score;
  result.grade.passed = score >= 75;
  result.grade.grade = score >= 75 ? "pass" : "below pass";
  result.grade.metrics = {
      {"time_s", 41.5, "s"}, {"force_max_n", 2.0 + score / 100, "N"}, {"tremor", std::nullopt, "mm"}};
  result.grade.subscores = {{"force", 0.8125, 0.6, 2.6, "N", 2.0, 6.0, true},
                            {"time", 1.0 / 3, 0.4, {}, "s", 30, 90, false}};
  result.grade.caps = {{.kind = CapKind::kCritical, .at_most = 49}};
  result.events = {{1.0 / 3, "TARGET_HELD", Severity::kInfo, 2, 1.25, "N", Vec3(0.1, -0.2, 1e-17)},
                   {0.5, "EXCESS_FORCE", Severity::kCritical, -1, 6.5, "N", Vec3::Zero()}};
  RunReport& device = result.device;
  device.backend = "simulated";
  device.rate_hz = 1000;
  device.ticks = 60000;
  device.overruns = 2;
  device.saturated_contact_share = 0.01;
  device.passivity_active_share = 0.02;
  device.min_energy_j = -1e-9;
  device.kappa = 0.5;
  device.warnings = {{"sensor stale", 0.25, 12}, {"heat", 41.5, 3}};
  device.transitions = {{0, "homing", "armed"}, {1.0 / 3, "armed", "running"}};
  device.realtime = "{\"policy\":\"fifo\"}";
  device.plant = "{\"seed\":7,\"calibration\":null,\"identification\":null}";
  result.state_hash = "0123456789abcdef";
  return result;
}

AttemptResult capped_result() {
  AttemptResult result = sample_result(100.0 / 3);
  result.grade.caps = {{.kind = CapKind::kGate, .subject = "force", .below = 0.5, .at_most = 59},
                       {.kind = CapKind::kCritical, .at_most = 49},
                       {.kind = CapKind::kUnfinished, .done = 7, .total = 12, .at_most = 49.0 * 7 / 12},
                       {.kind = CapKind::kVoid, .subject = "it \"jumps\", 0.2 m"}};
  return result;
}

AttemptId store_attempt(Database& database, const AttemptStart& start, const AttemptResult& result) {
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(start);
  store.finish_attempt(id, result);
  return id;
}

std::string run_outside(const fs::path& database, const std::string& sql) {
  sqlite3* connection = nullptr;
  char* message = nullptr;
  sqlite3_open(database.c_str(), &connection);
  sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, &message);
  const std::string error = message == nullptr ? "" : message;
  sqlite3_free(message);
  sqlite3_close(connection);
  return error;
}

std::string run_without_triggers(const fs::path& database, const std::string& sql, const std::string& before) {
  sqlite3* connection = nullptr;
  sqlite3_open(database.c_str(), &connection);
  std::string drop, restore;
  {
    sql::Statement triggers(connection, "SELECT name, sql FROM sqlite_schema WHERE type = 'trigger' ORDER BY rowid");
    while (triggers.step()) {
      drop += "DROP TRIGGER " + triggers.text(0) + ";";
      restore += triggers.text(1) + ";";
    }
  }
  sqlite3_close(connection);
  return run_outside(database, before + "BEGIN;" + drop + sql + ";" + restore + "COMMIT");
}

std::string problems_of(const Database& database) {
  std::string all;
  for (const std::string& problem : database.check()) all += problem + "\n";
  return all;
}

}  // namespace trocar
