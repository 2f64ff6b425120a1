// A backup is a whole record: it passes the check by itself, wherever it is carried to.
#include "trainees/records/record_backup.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/station_key.h"
#include "trainees/store/disk_full.h"

namespace trocar::record_backup_test {
namespace {

namespace fs = std::filesystem;

class RecordBackup : public TemporaryFolder {
 protected:
  /// @param where empty: beside the database.
  AttemptId recorded(const std::string& motion, const fs::path& where = {}) {
    AttemptStart start = sample_start();
    if (!where.empty()) start.recording = where;
    AttemptStore store(database_);
    const AttemptId id = store.begin_attempt(start);
    fs::create_directories(id.recording.parent_path());
    std::ofstream(id.recording) << motion;
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_file(id.recording);
    store.finish_attempt(id, result);
    return id;
  }
  static std::string problems(const fs::path& database) {
    Database opened(database, OpenMode::kExisting);
    std::string all = problems_of(opened);
    for (const std::string& problem : AttemptStore(opened).check_recordings()) all += problem + "\n";
    return all;
  }
  Database database_{folder_ / "t.db"};
};

TEST_F(RecordBackup, TakesTheRecordingsAlongAndIsSoundWithoutTheOriginal) {
  recorded("motion");
  recorded("of a chosen name", folder_ / "chosen" / "a.trec");
  EXPECT_EQ(recordings_size(database_), 22U);
  const fs::path to = folder_ / "disk" / "copy.backup";
  const BackupReport made = back_up(database_, to, BackedUp::kWithRecordings);
  EXPECT_EQ(made.recordings, folder_ / "disk" / "copy.recordings");
  EXPECT_EQ(made.files, 2U);
  EXPECT_EQ(made.bytes, 22U);
  EXPECT_TRUE(made.missing.empty());
  for (const auto& entry : fs::directory_iterator(made.recordings))
    EXPECT_EQ(entry.status().permissions(), fs::perms(0600));
  EXPECT_EQ(fs::status(made.recordings).permissions(), fs::perms(0700));
  fs::remove_all(folder_ / "t.recordings");
  fs::remove_all(folder_ / "chosen");
  EXPECT_EQ(problems(to), "");
}

/// A row may have been changed to name any file, and a UUID to lead out of the folder.
TEST_F(RecordBackup, TakesNoFileThatOnlyARowNames) {
  const AttemptId id = recorded("motion"), other = recorded("other motion");
  const fs::path secret = folder_ / "secret.txt", to = folder_ / "disk" / "copy.backup";
  std::ofstream(secret) << "private";
  ASSERT_EQ(
      run_without_triggers(folder_ / "t.db",
                           "UPDATE attempt SET recording_path = '" + secret.string() + "' WHERE uuid = '" + id.uuid +
                               "'; UPDATE attempt SET uuid = '../../escaped' WHERE uuid = '" + other.uuid + "'"),
      "");
  const BackupReport made = back_up(database_, to, BackedUp::kWithRecordings);
  EXPECT_EQ(made.files, 0U);
  EXPECT_EQ(made.missing.size(), 2U);
  EXPECT_FALSE(fs::exists(folder_ / "escaped.trec"));
}

TEST_F(RecordBackup, LeavesThemOutWhenAsked) {
  const AttemptId id = recorded("motion");
  const fs::path to = folder_ / "disk" / "copy.backup";
  EXPECT_TRUE(back_up(database_, to, BackedUp::kWithoutRecordings).recordings.empty());
  EXPECT_FALSE(fs::exists(folder_ / "disk" / "copy.recordings"));
  EXPECT_NE(problems(to).find(id.uuid + ".trec of attempt " + id.uuid + " is missing"), std::string::npos);
}

TEST_F(RecordBackup, OverwritesNothingAndLeavesNoPartBehind) {
  recorded("motion");
  const fs::path to = folder_ / "copy.backup";
  fs::create_directories(folder_ / "copy.recordings");
  const auto begin = [&] { back_up(database_, to, BackedUp::kWithRecordings); };
  EXPECT_NE(message_of<InputError>(begin).find("copy.recordings: exists already"), std::string::npos);
  EXPECT_FALSE(fs::exists(to));
  fs::remove(folder_ / "copy.recordings");
  begin();
  EXPECT_NE(message_of<InputError>(begin).find("exists already"), std::string::npos);
  EXPECT_EQ(problems(to), "") << "the first one stands";
  const fs::path other = folder_ / "other.backup";
  fs::create_directories(other.string() + ".anchor");
  EXPECT_NE(message_of<InputError>([&] {
              back_up(database_, other, BackedUp::kWithoutRecordings);
            }).find("other.backup.anchor"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(other));
}

TEST_F(RecordBackup, TakesAwayWhatKilledProgramsLeftBesideTheRecord) {
  for (const char* name : {"t.db.2026-01-01.backup.part", "t.db.2026-01-01.backup.part-journal", "new.backup.part",
                           "new.backup.part-journal", "t.db.2026-02-02.backup.part", "u.db.2026-01-01.backup.part"})
    std::ofstream(folder_ / name) << "half a database";
  const int held = ::open((folder_ / "t.db.2026-02-02.backup.part").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  back_up(database_, folder_ / "new.backup", BackedUp::kWithoutRecordings);
  for (const char* gone : {"t.db.2026-01-01.backup.part", "t.db.2026-01-01.backup.part-journal", "new.backup.part",
                           "new.backup.part-journal"})
    EXPECT_FALSE(fs::exists(folder_ / gone)) << gone;
  EXPECT_TRUE(fs::exists(folder_ / "t.db.2026-02-02.backup.part")) << "somebody writes it";
  EXPECT_TRUE(fs::exists(folder_ / "u.db.2026-01-01.backup.part")) << "another record's";
  EXPECT_EQ(problems(folder_ / "new.backup"), "");
  ::close(held);
}

TEST_F(RecordBackup, SaysThatTheDiskIsFullAndLeavesNothing) {
  const AttemptId id = recorded("motion");
  fs::resize_file(id.recording, fs::space(folder_).available + (1U << 30U));  // takes no room itself
  const auto begin = [&] { back_up(database_, folder_ / "new.backup", BackedUp::kWithRecordings); };
  EXPECT_NE(message_of<DiskFull>(begin).find("give a place on a larger disk"), std::string::npos);
  for (const char* name : {"new.backup", "new.backup.part", "new.backup.anchor", "new.backup.key", "new.recordings"})
    EXPECT_FALSE(fs::exists(folder_ / name)) << name;
}

/// As root, whom no right keeps from reading it.
TEST_F(RecordBackup, AKeyOfAnotherUserIsRefusedUnlessTheRecordIsTheirs) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  const fs::path file = folder_ / "t.db", key = key_path(file);
  ASSERT_EQ(::chown(key.c_str(), 65534, 65534), 0);
  EXPECT_NE(message_of<EnvironmentError>([&] { station_key(file); }).find("t.db.key: the station's key belongs to"),
            std::string::npos);
  ASSERT_EQ(::chown(file.c_str(), 65534, 65534), 0);
  EXPECT_TRUE(station_key(file)) << "root looks at somebody's record";
  ASSERT_EQ(::chown(key.c_str(), 0, 0), 0);
  EXPECT_TRUE(station_key(file));
}

TEST_F(RecordBackup, TellsARecordingThatIsGone) {
  const AttemptId id = recorded("motion");
  fs::remove(id.recording);
  const BackupReport made = back_up(database_, folder_ / "copy.backup", BackedUp::kWithRecordings);
  EXPECT_EQ(made.missing, std::vector<fs::path>{id.recording});
  EXPECT_EQ(made.files, 0U);
}

}  // namespace
}  // namespace trocar::record_backup_test
