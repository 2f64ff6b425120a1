#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/picture/scene/scene_block.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar::graphics_optics_test {
namespace {

Camera looking_down() {
  Camera camera;
  camera.eye_T = Vec3(0, 0, 0.1);
  camera.look_at_T = Vec3::Zero();
  camera.up_T = Vec3::UnitY();
  return camera;
}

TEST(ScopeOptics, CentreLandsInTheMiddleOfTheWindow) {
  const auto pixel = ScopeOptics(looking_down(), {100, 50, 800, 600}).project(Vec3::Zero());
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 500, 1e-9);
  EXPECT_NEAR(pixel->y(), 350, 1e-9);
}

TEST(ScopeOptics, RightIsRightAndUpIsUp) {
  const ScopeOptics optics(looking_down(), {0, 0, 800, 600});
  EXPECT_GT(optics.project(Vec3(0.01, 0, 0))->x(), 400);
  EXPECT_LT(optics.project(Vec3(0, 0.01, 0))->y(), 300);
}

TEST(ScopeOptics, RimIsHalfTheDiagonalField) {
  const ScopeOptics optics(looking_down(), {0, 0, 800, 600});
  const double half = 35 * std::numbers::pi / 180;
  EXPECT_FALSE(optics.project(Vec3(0.1 * std::tan(half * 1.001), 0, 0)));
  const auto rim = optics.project(Vec3(0.1 * std::tan(half * 0.9999), 0, 0));
  ASSERT_TRUE(rim);
  EXPECT_NEAR(rim->x() - 400, optics.circle_radius(), 0.1);
}

TEST(ScopeOptics, BarrelEnlargesTheMiddle) {
  const ScopeOptics optics(looking_down(), {0, 0, 800, 600});
  const double per_metre_middle = (optics.project(Vec3(0.001, 0, 0))->x() - 400) / 0.001;
  const double rim_at = 0.1 * std::tan(34 * std::numbers::pi / 180);
  const double per_metre_rim =
      (optics.project(Vec3(rim_at, 0, 0))->x() - optics.project(Vec3(rim_at - 0.001, 0, 0))->x()) / 0.001;
  EXPECT_GT(per_metre_middle, 1.15 * per_metre_rim);
}

TEST(ScopeOptics, InvertsTheFormulaThatTheCameraShaderUses) {
  const ScopeOptics optics(looking_down(), {0, 0, 800, 600});
  for (double source = 0.05; source < 0.99; source += 0.1) {
    const double tan_half = std::tan(35 * std::numbers::pi / 180);
    const double r = (optics.project(Vec3(0.1 * tan_half * source, 0, 0))->x() - 400) / optics.circle_radius();
    EXPECT_NEAR(r * (1 + ScopeOptics::kBarrel * r * r) / (1 + ScopeOptics::kBarrel), source, 1e-9);
  }
}

TEST(ScopeOptics, PointsBehindTheLensAreNotSeen) {
  EXPECT_FALSE(ScopeOptics(looking_down(), {0, 0, 800, 600}).project(Vec3(0, 0, 0.2)));
}

TEST(ScopeOptics, LookingAlongUpStillGivesAPose) {
  Camera camera = looking_down();
  camera.up_T = Vec3::UnitZ();
  const ScopeOptics optics(camera, {0, 0, 800, 600});
  EXPECT_TRUE(optics.view_projection().allFinite());
  EXPECT_NEAR(optics.right().dot(optics.up()), 0, 1e-12);
}

TEST(ScopeOptics, ClipMatrixAgreesWithTheProjection) {
  const ScopeOptics optics(looking_down(), {0, 0, 800, 600});
  const Eigen::Vector4f clip = optics.view_projection() * Eigen::Vector4f(0.012F, 0.007F, 0.01F, 1);
  const Eigen::Vector2d source(clip.x() / clip.w() * 400, clip.y() / clip.w() * 300);
  const Eigen::Vector2d seen = *optics.project(Vec3(0.012, 0.007, 0.01)) - Eigen::Vector2d(400, 300);
  EXPECT_NEAR(std::atan2(-seen.y(), seen.x()), std::atan2(source.y(), source.x()), 1e-5);
  EXPECT_GT(seen.norm(), source.norm());
}

TEST(SceneBlock, DimpleOnlyWhereThereIsContactWithDepth) {
  SceneView view;
  EXPECT_FALSE(has_dimple(view));
  view.dimple_T = Vec3::Zero();
  EXPECT_FALSE(has_dimple(view));
  view.dimple_depth_m = 0.002;
  EXPECT_TRUE(has_dimple(view));
  const SceneBlock block = make_scene_block(view, ScopeOptics(view.camera, {0, 0, 800, 600}));
  EXPECT_FLOAT_EQ(block.dimple[3], 0.002F);
  EXPECT_GT(block.dimple_normal[3], 0.002F);
}

}  // namespace
}  // namespace trocar::graphics_optics_test
