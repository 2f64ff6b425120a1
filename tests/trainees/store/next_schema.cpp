#include "tests/trainees/store/next_schema.h"

#include <sqlite3.h>

#include <vector>

#include "tests/trainees/records/store_samples.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {

namespace fs = std::filesystem;

std::span<const Migration> next_migrations() {
  static const std::vector<Migration> kNext = [] {
    std::vector<Migration> steps(shipped_migrations().begin(), shipped_migrations().end());
    steps.push_back({steps.back().version + 1,
                     "CREATE TABLE event_tip (id INTEGER PRIMARY KEY, x_m REAL, y_m REAL, z_m REAL) STRICT;"
                     "INSERT INTO event_tip SELECT id, tip_x_m, tip_y_m, tip_z_m FROM event_row",
                     note_migration});
    return steps;
  }();
  return kNext;
}

Database open_by_next_program(const fs::path& file, int busy_timeout_ms) {
  return Database(file, OpenMode::kCreate, busy_timeout_ms, next_migrations());
}

int written_version(const fs::path& file) {
  sqlite3* raw = nullptr;
  sqlite3_open(file.c_str(), &raw);
  const auto version = sql::query_integer(raw, "PRAGMA user_version");
  sqlite3_close(raw);
  return static_cast<int>(version);
}

void make_store(const fs::path& file, int attempts) {
  {
    Database database(file);
    AttemptStore store(database);
    for (int i = 1; i <= attempts; ++i) {
      const AttemptId id = store.begin_attempt(sample_start("T-old"));
      if (i % 3 != 0) store.finish_attempt(id, sample_result(50 + i % 50));
    }
  }
  EXPECT_EQ(run_without_triggers(file,
                                 "UPDATE attempt SET owner_pid = 1, owner_boot = '', owner_start = 1"
                                 " WHERE status = 'running'"),
            "");
}

}  // namespace trocar
