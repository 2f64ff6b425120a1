// The recording on a real disk: crash, full disk, no permission.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_disk_test {
namespace {

namespace fs = std::filesystem;

class RecordingDisk : public testing::Test {
 protected:
  RecordingDisk() : folder_(fs::temp_directory_path() / ("trocar_recording_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~RecordingDisk() override { fs::remove_all(folder_); }

  fs::path folder_;
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  return "";
}

TEST_F(RecordingDisk, WritesWhatTheReaderReadsAndMakesItsFolder) {
  const fs::path file = folder_ / "deep" / "er" / "a.trec";
  const auto rows = realistic_ticks(1200, 1);
  std::string sha;
  {
    RecordingWriter writer(file, "s", 1000);
    for (const RecordedTick& row : rows) writer.append(row);
    writer.close({1, AttemptStatus::kCompleted, 0, 0, ""});
    sha = writer.sha256();
  }
  const Recording recording = read_recording(file);
  EXPECT_EQ(recording.ticks, rows);
  EXPECT_EQ(recording.sha256, sha);
  EXPECT_EQ(digest::of_file(file), sha);
}

TEST_F(RecordingDisk, AWriterThatIsDroppedLeavesEverythingReadable) {
  const fs::path file = folder_ / "dropped.trec";
  {
    RecordingWriter writer(file, "s", 1000);
    for (const RecordedTick& row : realistic_ticks(1300, 1)) writer.append(row);
  }
  const Recording recording = read_recording(file);
  EXPECT_EQ(recording.ticks.size(), 1300u);
  EXPECT_FALSE(recording.end);
  EXPECT_NE(recording.torn.find("without an END"), std::string::npos);
}

TEST_F(RecordingDisk, KillMinusNineLosesAtMostTheLastHalfSecond) {
  const fs::path file = folder_ / "killed.trec";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    RecordingWriter writer(file, "s", 1000);
    for (const RecordedTick& row : realistic_ticks(3700, 1)) writer.append(row);
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const Recording recording = read_recording(file);
  EXPECT_EQ(recording.ticks.size(), 3500u);
  EXPECT_FALSE(recording.torn.empty());
}

TEST_F(RecordingDisk, AFullDiskIsNamedAndTheReadablePartStays) {
  const fs::path file = folder_ / "full.trec";
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  rlimit limit = old_limit;
  limit.rlim_cur = 20000;
  setrlimit(RLIMIT_FSIZE, &limit);
  const auto rows = realistic_ticks(60000, 1);
  const std::string message = message_of([&] {
    RecordingWriter writer(file, "s", 1000);
    for (const RecordedTick& row : rows) writer.append(row);
  });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find("full.trec"), std::string::npos) << message;
  const Recording recording = read_recording(file);
  ASSERT_FALSE(recording.ticks.empty());
  EXPECT_LT(recording.ticks.size(), rows.size());
  EXPECT_EQ(recording.ticks.size() % 500, 0u);
  EXPECT_FALSE(recording.torn.empty());
}

TEST_F(RecordingDisk, ADeviceWithoutSpaceIsAnEnvironmentError) {
  const std::string message = message_of([] { RecordingWriter writer("/dev/full", "s", 1000); });
  EXPECT_NE(message.find("/dev/full"), std::string::npos) << message;
  EXPECT_NE(message.find("No space left"), std::string::npos) << message;
}

TEST_F(RecordingDisk, AnImpossibleFolderIsAnEnvironmentError) {
  std::ofstream(folder_ / "plain") << "not a folder";
  const std::string message = message_of([&] { RecordingWriter writer(folder_ / "plain" / "a.trec", "s", 1000); });
  EXPECT_NE(message.find("a.trec"), std::string::npos) << message;
}

TEST_F(RecordingDisk, AFailedRecordingTakesNothingMore) {
  class Failing : public RecordingSink {
   public:
    void append(std::string_view) override {
      if (++calls_ > 1) throw EnvironmentError("disk is gone");
    }
    void sync() override {}

   private:
    int calls_ = 0;
  } sink;
  RecordingWriter writer(sink, "s", 10);
  RecordedTick row;
  EXPECT_THROW(for (row.tick = 0; row.tick < 20; ++row.tick) writer.append(row), EnvironmentError);
  EXPECT_THROW(writer.append(row), EnvironmentError);
  EXPECT_THROW(writer.close({}), EnvironmentError);
}

}  // namespace
}  // namespace trocar::recording_disk_test
