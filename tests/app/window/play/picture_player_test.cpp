// Who sees only the screen can pass: the window's own pictures in, events of a hand out. Time is the attempt's own, so
// that the same player plays the same however slowly pictures are made.
#include <iostream>

#include "app/picture/films/video_writer.h"
#include "app/window/attempt/step_gate.h"
#include "app/window/practice/practice_loop.h"
#include "scenarios/scoring/attempt_result.h"
#include "tests/app/window/pages/loop_bench.h"
#include "tests/app/window/play/picture_player.h"
#include "tests/support/repeats.h"

namespace trocar::testing_support::picture_player_test {
namespace {

constexpr double kFrame_s = 0.05;
constexpr int kKeepEvery = 5;  // pictures

using Task = PicturePlayer::Task;

void tell(const Grade& grade) {
  std::printf("%s score %.1f passed %d\n", status_name(grade.status), grade.score.value_or(-1), grade.passed);
  for (const Subscore& s : grade.subscores)
    std::printf("  %-16s %3.0f %%  raw %.3f %s\n", s.name.c_str(), 100 * s.value, s.raw.value_or(-1), s.unit.c_str());
}

/// With PLAYER_PICTURES=FOLDER: what was seen, and what the player took from it.
void keep(const std::string& folder, int number, const PicturePlayer& player, const Image& picture) {
  char name[64];
  std::snprintf(name, sizeof name, "/%05d.png", number);
  write_png(folder + name, picture);
  const Glance g = glance(picture);
  std::cerr << name << ' ' << player.doing << " force " << static_cast<int>(g.force);
  if (g.lit) std::cerr << " lit " << g.lit->x << ' ' << g.lit->y << " wide " << g.lit_wide;
  if (g.foot) std::cerr << " foot " << g.foot->x << ' ' << g.foot->y << " tip " << g.tip->x << ' ' << g.tip->y;
  std::cerr << '\n';
}

/// With PLAYER_FILMS=FOLDER: the attempt as its player saw it.
std::unique_ptr<VideoWriter> film(const std::string& name, int width, int height) {
  const char* folder = std::getenv("PLAYER_FILMS");
  if (!folder) return nullptr;
  return std::make_unique<VideoWriter>(std::filesystem::path(folder) / (name + ".mp4"), width, height, 1 / kFrame_s);
}

class PicturePlay : public LoopBench {
 protected:
  /// One attempt, from its briefing to its debrief. @return its grade.
  Grade attempt(const std::string& exercise, Task task, std::int64_t seed, InputKind input) {
    ModelOptions options = bench_.options();
    options.exercise = exercise;
    options.seed = seed;
    options.input = input_name(input);
    options.steps = &steps_;
    width_ = test::repeats("PLAY_WIDTH", 960);
    height_ = width_ * 9 / 16;
    loop_.reset();
    model_.reset();
    context_ = std::make_unique<HeadlessContext>();  // each attempt as in a window of its own
    open(options);
    frame();
    tap(kKeyEnter);
    const std::unique_ptr<PlayerHand> hand = player_hand(input, height_);
    PicturePlayer player(*hand, task);
    const std::unique_ptr<VideoWriter> filmed =
        film(exercise + "-" + input_name(input) + "-" + std::to_string(seed), width_, height_);
    const char* kept_in = std::getenv("PLAYER_PICTURES");
    std::vector<InputEvent> events;
    int n = 0;
    for (double t_s = 0; loop_->here() != ScreenName::kDebrief && t_s < 320; t_s += kFrame_s) {
      steps_.advance(kFrame_s);
      const bool kept = kept_in && n++ % kKeepEvery == 0, looks = player.looks(t_s), drawn = looks || kept || filmed;
      loop_->draw_scopes(drawn);
      loop_->frame(width_, height_, kFrame_s, events);
      const Image picture = drawn ? loop_->picture() : Image();
      events = player.play(t_s, looks ? &picture : nullptr);
      if (kept) keep(kept_in, n, player, picture);
      if (filmed) filmed->add(picture);
    }
    if (filmed) filmed->close();
    EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
    return model_->result() ? model_->result()->grade : Grade{};
  }

  /// Each try on a board of its own.
  void passes(const std::string& exercise, Task task, int tries, int seed, InputKind input) {
    for (int n = 0; n < tries; ++n) {
      const Grade grade = attempt(exercise, task, 1000 * n + seed, input);
      std::printf("%s by %s, seed %d, try %d: ", exercise.c_str(), input_name(input), seed, n + 1);
      tell(grade);
      std::fflush(stdout);
      if (grade.passed) return;
    }
    ADD_FAILURE() << exercise << ": not passed in " << tries << " tries, seed " << seed;
  }

  StepGate steps_;
};

constexpr int kShortTries = 3;

TEST_F(PicturePlay, PassesReachAndOrient) { passes("E01", Task::kReach, kShortTries, 7, InputKind::kMouse); }
TEST_F(PicturePlay, PassesSurfaceTouch) { passes("E02", Task::kTouch, kShortTries, 7, InputKind::kMouse); }
TEST_F(PicturePlay, PassesLimitedGrasp) { passes("E03", Task::kGrasp, kShortTries, 7, InputKind::kMouse); }
TEST_F(PicturePlay, PassesSurfaceTouchByKeys) { passes("E02", Task::kTouch, kShortTries, 7, InputKind::kKeyboard); }
TEST_F(PicturePlay, PassesReachAndOrientByPad) { passes("E01", Task::kReach, kShortTries, 7, InputKind::kPad); }

/// How many tries each exercise takes on how many boards; by hand (ctest -L long).
class PictureSweep : public PicturePlay, public ::testing::WithParamInterface<InputKind> {
 protected:
  void passes_within(const std::string& exercise, Task task, int tries) {
    const int seeds = test::repeats("PLAY_SEEDS", 0), first = test::repeats("PLAY_FIRST", 1);
    if (seeds == 0) GTEST_SKIP() << "only with PLAY_SEEDS";
    for (int seed = first; seed < first + seeds; ++seed) passes(exercise, task, tries, seed, GetParam());
  }
};

TEST_P(PictureSweep, SurfaceTouchWithinFive) { passes_within("E02", Task::kTouch, 5); }
TEST_P(PictureSweep, ReachAndOrientWithinFifteen) { passes_within("E01", Task::kReach, 15); }
TEST_P(PictureSweep, LimitedGraspWithinFifteen) { passes_within("E03", Task::kGrasp, 15); }

TEST_P(PictureSweep, PegTransferWithinFifteen) { passes_within("E05", Task::kPegs, 15); }

TEST_P(PictureSweep, RetractAndHoldWithinFifteen) { passes_within("E09", Task::kRetract, 15); }

INSTANTIATE_TEST_SUITE_P(By, PictureSweep, ::testing::Values(InputKind::kMouse, InputKind::kKeyboard, InputKind::kPad),
                         [](const auto& one) { return std::string(input_name(one.param)); });

}  // namespace
}  // namespace trocar::testing_support::picture_player_test
