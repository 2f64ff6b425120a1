// The attempt runner and its database: two at once, busy, broken, killed.
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/session/grading/recorded_result.h"
#include "app/window/attempt/attempt_runner.h"
#include "haptics/input_error.h"
#include "tests/app/window/attempt/runner_samples.h"

namespace trocar::attempt_runner_store_test {
namespace {

/// Another program that is writing.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& database) {
    EXPECT_EQ(sqlite3_open(database.c_str(), &connection_), SQLITE_OK);
    sqlite3_busy_timeout(connection_, 5000);
    EXPECT_EQ(sqlite3_exec(connection_, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  }
  ~Writer() { sqlite3_close(connection_); }

 private:
  sqlite3* connection_ = nullptr;
};

std::vector<AttemptSummary> attempts(const std::filesystem::path& file) {
  Database database(file, OpenMode::kExisting);
  return AttemptStore(database).list();
}

TEST(AttemptRunnerStore, TwoAtOnceOnOneDatabaseDoNotDisturbEachOther) {
  const RunnerFolder folder;
  AttemptRunner one(short_request(folder.database()), find_assets());
  AttemptRequest other = short_request(folder.database());
  other.trainee = "T-2";
  other.setup.hand = "gamepad";
  AttemptRunner two(other, find_assets());
  ASSERT_TRUE(wait_for([&] { return one.ready() && two.ready(); }));
  HandIntent intent;
  intent.X_TI = one.newest().record.stylus.X_TI;
  intent.X_TI.p.z() += 0.02;
  one.steer(intent);
  ASSERT_TRUE(wait_for([&] { return one.newest().steered == 1; }));
  EXPECT_EQ(two.newest().steered, 0u) << "each has a hand of its own";
  one.abort();
  two.abort();
  ASSERT_TRUE(wait_for([&] { return one.stored() && two.stored(); }));
  ASSERT_EQ(attempts(folder.database()).size(), 2u);
  EXPECT_NE(one.result().uuid, two.result().uuid);
  EXPECT_TRUE(verified(one.result().recording_path));
  EXPECT_TRUE(verified(two.result().recording_path));
}

TEST(AttemptRunnerStore, ABusyDatabaseAtTheBeginningRefusesTheAttempt) {
  const RunnerFolder folder;
  Database(folder.database());
  {
    const Writer busy(folder.database());
    EXPECT_THROW(AttemptRunner(short_request(folder.database()), find_assets()), EnvironmentError);
  }
  EXPECT_TRUE(attempts(folder.database()).empty());
}

TEST(AttemptRunnerStore, ABusyDatabaseAtTheEndIsAskedUntilItTakesTheResult) {
  const RunnerFolder folder;
  AttemptRunner run(short_request(folder.database()), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.newest().seen; }));
  {
    const Writer busy(folder.database());
    run.abort();
    ASSERT_TRUE(wait_for([&] { return run.finished(); }));
    EXPECT_EQ(run.result().grade.status, AttemptStatus::kAborted) << "there, though not stored";
    ASSERT_TRUE(
        wait_for([&] { return !run.notes().empty() && run.notes().back().find("not stored") != std::string::npos; }));
    EXPECT_FALSE(run.stored());
  }
  ASSERT_TRUE(wait_for([&] { return run.stored(); }));
  EXPECT_EQ(stored_attempt(folder.database()).uuid, run.result().uuid);
}

TEST(AttemptRunnerStore, WhatWasNeverStoredIsNotGradedByTheNextProgram) {
  const RunnerFolder folder;
  const ::pid_t child = ::fork();
  if (child == 0) {
    AttemptRunner run(short_request(folder.database()), find_assets());
    wait_for([&] { return run.newest().seen; });
    static Writer busy(folder.database());
    run.abort();
    wait_for([&] { return run.finished(); });
    ::_exit(0);  // with the database still busy
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  Database database(folder.database(), OpenMode::kExisting);
  ASSERT_EQ(database.recovered().size(), 1u);
  EXPECT_EQ(AttemptStore(database).load("latest").integrity, "its program ended before the attempt was stored");
}

TEST(AttemptRunnerStore, AKilledProgramLosesLessThanASecond) {
  const RunnerFolder folder;
  int alive[2];
  ASSERT_EQ(::pipe(alive), 0);
  const ::pid_t child = ::fork();
  if (child == 0) {
    AttemptRunner run(short_request(folder.database()), find_assets());
    wait_for([&] { return run.newest().t_s > 4; });
    const double t_s = run.newest().t_s;
    [[maybe_unused]] const auto n = ::write(alive[1], &t_s, sizeof t_s);
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
  double killed_at_s = 0;
  ASSERT_EQ(::read(alive[0], &killed_at_s, sizeof killed_at_s), static_cast<ssize_t>(sizeof killed_at_s));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  Database database(folder.database(), OpenMode::kExisting);
  ASSERT_EQ(database.recovered().size(), 1u);
  EXPECT_EQ(AttemptStore(database).load("latest").grade.status, AttemptStatus::kAborted);
  const Recording left = read_recording(database.recovered()[0].recording);
  ASSERT_FALSE(left.ticks.empty());
  // A chunk holds half a second and is written within a tenth of a second after its end; the rest is for a busy
  // machine.
  EXPECT_GT(static_cast<double>(left.ticks.back().tick) / left.rate_hz, killed_at_s - 1.0);
}

TEST(AttemptRunnerStore, ARecordingThatCannotBeMadeEndsTheAttemptWithItsReason) {
  const RunnerFolder folder;
  std::ofstream(folder.path() / "trocar.recordings") << "a file where the folder should be";
  AttemptRunner run(short_request(folder.database()), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.finished(); }));
  EXPECT_THROW(run.result(), EnvironmentError);
  EXPECT_FALSE(run.notes().empty());
  const auto kept = attempts(folder.database());
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].status, "aborted") << "none stays running while the program lives on";
  EXPECT_FALSE(kept[0].integrity.empty());
}

TEST(AttemptRunnerStore, AWrongScriptOrLevelIsRefusedBeforeAnythingIsStored) {
  const RunnerFolder folder;
  EXPECT_THROW(AttemptRunner(short_request(folder.database(), "nobody"), find_assets()), InputError);
  AttemptRequest request = short_request(folder.database());
  request.setup.level = "L9";
  EXPECT_THROW(AttemptRunner(request, find_assets()), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.database()));
}

}  // namespace
}  // namespace trocar::attempt_runner_store_test
