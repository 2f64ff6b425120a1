// The ducts of free play through the whole chain: a hand holds the cystic duct, clips it twice, cuts between; recorded,
// solved again to the bit, and played without solving.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "app/session/playback/recorded_run.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/waypoint_hand.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/thin/duct_system.h"
#include "tissue/tissue_world.h"

namespace trocar::ducts_session_test {
namespace {

Scene ducts_scene(const std::string& tissue, const std::string& organ = "phantom-liver") {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = load_exercise(assets.exercises / "ungraded" / "free-play.toml");
  setup.organ = organ;
  setup.hand = "waypoints";
  setup.tissue = tissue;
  return build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
}

/// Jaws over a place of the duct's path, 0 .. 1, closed on it, and away again.
void add_closing(std::vector<ScriptedMove>& moves, const Scene& scene, double share, InstrumentKind kind,
                 double pull_m = 0) {
  const std::vector<Vec3>& path = scene.ducts[0].path_T;
  const Vec3 along = scene.loop.map.instrument_pose(home_pose()).R.col(2);
  const Vec3 at = path.front() + share * (path.back() - path.front()) + 0.0065 * along;
  const auto move = [&](const Vec3& to, double seconds, double jaw_m) {
    moves.push_back({.to_m = to, .seconds = seconds, .hold_s = 0.3, .jaw_m = jaw_m, .instrument = kind});
  };
  move(at - 0.03 * along, 1.5, 0.012);
  move(at, 1, 0.012);
  move(at, 0.8, kind == InstrumentKind::kScissors ? -0.015 : 0);  // the fingers press
  if (pull_m > 0) move(at - pull_m * along, 1, 0), move(at, 1, 0);
  move(at, 0.6, 0.012);
  move(at - 0.03 * along, 1, 0.012);
}

struct Ducts {
  SessionOutcome outcome;
  Recording recording;
  bool held = false;
  double pulled_m = 0;
  SurgeryState last;
  std::vector<SurfacePtr> thin_T;
};

Ducts run(const Scene& scene, const std::vector<ScriptedMove>& moves, double most_s,
          const std::filesystem::path& file = {}) {
  Ducts out;
  SessionHooks hooks;
  double now_s = 0;
  hooks.hand = [&] { return std::make_unique<WaypointHand>(moves); };
  hooks.interrupted = [&] { return now_s > most_s; };
  hooks.observe = [&](const SessionView& view) {
    now_s = view.t_s;
    out.held = out.held || (view.tissue && view.tissue->held());
    if (view.tissue) out.last = view.tissue->surgery;
    if (view.thin_T.empty()) return;
    out.thin_T = view.thin_T;
    const SurfaceSnapshot& tube = *view.thin_T[0];
    if (!tube.rest || tube.topology > 0) return;
    for (std::size_t v = 0; v < tube.vertices.size(); ++v)
      out.pulled_m = std::max(out.pulled_m, (tube.vertices[v] - tube.rest->vertices[v]).norm());
  };
  std::tie(out.outcome, out.recording) = record_session(scene, find_assets(), hooks, file);
  return out;
}

TEST(DuctsSession, IsHeldClippedTwiceAndCutBetweenReplaysToTheBitAndPlaysWithoutSolving) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "ducts.trec";
  const Scene scene = ducts_scene("normal");
  ASSERT_EQ(scene.ducts.size(), 2U);
  EXPECT_EQ(scene.thin_T.size(), 2U);
  std::vector<ScriptedMove> moves{{.to_m = {0, 0, 0.045}, .seconds = 2, .hold_s = 0.5, .jaw_m = 0.012}};
  add_closing(moves, scene, 0.5, InstrumentKind::kGrasper, 0.008);
  add_closing(moves, scene, 0.35, InstrumentKind::kClipApplier);
  add_closing(moves, scene, 0.65, InstrumentKind::kClipApplier);
  add_closing(moves, scene, 0.5, InstrumentKind::kScissors);
  const Ducts ran = run(scene, moves, 45, file);
  EXPECT_EQ(ran.outcome.device.fault, "");
  EXPECT_TRUE(ran.held);
  EXPECT_GT(ran.pulled_m, 0.003);
  EXPECT_EQ(ran.last.clips, 2) << closing_words(ran.last.refusal);
  EXPECT_EQ(ran.last.cuts, 1) << closing_words(ran.last.refusal);
  EXPECT_EQ(ran.last.blood_ml, 0);
  EXPECT_EQ(ran.last.bile_leaks, 0);
  ASSERT_EQ(ran.thin_T.size(), 2U);
  EXPECT_EQ(ran.thin_T[0]->topology, 1U);

  const RecordedSetup recorded = parse_scene_json(ran.recording.session, "ducts");
  const Scene again = build_scene(recorded.setup, find_assets(), recorded.daq);
  EXPECT_EQ(replay_session(again, ran.recording).state_hash_hex, ran.outcome.state_hash_hex);

  const RecordedRun played(file, find_assets());
  const RunMoment first = played.at(1), last = played.at(played.end_s());
  ASSERT_EQ(first.thin_T.size(), 2U);
  EXPECT_EQ(first.thin_T[0]->topology, 0U);
  ASSERT_EQ(last.thin_T.size(), 2U);
  EXPECT_EQ(last.thin_T[0]->triangles, ran.thin_T[0]->triangles);
  ASSERT_EQ(last.thin_T[0]->vertices.size(), ran.thin_T[0]->vertices.size());
  for (std::size_t v = 0; v < ran.thin_T[0]->vertices.size(); ++v)
    EXPECT_LT((last.thin_T[0]->vertices[v] - ran.thin_T[0]->vertices[v]).norm(), 6e-4) << v;
  EXPECT_EQ(last.tissue.surgery.clips, 2);
}

TEST(DuctsSession, AnOrganThatStandsStillOrIsNoLiverGoesWithoutThem) {
  EXPECT_TRUE(ducts_scene("still").ducts.empty());
  const Scene gallbladder = ducts_scene("normal", "phantom-gallbladder");
  EXPECT_TRUE(gallbladder.ducts.empty());
  EXPECT_EQ(gallbladder.thin_left_out, (std::vector<std::string>{"cystic duct", "cystic artery"}));
}

TEST(DuctsSession, ATissueThatIsNotKnownIsNamed) {
  AttemptSetup setup = ducts_scene("still").setup;
  setup.tissue = "normal";
  setup.exercise.ducts[1].material = "rubber";
  try {
    build_scene(setup, find_assets(), backend_capabilities(setup.backend, setup.rate_hz));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cystic artery"), std::string::npos) << message;
    EXPECT_NE(message.find("rubber"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace trocar::ducts_session_test
