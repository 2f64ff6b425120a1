// Whole exercises through the drivers of real boards and cards, which are not there, against the simulated device
// itself: the same score but for the finer points of their converters, every time to the bit, and replays that agree.
#include <gtest/gtest.h>

#include "app/session/grading/recorded_result.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/device/backends/simulated_board.h"
#include "haptics/input_error.h"
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

/// A disk that is full after so many chunks.
class FullSink final : public RecordingSink {
 public:
  explicit FullSink(int most) : most_(most) {}
  void append(std::string_view) override {
    if (++written_ > most_) throw EnvironmentError("attempt.trec: No space left on device");
  }
  void sync() override {}

 private:
  int most_, written_ = 0;
};

/// Torques that the loop asked for, a row a view, until the disk is full; and what was said then.
std::pair<std::vector<ChannelVector>, std::string> torques_until_full(const std::string& backend, int chunks) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise("surface-touch", assets.exercises);
  setup.organ = "phantom-liver";
  setup.hand = "expert";
  setup.seed = 5;
  setup.backend = backend;
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  FullSink sink(chunks);
  RecordingWriter writer(sink, scene_json(scene), setup.rate_hz);
  std::pair<std::vector<ChannelVector>, std::string> out;
  const auto seen = [&](const SessionView& view) { out.first.push_back(view.record.torque); };
  try {
    run_session(scene, assets, writer, seen, [&] { return out.first.size() >= 700; });
  } catch (const EnvironmentError& error) {
    out.second = error.what();
  }
  return out;
}

class FullDisk : public testing::TestWithParam<std::string> {};

TEST_P(FullDisk, EndsTheAttemptWithItsReasonAndNeverTouchesTheForce) {
  const auto [whole, nothing] = torques_until_full(GetParam(), 1 << 20);
  const auto [cut, reason] = torques_until_full(GetParam(), 10);
  EXPECT_EQ(nothing, "");
  EXPECT_EQ(reason, "attempt.trec: No space left on device");
  ASSERT_GT(cut.size(), 100U);
  ASSERT_LT(cut.size(), whole.size());
  for (std::size_t k = 0; k < cut.size(); ++k) ASSERT_EQ(cut[k], whole[k]) << "view " << k;
}

INSTANTIATE_TEST_SUITE_P(Backends, FullDisk, testing::ValuesIn(simulated_board_names()), [](const auto& backend) {
  std::string name = backend.param;
  std::erase(name, '-');
  return name;
});

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
