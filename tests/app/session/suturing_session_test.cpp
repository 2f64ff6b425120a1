// A stitch through the whole chain: a hand takes the needle driver, rolls the needle through the liver, takes its
// point, draws the thread through; recorded, solved again to the bit, and played without solving.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "app/session/playback/recorded_run.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/least_turn.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/waypoint_hand.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/interaction/suturing.h"
#include "tissue/tissue_world.h"

namespace trocar::suturing_session_test {
namespace {

constexpr double kOver = 0.004;            // m of the circle's middle over the surface, in the circle's plane
const Vec3 kWhere(-0.036, -0.022, -0.01);  // where the shaft passes along the surface, in sight
constexpr double kDegree = std::numbers::pi / 180;

Scene stitching_scene(const std::string& tissue) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = load_exercise(assets.exercises / "ungraded" / "stitching.toml");
  setup.organ = "phantom-liver";
  setup.hand = "waypoints";
  setup.tissue = tissue;
  return build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
}

/// Of a needle that is turned in the plane across the shaft: angles about the shaft's back, from the side, 90 degrees
/// off the tissue.
struct Stitch {
  explicit Stitch(const Scene& scene) : fulcrum(*scene.loop.map.fulcrum), r(scene.suture->needle.radius_m()) {
    const SurfaceSnapshot& organ = *scene.organ_T;
    const auto nearest = std::min_element(
        organ.vertices.begin(), organ.vertices.end(),
        [](const Vec3& a, const Vec3& b) { return (a - kWhere).squaredNorm() < (b - kWhere).squaredNorm(); });
    const Vec3 normal = organ.vertex_normals()[static_cast<std::size_t>(nearest - organ.vertices.begin())];
    along = (*nearest - fulcrum.port_T).normalized();
    const Vec3 swing_from = fulcrum.R_TI_reference.col(2);
    R0 = least_turn(swing_from, along).toRotationMatrix() * fulcrum.R_TI_reference;
    up = (normal - normal.dot(along) * along).normalized();
    side = up.cross(-along);
    middle = *nearest + kOver * up;
  }
  Vec3 at(double degrees) const { return std::cos(degrees * kDegree) * side + std::sin(degrees * kDegree) * up; }
  /// Of the shaft whose jaws open along this direction.
  double roll_of(const Vec3& y_T) const { return std::atan2(-y_T.dot(R0.col(0)), y_T.dot(R0.col(1))); }
  /// The tip of jaws that have the wire at this angle.
  Vec3 tip(double degrees) const { return middle + r * at(degrees) + 0.002 * along; }

  Fulcrum fulcrum;
  double r;
  Vec3 along, up, side, middle;
  Mat3 R0;
};

double shortest(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

std::vector<ScriptedMove> stitch_moves(const Stitch& s) {
  constexpr double kHeld = 70, kTurn = 140, kTaken = 333;  // degrees
  const double first = s.roll_of(-s.at(kHeld)), driven = first - kTurn * kDegree;
  const double second = driven + shortest(s.roll_of(s.at(kTaken)) - driven);
  const Vec3 back = -0.03 * s.along, left = s.tip(kHeld + kTurn), taken = s.tip(kTaken);
  std::vector<ScriptedMove> moves{{.to_m = {0, 0, 0.045}, .seconds = 2, .hold_s = 0.3, .jaw_m = 0}};
  moves.push_back({.to_m = s.tip(kHeld) + back, .roll_rad = first, .seconds = 2, .hold_s = 0.3, .jaw_m = 0});
  moves.push_back({.to_m = s.tip(kHeld), .seconds = 1.5, .hold_s = 0.3, .jaw_m = 0});
  moves.push_back({.about_m = s.middle, .roll_rad = -kTurn * kDegree, .seconds = 6, .hold_s = 0.3, .jaw_m = 0});
  moves.push_back({.to_m = left, .seconds = 0.5, .hold_s = 0.2, .jaw_m = 0.008});
  moves.push_back({.to_m = left + back, .seconds = 1, .jaw_m = 0.008});
  moves.push_back({.to_m = taken + back, .roll_rad = second - driven, .seconds = 1, .hold_s = 0.2, .jaw_m = 0.008});
  moves.push_back({.to_m = taken, .seconds = 1, .hold_s = 0.3, .jaw_m = 0.008});
  moves.push_back({.to_m = taken, .seconds = 0.5, .hold_s = 0.3, .jaw_m = 0});
  moves.push_back({.about_m = s.middle, .roll_rad = -kTurn * kDegree, .seconds = 5, .hold_s = 0.2, .jaw_m = 0});
  const Vec3 out = s.middle + s.r * s.at(kTaken + kTurn);
  moves.push_back({.to_m = out + 0.04 * s.up, .seconds = 4, .hold_s = 1, .jaw_m = 0});
  return moves;
}

TEST(SuturingSession, AStitchReplaysToTheBitAndPlaysWithoutSolving) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "stitch.trec";
  const Scene scene = stitching_scene("normal");
  ASSERT_TRUE(scene.suture);
  SessionHooks hooks;
  double now_s = 0;
  SutureState last;
  std::vector<SurfacePtr> thin_T;
  double held_s = 0;
  hooks.hand = [&] { return std::make_unique<WaypointHand>(stitch_moves(Stitch(scene))); };
  hooks.interrupted = [&] { return now_s > 34; };
  hooks.observe = [&](const SessionView& view) {
    if (view.tissue && view.tissue->suture.held) held_s += view.t_s - now_s;
    now_s = view.t_s;
    if (view.tissue) last = view.tissue->suture;
    thin_T = view.thin_T;
  };
  const auto [outcome, recording] = record_session(scene, find_assets(), hooks, file);
  EXPECT_EQ(outcome.device.fault, "");
  EXPECT_EQ(last.needles, 1);
  EXPECT_EQ(last.punctures, 1);
  EXPECT_EQ(last.stitches, 1);
  EXPECT_EQ(last.tears, 0);
  EXPECT_GT(held_s, 15);
  ASSERT_EQ(thin_T.size(), 2U);

  const RecordedSetup recorded = parse_scene_json(recording.session, "stitch");
  const Scene again = build_scene(recorded.setup, find_assets(), recorded.daq);
  EXPECT_EQ(replay_session(again, recording).state_hash_hex, outcome.state_hash_hex);

  const RecordedRun played(file, find_assets());
  const RunMoment end = played.at(played.end_s());
  ASSERT_EQ(end.thin_T.size(), 2U);
  for (std::size_t part = 0; part < thin_T.size(); ++part) {
    ASSERT_EQ(end.thin_T[part]->triangles, thin_T[part]->triangles);
    for (std::size_t v = 0; v < thin_T[part]->vertices.size(); ++v)
      EXPECT_LT((end.thin_T[part]->vertices[v] - thin_T[part]->vertices[v]).norm(), 1e-3) << part << " " << v;
  }
  EXPECT_EQ(end.tissue.suture.stitches, 1);
}

TEST(SuturingSession, AnOrganThatStandsStillHasNoNeedle) { EXPECT_FALSE(stitching_scene("still").suture); }

}  // namespace
}  // namespace trocar::suturing_session_test
