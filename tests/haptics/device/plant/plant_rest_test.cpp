// Rest, fall, stops and refusals of the whole plant.
#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/device/plant/device_plant.h"
#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::plant_rest_test {
namespace {

using test::kDegree;

constexpr double kStep = 50e-6;

void run(DevicePlant& plant, double seconds, const ExternalLoad& load = {}) {
  for (int n = 0; n < static_cast<int>(std::lround(seconds / kStep)); ++n) plant.step(kStep, load);
}

TEST(PlantRest, PublishedHoldingTorqueKeepsTheHomePose) {
  const PlantParameters p = nominal_parameters();
  DevicePlant plant(p);
  const Vec3 home = plant.motion().X_BS.p;
  JointVector published;
  published << 0.0224, -0.0224, 0, -0.0144, 0, 0;
  plant.enable_amplifiers(true);
  plant.command_volts(test::volts_for(p, published));
  run(plant, 2.0);
  // The rounding of the published torque (4e-5 N m) is far below Coulomb friction; what moves is the bristle.
  EXPECT_LT((plant.motion().X_BS.p - home).norm(), 0.1e-3);
  EXPECT_LT(plant.rates().cwiseAbs().maxCoeff(), 1e-6);
}

TEST(PlantRest, WeightBelowFrictionDoesNotCreep) {
  const PlantParameters p = nominal_parameters();
  DevicePlant plant(p);
  plant.enable_amplifiers(true);
  plant.command_volts(
      test::volts_for(p, 0.75 * plant.holding_torque()));  // a quarter of the weight is left to friction
  run(plant, 3.0);
  const Vec3 start = plant.motion().X_BS.p;
  run(plant, 2.0);
  EXPECT_LT((plant.motion().X_BS.p - start).norm() / 2.0, 1e-6) << "m/s";
}

TEST(PlantRest, WeightBeyondFrictionFalls) {
  const PlantParameters p = nominal_parameters();
  DevicePlant plant(p);
  JointVector q;
  q << 45 * kDegree, 30 * kDegree, 60 * kDegree, -80 * kDegree, -40 * kDegree, 0;
  plant.place(q, 0.02);
  const double height = plant.motion().X_BS.p.z(), energy = plant.energy();
  run(plant, 0.05);
  const JointVector fell = plant.angles() - q, hold = plant.holding_torque();
  EXPECT_LT(plant.energy(), energy);
  EXPECT_LT(fell.dot(hold), 0) << "joints must move against the torque that would hold them";
  run(plant, 6.0);  // a pendulum of about one second that friction stops
  EXPECT_LT(plant.motion().X_BS.p.z(), height);
  EXPECT_LT(plant.rates().cwiseAbs().maxCoeff(), 1e-3) << "friction must have ended the fall";
}

TEST(PlantRest, EnergyOnlyFallsWithoutDrive) {
  DevicePlant plant(draw_parameters(3));
  plant.set_joint_rates(JointVector::Constant(0.5));
  double last = plant.energy();
  // Bristles and stops give back what they stored: a few 10 uJ at most, not a trend.
  for (int n = 0; n < 200; ++n) {
    run(plant, 0.01);
    EXPECT_LT(plant.energy(), last + 3e-5);
    last = plant.energy();
  }
}

class PlantStop : public ::testing::TestWithParam<int> {};

TEST_P(PlantStop, FullMotorTorqueEndsAtTheStopWithoutChatter) {
  const int joint = GetParam();
  PlantParameters p = nominal_parameters();
  p.gravity = 0;
  DevicePlant plant(p);
  for (const double direction : {-1.0, 1.0}) {
    JointVector q;
    q << 45, 45, 45, -60, -80, 0;
    plant.place(q * kDegree, 0.02);
    plant.enable_amplifiers(true);
    ChannelVector volts = ChannelVector::Zero();
    volts[joint] = 4.0 * direction;
    plant.command_volts(volts);
    run(plant, 3.0);
    const StopParameters& stop = p.channel[joint].stop;
    const double limit = direction > 0 ? stop.upper : stop.lower;
    EXPECT_NEAR(plant.angles()[joint], limit, 1.0 * kDegree) << "direction " << direction;
    EXPECT_LT(std::abs(plant.rates()[joint]), 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(LimitedJoints, PlantStop, ::testing::Values(0, 1, 2, 3, 4));

TEST(PlantRest, RollTurnsPastAFullTurnWithoutAStop) {
  PlantParameters p = nominal_parameters();
  p.gravity = 0;
  DevicePlant plant(p);
  plant.enable_amplifiers(true);
  ChannelVector volts = ChannelVector::Zero();
  volts[5] = 1.0;
  plant.command_volts(volts);
  run(plant, 2.0);
  EXPECT_GT(plant.angles()[5], 4 * std::numbers::pi);
  EXPECT_TRUE(plant.motion().X_BS.R.allFinite());
}

TEST(PlantRest, NonFiniteLoadIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DevicePlant plant(nominal_parameters()), untouched(nominal_parameters());
  ExternalLoad bad;
  bad.stylus_B.force = {1.0, nan, 0.0};
  EXPECT_EQ(plant.step(kStep, bad), PlantStatus::kNonFiniteLoad);
  EXPECT_EQ(untouched.step(kStep, {}), PlantStatus::kOk);
  EXPECT_EQ(plant.angles(), untouched.angles()) << "a refused load counts as none";
  bad = {};
  bad.stylus_B.moment = {0, 0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(plant.step(kStep, bad), PlantStatus::kNonFiniteLoad);
  bad = {};
  bad.jaw_force_n = nan;
  EXPECT_EQ(plant.step(kStep, bad), PlantStatus::kNonFiniteLoad);
  EXPECT_TRUE(plant.outputs().allFinite());
}

TEST(PlantRest, ClampedArmIgnoresEverything) {
  DevicePlant plant(nominal_parameters());
  plant.clamp(true);
  plant.enable_amplifiers(true);
  plant.command_volts(ChannelVector::Constant(5.0));
  const ChannelVector before = plant.outputs();
  run(plant, 0.1, {{Vec3(20, 20, 20), Vec3(1, 1, 1)}, 10});
  EXPECT_EQ(plant.outputs(), before);
  EXPECT_EQ(plant.rates(), JointVector(JointVector::Zero()));
}

TEST(PlantRest, SameInputGivesTheSameBytes) {
  const auto swing = [] {
    DevicePlant plant(draw_parameters(9));
    plant.enable_amplifiers(true);
    for (int n = 0; n < 4000; ++n) {
      plant.command_volts(ChannelVector::Constant(0.4 * std::sin(n * 1e-3)));
      plant.step(kStep, {{Vec3(0.1, 0.2, std::cos(n * 2e-3)), Vec3::Zero()}, 0.1});
    }
    return plant.outputs();
  };
  EXPECT_EQ(swing(), swing());
}

TEST(PlantRest, HardPushesIntoTheCornersStayFiniteAndLegsNeverLockUp) {
  const PlantParameters p = nominal_parameters();
  PlantRandom random(31);
  double nearest = 1;
  for (int device = 0; device < 20; ++device) {
    DevicePlant plant(p);
    for (int n = 0; n < 10; ++n) {
      const ExternalLoad push{{test::random_vector(random, 40), test::random_vector(random, 0.3)},
                              random.symmetric(15)};
      for (int k = 0; k < 2000; ++k) {
        plant.step(kStep, push);
        ASSERT_TRUE(plant.outputs().allFinite()) << "device " << device << " push " << n;
        const PlantKinematics here = evaluate_kinematics(configuration_at(plant.angles()), p.link1, p.link2);
        nearest = std::min(nearest, here.b.minCoeff());
      }
    }
  }
  EXPECT_LT(nearest, p.leg_stop + 0.01) << "no push reached a corner: nothing shown";
  EXPECT_GT(nearest, 0.5 * p.leg_stop) << "the legs' stop gave way";
}

}  // namespace
}  // namespace trocar::plant_rest_test
