// An attempt that cuts, burns and bleeds, through the whole chain: lockstep, recording, replay, keyframes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "app/session/playback/recorded_run.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/waypoint_hand.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::surgery_session_test {
namespace {

/// Scissors down with open blades, squeezed shut, up; then the hook, energised, drawn along beside it.
std::vector<ScriptedMove> cut_and_burn() {
  const auto move = [](double x_mm, double y_mm, double z_mm, double seconds, double jaw_mm, InstrumentKind kind,
                       bool pedal = false) {
    return ScriptedMove{.to_m = 1e-3 * Vec3(x_mm, y_mm, z_mm),
                        .seconds = seconds,
                        .hold_s = 0.2,
                        .jaw_m = 1e-3 * jaw_mm,
                        .pedal = pedal,
                        .instrument = kind};
  };
  const auto scissors = InstrumentKind::kScissors, hook = InstrumentKind::kHook;
  return {move(0, 0, 45, 2, 12, scissors),    move(0, 0, -9, 1.5, 14, scissors), move(0, 0, -9, 0.6, -15, scissors),
          move(0, 0, 30, 0.8, 0, scissors),   move(20, -12, 15, 1, 10, hook),    move(20, -12, -4, 0.8, 10, hook, true),
          move(20, 6, -4, 3, 10, hook, true), move(20, 6, 30, 1, 10, hook)};
}

TEST(SurgerySession, ACutAndABurnReplayToTheBitAndPlayWithoutSolving) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "surgery.trec";
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = load_exercise(assets.exercises / "ungraded" / "free-play.toml");
  setup.organ = "phantom-liver";
  setup.hand = "waypoints";
  setup.tissue = "normal";
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  SessionHooks hooks;
  double now_s = 0;
  SurgeryState last;
  SurfacePtr surface;
  hooks.hand = [] { return std::make_unique<WaypointHand>(cut_and_burn()); };
  hooks.interrupted = [&] { return now_s > 16; };
  hooks.observe = [&](const SessionView& view) {
    now_s = view.t_s;
    if (view.tissue) last = view.tissue->surgery;
    if (view.organ_T) surface = view.organ_T;
  };
  const auto [outcome, recording] = record_session(scene, assets, hooks, file);
  EXPECT_EQ(outcome.device.fault, "");
  EXPECT_GE(last.cuts, 2) << "one by the scissors, some by the hook";
  EXPECT_GT(last.blood_ml, 0.05);
  EXPECT_GT(last.heat_j, 10);
  ASSERT_TRUE(surface && surface->topology == std::uint64_t(last.cuts));

  const RecordedSetup recorded = parse_scene_json(recording.session, "surgery");
  const Scene again = build_scene(recorded.setup, assets, recorded.daq);
  EXPECT_EQ(replay_session(again, recording).state_hash_hex, outcome.state_hash_hex);

  const RecordedRun run(file, assets);
  ASSERT_TRUE(run.plays_keyframes());
  const RunMoment end = run.at(run.end_s());
  ASSERT_TRUE(end.organ_T);
  EXPECT_EQ(end.organ_T->triangles, surface->triangles);
  EXPECT_EQ(end.tissue.surgery.cuts, last.cuts);
  EXPECT_NEAR(end.tissue.surgery.blood_ml, last.blood_ml, 1e-3);
  double off = 0;
  for (std::size_t v = 0; v < surface->vertices.size(); ++v)
    off = std::max(off, (end.organ_T->vertices[v] - surface->vertices[v]).norm());
  EXPECT_LT(off, 5e-4) << "quanta of 0.05 mm, a moment later";
  // Backwards: before the first cut the surface is whole again.
  ASSERT_TRUE(run.at(1).organ_T);
  EXPECT_EQ(run.at(1).organ_T->topology, 0U);
  EXPECT_EQ(run.at(run.end_s()).organ_T->topology, surface->topology);
}

}  // namespace
}  // namespace trocar::surgery_session_test
