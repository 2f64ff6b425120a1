#include "haptics/device/plant/hand_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/haptics/device/plant/plant_fixtures.h"

namespace trocar::hand_model_test {
namespace {

constexpr double kStep = 50e-6;
constexpr double kPeriod = 1e-3;

HandParameters steady_hand(GripPreset grip = GripPreset::kNormal) {
  HandParameters p = hand_parameters(grip);
  p.tremor_m = 0;
  return p;
}

// Load of a hand on a tool that stands still, after the given time.
ExternalLoad load_on_fixed_tool(HandModel& hand, const StylusMotion& tool, double seconds) {
  ExternalLoad load;
  for (int n = 0; n < static_cast<int>(std::lround(seconds / kStep)); ++n) load = hand.update(tool, kStep);
  return load;
}

TEST(HandModel, ExertsNothingUntilItHolds) {
  HandModel hand(steady_hand(), 1);
  EXPECT_FALSE(hand.holding());
  const ExternalLoad load = load_on_fixed_tool(hand, {}, 0.1);
  EXPECT_EQ(load.stylus_B.force, Vec3(Vec3::Zero()));
  EXPECT_EQ(load.jaw_force_n, 0.0);
}

TEST(HandModel, TakesHoldWithoutAJerkHoweverFarTheIntent) {
  HandModel hand(steady_hand(), 1);
  StylusMotion tool;
  tool.X_BS.p = {0.1, 0.2, 0.3};
  tool.jaw = 0.02;
  hand.set_intent({Mat3::Identity(), Vec3(0.5, 0, 0)}, 0.02, kPeriod);
  EXPECT_TRUE(hand.holding());
  EXPECT_LT(hand.update(tool, kStep).stylus_B.force.norm(), 0.05);
}

class HandGrip : public ::testing::TestWithParam<GripPreset> {};

TEST_P(HandGrip, PullsAFixedToolWithItsSpringsInSeries) {
  const HandParameters p = steady_hand(GetParam());
  HandModel hand(p, 1);
  hand.set_intent({Mat3::Identity(), Vec3(0.01, 0, -0.02)}, 0.0, kPeriod);
  const Vec3 force = load_on_fixed_tool(hand, {}, 5.0).stylus_B.force;
  const double stiffness = p.grip_stiffness * p.arm_stiffness / (p.grip_stiffness + p.arm_stiffness);
  EXPECT_LT((force - stiffness * Vec3(0.01, 0, -0.02)).norm(), 1e-6);
}

TEST_P(HandGrip, HoldsTheDeviceStillAtManyPoses) {
  PlantParameters p = nominal_parameters();
  p.gravity = 0;  // what a perfect weight compensation leaves
  PlantRandom random(41);
  for (int n = 0; n < 5; ++n) {
    DevicePlant plant(p);
    plant.place(test::random_joints(random, 20), 0.02);
    HandModel hand(steady_hand(GetParam()), 1);
    Pose wanted = plant.motion().X_BS;
    wanted.p += test::random_vector(random, 0.01);
    hand.set_intent(wanted, 0.015, kPeriod);
    ExternalLoad load;
    for (int k = 0; k < 40000; ++k) {
      load = hand.update(plant.motion(), kStep);
      plant.step(kStep, load);
    }
    const StylusMotion m = plant.motion();
    Vec6 wrench;
    wrench << load.stylus_B.force, load.stylus_B.moment;
    const JointVector tau = plant.joint_jacobian().transpose() * wrench;
    EXPECT_LT(m.V_BS.linear.norm(), 1e-3) << "pose " << n;
    EXPECT_LT(m.V_BS.angular.norm(), 1e-2);
    // What is still pulled is held by friction: no joint carries more than its breakaway.
    for (int i = 0; i < kArmJoints; ++i)
      EXPECT_LT(std::abs(tau[i]), 1.3 * p.channel[i].friction.coulomb) << "joint " << i;
    EXPECT_NEAR(m.jaw, 0.015, 0.2e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Grips, HandGrip,
                         ::testing::Values(GripPreset::kFingertip, GripPreset::kLight, GripPreset::kNormal,
                                           GripPreset::kFirm));

TEST(HandModel, GripStiffensFromFingertipToFirm) {
  double last = 0;
  for (const GripPreset grip : {GripPreset::kFingertip, GripPreset::kLight, GripPreset::kNormal, GripPreset::kFirm}) {
    const HandParameters p = hand_parameters(grip);
    EXPECT_GT(p.grip_stiffness, last);
    last = p.grip_stiffness;
  }
}

TEST(HandModel, TurnsTheStylusTowardsTheIntendedOrientation) {
  const HandParameters p = steady_hand();
  HandModel hand(p, 1);
  const Vec3 axis = Vec3(1, 2, -1).normalized();
  hand.set_intent({Mat3(Eigen::AngleAxisd(0.3, axis)), Vec3::Zero()}, 0.0, kPeriod);
  const Vec3 moment = load_on_fixed_tool(hand, {}, 0.1).stylus_B.moment;
  EXPECT_LT((moment - 0.3 * p.turn_stiffness * axis).norm(), 1e-9);
}

TEST(HandModel, TakesTheShortWayRound) {
  HandModel hand(steady_hand(), 1);
  StylusMotion tool;
  tool.X_BS.R = Mat3(Eigen::AngleAxisd(3.0, Vec3::UnitZ()));
  hand.set_intent({Mat3(Eigen::AngleAxisd(-3.0, Vec3::UnitZ())), Vec3::Zero()}, 0.0, kPeriod);
  const Vec3 moment = load_on_fixed_tool(hand, tool, 0.01).stylus_B.moment;
  EXPECT_GT(moment.z(), 0.1) << "from 3.0 on through pi, not back through zero";
}

TEST(HandModel, ForcesStayWithinWhatAHandCanDo) {
  const HandParameters p = steady_hand(GripPreset::kFirm);
  HandModel hand(p, 1);
  StylusMotion tool;
  hand.set_intent({Mat3(Eigen::AngleAxisd(3.0, Vec3::UnitX())), Vec3(2, 0, 0)}, 0.5, kPeriod);
  for (int n = 0; n < 40000; ++n) {
    const ExternalLoad load = hand.update(tool, kStep);
    ASSERT_LE(load.stylus_B.force.norm(), p.force_limit_n * (1 + 1e-12));
    ASSERT_LE(load.stylus_B.moment.norm(), p.moment_limit_nm * (1 + 1e-12));
    ASSERT_LE(std::abs(load.jaw_force_n), p.finger_limit_n);
  }
  EXPECT_NEAR(hand.update(tool, kStep).stylus_B.force.norm(), p.force_limit_n, 1e-9);
}

TEST(HandModel, NonFiniteIntentIsAFaultAndExertsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HandModel hand(steady_hand(), 1);
  hand.set_intent({Mat3::Identity(), Vec3(0.01, 0, 0)}, 0.0, kPeriod);
  load_on_fixed_tool(hand, {}, 0.1);
  hand.set_intent({Mat3::Identity(), Vec3(0, nan, 0)}, 0.0, kPeriod);
  EXPECT_TRUE(hand.fault());
  EXPECT_FALSE(hand.holding());
  EXPECT_EQ(hand.update({}, kStep).stylus_B.force, Vec3(Vec3::Zero()));
  hand.set_intent({Mat3::Identity(), Vec3::Zero()}, nan, kPeriod);
  EXPECT_TRUE(hand.fault());
  hand.set_intent({Mat3::Identity(), Vec3::Zero()}, 0.0, kPeriod);
  EXPECT_FALSE(hand.fault()) << "a finite intent takes hold anew";
  EXPECT_TRUE(hand.holding());
  EXPECT_TRUE(hand.update({}, kStep).stylus_B.force.allFinite());
}

TEST(HandModel, IntentIsReachedLinearlyOverThePeriod) {
  HandParameters p = steady_hand();
  HandModel hand(p, 1);
  StylusMotion tool;
  hand.set_intent({}, 0.0, kPeriod);
  load_on_fixed_tool(hand, tool, kPeriod);
  hand.set_intent({}, 0.0005, kPeriod);
  const double half = load_on_fixed_tool(hand, tool, kPeriod / 2).jaw_force_n;
  EXPECT_NEAR(half, p.finger_stiffness * 0.00025 + p.finger_damping * 0.0005 / kPeriod, 1e-9);
  const double after = load_on_fixed_tool(hand, tool, kPeriod).jaw_force_n;
  EXPECT_NEAR(after, p.finger_stiffness * 0.0005, 1e-9);
}

TEST(HandModel, LeapOfTheIntentBecomesAMovement) {
  HandParameters p = steady_hand();
  HandModel hand(p, 1);
  hand.set_intent({}, 0.0, kPeriod);
  load_on_fixed_tool(hand, {}, kPeriod);
  hand.set_intent({Mat3::Identity(), Vec3(0, 0, 1)}, 0.0, kPeriod);  // a metre in a millisecond
  const double early = load_on_fixed_tool(hand, {}, 0.01).stylus_B.force.norm();
  EXPECT_LT(early, 5.0) << "at 3 m/s only 3 cm were covered";
}

TEST(HandModel, WildIntentsLeaveTheDeviceFinite) {
  PlantRandom random(42);
  for (const GripPreset grip : {GripPreset::kNormal, GripPreset::kFirm}) {
    DevicePlant plant(nominal_parameters());
    HandModel hand(steady_hand(grip), 1);
    for (int k = 0; k < 5000; ++k) {
      if (k % 200 == 0) {
        const Vec3 axis = (test::random_vector(random, 1.0) + Vec3(0, 0, 1e-3)).normalized();
        const Mat3 R(Eigen::AngleAxisd(random.symmetric(3.1), axis));
        hand.set_intent({R, test::random_vector(random, 0.4)}, random.symmetric(0.1), kPeriod);
      }
      for (int n = 0; n < 20; ++n) plant.step(kStep, hand.update(plant.motion(), kStep));
      ASSERT_TRUE(plant.outputs().allFinite()) << k << " ms";
      ASSERT_LT(plant.rates().cwiseAbs().maxCoeff(), 2000.0) << k << " ms";
    }
  }
}

TEST(HandModel, TremorHasItsAmplitudeAndBand) {
  HandParameters p = hand_parameters(GripPreset::kNormal);
  p.arm_stiffness = 1e5;  // pin the hand, so that only the tremor between hand and grip is left
  p.arm_damping = 1e3;
  p.grip_damping = 0;
  HandModel hand(p, 7);
  hand.set_intent({}, 0.0, kPeriod);
  double peak = 0;
  int crossings = 0;
  double last = 0;
  const int steps = 200000;  // 10 s
  for (int n = 0; n < steps; ++n) {
    const double shake = hand.update({}, kStep).stylus_B.force.x() / p.grip_stiffness;
    peak = std::max(peak, std::abs(shake));
    crossings += last < 0 && shake >= 0;
    last = shake;
  }
  EXPECT_LE(peak, 1.05e-4);
  EXPECT_GE(peak, 0.5e-4);
  EXPECT_GE(crossings, 70) << "8 Hz for 10 s, less a beat or two";
  EXPECT_LE(crossings, 125);
}

TEST(HandModel, TremorIsItsSeeds) {
  const auto trace = [](std::uint64_t seed) {
    HandModel hand(hand_parameters(GripPreset::kNormal), seed);
    hand.set_intent({}, 0.0, kPeriod);
    return load_on_fixed_tool(hand, {}, 0.05).stylus_B.force;
  };
  EXPECT_EQ(trace(1), trace(1));
  EXPECT_NE(trace(1), trace(2));
}

TEST(HandModel, StillIntentNeverFeedsEnergyInForGood) {
  // The springs may give back what they stored, nothing more: a passive hand on a moving device.
  PlantParameters p = nominal_parameters();
  p.gravity = 0;
  DevicePlant plant(p);
  plant.set_joint_rates(JointVector::Constant(0.8));
  HandModel hand(steady_hand(), 1);
  hand.set_intent(plant.motion().X_BS, 0.02, kPeriod);
  double work = 0;  // by the hand on the device
  for (int n = 0; n < 60000; ++n) {
    const ExternalLoad load = hand.update(plant.motion(), kStep);
    const Twist before = plant.motion().V_BS;
    plant.step(kStep, load);
    const Twist after = plant.motion().V_BS;
    work += 0.5 * kStep * load.stylus_B.force.dot(before.linear + after.linear);
    work += 0.5 * kStep * load.stylus_B.moment.dot(before.angular + after.angular);
    // What it may have given back at most: the kinetic energy of M_h that it took up when taking hold.
    ASSERT_LT(work, 0.5 * 0.4 * 0.5 * 0.5) << "step " << n;
  }
  EXPECT_LT(plant.motion().V_BS.linear.norm(), 1e-3);
}

TEST(HandModel, DrawnHandsSpreadAboutTheirPreset) {
  double sum = 0;
  const int draws = 1000;
  for (int n = 0; n < draws; ++n) {
    const HandParameters p = draw_hand_parameters(GripPreset::kLight, static_cast<std::uint64_t>(n));
    EXPECT_GT(p.grip_stiffness, 0);
    sum += std::log(p.grip_stiffness / 150.0) / draws;
  }
  EXPECT_NEAR(sum, 0.0, 4 * 0.3 / std::sqrt(draws));
}

}  // namespace
}  // namespace trocar::hand_model_test
