// The benches of the compensation studies: releases, the bare loop, the thesis' weight law, what the sensor of the hand
// reads.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "app/studies/contact/bare_control_loop.h"
#include "app/studies/contact/release_bench.h"
#include "app/studies/device/identified_device.h"
#include "haptics/control/gravity.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar::compensation_bench_test {
namespace {

JointVector degrees(double a, double b, double c, double d, double e, double f) {
  return kDegree * (JointVector() << a, b, c, d, e, f).finished();
}

const JointVector kPose = degrees(45, 45, 45, -60, -75, 0);

TEST(ReleaseBench, TheExactLawHoldsTheArmStill) {
  const GravityLaw exact{"exact", [](const ArmState& arm) { return gravity_torque({}, arm); }};
  const Release r = release(nominal_parameters(), kPose, exact, 1);
  EXPECT_LT(r.drift_m, 3e-4) << "the bristles' deflection, 1 mrad";
  EXPECT_LT(r.left_over / r.weight, 0.002) << "one count of angle and one code of torque";
  EXPECT_EQ(r.t.size(), r.drift.size());
  EXPECT_NEAR(r.t.back(), 1, 0.011);
}

TEST(ReleaseBench, WithoutALawItFallsAndTheMeasurementEnds) {
  const GravityLaw none{"none", [](const ArmState&) -> JointVector { return JointVector::Zero(); }};
  const Release r = release(nominal_parameters(), kPose, none, 5);
  EXPECT_GE(r.drift_m, 0.05);
  EXPECT_LT(r.t.back(), 2) << "falls 50 mm in no time";
  EXPECT_NEAR(r.left_over / r.weight, 1, 0.01) << "all of the weight is left over";
}

TEST(ReleaseBench, HalfTheWeightIsHalfLeftOver) {
  const GravityLaw half{"half", [](const ArmState& arm) -> JointVector { return 0.5 * gravity_torque({}, arm); }};
  const Release r = release(nominal_parameters(), kPose, half, 0.1);
  EXPECT_NEAR(r.left_over / r.weight, 0.5, 0.01);
}

TEST(ThesisGravity, DoublesThePlatformsLeverAtHome) {
  const ArmState home = arm_state(home_angles());
  DeviceModel platform, stylus;
  platform.stylus_weight_n = 0;
  for (PlatformWeight& w : stylus.platform_weights) w.weight_n = 0;
  const JointVector expected = 2 * gravity_torque(platform, home) + gravity_torque(stylus, home);
  EXPECT_LT((thesis_gravity_torque(home) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(BareControlLoop, AsksForTheLawsTorqueAtTheAnglesOfTheCounts) {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  SimulatedDaq daq(config);
  JointVector seen = JointVector::Zero();
  const JointVector wanted = (JointVector() << 0.1, -0.1, 0.05, 0.02, -0.01, 0.005).finished();
  BareControlLoop loop(
      daq, [&](const ArmState& arm) { return seen = arm.q, wanted; }, home_angles());
  for (int k = 0; k < 10; ++k) loop.tick();  // still in the jig
  EXPECT_LT((seen - home_angles()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((daq.plant().motor_loads().head<kArmJoints>() - wanted).cwiseAbs().maxCoeff(), 2e-5) << "half a code";
}

TEST(HandSense, FeelsForceAndMomentThatHoldTheStylus) {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  for (ChannelParameters& c : config.plant->channel) c.friction.coulomb = 0;
  config.hand = hand_parameters(GripPreset::kFirm);
  config.hand.tremor_m = 0;
  SimulatedDaq daq(config);
  const HandSense at_home = daq.sense();
  EXPECT_EQ(at_home.moment_on_hand, Vec3::Zero());
  // The loop renders 0.5 N up and 20 mN m about z beside the weight: the hand feels those.
  Vec6 w = Vec6::Zero();
  w[2] = 0.5, w[5] = 0.02;
  BareControlLoop loop(
      daq, [&](const ArmState& arm) -> JointVector { return gravity_torque({}, arm) + arm.J_WS.transpose() * w; },
      home_angles());
  for (int k = 0; k < 3000; ++k) {
    daq.set_hand_intent(at_home.X_BS, at_home.jaw_opening_m);
    loop.tick();
  }
  EXPECT_LT((daq.sense().force_on_hand - Vec3(0, 0, 0.5)).norm(), 0.02);
  EXPECT_LT((daq.sense().moment_on_hand - Vec3(0, 0, 0.02)).norm(), 0.002);
}

TEST(Payload, MovesMassCentreAndInertiaOfTheStylusAsOneBody) {
  const PlantParameters bare = draw_parameters(4), loaded = drawn_with_payload(4, 0.02);
  EXPECT_NEAR(loaded.stylus_mass, bare.stylus_mass + 0.02, 1e-15);
  const Vec3 moment = bare.stylus_mass * bare.stylus_com + 0.02 * Vec3(0, 0, 0.03);
  EXPECT_LT((loaded.stylus_mass * loaded.stylus_com - moment).norm(), 1e-15);
  const double across =
      bare.stylus_mass * 0.02 / loaded.stylus_mass * 0.03 * 0.03;  // reduced mass times distance squared
  EXPECT_NEAR(loaded.stylus_inertia[0] - bare.stylus_inertia[0], across, 0.05 * across);
  EXPECT_LT(loaded.stylus_inertia[2] - bare.stylus_inertia[2], 1e-7);
  EXPECT_EQ(drawn_with_payload(4, 0).stylus_mass, bare.stylus_mass);
}

TEST(Payload, IsFoundAsWeightOfTheStylus) {
  IdentifyRequest request = quick_identification();
  request.seed = 3;
  const PlantParameters loaded = drawn_with_payload(3, 0.02);
  const double found = identify_simulated(loaded, request).device.identified_gravity->link2.x() / kLink2;
  EXPECT_NEAR(found / (9.81 * loaded.stylus_mass), 1, 0.02) << "gain errors of 1 %; the payload is a fifth of it";
}

/// A pose whose platform has turned since home by one angle about one axis of W'.
ArmState turned_home(const Vec3& axis, double angle) {
  const Mat3 R_Pp = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * arm_state(home_angles()).R_WPprime;
  const Mat3 R_WP = rotation_W_Wprime() * R_Pp * rotation_P_Pprime().transpose();
  JointVector q = home_angles();
  q.head<3>() << std::atan2(R_WP(1, 0), R_WP(0, 0)), std::atan2(R_WP(2, 1), R_WP(1, 1)),
      std::atan2(R_WP(0, 2), R_WP(2, 2));
  return arm_state(q);
}

TEST(ThesisGravity, SingleRotationsChangeTheMomentTheRightWay) {
  DeviceModel platform, stylus;
  platform.stylus_weight_n = 0;
  for (PlatformWeight& w : stylus.platform_weights) w.weight_n = 0;
  constexpr double kAngle = 0.1;
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const ArmState plus = turned_home(axis, kAngle), minus = turned_home(axis, -kAngle);
    const auto platform_part = [&](const ArmState& arm) -> JointVector {
      return thesis_gravity_torque(arm) - gravity_torque(stylus, arm);
    };
    // The odd part in the angle about the axis: moment of the weights about that axis, where the sum of three adds
    // nothing.
    const auto moment = [&](const JointVector& tau, const ArmState& arm) {
      return axis.dot(arm.J_WS.block<3, 3>(3, 0).transpose().partialPivLu().solve(tau.head<3>()));
    };
    const double thesis = moment(platform_part(plus), plus) - moment(platform_part(minus), minus);
    const double right = moment(gravity_torque(platform, plus), plus) - moment(gravity_torque(platform, minus), minus);
    EXPECT_NEAR(thesis / right, 1, 0.02);
  }
}

}  // namespace
}  // namespace trocar::compensation_bench_test
