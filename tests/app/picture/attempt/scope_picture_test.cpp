// Where the instrument is the scope, the picture goes with it: from the tip, along or below the shaft, rolled as the
// hand rolls it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/scene/scope_optics.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/camera/camera_rules.h"
#include "scenarios/kinds/camera/cup.h"

namespace trocar::scope_picture_test {
namespace {

constexpr PixelRect kSquare{0, 0, 720, 720};

Scene board_at(const std::string& level) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise("camera-navigation", assets.exercises);
  setup.level = level;
  setup.board = 4;
  return build_scene(setup, assets, {"simulated", 1000, 16});
}

/// The instrument at a target of the board, rolled.
struct Moment {
  explicit Moment(const Scene& scene_in, double roll_rad = 0)
      : scene(scene_in), director(scene.setup.exercise, scene.level, scene.board) {
    const Target& pose = scene.board.targets[3];
    record.stylus.X_TI.p = pose.centre_T;
    record.stylus.X_TI.R = pose.R_TI * Eigen::AngleAxisd(roll_rad, Vec3::UnitZ());
  }
  SceneView seen() const { return attempt_view({scene, record, director, 0}, "T-1"); }

  const Scene& scene;
  Director director;
  TickRecord record;
};

TEST(ScopePicture, HasTheSphereOfThePoseInItsMiddleAtEveryLevel) {
  for (const char* level : {"L1", "L2", "L3"}) {
    const Scene scene = board_at(level);
    const SceneView view = Moment(scene).seen();
    const Cup cup = cup_of(scene.board.targets[3], own_rules<CameraRules>(scene.setup.exercise),
                           own_rules<CameraLevel>(scene.level));
    EXPECT_EQ(view.camera.eye_T, scene.board.targets[3].centre_T);
    const auto at = ScopeOptics(view.camera, kSquare).project(cup.sphere_T);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x(), 360, 1e-6) << level;
    EXPECT_NEAR(at->y(), 360, 1e-6) << level;
    EXPECT_EQ(view.camera.level_rad.has_value(), std::string(level) != "L3") << "the last level shows no horizon";
    EXPECT_FALSE(view.hud.dial) << "no pose to match is told";
  }
}

TEST(ScopePicture, RollsAgainstTheHand) {
  const Scene scene = board_at("L1");
  EXPECT_NEAR(Moment(scene).seen().camera.level_rad.value(), 0, 1e-9);
  EXPECT_NEAR(Moment(scene, 0.3).seen().camera.level_rad.value(), -0.3, 1e-9);
}

TEST(ScopePicture, RingsAFifthOfTheField) {
  const Scene scene = board_at("L1");
  const SceneView view = Moment(scene).seen();
  const auto ring = std::find_if(view.objects.begin(), view.objects.end(),
                                 [](const SceneObject& o) { return o.shape == SceneObject::Shape::kRing; });
  ASSERT_NE(ring, view.objects.end());
  const ScopeOptics optics(view.camera, kSquare);
  const auto rim = optics.project(ring->X_TO * Vec3(0.5 * ring->size_m.x(), 0, 0));
  ASSERT_TRUE(rim);
  EXPECT_NEAR((*rim - Eigen::Vector2d(360, 360)).norm() / optics.circle_radius(), 0.2, 0.01);
}

}  // namespace
}  // namespace trocar::scope_picture_test
