// Free blocks against closed forms: fall, sliding friction, tipping, rest.
#include <gtest/gtest.h>

#include <cmath>

#include "tissue/rigid/block_dynamics.h"

namespace trocar::block_dynamics_test {
namespace {

const Vec3 kHalf(0.007, 0.007, 0.010);

RigidBody block_at(const Vec3& middle, const Mat3& R = Mat3::Identity()) {
  RigidBody body;
  body.half = kHalf;
  body.mass_kg = 0.002;
  body.X_TB = {R, middle};
  body.wake();
  return body;
}

void run(std::vector<RigidBody>& bodies, double seconds, const std::vector<Pusher>& pushers = {},
         double friction = 0.6) {
  BlockDynamics dynamics({.friction = friction});
  for (int i = 0; i < std::lround(seconds / 0.01); ++i) dynamics.step(bodies, pushers, 0.01);
}

double energy(const RigidBody& body) {
  return body.mass_kg * (kGravity * body.X_TB.p.z() + body.velocity_T.squaredNorm() / 2) +
         body.spin_T.dot(body.inverse_inertia().inverse() * body.spin_T) / 2;
}

TEST(BlockDynamics, AFreeFallIsExact) {
  std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.5))};
  run(bodies, 0.2);
  EXPECT_NEAR(bodies[0].X_TB.p.z(), 0.5 - kGravity * 0.2 * 0.2 / 2, 1e-12);
  EXPECT_NEAR(bodies[0].velocity_T.z(), -kGravity * 0.2, 1e-12);
}

TEST(BlockDynamics, FallTimeFromThirtyMillimetres) {
  std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.040))};
  BlockDynamics dynamics(BlockDynamicsSettings{});
  int steps = 0;
  while (bodies[0].X_TB.p.z() > 0.010 + 1e-4 && steps < 100) {
    dynamics.step(bodies, {}, 0.001);
    ++steps;
  }
  EXPECT_NEAR(steps * 1e-3, std::sqrt(2 * 0.030 / kGravity), 0.0011) << "one step of the test";
}

TEST(BlockDynamics, LandsWithoutBouncingAndSleepsUpright) {
  std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.040))};
  double highest_after_landing = 0;
  BlockDynamics dynamics(BlockDynamicsSettings{});
  for (int i = 0; i < 60; ++i) {
    dynamics.step(bodies, {}, 0.01);
    if (i > 10) highest_after_landing = std::max(highest_after_landing, bodies[0].X_TB.p.z());
  }
  EXPECT_TRUE(bodies[0].asleep);
  EXPECT_NEAR(bodies[0].X_TB.p.z(), 0.010, 1e-4);
  EXPECT_LT(highest_after_landing, 0.0102);
  EXPECT_GT(bodies[0].X_TB.R(2, 2), 0.9999);
}

TEST(BlockDynamics, SlidesAsFarAsFrictionSays) {
  for (const double mu : {0.3, 0.6}) {
    std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.010))};
    bodies[0].half = Vec3(0.010, 0.010, 0.004);  // flat: it must not tip
    bodies[0].X_TB.p.z() = 0.004;
    bodies[0].velocity_T = Vec3(0.4, 0, 0);
    run(bodies, 1.0, {}, mu);
    EXPECT_NEAR(bodies[0].X_TB.p.x(), 0.4 * 0.4 / (2 * mu * kGravity), 0.02 * 0.4 * 0.4 / (2 * mu * kGravity) + 2e-4);
    EXPECT_TRUE(bodies[0].asleep);
  }
}

TEST(BlockDynamics, TipsOverBeyondItsDiagonalOnly) {
  const double balance = std::atan2(kHalf.x(), kHalf.z());  // over its lower edge
  for (const double share : {0.8, 1.2}) {
    const double tilt = share * balance;
    const double height = kHalf.x() * std::sin(tilt) + kHalf.z() * std::cos(tilt);
    std::vector<RigidBody> bodies{
        block_at(Vec3(0, 0, height), Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix())};
    run(bodies, 1.5);
    EXPECT_NEAR(std::abs(bodies[0].X_TB.R(2, 2)), share < 1 ? 1 : 0, 0.01) << share;
    EXPECT_NEAR(bodies[0].X_TB.p.z(), share < 1 ? 0.010 : 0.007, 2e-4) << share;
    EXPECT_TRUE(bodies[0].asleep);
  }
}

TEST(BlockDynamics, NeverGainsEnergy) {
  std::vector<RigidBody> bodies{
      block_at(Vec3(0, 0, 0.05), Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.3).normalized()).toRotationMatrix())};
  bodies[0].velocity_T = Vec3(0.2, -0.1, 0);
  bodies[0].spin_T = Vec3(5, -3, 8);
  BlockDynamics dynamics(BlockDynamicsSettings{});
  double before = energy(bodies[0]);
  for (int i = 0; i < 300; ++i) {
    dynamics.step(bodies, {}, 0.001);
    EXPECT_LT(energy(bodies[0]), before + 2e-6) << "2 uJ: a tenth of a millimetre of pushing out";
    before = energy(bodies[0]);
  }
  EXPECT_GT(bodies[0].X_TB.p.z(), 0.0065);
}

TEST(BlockDynamics, StacksStandAndAreWokenByALanding) {
  std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.010)), block_at(Vec3(0.002, 0.001, 0.0305))};
  run(bodies, 1);
  EXPECT_NEAR(bodies[1].X_TB.p.z(), 0.030, 3e-4);
  EXPECT_TRUE(bodies[0].asleep && bodies[1].asleep);
  bodies.push_back(block_at(Vec3(-0.012, 0, 0.060)));
  bodies[2].velocity_T.x() = 0.2;
  const Vec3 before = bodies[1].X_TB.p;
  run(bodies, 1);
  EXPECT_GT((bodies[1].X_TB.p - before).norm(), 1e-4) << "what lands on a sleeper moves it";
  EXPECT_GT(bodies[2].X_TB.p.z(), 0.006) << "nothing sinks into the board";
}

TEST(BlockDynamics, TheInstrumentPushesABlockAlong) {
  std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.010))};
  BlockDynamics dynamics(BlockDynamicsSettings{});
  const double speed = 0.05;
  double x = -0.012;  // capsule upright, 2.5 mm, low on the block's side
  for (int i = 0; i < 60; ++i) {
    x += speed * 0.01;
    Pusher pusher{{Vec3(x, 0, 0.004), Vec3(x, 0, 0.012), 0.0025}, Vec3(speed, 0, 0), Vec3::Zero(), Vec3::Zero()};
    dynamics.step(bodies, {pusher}, 0.01);
  }
  EXPECT_NEAR(bodies[0].X_TB.p.x(), x + 0.0025 + 0.007, 1e-3) << "it stays in front of the instrument";
  EXPECT_NEAR(bodies[0].X_TB.p.z(), 0.010, 1e-3);
}

TEST(BlockDynamics, ABlockPinnedAgainstTheBoardYieldsInsteadOfExploding) {
  std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.010))};
  BlockDynamics dynamics(BlockDynamicsSettings{});
  for (int i = 0; i < 100; ++i) {
    const double z = 0.0225 - 0.00006 * i;  // 6 mm into the foam
    dynamics.step(bodies, {{{Vec3(0, 0, z), Vec3(0, 0, 0.1), 0.0025}, Vec3(0, 0, -0.006), Vec3::Zero(), Vec3::Zero()}},
                  0.01);
    ASSERT_LT(bodies[0].velocity_T.norm(), 0.3);
    ASSERT_GT(bodies[0].X_TB.p.z(), 0.006);
    ASSERT_LT(bodies[0].X_TB.p.z(), 0.012);
  }
}

TEST(BlockDynamics, TheSameStepsGiveTheSameBytes) {
  const auto final_state = [] {
    std::vector<RigidBody> bodies{block_at(Vec3(0, 0, 0.010)), block_at(Vec3(0.004, 0.003, 0.045))};
    run(bodies, 0.5);
    return std::pair(bodies[0].X_TB.p, bodies[1].X_TB.R);
  };
  const auto a = final_state(), b = final_state();
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.second, b.second);
}

}  // namespace
}  // namespace trocar::block_dynamics_test
