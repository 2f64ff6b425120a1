// kill -9 in the middle of an attempt: nothing hangs, nothing is lost but the last second.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "app/session/recording/recording_reader.h"
#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/process_identity.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::attempt_recovery_test {
namespace {

using AttemptRecovery = TemporaryFolder;

/// In a child: begins an attempt, records 2.5 s, says so through the pipe and waits to be killed.
pid_t attempt_in_child(const std::filesystem::path& file, int ready) {
  const pid_t child = fork();
  if (child != 0) return child;
  Database database(file);
  const AttemptId id = AttemptStore(database).begin_attempt(sample_start("T-killed"));
  RecordingWriter writer(id.recording, "session", 1000);
  RecordedTick row;
  for (row.tick = 0; row.tick < 2500; ++row.tick) writer.append(row);
  if (write(ready, "x", 1) != 1) _exit(1);
  pause();
  _exit(1);
}

struct Child {
  explicit Child(const std::filesystem::path& file) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("pipe");
    pid = attempt_in_child(file, ends[1]);
    char byte = 0;
    if (read(ends[0], &byte, 1) != 1) throw std::runtime_error("child failed");
    close(ends[0]);
    close(ends[1]);
  }
  void kill_and_reap() {
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  pid_t pid = 0;
};

TEST_F(AttemptRecovery, AKilledAttemptIsAbortedAndItsRecordingReadable) {
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  Database database(folder_ / "t.db");
  ASSERT_EQ(database.recovered().size(), 1u);
  EXPECT_EQ(database.recovered()[0].trainee, "T-killed");
  const AttemptResult result = AttemptStore(database).load("latest");
  EXPECT_EQ(result.grade.status, AttemptStatus::kAborted);
  EXPECT_FALSE(result.grade.score);
  EXPECT_EQ(result.grade.grade, "not graded");
  EXPECT_EQ(result.recording_path, database.recovered()[0].recording.string());
  EXPECT_EQ(result.recording_sha256, digest::of_file(result.recording_path));
  const Recording recording = read_recording(result.recording_path);
  EXPECT_EQ(recording.ticks.size(), 2500u);
  EXPECT_FALSE(recording.torn.empty());
  EXPECT_TRUE(database.check().empty());
  EXPECT_TRUE(AttemptStore(database).check_recordings().empty());
}

TEST_F(AttemptRecovery, AWholeRecordingInItsPlaceEarnsNothing) {
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  std::filesystem::path place;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "t.recordings")) place = entry.path();
  std::filesystem::remove(place);
  RecordingWriter(place, "another's", 1000).close({0, AttemptStatus::kCompleted, 0, 0, ""});
  const Database database(folder_ / "t.db");
  ASSERT_EQ(database.recovered().size(), 1u);
  EXPECT_EQ(database.recovered()[0].recording, place);
  Database again(folder_ / "t.db");
  const AttemptResult result = AttemptStore(again).load("latest");
  EXPECT_EQ(result.grade.status, AttemptStatus::kAborted);
  EXPECT_TRUE(result.cut_off);
  EXPECT_FALSE(result.grade.score);
  EXPECT_NE(AttemptStore(again).recording_problem(result.uuid, read_recording(place).attempt, ""), "");
}

TEST_F(AttemptRecovery, ALivingSecondProgramIsNotDisturbed) {
  Child child(folder_ / "t.db");
  {
    Database database(folder_ / "t.db");
    EXPECT_TRUE(database.recovered().empty());
    EXPECT_EQ(AttemptStore(database).latest()->status, "running");
    store_attempt(database, sample_start("T-here"), sample_result());
  }
  child.kill_and_reap();
  EXPECT_EQ(Database(folder_ / "t.db").recovered().size(), 1u);
  EXPECT_TRUE(Database(folder_ / "t.db").recovered().empty());
}

TEST_F(AttemptRecovery, AnOwnRunningAttemptSurvivesASecondConnection) {
  Database database(folder_ / "t.db");
  const AttemptId id = AttemptStore(database).begin_attempt(sample_start());
  EXPECT_TRUE(Database(folder_ / "t.db").recovered().empty());
  AttemptStore(database).finish_attempt(id, sample_result());
  EXPECT_EQ(AttemptStore(database).load(id.row).grade.status, AttemptStatus::kCompleted);
}

TEST_F(AttemptRecovery, AZombieCountsAsDead) {
  Child child(folder_ / "t.db");
  kill(child.pid, SIGKILL);
  siginfo_t info{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child.pid), &info, WEXITED | WNOWAIT), 0);
  EXPECT_EQ(Database(folder_ / "t.db").recovered().size(), 1u);
  waitpid(child.pid, nullptr, 0);
}

TEST_F(AttemptRecovery, AnAttemptWithoutRecordingIsAbortedToo) {
  {
    Database database(folder_ / "t.db");
    AttemptStart start = sample_start();
    start.recording = "";
    AttemptStore(database).begin_attempt(start);
  }
  // The same process number after a boot: another process.
  ASSERT_EQ(run_outside(folder_ / "t.db", "DROP TRIGGER attempt_keeps_identity"), "");
  ASSERT_EQ(run_outside(folder_ / "t.db", "UPDATE attempt SET owner_boot = 'before'"), "");
  Database database(folder_ / "t.db");
  ASSERT_EQ(database.recovered().size(), 1u);
  EXPECT_TRUE(database.recovered()[0].recording.empty());
  EXPECT_EQ(AttemptStore(database).load("latest").recording_path, "");
}

TEST(ProcessIdentity, TellsAReusedNumberFromTheProcessThatHadIt) {
  ProcessIdentity me = this_process();
  EXPECT_TRUE(process_lives(me));
  me.start += 1;
  EXPECT_FALSE(process_lives(me));
  ProcessIdentity rebooted = this_process();
  rebooted.boot = "another";
  EXPECT_FALSE(process_lives(rebooted));
}

}  // namespace
}  // namespace trocar::attempt_recovery_test
