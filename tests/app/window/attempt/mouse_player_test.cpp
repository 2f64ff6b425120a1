// A person can do it: the exercises are played by mouse from what the screen shows, and end with a score.
#include <gtest/gtest.h>

#include "app/session/recording/recording_reader.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/window/attempt/mouse_player.h"

namespace trocar::mouse_player_test {
namespace {

struct Played {
  SessionOutcome outcome;
  Grade grade;
};

Played play(const std::string& exercise, int board, const SteeringOptions& options = {}) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise(exercise, assets.exercises);
  setup.organ = "phantom-liver";
  setup.hand = "mouse";
  setup.seed = 7;
  setup.board = board;
  const Scene scene = build_scene(setup, assets, {"simulated", 1000, 16});
  MousePlayer player(scene, options);
  auto [outcome, recording] = record_session(scene, assets, player.hooks(), {});
  const Grade grade = grade_recording(recording, "played");
  return {std::move(outcome), grade};
}

void tell(const Played& played) {
  std::printf("status %s  score %.1f  ends at %.1f s\n", status_name(played.grade.status),
              played.grade.score.value_or(-1), played.outcome.events.empty() ? 0 : played.outcome.events.back().t_s);
  for (const Subscore& s : played.grade.subscores)
    std::printf("  %-16s %3.0f %%  raw %.3f %s\n", s.name.c_str(), 100 * s.value, s.raw.value_or(-1), s.unit.c_str());
  for (const Cap& cap : played.grade.caps) std::printf("  cap %s\n", cap_sentence(cap).c_str());
}

TEST(MousePlayer, SurfaceTouchCanBePlayedByMouseAlone) {
  const Played played = play("surface-touch", 3);
  tell(played);
  EXPECT_EQ(played.grade.status, AttemptStatus::kCompleted) << played.outcome.device.reason;
  ASSERT_TRUE(played.grade.score);
  EXPECT_GT(*played.grade.score, 40) << "a player who sees 200 ms late and is told no depth";
}

TEST(MousePlayer, ReachAndOrientCanBePlayedByMouseAlone) {
  const Played played = play("reach-and-orient", 3);
  tell(played);
  EXPECT_EQ(played.grade.status, AttemptStatus::kCompleted) << played.outcome.device.reason;
  ASSERT_TRUE(played.grade.score);
  EXPECT_GT(*played.grade.score, 40);
}

}  // namespace
}  // namespace trocar::mouse_player_test
