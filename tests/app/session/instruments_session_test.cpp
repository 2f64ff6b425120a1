// Pedal and exchange switch through a whole session: a script that uses them, what the rows keep, replay, playback.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "app/session/playback/recorded_run.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/waypoint_hand.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::instruments_session_test {
namespace {

/// Into the start ball with the grasper, then the hook, energised for a second, then scissors by way of all others.
std::vector<ScriptedMove> moves() {
  const ScriptedMove to_start{.to_m = {0, 0, 0.045}, .seconds = 2, .hold_s = 0.5};
  ScriptedMove hook = to_start, scissors = to_start;
  hook.instrument = InstrumentKind::kHook;
  hook.seconds = hook.hold_s = 0.5;
  hook.pedal = true;
  scissors.instrument = InstrumentKind::kScissors;
  scissors.seconds = 0.2;
  return {to_start, hook, scissors};
}

class InstrumentsSession : public testing::TestWithParam<const char*> {};

TEST_P(InstrumentsSession, AreTakenEnergisedRecordedReplayedAndPlayed) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "instruments.trec";
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = load_exercise(assets.exercises / "ungraded" / "free-play.toml");
  setup.organ = "phantom-liver";
  setup.hand = "waypoints";
  setup.backend = GetParam();
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  SessionHooks hooks;
  double now_s = 0;
  std::vector<std::int32_t> taken;
  hooks.hand = [] { return std::make_unique<WaypointHand>(moves()); };
  hooks.interrupted = [&] { return now_s > 9; };
  hooks.observe = [&](const SessionView& view) {
    now_s = view.t_s;
    const std::int32_t instrument = view.record.stylus.instrument;
    if (taken.empty() || taken.back() != instrument) taken.push_back(instrument);
  };
  const auto [outcome, recording] = record_session(scene, assets, hooks, file);
  EXPECT_EQ(outcome.device.fault, "");
  EXPECT_EQ(taken, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 0, 1})) << "in the order of the exercise's list";

  int pressed = 0, energised = 0;
  for (const RecordedTick& row : recording.ticks) {
    const TraceSample sample = dequantise(row, recording.rate_hz);
    pressed += (row.digital_in & kPedal) != 0;
    energised += sample.pedal;
    EXPECT_TRUE(!sample.pedal || scene.setup.exercise.instruments.at(sample.instrument) == InstrumentKind::kHook);
  }
  EXPECT_NEAR(pressed, 1000, 3);
  EXPECT_EQ(energised, pressed);

  const RecordedSetup recorded = parse_scene_json(recording.session, "instruments");
  const Scene again = build_scene(recorded.setup, assets, recorded.daq);
  EXPECT_EQ(replay_session(again, recording).state_hash_hex, outcome.state_hash_hex);

  const RecordedRun run(file, assets);
  std::vector<std::int32_t> seen;
  bool with_pedal = false;
  for (double t = 0; t < run.end_s(); t += 0.05) {
    const StylusState& stylus = run.at(t).record.stylus;
    if (seen.empty() || seen.back() != stylus.instrument) seen.push_back(stylus.instrument);
    with_pedal = with_pedal || stylus.pedal;
  }
  EXPECT_EQ(seen, taken);
  EXPECT_TRUE(with_pedal);
}

INSTANTIATE_TEST_SUITE_P(BothDevices, InstrumentsSession, testing::Values("simulated", "pointer"),
                         [](const auto& backend) { return std::string(backend.param); });

}  // namespace
}  // namespace trocar::instruments_session_test
