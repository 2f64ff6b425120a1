// kill -9 at random moments of the store itself: attempts, notes, signatures, overrides; and of migrations. What was
// committed is there, what was interrupted is marked, db check finds nothing. STORE_KILLS and MIGRATION_KILLS say how
// often.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/support/repeats.h"
#include "tests/trainees/records/store_samples.h"
#include "tests/trainees/store/next_schema.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::store_kill_test {
namespace {

const int kStoreKills = test::repeats("STORE_KILLS", 20);
const int kMigrationKills = test::repeats("MIGRATION_KILLS", 20);

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const Author kAuthor{"", "Ida Adler"};

/// Says through the pipe what has been committed: a letter and a UUID.
void committed(int pipe, char kind, const std::string& uuid) {
  const std::string line = kind + uuid + "\n";
  if (write(pipe, line.data(), line.size()) != static_cast<ssize_t>(line.size())) _exit(1);
}

/// Attempts until the kill comes, each with what people say of it.
[[noreturn]] void work(const fs::path& file, int pipe) {
  try {
    Database database(file);
    AttemptStore attempts(database);
    AssessmentStore assessments(database);
    while (true) {
      const AttemptId id = attempts.begin_attempt(sample_start("T-killed"));
      const std::string attempt = id.uuid;
      committed(pipe, 'b', attempt);
      std::this_thread::sleep_for(std::chrono::milliseconds(3));  // the run
      attempts.finish_attempt(id, sample_result());
      committed(pipe, 'a', attempt);
      committed(pipe, 'n', assessments.add_note("T-killed", attempt, "Slower.", kAuthor).uuid);
      committed(pipe, 's', assessments.sign(attempt, "review", "", kAuthor).uuid);
      committed(pipe, 'o', assessments.override_verdict(attempt, true, "The camera was knocked", kAuthor).uuid);
      assessments.mark_seen(assessments.newest_unseen("T-killed")->uuid);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  _exit(2);
}

/// Everything that comes through until the writer is gone.
std::string read_all(int pipe) {
  std::string all;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(pipe, buffer, sizeof buffer)) > 0;)
    all.append(buffer, static_cast<std::size_t>(got));
  return all;
}

class StoreKill : public TemporaryFolder {
 protected:
  /// @param at_work the delay begins with the first commit, however long a busy machine takes to get there; else with
  /// the opening. @returns what the child had committed for certain, whole lines.
  std::vector<std::string> killed_after(const fs::path& file, std::chrono::microseconds delay, bool at_work) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      work(file, ends[1]);
    }
    close(ends[1]);
    std::string all;
    char first = 0;
    if (at_work && read(ends[0], &first, 1) == 1) all = first;
    std::this_thread::sleep_for(delay);
    kill(child, SIGKILL);
    all += read_all(ends[0]);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the child failed by itself";
    std::vector<std::string> lines;
    std::istringstream in(all);
    for (std::string line; std::getline(in, line) && !in.eof();) lines.push_back(line);
    return lines;
  }
  static bool stored(const Database& database, const std::string& line) {
    const char* tables[] = {"attempt", "note", "signature", "verdict_override", "attempt"};
    const std::string table = tables[std::string("ansob").find(line[0])];
    const std::string done = line[0] == 'a' ? " AND status = 'completed'" : "";
    sql::Statement row(database.connection(), "SELECT 1 FROM " + table + " WHERE uuid = ?" + done);
    return row.bind(line.substr(1)).step();
  }
  std::mt19937 random_{20260307};
};

TEST_F(StoreKill, NothingThatWasCommittedIsLostAndWhatWasInterruptedIsMarked) {
  const fs::path file = folder_ / "t.db";
  { Database database(file); }
  std::size_t promises = 0, interrupted = 0, attempts = 0;
  for (int round = 0; round < kStoreKills && !HasFailure(); ++round) {
    std::uniform_int_distribution<int> microseconds(0, 40000);
    const auto lines = killed_after(file, std::chrono::microseconds(microseconds(random_)), round % 2 == 0);
    Database database(file);
    for (const std::string& line : lines) EXPECT_TRUE(stored(database, line)) << line;
    EXPECT_EQ(sql::query_integer(database.connection(), "SELECT count(*) FROM attempt WHERE status = 'running'"), 0);
    interrupted += database.recovered().size();
    promises += lines.size();
    if (round % 10 == 9 || round + 1 == kStoreKills) {
      EXPECT_EQ(problems_of(database), "") << "after kill " << round;
    }
    attempts = AttemptStore(database).list().size();
    // A fresh start now and then: the database would grow, and the checks with it.
    if (round % 200 == 199) {
      for (const char* more : {"", "-wal", "-shm", ".anchor"}) fs::remove(file.string() + more);
    }
  }
  EXPECT_GT(promises, static_cast<std::size_t>(kStoreKills) / 4);
  std::printf("%d kills: %zu commits promised and kept, %zu attempts interrupted and marked, %zu attempts at the end\n",
              kStoreKills, promises, interrupted, attempts);
}

TEST_F(StoreKill, AMigrationIsDoneOrHasNotBegun) {
  const int kNow = shipped_migrations().back().version;
  const std::string old = ".schema" + std::to_string(kNow);
  make_store(folder_ / "old.db", 60);
  const auto fresh = [&](const fs::path& file) {
    for (const std::string& more :
         {std::string(), std::string("-wal"), std::string("-shm"), old + ".backup", old + "-2.backup"})
      fs::remove(file.string() + more);
    for (const char* more : {"", ".anchor", ".key"})
      fs::copy_file((folder_ / "old.db").string() + more, file.string() + more, fs::copy_options::overwrite_existing);
  };
  const fs::path file = folder_ / "t.db";
  fresh(file);
  const auto begin = Clock::now();
  { open_by_next_program(file); }
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin);
  long longest = whole.count() * 3 / 2;
  int before = 0, after = 0;
  for (int round = 0; round < kMigrationKills && !HasFailure(); ++round) {
    fresh(file);
    const pid_t child = fork();
    if (child == 0) {
      try {
        open_by_next_program(file);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
      }
      pause();
    }
    std::uniform_int_distribution<long> microseconds(0, longest);
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random_)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const int version = written_version(file);
    EXPECT_TRUE(version == kNow || version == kNow + 1) << version;
    version == kNow ? ++before : ++after;
    longest = version == kNow ? longest * 5 / 4 : longest * 4 / 5;  // round its end, however busy the machine is
    Database database = open_by_next_program(file);
    EXPECT_EQ(database.schema_version(), kNow + 1);
    EXPECT_EQ(AttemptStore(database).list().size(), 60u);
    EXPECT_EQ(problems_of(database), "") << "kill " << round;
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(after, 0);
  std::printf("%d kills of migrations: %d found the old schema, %d the new\n", kMigrationKills, before, after);
}

}  // namespace
}  // namespace trocar::store_kill_test
