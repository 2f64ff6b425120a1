// Friction of the port and the spring that leads the stylus along the shaft; both through the whole loop.
#include "haptics/mapping/port_forces.h"

#include <gtest/gtest.h>

#include "haptics/least_turn.h"
#include "tests/haptics/haptics_fixtures.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::port_forces_test {
namespace {

using test::Random;

TEST(PortFriction, SticksThenSlipsAtItsLimit) {
  PortForces port({});
  const Vec3 u(0, 0, -1);
  port.friction(0.1, 0, u);
  EXPECT_NEAR(port.friction(0.1004, 0, u).force.z(), 300 * 0.4e-3, 1e-12) << "against the way in";
  EXPECT_NEAR(port.friction(0.2, 0, u).force.z(), 0.25, 1e-12);
  EXPECT_NEAR(port.friction(0.2 - 0.25 / 300, 0, u).force.z(), 0, 1e-12) << "back by the bristle's length";
  EXPECT_NEAR(port.friction(0.1, 0, u).force.z(), -0.25, 1e-12);
  EXPECT_NEAR(port.friction(0.1, 1.0, u).moment.z(), 0.6e-3, 1e-15) << "against the roll about u";
}

TEST(PortFriction, OnlyDissipates) {
  Random random(1);
  PortForces port({});
  double depth = 0.1, absorbed = 0;
  const Vec3 u(0, 0, -1);
  Wrench held = port.friction(depth, 0, u);
  for (int k = 0; k < 20000; ++k) {
    const double step = random.symmetric(2e-5), roll = random.symmetric(1e-3), stored = port.stored_j();
    depth += step;
    const Wrench next = port.friction(depth, roll, u);
    const Wrench mean = (held + next) * 0.5;  // a clamped linear spring: the mean is its work, or below while it slips
    absorbed += -(mean.force.dot(u) * step + mean.moment.dot(u) * roll) - (port.stored_j() - stored);
    held = next;
    ASSERT_GT(absorbed, -1e-12);
  }
  EXPECT_GT(absorbed, 1e-4);
}

InstrumentMap port_map() {
  InstrumentMap map;
  map.X_TW = {Random(7).rotation(), Vec3(0.1, 0.2, -0.1)};
  map.motion_scale = 1.3;
  Fulcrum f;
  f.port_T = Vec3(0, 0, 0.12);
  f.R_TI_reference = test::tip_down(Vec3::Zero()).R;
  f.R_TS_reference = Eigen::AngleAxisd(0.5, Vec3::UnitX()).toRotationMatrix();
  map.fulcrum = f;
  return map;
}

TEST(Alignment, WrenchIsTheGradientOfItsEnergy) {
  const InstrumentMap map = port_map();
  Random random(2);
  constexpr double h = 1e-6, k = 0.4;  // central differences: h^2 times third derivatives of order k/d^3
  for (int i = 0; i < 300; ++i) {
    const Vec3 handle_T = Vec3(0, 0, 0.27) + random.vector(0.06);
    const Pose X{random.rotation(), map.X_TW.R.transpose() * (handle_T - map.X_TW.p) / map.motion_scale};
    const Wrench F = alignment_wrench(map, X, k);
    for (int axis = 0; axis < 3; ++axis) {
      const auto energy = [&](double by, bool turn) {
        const Vec3 e = Vec3::Unit(axis);
        return turn ? alignment_energy_j(map, {Eigen::AngleAxisd(by, e) * X.R, X.p}, k)
                    : alignment_energy_j(map, {X.R, X.p + by * e}, k);
      };
      EXPECT_NEAR(F.force[axis], -(energy(h, false) - energy(-h, false)) / (2 * h), 1e-7);
      EXPECT_NEAR(F.moment[axis], -(energy(h, true) - energy(-h, true)) / (2 * h), 1e-7);
    }
  }
}

TEST(Alignment, IsAtRestWhereTheStylusFollowsTheShaft) {
  const InstrumentMap map = port_map();
  const Vec3 handle_T(0.05, 0.02, 0.26);
  Pose X_TS{Mat3::Identity(), handle_T};
  X_TS.R = least_turn(Vec3::UnitZ(), map.fulcrum->followed_axis(handle_T)).toRotationMatrix();
  const Pose X{map.X_TW.R.transpose() * X_TS.R, map.X_TW.R.transpose() * (handle_T - map.X_TW.p) / map.motion_scale};
  EXPECT_NEAR(alignment_energy_j(map, X, 1), 0, 1e-15);
  EXPECT_LT(alignment_wrench(map, X, 1).moment.norm(), 1e-8);
}

/// A rig whose instrument goes through a port 150 mm from the handle, tip 150 mm beyond it.
HapticLoopConfig through_port(double force_scale, double motion_scale, const PortParameters& port) {
  HapticLoopConfig config;
  Fulcrum f;
  const Pose X_WS = test::working_pose();
  f.length_m = 0.3;
  f.R_TS_reference = X_WS.R;
  f.R_TI_reference = test::tip_down(Vec3::Zero()).R;
  f.port_T = motion_scale * X_WS.p - Vec3(0, 0, 0.15);
  config.map.fulcrum = f;
  config.map.force_scale = force_scale;
  config.map.motion_scale = motion_scale;
  config.port = port;
  return config;
}

PortParameters without_friction() {
  PortParameters port;
  port.axial_friction_n = port.roll_friction_n_m = 1e-9;
  return port;
}

TEST(FulcrumInTheLoop, PowerAtTheStylusIsKappaTimesThePowerAtTheTip) {
  for (const auto& [kappa, scale] : {std::pair{1.0, 1.0}, std::pair{0.5, 1.0}, std::pair{0.6, 1.4}}) {
    test::LoopRig rig({}, through_port(kappa, scale, without_friction()));
    rig.start();
    rig.move(test::working_pose(), 0.8);
    rig.put_floor(0.002, 150);
    Pose down = rig.goal;
    down.p += Vec3(0.004, 0, -0.012 / scale);
    rig.keep = true;
    rig.move(down, 0.8);
    double scene_j = 0, stylus_j = 0, most_n = 0;
    for (std::size_t k = 1; k < rig.records.size(); ++k) {
      const TickRecord &a = rig.records[k - 1], &b = rig.records[k];
      const ArmState arm = arm_state(b.q.head<kArmJoints>());
      const Vec3 moved = arm.X_WS.p - arm_state(a.q.head<kArmJoints>()).X_WS.p;
      stylus_j += b.stylus.commanded_force_T.dot(moved);  // X_TW turns nothing here
      const Vec3 shaft = b.stylus.X_TI.R.col(2);
      const Vec3 swept = b.stylus.X_TI.p - a.stylus.X_TI.p;
      const Vec3 turned = a.stylus.X_TI.R.col(2).cross(shaft);
      scene_j += b.stylus.F_I_T.force.dot(swept) + b.stylus.F_I_T.moment.dot(turned);
      most_n = std::max(most_n, b.stylus.F_I_T.force.norm());
    }
    ASSERT_GT(most_n, 0.3);
    ASSERT_LT(scene_j, -1e-4);
    // Work summed with the newer force: both sums err by half a step of force, a few counts in a hundred.
    EXPECT_NEAR(stylus_j, kappa * scene_j, 0.03 * std::abs(kappa * scene_j)) << kappa << ' ' << scale;
    EXPECT_FALSE(rig.record.stylus.fault);
    EXPECT_GT(rig.record.stylus.depth_in_port_m, 0.1);
  }
}

TEST(FulcrumInTheLoop, TheTipGoesLeftWhenTheHandGoesRight) {
  test::LoopRig rig({}, through_port(1, 1, {}));
  rig.start();
  rig.move(test::working_pose(), 0.8);
  rig.run(0.3);
  const Vec3 tip = rig.record.stylus.X_TI.p, stylus = rig.daq.sense().X_BS.p;
  Pose right = rig.goal;
  right.p.x() += 0.02;
  rig.move(right, 0.6);
  rig.run(0.4);
  const Vec3 hand_moved = rig.daq.sense().X_BS.p - stylus, tip_moved = rig.record.stylus.X_TI.p - tip;
  EXPECT_GT(hand_moved.x(), 0.015);
  // (L - d)/d = 1 at equal arms; 1.5 mm for calibration of the plant and a handle that is not exactly there.
  EXPECT_NEAR(tip_moved.x(), -hand_moved.x(), 1.5e-3);
}

TEST(FulcrumInTheLoop, ThePortHoldsBackWhatIsPushedThroughItAndStaysPassive) {
  PortParameters heavy;
  heavy.axial_friction_n = 0.8;
  heavy.alignment_n_m_per_rad = 0.05;
  test::LoopRig rig({}, through_port(1, 1, heavy));
  rig.start();
  rig.move(test::working_pose(), 0.8);
  rig.keep = true;
  for (int way = 0; way < 4; ++way) {
    Pose to = rig.goal;
    to.p.z() += way % 2 == 0 ? -0.03 : 0.03;
    rig.move(to, 0.4);
  }
  for (const TickRecord& r : rig.records) EXPECT_FALSE(r.stylus.contact);
  EXPECT_FALSE(rig.record.stylus.fault);
  EXPECT_GT(rig.record.min_energy_j, -1e-3) << "the observer saw no energy made";
  EXPECT_GT(rig.record.stylus.energy_j, 0.8 * 0.02)
      << "a stroke's worth at least: the observer forgets credit in free space";
  EXPECT_EQ(rig.allocations, 0u);
}

}  // namespace
}  // namespace trocar::port_forces_test
