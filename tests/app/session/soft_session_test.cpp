// An attempt on tissue that gives way, through the whole chain: lockstep, recording, replay, keyframes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "app/session/playback/recorded_run.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/hands/waypoint_hand.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::soft_session_test {
namespace {

/// Free play on a bed that lies still, so that where the organ is can be told.
Exercise still_play(const std::filesystem::path& file) {
  std::string text = test::edited(read_text_file(file.string()), "depth_mm = 4", "depth_mm = 0");
  return parse_exercise(test::edited(text, "beat_mm = 0.4", "beat_mm = 0"), file);
}

Scene soft_scene(const std::string& tissue, const std::string& exercise = "free-play") {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = exercise == "free-play" ? still_play(assets.exercises / "ungraded" / "free-play.toml")
                                           : find_exercise(exercise, assets.exercises);
  setup.organ = "phantom-liver";
  setup.hand = "waypoints";
  setup.tissue = tissue;
  return build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
}

/// Into the start ball, down with open jaws, closed, up again, open.
std::vector<ScriptedMove> grasp_and_lift() {
  const auto move = [](double z_mm, double seconds, double jaw_mm) {
    return ScriptedMove{.to_m = {0, 0, 1e-3 * z_mm}, .seconds = seconds, .hold_s = 0.5, .jaw_m = 1e-3 * jaw_mm};
  };
  return {move(45, 3, 14), move(-6, 2, 18), move(-8, 1.5, 0), move(12, 2, 0), move(12, 1, 25), move(45, 1, 25)};
}

struct Lifted {
  SessionOutcome outcome;
  Recording recording;
  double deepest_m = 0, highest_m = 0, furthest_at_end_m = 0;  ///< of a vertex against its rest, along z; at the end
  bool held = false;
};

/// @param most_s 22: all of it; 8: until the jaws are down.
Lifted lift(const Scene& scene, double most_s, const std::filesystem::path& file = {}) {
  Lifted out;
  SessionHooks hooks;
  double now_s = 0;
  hooks.hand = [] { return std::make_unique<WaypointHand>(grasp_and_lift()); };
  hooks.interrupted = [&] { return now_s > most_s; };
  hooks.observe = [&](const SessionView& view) {
    now_s = view.t_s;
    out.held = out.held || (view.tissue && view.tissue->held());
    if (!view.organ_T || !view.organ_T->rest) return;
    out.furthest_at_end_m = 0;
    for (std::size_t v = 0; v < view.organ_T->vertices.size(); ++v) {
      const Vec3 way = view.organ_T->vertices[v] - view.organ_T->rest->vertices[v];
      out.deepest_m = std::min(out.deepest_m, way.z());
      out.highest_m = std::max(out.highest_m, way.z());
      out.furthest_at_end_m = std::max(out.furthest_at_end_m, way.norm());
    }
  };
  std::tie(out.outcome, out.recording) = record_session(scene, find_assets(), hooks, file);
  return out;
}

TEST(SoftSession, AFoldIsPressedLiftedAndLetGoReplaysToTheBitAndPlaysWithoutSolving) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "lift.trec";
  const Scene scene = soft_scene("normal");
  const Lifted lifted = lift(scene, 22, file);
  EXPECT_EQ(lifted.outcome.device.fault, "");
  EXPECT_TRUE(lifted.held);
  EXPECT_LT(lifted.deepest_m, -1e-3);
  EXPECT_GT(lifted.highest_m, 3e-3);
  EXPECT_LT(lifted.furthest_at_end_m, 1e-3) << "let go, it goes back";

  const RecordedSetup recorded = parse_scene_json(lifted.recording.session, "lift");
  EXPECT_EQ(recorded.setup.tissue, "normal");
  const Scene again = build_scene(recorded.setup, find_assets(), recorded.daq);
  EXPECT_EQ(replay_session(again, lifted.recording).state_hash_hex, lifted.outcome.state_hash_hex);

  const RecordedRun run(file, find_assets());
  ASSERT_TRUE(run.plays_keyframes());
  double highest = 0;
  for (double t = run.end_s(); t > 0; t -= 0.25) {  // any order
    const RunMoment moment = run.at(t);
    ASSERT_TRUE(moment.organ_T);
    for (std::size_t v = 0; v < moment.organ_T->vertices.size(); ++v)
      highest = std::max(highest, (moment.organ_T->vertices[v] - scene.organ_T->vertices[v]).z());
  }
  EXPECT_NEAR(highest, lifted.highest_m, 1e-3) << "20 keyframes a second, quanta of 0.05 mm";
}

TEST(SoftSession, OneStiffnessIsNotTheOther) {
  const Scene soft = soft_scene("soft"), stiff = soft_scene("stiff");
  EXPECT_LT(lift(soft, 8).deepest_m, 1.1 * lift(stiff, 8).deepest_m) << "the same hand goes deeper";
  EXPECT_THROW(soft_scene("runny"), std::exception);
}

TEST(SoftSession, AnExerciseRunsOnTissueThatGivesWay) {
  const Scene scene = soft_scene("stiff", "surface-touch");
  ASSERT_TRUE(scene.soft);
  EXPECT_EQ(scene.setup.exercise.instruments, std::vector{InstrumentKind::kProbe});
  EXPECT_FALSE(soft_scene("still", "surface-touch").soft);
}

}  // namespace
}  // namespace trocar::soft_session_test
