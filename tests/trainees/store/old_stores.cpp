#include "tests/trainees/store/old_stores.h"

#include <sqlite3.h>

#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/attempt_rows.h"
#include "trainees/store/migrations.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRunning =
    "INSERT INTO attempt (uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed, board, hand, "
    "organ_name,"
    " organ_source, organ_sha256, organ_synthetic, organ_credit, program, started_utc, owner_pid, owner_boot, "
    "owner_start,"
    " hash_version, status)"
    " SELECT ?1, 1, 'surface-touch', '1.0', sha256, 'L1', 1, ?2, 'expert', 'liver', '', '', 1, '', '0.1', "
    "'2026-01-01T00:00:00.000Z',"
    " 1, '', 1, 3, 'running' FROM ruleset";

/// The attempts as today's program stores them: what their hashes cover is the same in every schema since 3.
void write_attempts(const fs::path& file, int version, int attempts) {
  sqlite3* raw = nullptr;
  sqlite3_open(file.c_str(), &raw);
  std::vector<Migration> steps(shipped_migrations().begin(), shipped_migrations().end());
  steps.back().after = nullptr;
  migrate(raw, "", steps);
  append_audit(raw, kActionMade, "schema " + std::to_string(version), "");
  sql::execute(raw,
               "INSERT INTO trainee VALUES (1, 'person-1', '2025-12-01T00:00:00.000Z');"
               "INSERT INTO person (trainee_id, code) VALUES (1, 'T-old');"
               "INSERT INTO exercise VALUES ('surface-touch', 'E02', 'Surface touch')");
  const std::string text = "id = \"surface-touch\"\n";
  sql::Statement(raw, "INSERT INTO ruleset VALUES (?, 'surface-touch', '1.0', ?)")
      .bind(digest::of_bytes(text))
      .bind(text)
      .run();
  append_anchor(file, audit_head(raw));
  for (int i = 1; i <= attempts; ++i) {
    sql::Transaction transaction(raw);
    sql::Statement(raw, kRunning).bind("attempt-" + std::to_string(i)).bind(i).run();
    if (i % 3 != 0) write_result(raw, i, sample_result(50 + i % 50), "");
    transaction.commit();
    if (i % 3 != 0) append_anchor(file, audit_head(raw));
  }
  sqlite3_close(raw);
}

}  // namespace

void make_old_store(const fs::path& file, int version, int attempts) {
  const std::string made = file.string() + ".made";
  write_attempts(made, version, attempts);
  sqlite3* raw = nullptr;
  sqlite3_open(file.c_str(), &raw);
  const Migration steps[] = {{1, kSchemaV1}, {2, schema_v2()}, {3, kSchemaV3}, {4, schema_v4()}};
  migrate(raw, "", std::span(steps).first(static_cast<std::size_t>(version)));
  sqlite3_close(raw);
  std::string copy;
  for (const char* table : {"trainee", "person", "exercise", "ruleset", "attempt", "event", "score", "metric",
                            "subscore", "score_cap", "device_warning", "device_transition", "audit"}) {
    const bool person = std::string(table) == "person";  // a column more since schema 5
    copy += std::string("INSERT INTO main.") + table + " SELECT " + (person ? "trainee_id, code, name, email" : "*") +
            " FROM made." + table + ";";
  }
  EXPECT_EQ(run_without_triggers(file, copy, "ATTACH '" + made + "' AS made;"), "");
  EXPECT_EQ(run_outside(file, "PRAGMA journal_mode = WAL"), "");
  fs::rename(made + ".anchor", file.string() + ".anchor");
  fs::remove(made);
}

void make_schema1(const fs::path& file) {
  // Triggers come last: they would refuse the finished attempts of the sample.
  const std::string schema = kSchemaV1;
  const std::size_t triggers = schema.find("CREATE TRIGGER");
  std::ifstream in(TROCAR_SOURCE_DIR "/tests/trainees/store/schema_v1_sample.sql");
  const std::string sample((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(run_outside(file, "BEGIN;" + schema.substr(0, triggers) + sample + schema.substr(triggers) +
                                  "PRAGMA user_version = 1; PRAGMA application_id = " + std::to_string(kApplicationId) +
                                  "; COMMIT; PRAGMA journal_mode = WAL"),
            "");
}

}  // namespace trocar
