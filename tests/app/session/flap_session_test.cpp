// A flap through the whole chain: a hand takes its free edge, lifts it and cuts into it; recorded, solved again to the
// bit, and played without solving.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "app/session/playback/recorded_run.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/waypoint_hand.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/tissue_world.h"

namespace trocar::flap_session_test {
namespace {

Scene flap_scene(const std::string& tissue, const std::string& organ = "phantom-liver") {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = load_exercise(assets.exercises / "ungraded" / "flap.toml");
  setup.organ = organ;
  setup.hand = "waypoints";
  setup.tissue = tissue;
  return build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
}

std::vector<ScriptedMove> lift_moves() {
  const auto move = [](double y_mm, double z_mm, double seconds, double jaw_mm) {
    return ScriptedMove{
        .to_m = {0, 1e-3 * y_mm, 1e-3 * z_mm}, .seconds = seconds, .hold_s = 0.4, .jaw_m = 1e-3 * jaw_mm};
  };
  return {move(0, 45, 2, 0),    move(-13, 12, 1.5, 14), move(-13, -5, 1.5, 14), move(-13, -5, 1, 0),
          move(-8, 18, 2.5, 0), move(8, 30, 2.5, 0),    move(8, 30, 0.5, 14),   move(0, 45, 2, 14)};
}

TEST(FlapSession, ALiftedFlapReplaysToTheBitAndPlaysWithoutSolving) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "flap.trec";
  const Scene scene = flap_scene("normal");
  ASSERT_EQ(scene.sheets.size(), 1U);
  SessionHooks hooks;
  double now_s = 0, held_s = 0, highest_m = -1;
  std::vector<SurfacePtr> thin_T;
  hooks.hand = [] { return std::make_unique<WaypointHand>(lift_moves()); };
  hooks.interrupted = [&] { return now_s > 20; };
  hooks.observe = [&](const SessionView& view) {
    if (view.tissue && view.tissue->held()) held_s += view.t_s - now_s;
    now_s = view.t_s;
    thin_T = view.thin_T;
    if (!thin_T.empty())
      for (const Vec3& vertex : thin_T[0]->vertices) highest_m = std::max(highest_m, vertex.z());
  };
  const auto [outcome, recording] = record_session(scene, find_assets(), hooks, file);
  EXPECT_EQ(outcome.device.fault, "");
  EXPECT_GT(held_s, 5);
  EXPECT_GT(highest_m, 0.022);
  ASSERT_EQ(thin_T.size(), 1U);

  const RecordedSetup recorded = parse_scene_json(recording.session, "flap");
  const Scene again = build_scene(recorded.setup, find_assets(), recorded.daq);
  EXPECT_EQ(replay_session(again, recording).state_hash_hex, outcome.state_hash_hex);

  const RecordedRun played(file, find_assets());
  const RunMoment end = played.at(played.end_s());
  ASSERT_EQ(end.thin_T.size(), 1U);
  ASSERT_EQ(end.thin_T[0]->triangles, thin_T[0]->triangles);
  for (std::size_t v = 0; v < thin_T[0]->vertices.size(); ++v)
    EXPECT_LT((end.thin_T[0]->vertices[v] - thin_T[0]->vertices[v]).norm(), 1e-3) << v;
}

TEST(FlapSession, AnOrganThatStandsStillHasNone) {
  EXPECT_TRUE(flap_scene("still").sheets.empty());
  EXPECT_TRUE(flap_scene("still").thin_left_out.empty());
}

}  // namespace
}  // namespace trocar::flap_session_test
