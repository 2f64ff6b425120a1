// Whole exercises through the drivers of real boards and cards, which are not there, against the simulated device
// itself: the same score but for the finer points of their converters, every time to the bit, and replays that agree.
#include <gtest/gtest.h>

#include "app/session/grading/recorded_result.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::real_drivers_test {
namespace {

struct Attempted {
  double score = 0;
  std::string status, hash, replayed;
};

Attempted attempt(const std::string& backend) {
  const test::TemporaryFolder folder;
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise("reach-and-orient", assets.exercises);
  setup.hand = "expert";
  setup.seed = 5;
  setup.board = 3;
  setup.backend = backend;
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  const std::filesystem::path file = folder / "attempt.trec";
  const auto [outcome, recording] = record_session(scene, assets, SessionHooks{}, file);
  const AttemptResult result = recorded_result(recording, file);
  EXPECT_EQ(outcome.device.fault, "") << backend;
  EXPECT_EQ(outcome.device.backend, backend);
  const RecordedSetup recorded = parse_scene_json(recording.session, "attempt");
  const Scene again = build_scene(recorded.setup, assets, recorded.daq);
  return {result.grade.score.value_or(0), status_name(result.grade.status), outcome.state_hash_hex,
          replay_session(again, recording).state_hash_hex};
}

class RealDrivers : public testing::TestWithParam<const char*> {};

TEST_P(RealDrivers, GiveTheScoreOfTheSimulatedDevice) {
  static const Attempted simulated = attempt(kSimulatedBackend);
  const Attempted first = attempt(GetParam()), second = attempt(GetParam());
  EXPECT_EQ(first.status, "completed");
  EXPECT_GT(simulated.score, 80);
  EXPECT_NEAR(first.score, simulated.score, 2) << "13 bits for 16, a period or two later";
  EXPECT_EQ(first.hash, second.hash) << "to the bit";
  EXPECT_EQ(first.replayed, first.hash);
  RecordProperty("score", std::to_string(first.score));
  RecordProperty("simulated", std::to_string(simulated.score));
}

INSTANTIATE_TEST_SUITE_P(Backends, RealDrivers, testing::Values(kFakeHostmot2Backend, kEmulatedMc4000Backend),
                         [](const auto& backend) { return backend.index == 0 ? "Hostmot2" : "Mc4000"; });

TEST(RealArm, OneBoardIsNotTwo) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise("reach-and-orient", assets.exercises);
  setup.hand = "expert";
  setup.backend = kMc4000Backend;
  setup.card = "/nowhere";
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  const test::TemporaryFolder folder;
  EXPECT_THROW(record_session(scene, assets, SessionHooks{}, folder / "a.trec"), InputError) << "one board is not two";
}

}  // namespace
}  // namespace trocar::real_drivers_test
