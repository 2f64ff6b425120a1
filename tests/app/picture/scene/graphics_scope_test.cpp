// The scope in its port: shaft, post, tilted tip and camera head give the camera that geometry says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "app/picture/scene/scope_optics.h"
#include "app/picture/scene/scope_pose.h"

namespace trocar::graphics_scope_test {
namespace {

constexpr double kPi = std::numbers::pi, kThirty = kPi / 6;

Vec3 forward(const Camera& camera) { return (camera.look_at_T - camera.eye_T).normalized(); }
double degrees_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / kPi; }

ScopePose tilted() {
  ScopePose pose;
  pose.port_T = Vec3(0.01, -0.2, 0.1);
  pose.yaw_rad = 0.2;
  pose.pitch_rad = -0.4;
  pose.tilt_rad = kThirty;
  return pose;
}

TEST(ScopePose, AtRestLooksAlongTheShaftLevel) {
  ScopePose pose;
  pose.depth_m = 0.12;
  const Camera camera = scope_camera(pose);
  EXPECT_TRUE(camera.eye_T.isApprox(Vec3(0, 0.12, 0)));
  EXPECT_TRUE(forward(camera).isApprox(Vec3::UnitY()));
  EXPECT_TRUE(camera.up_T.isApprox(Vec3::UnitZ()));
  EXPECT_NEAR(*camera.level_rad, 0, 1e-12);
  EXPECT_EQ(camera.notch_rad, 0);
}

TEST(ScopePose, YawGoesRightAndPitchUp) {
  ScopePose pose;
  pose.yaw_rad = 0.3;
  EXPECT_GT(forward(scope_camera(pose)).x(), 0.2);
  pose = {};
  pose.pitch_rad = 0.3;
  EXPECT_NEAR(forward(scope_camera(pose)).z(), std::sin(0.3), 1e-12);
}

TEST(ScopePose, PostUpLooksThirtyDegreesBelowTheShaft) {
  ScopePose pose;
  pose.tilt_rad = kThirty;
  EXPECT_NEAR(forward(scope_camera(pose)).z(), -0.5, 1e-12);
  pose.post_rad = kPi;  // post down: looks up
  EXPECT_NEAR(forward(scope_camera(pose)).z(), 0.5, 1e-12);
}

TEST(ScopePose, ThePostTurnsTheViewOnAConeRoundTheShaft) {
  ScopePose pose = tilted();
  ScopePose straight = pose;
  straight.tilt_rad = 0;
  const Vec3 shaft = forward(scope_camera(straight));
  Vec3 before = forward(scope_camera(pose));
  for (int i = 1; i < 12; ++i) {
    pose.post_rad = i * kPi / 6;
    const Camera camera = scope_camera(pose);
    EXPECT_NEAR(degrees_between(forward(camera), shaft), 30, 1e-9);
    EXPECT_NEAR(degrees_between(forward(camera), before),
                2 * std::asin(std::sin(kThirty) * std::sin(kPi / 12)) * 180 / kPi, 1e-6);
    EXPECT_TRUE(camera.eye_T.isApprox(scope_camera(straight).eye_T));  // the lens stays where it is
    before = forward(camera);
  }
}

TEST(ScopePose, TheHeadTurnsThePictureAndLeavesTheViewAlone) {
  ScopePose pose = tilted();
  const Camera before = scope_camera(pose);
  pose.head_rad = 0.5;
  const Camera after = scope_camera(pose);
  EXPECT_TRUE(forward(before).isApprox(forward(after)));
  EXPECT_NEAR(after.notch_rad, -0.5, 1e-12);
  EXPECT_NEAR(std::remainder(*after.level_rad - *before.level_rad + 0.5, 2 * kPi), 0, 1e-9);
  EXPECT_NEAR(degrees_between(before.up_T, after.up_T), 0.5 * 180 / kPi, 1e-9);
}

TEST(ScopePose, LevelHeadBringsUpToTwelveOClockWhateverThePostDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-1.2, 1.2);
  for (int i = 0; i < 50; ++i) {
    ScopePose pose = tilted();
    pose.yaw_rad = angle(random);
    pose.pitch_rad = 0.8 * angle(random);
    pose.post_rad = 2.5 * angle(random);
    pose.head_rad = angle(random);
    pose.head_rad = level_head_rad(pose);
    EXPECT_NEAR(*scope_camera(pose).level_rad, 0, 1e-9) << i;
  }
}

TEST(ScopePose, LookingStraightDownThereIsNoLevel) {
  ScopePose pose;
  pose.pitch_rad = -kPi / 2;
  pose.head_rad = 0.3;
  EXPECT_FALSE(scope_camera(pose).level_rad);
  EXPECT_EQ(level_head_rad(pose), 0.3);
}

TEST(ScopePose, TheLevelTickPointsWhereUpIsInThePicture) {
  ScopePose pose = tilted();
  pose.post_rad = 0.7;
  const Camera camera = scope_camera(pose);
  const ScopeOptics optics(camera, {0, 0, 800, 600});
  const Vec3 at = camera.look_at_T;
  const Vec3 up_in_plane = Vec3::UnitZ() - forward(camera) * forward(camera).z();
  const Eigen::Vector2d step = *optics.project(at + 1e-3 * up_in_plane) - *optics.project(at);
  EXPECT_NEAR(std::remainder(std::atan2(step.x(), -step.y()) - *camera.level_rad, 2 * kPi), 0, 1e-6);
}

TEST(ScopePose, BehindACameraGivesThatCameraBack) {
  Camera camera;
  camera.eye_T = Vec3(-0.012, -0.085, 0.072);
  camera.look_at_T = Vec3(0.003, 0.004, -0.006);
  for (const double tilt : {0.0, kThirty}) {
    const ScopePose pose = scope_behind(camera, tilt, 0.15);
    const Camera again = scope_camera(pose);
    EXPECT_TRUE(again.eye_T.isApprox(camera.eye_T, 1e-9));
    EXPECT_TRUE(again.look_at_T.isApprox(camera.look_at_T, 1e-9));
    const Vec3 right = forward(camera).cross(camera.up_T).normalized(),
               right_again = forward(again).cross(again.up_T).normalized();
    EXPECT_NEAR(right.dot(right_again), 1, 1e-12);
    EXPECT_NEAR((pose.port_T - camera.eye_T).norm(), 0.15, 1e-12);
  }
}

TEST(ScopePose, BehindATurnedCameraKeepsItsTurn) {
  Camera camera;
  camera.eye_T = Vec3(0, -0.1, 0.05);
  camera.look_at_T = Vec3(0.02, 0, 0);
  camera.up_T = Vec3(0.4, 0, 1);
  const Camera again = scope_camera(scope_behind(camera, kThirty));
  const Vec3 right = forward(camera).cross(camera.up_T).normalized(),
             right_again = forward(again).cross(again.up_T).normalized();
  EXPECT_NEAR(right.dot(right_again), 1, 1e-9);
}

}  // namespace
}  // namespace trocar::graphics_scope_test
