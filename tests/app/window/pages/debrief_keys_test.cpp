// The debrief's keys in the whole loop: R again, N onwards, W watch, S beside the expert; Enter is the key that the
// verdict asks for.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/session/recording/recording_reader.h"
#include "app/session/setup/scene.h"
#include "tests/app/session/recording/recording_samples.h"
#include "tests/app/window/attempt/attempt_samples.h"
#include "tests/app/window/pages/loop_bench.h"

namespace trocar::debrief_keys_test {
namespace {

using testing_support::graded;
using testing_support::press;

class DebriefKeys : public testing_support::LoopBench {
 protected:
  void SetUp() override {
    width_ = 1280;
    height_ = 720;
    LoopBench::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(model_->sign_in("T-1"), "");
  }
  /// Keeps the result as an attempt of T-1 and opens its debrief.
  void debrief(AttemptResult result, bool recorded = true) {
    Database database(bench_.options().database);
    AttemptStart start;
    start.trainee = "T-1";
    start.exercise_id = result.exercise_id;
    start.exercise_version = result.exercise_version;
    start.exercise_number = touch_.number;
    start.exercise_title = touch_.title;
    start.exercise_text = touch_.text;
    start.level = result.level;
    start.hand = result.hand;
    start.board = result.board;
    start.seed = 31;
    start.program = "0";
    start.recording =
        recorded ? bench_.folder.write("run.trec", small_recording(20, 1000, 3)) : std::filesystem::path();
    const AttemptId id = AttemptStore(database).begin_attempt(start);
    result.recording_path = start.recording->string();
    AttemptStore(database).finish_attempt(id, result);
    ASSERT_TRUE(model_->open_result(id.uuid));
    model_->exercise_id = model_->exercises().front().id;  // something else was chosen meanwhile
    model_->level = "L1";
    loop_->go(ScreenName::kDebrief);
    frame();
    frame();
    ASSERT_EQ(loop_->here(), ScreenName::kDebrief);
  }
  /// Pressed too hard and too long: not passed.
  AttemptResult failed(const std::string& level = "L1") const {
    AttemptResult result =
        graded(touch_, level, {{"excess_events", 4}, {"object_in_band_share", 0.72}, {"time_s", 61.5}});
    result.events = testing_support::pressing_events();
    testing_support::put_caps(result, touch_);
    return result;
  }
  bool says(const std::string& part) const {
    for (const DrawnText& t : loop_->texts())
      if (t.text.find(part) != std::string::npos) return true;
    return false;
  }
  /// Frames until it is so; a test that waits a minute has failed.
  bool wait_until(const std::function<bool()>& what) {
    for (int i = 0; i < 3000 && !what(); ++i) {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return what();
  }

  const Exercise touch_ = testing_support::shipped_exercise("surface-touch");
};

TEST_F(DebriefKeys, RBeginsTheSameExerciseAtTheSameLevelAgain) {
  debrief(failed());
  tap('R');
  EXPECT_EQ(loop_->here(), ScreenName::kRun);
  ASSERT_TRUE(model_->running());
  const AttemptSetup& setup = model_->running()->scene().setup;
  EXPECT_EQ(setup.exercise.id, "surface-touch");
  EXPECT_EQ(setup.level, "L1");
  EXPECT_EQ(setup.seed, 7) << "a board of its own, not that of the attempt before";
  EXPECT_EQ(model_->exercise_id, "surface-touch");
}

TEST_F(DebriefKeys, RAtALockedLevelSaysWhyAndStays) {
  debrief(failed("L2"));
  tap('R');
  EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
  EXPECT_FALSE(model_->running());
  EXPECT_TRUE(says("L2 is locked"));
}

TEST_F(DebriefKeys, NGoesToTheBriefingOfWhatTheDeskAdvises) {
  debrief(failed());
  const PracticeModel::Advice next = model_->next();
  ASSERT_NE(next.exercise_id, "surface-touch") << "nothing has been passed: the first one";
  model_->exercise_id = "surface-touch";
  tap('N');
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing);
  EXPECT_EQ(model_->exercise_id, next.exercise_id);
  EXPECT_EQ(model_->level, next.level);
  EXPECT_FALSE(model_->running()) << "a briefing begins nothing";
}

TEST_F(DebriefKeys, EnterTriesAgainAfterAFailureAndGoesOnAfterAPass) {
  debrief(graded(touch_, "L1"));
  ASSERT_TRUE(says("PASS"));
  tap(kKeyEnter);
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing);
  EXPECT_FALSE(model_->running());
  debrief(failed());
  tap(kKeyEnter);
  EXPECT_EQ(loop_->here(), ScreenName::kRun);
  EXPECT_TRUE(model_->running());
}

TEST_F(DebriefKeys, WWatchesFromThreeSecondsBeforeTheWorstMoment) {
  debrief(failed());
  ASSERT_TRUE(wait_until([&] { return says("Force at the tip, N"); }));
  frame(press('W'));
  EXPECT_EQ(model_->replay_file, model_->recording());
  EXPECT_TRUE(model_->replay_beside.empty());
  ASSERT_TRUE(model_->replay_at_s);
  double hardest_s = 0;
  for (const Event& e : testing_support::pressing_events())
    if (e.type == "EXCESS_FORCE") hardest_s = e.t_s;
  EXPECT_NEAR(*model_->replay_at_s, hardest_s - 3, 1e-6);
  frame();
  EXPECT_EQ(loop_->here(), ScreenName::kReplay);
}

TEST_F(DebriefKeys, WithoutARecordingWAndSDoNothing) {
  debrief(failed(), false);
  tap('W');
  tap('S');
  EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
  EXPECT_FALSE(says("The expert is doing"));
  EXPECT_FALSE(std::filesystem::exists(bench_.folder / "cache" / "trocar")) << "no expert was asked for";
}

TEST_F(DebriefKeys, SWaitsForTheExpertOnTheSameBoardAndShowsBoth) {
  debrief(failed());
  model_->exercise_id = "surface-touch";
  tap('S');
  EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
  EXPECT_TRUE(says("The expert is doing the same board"));
  ASSERT_TRUE(wait_until([&] { return loop_->here() == ScreenName::kReplay; }));
  EXPECT_EQ(model_->replay_file, model_->recording());
  ASSERT_TRUE(std::filesystem::is_regular_file(model_->replay_beside)) << model_->replay_beside;
  const RecordedSetup beside = parse_scene_json(read_recording(model_->replay_beside).session, "expert");
  EXPECT_EQ(beside.setup.hand, "expert");
  EXPECT_EQ(beside.setup.exercise.id, "surface-touch");
  EXPECT_EQ(beside.setup.level, "L1");
  EXPECT_EQ(beside.setup.board, failed().board);
  EXPECT_EQ(beside.setup.seed, model_->result()->seed);
}

TEST_F(DebriefKeys, AnExpertThatCannotBeMadeIsSaidAndMayBeAskedAgain) {
  debrief(failed());
  const std::string full = bench_.folder.write("no-folder", "a file where the cache should be").string();
  ::setenv("XDG_CACHE_HOME", full.c_str(), 1);
  for (int asked = 0; asked < 2; ++asked) {
    tap('S');
    ASSERT_TRUE(wait_until([&] { return says("The expert's run cannot be made"); })) << asked;
    EXPECT_TRUE(says("cannot be made: Not a directory"));
    EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
    EXPECT_TRUE(model_->replay_beside.empty());
  }
}

}  // namespace
}  // namespace trocar::debrief_keys_test
