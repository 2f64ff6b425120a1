// kill -9 in the middle of an attempt: nothing hangs, nothing is lost but the last second.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "app/session/recording/recording_reader.h"
#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/attempt_identity.h"
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

TEST_F(AttemptRecovery, AnotherAttemptsRecordingInItsPlaceIsNotTakenForIt) {
  std::string other;
  std::filesystem::path kept;
  {
    Database database(folder_ / "t.db");
    AttemptStore store(database);
    const AttemptId id = store.begin_attempt(sample_start("T-1"));
    RecordingWriter(kept = id.recording, "session", 1000).close({0, AttemptStatus::kCompleted, 0, 0, ""});
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_file(kept);
    store.finish_attempt(id, result);
    other = id.uuid;
  }
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  std::filesystem::path place;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "t.recordings"))
    if (entry.path() != kept) place = entry.path();
  std::filesystem::copy_file(kept, place, std::filesystem::copy_options::overwrite_existing);
  Database database(folder_ / "t.db");
  const AttemptResult died = AttemptStore(database).load("latest");
  EXPECT_NE(died.integrity.find("in the place of its recording lies that of attempt " + other), std::string::npos);
  EXPECT_EQ(died.recording_path, "");
  EXPECT_EQ(died.recording_sha256, "");
  ASSERT_EQ(AttemptStore(database).check_recordings().size(), 1u);
  EXPECT_NE(AttemptStore(database).check_recordings()[0].find("kept without one"), std::string::npos);
}

/// A row that nobody's attempt began is not ended in that person's name without a word.
TEST_F(AttemptRecovery, ARowThatWasPutInIsTold) {
  {
    Database database(folder_ / "t.db");
    store_attempt(database, sample_start("T-1"), sample_result());
  }
  ASSERT_EQ(run_outside(folder_ / "t.db",
                        "CREATE TEMP TABLE forged AS SELECT * FROM attempt; UPDATE forged SET id = 2, status ="
                        " 'running', uuid = '0190aaaa-0000-7000-8000-000000000001', finished_utc = NULL, chain_position"
                        " = NULL, prev_hash = NULL, row_hash = NULL, owner_pid = 1, owner_boot = 'none',"
                        " recording_path = '', recording_sha256 = ''; INSERT INTO attempt SELECT * FROM forged"),
            "");
  Database database(folder_ / "t.db");
  ASSERT_EQ(database.recovered().size(), 1u);
  const AttemptResult result = AttemptStore(database).load("latest");
  EXPECT_EQ(result.grade.status, AttemptStatus::kAborted);
  EXPECT_EQ(result.integrity, "no entry says that it began: its row was put in");
  EXPECT_EQ(problems_of(database), "audit trail: attempt " + result.uuid + ": " + result.integrity + "\n");
}

TEST_F(AttemptRecovery, ARowThatWasChangedWhileItRanIsTold) {
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  ASSERT_EQ(run_without_triggers(folder_ / "t.db", "UPDATE attempt SET hand = 'somebody'"), "");
  Database database(folder_ / "t.db");
  EXPECT_EQ(AttemptStore(database).load("latest").integrity, "its row is not as it began: it was changed");
  EXPECT_NE(problems_of(database).find(": its row is not as it began"), std::string::npos) << problems_of(database);
}

TEST_F(AttemptRecovery, ARowWithBytesThatAreNoTextLocksNobodyOut) {
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  ASSERT_EQ(run_without_triggers(folder_ / "t.db", "UPDATE attempt SET hand = CAST(x'ff41' AS TEXT)"), "");
  Database database(folder_ / "t.db");
  EXPECT_EQ(database.recovered().size(), 1u);
  EXPECT_NE(problems_of(database).find(": its row is not as it began"), std::string::npos) << problems_of(database);
}

/// What an attempt began with is told in the trail, what its row says of its file, program and owner too.
TEST_F(AttemptRecovery, NoOtherFileIsTakenForTheRecordingOfARowThatWasChanged) {
  for (const char* change : {"recording_path = 't.db.key'", "program = 'trocar 9.9'", "organ_name = 'patient'",
                             "started_utc = '2020-01-01T00:00:00.000Z'", "hash_version = 1"}) {
    Child child(folder_ / "t.db");
    child.kill_and_reap();
    ASSERT_EQ(run_without_triggers(folder_ / "t.db",
                                   std::string("UPDATE attempt SET ") + change + " WHERE status = 'running'"),
              "");
    const Database database(folder_ / "t.db");
    Database again(folder_ / "t.db");
    const AttemptResult died = AttemptStore(again).load("latest");
    EXPECT_EQ(died.integrity, "its row is not as it began: it was changed") << change;
    EXPECT_EQ(died.recording_path, "") << change;
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "t.db.key"));
}

/// Else it would run for good, and nothing of its person could be erased.
TEST_F(AttemptRecovery, ARowWithAnOwnerThatSomebodyWroteEnds) {
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  const ProcessIdentity self = this_process();
  ASSERT_EQ(run_without_triggers(folder_ / "t.db", "UPDATE attempt SET owner_pid = " + std::to_string(self.pid) +
                                                       ", owner_boot = '" + self.boot +
                                                       "', owner_start = " + std::to_string(self.start)),
            "");
  EXPECT_EQ(Database(folder_ / "t.db").recovered().size(), 1u);
}

TEST_F(AttemptRecovery, ARowThatWasChangedWhileItRanIsNotGraded) {
  Database database(folder_ / "t.db");
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start());
  ASSERT_EQ(run_without_triggers(folder_ / "t.db", "UPDATE attempt SET program = 'trocar 9.9 (official)'"), "");
  EXPECT_NE(message_of<InputError>([&] { store.finish_attempt(id, sample_result()); }).find("changed while it ran"),
            std::string::npos);
}

/// A station whose key is lost goes on: nothing is signed, nothing is lost.
TEST_F(AttemptRecovery, WithoutTheKeyAttemptsRunOnEndAndKeepTheirRecording) {
  { Database made(folder_ / "t.db"); }
  std::filesystem::remove(folder_ / "t.db.key");
  Child child(folder_ / "t.db");
  EXPECT_TRUE(Database(folder_ / "t.db").recovered().empty()) << "it lives";
  child.kill_and_reap();
  Database database(folder_ / "t.db");
  ASSERT_EQ(database.recovered().size(), 1u);
  EXPECT_NE(AttemptStore(database).load("latest").recording_sha256, "");
  store_attempt(database, sample_start(), sample_result(64));
  EXPECT_EQ(*AttemptStore(database).load("latest").grade.score, 64);
}

/// No version of the hash and no table tells whose recording it is, only the signed entry of its beginning.
TEST_F(AttemptRecovery, ARecordingOfAnotherStaysAnothersWhateverTheRowSays) {
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  std::string uuid;
  {
    Database database(folder_ / "t.db");
    uuid = AttemptStore(database).load("latest").uuid;
  }
  const SigningKey own = SigningKey::make();
  const auto problem = [&](const std::string& identity) {
    const Database database(folder_ / "t.db");
    Database again(folder_ / "t.db");
    return AttemptStore(again).recording_problem(uuid, identity, own.public_key());
  };
  std::string forged;
  {
    const Database database(folder_ / "t.db");
    forged = identity_of(database.connection(), uuid, own.public_key());
  }
  EXPECT_EQ(problem(forged), "is signed with another station's key");
  EXPECT_EQ(problem(R"({"attempt": "x", "key": 5})"), "does not say whose key signs it");
  ASSERT_EQ(run_without_triggers(folder_ / "t.db", "UPDATE attempt SET hash_version = 1"), "");
  EXPECT_EQ(problem(forged), "is signed with another station's key");
  ASSERT_EQ(run_outside(folder_ / "t.db",
                        "INSERT INTO station VALUES ('01a22b0b-0000-7000-8000-000000000000', 'Room 2', 0);"
                        "INSERT INTO replica SELECT id, '01a22b0b-0000-7000-8000-000000000000', chain_position,"
                        " prev_hash FROM attempt"),
            "");
  EXPECT_EQ(problem(forged), "is signed with another station's key");
  const Database database(folder_ / "t.db");
  EXPECT_NE(problems_of(database).find("is kept as another station's, and no signed entry"), std::string::npos);
}

/// Else nobody could open the database any more.
TEST_F(AttemptRecovery, RowsPutInForARunningAttemptGo) {
  const auto put_in = [&](std::int64_t attempt) {
    return run_outside(
        folder_ / "t.db",
        "INSERT INTO score (attempt_id, revision, ruleset_sha256, value, passed, grade) SELECT id, 0,"
        " ruleset_sha256, 100, 1, 'expert' FROM attempt WHERE id = " +
            std::to_string(attempt) +
            "; INSERT INTO metric (score_id, position, name, value, unit) SELECT max(id), 0, 'time', 1, 's' FROM "
            "score; INSERT INTO device_warning VALUES (" +
            std::to_string(attempt) + ", 0, 'x', 1, 1)");
  };
  Child child(folder_ / "t.db");
  child.kill_and_reap();
  ASSERT_EQ(put_in(1), "");
  Database database(folder_ / "t.db");
  const AttemptResult died = AttemptStore(database).load("latest");
  EXPECT_FALSE(died.grade.score);
  EXPECT_TRUE(died.grade.metrics.empty());
  EXPECT_EQ(died.integrity,
            "its program ended before the attempt was stored; rows that were put in for it while it ran were removed");
  const AttemptId id = AttemptStore(database).begin_attempt(sample_start());
  ASSERT_EQ(put_in(id.row), "");
  AttemptStore(database).finish_attempt(id, sample_result(61));
  const AttemptResult ended = AttemptStore(database).load(id.row);
  EXPECT_EQ(*ended.grade.score, 61);
  EXPECT_EQ(ended.integrity, "rows that were put in for it while it ran were removed");
  EXPECT_EQ(problems_of(database), "");
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
