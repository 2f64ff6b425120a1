// Exercises done to their end by mouse and keys, by the expert's aims. E01, E02, E03 and E05 are played by who sees the
// window's pictures alone (tests/app/window/play).
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>

#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "tests/app/window/steered/steered_hand.h"
#include "tests/support/repeats.h"

namespace trocar::steered_play_test {
namespace {

struct Played {
  AttemptStatus status;
  Grade grade;
  std::string reason;
};

Played played(const std::string& number, const std::string& level, std::int64_t seed) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise(number, assets.exercises);
  setup.level = level;
  setup.organ = "phantom-liver";
  setup.tissue = setup.exercise.tissue;
  setup.hand = "mouse";
  setup.seed = seed;
  setup.board = static_cast<int>(seed % 20);
  setup.backend = kPointerBackend;
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  RunMoment newest;
  SessionHooks hooks;
  hooks.hand = [&] {
    return std::make_unique<testing_support::SteeredHand>(
        scene, newest, make_hand("expert", static_cast<std::uint64_t>(seed), assets.hands));
  };
  hooks.observe = [&](const SessionView& view) {
    newest.record = view.record;
    newest.status = view.director.status();
    if (view.tissue) newest.tissue = *view.tissue;
    newest.t_s = view.t_s;
    newest.seen = true;
  };
  const auto [outcome, recording] = record_session(scene, assets, hooks, {});
  return {outcome.status, grade_recording(recording, number).grade, outcome.device.reason};
}

/// Done to the end, whatever the score: the expert's aims are those of a hand that feels.
void plays(const std::string& number) {
  const Played one = played(number, "L1", 1);
  std::printf("%s L1 by mouse and keys: %s %s, %.1f points\n", number.c_str(), status_name(one.status),
              one.reason.c_str(), one.grade.score.value_or(0));
  for (const Subscore& sub : one.grade.subscores) std::printf("  %-20s %.2f\n", sub.name.c_str(), sub.value);
  EXPECT_EQ(one.status, AttemptStatus::kCompleted) << one.reason;
}

TEST(SteeredPlay, CameraNavigation) { plays("E04"); }
TEST(SteeredPlay, RingOnWire) { plays("E06"); }
TEST(SteeredPlay, ClipAndCut) { plays("E11"); }
TEST(SteeredPlay, BleedersAndHook) { plays("E13"); }

class SteeredSweep : public ::testing::TestWithParam<const char*> {};

TEST_P(SteeredSweep, ToTheEnd) {
  if (test::repeats("STEERED_PLAYS", 0) == 0) GTEST_SKIP() << "only with STEERED_PLAYS=1";
  plays(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Of, SteeredSweep, ::testing::Values("E07", "E08", "E09", "E10", "E12", "E14"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace trocar::steered_play_test
