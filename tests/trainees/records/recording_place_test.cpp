// Where a recording is looked for: under the database's present name, for it may be a copy, and where it was kept.
#include <fstream>

#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/attempt_recovery.h"

namespace trocar::recording_place_test {
namespace {

namespace fs = std::filesystem;

class RecordingPlace : public TemporaryFolder {
 protected:
  /// A database with one recorded attempt.
  RecordingPlace() : file_(folder_ / "t.db") {
    Database database(file_);
    AttemptStore store(database);
    const AttemptId id = store.begin_attempt(sample_start());
    fs::create_directories(id.recording.parent_path());
    std::ofstream(id.recording) << "motion";
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_file(id.recording);
    store.finish_attempt(id, result);
    name_ = id.uuid + ".trec";
  }
  static std::string found(const fs::path& database) {
    Database opened(database, OpenMode::kExisting);
    return AttemptStore(opened).load(1).recording_path;
  }
  static std::string problems(const fs::path& database) {
    Database opened(database, OpenMode::kExisting);
    std::string all;
    for (const std::string& problem : AttemptStore(opened).check_recordings()) all += problem + "\n";
    return all;
  }
  fs::path copy_elsewhere() const {
    fs::create_directories(folder_ / "else");
    Database(file_).backup(folder_ / "else" / "copy.db");
    return folder_ / "else" / "copy.db";
  }
  fs::path file_;
  std::string name_;
};

TEST_F(RecordingPlace, FollowsADatabaseThatGotAnotherName) {
  const fs::path copy = copy_elsewhere();
  fs::create_directories(folder_ / "else" / "copy.recordings");
  fs::copy_file(folder_ / "t.recordings" / name_, folder_ / "else" / "copy.recordings" / name_);
  EXPECT_EQ(found(copy), (folder_ / "else" / "copy.recordings" / name_).string());
  EXPECT_EQ(problems(copy), "");
}

TEST_F(RecordingPlace, StaysWhereItWasWhenOnlyTheDatabaseGotAnotherName) {
  const fs::path copy = copy_elsewhere();
  fs::copy(folder_ / "t.recordings", folder_ / "else" / "t.recordings");
  EXPECT_EQ(found(copy), (folder_ / "else" / "t.recordings" / name_).string());
  EXPECT_EQ(problems(copy), "");
}

TEST_F(RecordingPlace, IsThatOfTheCopyWhereBothAreThere) {
  Database(file_).backup(folder_ / "copy.db");
  fs::copy(folder_ / "t.recordings", folder_ / "copy.recordings");
  EXPECT_EQ(found(folder_ / "copy.db"), (folder_ / "copy.recordings" / name_).string())
      << "erasing in the copy spares the original";
  EXPECT_EQ(found(file_), (folder_ / "t.recordings" / name_).string());
}

TEST_F(RecordingPlace, IsToldWhereItWasLookedForWhenItIsNowhere) {
  const fs::path copy = copy_elsewhere();
  const std::string told = problems(copy);
  EXPECT_NE(told.find("is missing (looked for: " + (folder_ / "else" / "copy.recordings" / name_).string() + ", " +
                      (folder_ / "else" / "t.recordings" / name_).string() + ")"),
            std::string::npos)
      << told;
}

TEST(RecordingPlaces, OfAChosenNameBeginWithThatName) {
  EXPECT_EQ(recording_places("/data/t.db", "/films/a.trec"),
            (std::vector<fs::path>{"/films/a.trec", "/data/t.recordings/a.trec"}));
  EXPECT_EQ(recording_places("/data/t.db", "a.trec"),
            (std::vector<fs::path>{"/data/a.trec", "/data/t.recordings/a.trec"}));
  EXPECT_EQ(recording_places("/data/t.db", "t.recordings/a.trec"),
            (std::vector<fs::path>{"/data/t.recordings/a.trec"}));
  EXPECT_EQ(recording_places("", "/films/a.trec"), (std::vector<fs::path>{"/films/a.trec"}));
  EXPECT_TRUE(recording_places("/data/t.db", "").empty());
  EXPECT_EQ(located_recording("/data/t.db", "old.recordings/a.trec"), "/data/old.recordings/a.trec")
      << "nowhere: as it was kept";
}

}  // namespace
}  // namespace trocar::recording_place_test
