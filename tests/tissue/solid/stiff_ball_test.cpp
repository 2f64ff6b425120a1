// Stiffer balls in an organ: what they do to force, that nothing of them is to be seen, and the law against its limits.
#include "tissue/solid/stiff_ball.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/tissue/solid/soft_organ_rig.h"

namespace trocar::stiff_ball_test {
namespace {

using namespace test;

SoftSceneOptions organ_with(std::vector<StiffBall> balls) {
  SoftSceneOptions options;
  options.half_m = {0.10, 0.075, 0.040};
  options.material.young_pa = 8700;
  options.material.stiffening = 3;
  options.organ.balls = std::move(balls);
  return options;
}

StiffBall under_the_top(double diameter_m, double top_m, double ratio) {
  return {Vec3(0, 0, 0.040 - top_m - diameter_m / 2), diameter_m / 2, ratio};
}

/// Force at that depth, pressed at 20 mm/s, N.
double force_at(const SoftSceneOptions& options, double x_m, double depth_m) {
  SoftScene scene(options);
  const double z = scene.touching_z(x_m, 0);
  double force = 0;
  for (double depth = 0; depth < depth_m; depth += 0.02e-3)
    force = scene.tick(from_above({x_m, 0, z - depth}), Vec3(0, 0, -0.02)).F_I_T.force.z();
  return force;
}

TEST(StiffBall, AMixtureLiesBetweenWhatItIsMadeOf) {
  EXPECT_DOUBLE_EQ(mixed_stiffness(0, 7), 1);
  EXPECT_DOUBLE_EQ(mixed_stiffness(1, 7), 7);
  EXPECT_DOUBLE_EQ(mixed_stiffness(0.4, 1), 1);
  EXPECT_NEAR(mixed_stiffness(0.01, 1e9), 1.025, 3e-4) << "Einstein: 1 + 5/2 f of rigid spheres";
}

TEST(StiffBall, ALargeBallIsFeltAlmostAsStiffAsItIs) {
  const std::vector<StiffBall> all{{Vec3(0, 0, -0.03), 0.03, 4}};
  const double stiffer = stiffer_under(Vec3::Zero(), -Vec3::UnitZ(), 0.0025, all);
  EXPECT_GT(stiffer, 2) << "the first part of the way to 4: a ball that touches the surface leaves its flanks out";
  EXPECT_LT(stiffer, 4);
  EXPECT_DOUBLE_EQ(stiffer_under(Vec3(0.1, 0, 0), -Vec3::UnitZ(), 0.0025, all), 1) << "far off";
}

TEST(StiffBall, IsFeltOverItAndNotBesideIt) {
  const double plain = force_at(organ_with({}), 0, 0.004);
  const SoftSceneOptions with = organ_with({under_the_top(0.016, 0.003, 6)});
  EXPECT_GT(force_at(with, 0, 0.004) / plain, 1.4);
  EXPECT_NEAR(force_at(with, 0.020, 0.004) / force_at(organ_with({}), 0.020, 0.004), 1, 0.03);
}

TEST(StiffBall, NothingOfItIsToBeSeen) {
  SoftScene plain(organ_with({})), with(organ_with({under_the_top(0.016, 0.003, 10)}));
  for (int i = 0; i < 30; ++i)  // the organ steps, the tool far above it
    for (SoftScene* scene : {&plain, &with}) scene->tick(from_above({0, 0, 0.1}), Vec3::Zero());
  const SurfacePtr a = plain.organ().surface(), b = with.organ().surface();
  ASSERT_EQ(a->vertices.size(), b->vertices.size());
  EXPECT_EQ(a->triangles, b->triangles);
  for (std::size_t v = 0; v < a->vertices.size(); ++v)
    ASSERT_LT((a->vertices[v] - b->vertices[v]).norm(), 1e-6) << "m: what the solver leaves of its rest, no bump";
}

}  // namespace
}  // namespace trocar::stiff_ball_test
