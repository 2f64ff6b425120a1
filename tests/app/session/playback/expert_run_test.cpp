#include "app/session/playback/expert_run.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/session/recording/recording_reader.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/window/pages/practice_bench.h"

namespace trocar::expert_run_test {
namespace {

class ExpertRunTest : public ::testing::Test {
 protected:
  void SetUp() override { setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

  AttemptSetup setup(const std::string& hand = "expert") const {
    AttemptSetup out;
    out.exercise = find_exercise("reach-and-orient", testing_support::source_assets().exercises);
    out.organ = "phantom-liver";
    out.hand = hand;
    out.seed = 3;
    out.board = 1003;
    return out;
  }
  static std::filesystem::path wait_for(ExpertRun& run, const AttemptSetup& setup) {
    for (;;) {
      const std::filesystem::path file = run.ask(setup, testing_support::source_assets());
      if (!file.empty() || !run.refusal().empty()) return file;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  test::TemporaryFolder folder_;
};

TEST_F(ExpertRunTest, IsMadeOnceAndFoundAgain) {
  ExpertRun run;
  const std::filesystem::path file = wait_for(run, setup());
  ASSERT_FALSE(file.empty()) << run.refusal();
  EXPECT_EQ(file.parent_path(), folder_.path() / "trocar");
  const Recording recording = read_recording(file);
  EXPECT_GT(recording.ticks.size(), 5000U);
  const auto made = std::filesystem::last_write_time(file);
  ExpertRun again;
  EXPECT_EQ(again.ask(setup(), testing_support::source_assets()), file) << "at once";
  EXPECT_EQ(std::filesystem::last_write_time(file), made);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_F(ExpertRunTest, WhatCannotBeMadeIsRefusedOnceAndSaysWhy) {
  ExpertRun run;
  EXPECT_TRUE(wait_for(run, setup("nobody")).empty());
  EXPECT_NE(run.refusal().find("nobody"), std::string::npos) << run.refusal();
  EXPECT_TRUE(run.ask(setup("nobody"), testing_support::source_assets()).empty());
}

TEST_F(ExpertRunTest, LeavingStopsItAndLeavesNothing) {
  {
    ExpertRun run;
    EXPECT_TRUE(run.ask(setup(), testing_support::source_assets()).empty());
  }
  const std::filesystem::path folder = folder_.path() / "trocar";
  if (std::filesystem::exists(folder)) {
    EXPECT_TRUE(std::filesystem::is_empty(folder));
  }
}

}  // namespace
}  // namespace trocar::expert_run_test
