// Friction through the whole chain: held against a soft hand it neither creeps nor makes energy, and allocates nothing.
#include <gtest/gtest.h>

#include "tests/haptics/loop_rig.h"

namespace trocar::haptic_loop_friction_test {
namespace {

using test::LoopRig;
using test::working_pose;

/// Presses on a rough floor with some 0.5 N and pushes aside by `aside` at the hand.
void press_aside(LoopRig& rig, double aside, double mu) {
  rig.start();
  rig.move(working_pose(), 1.5);
  rig.run(0.4);
  rig.put_floor(0.002, 150);
  rig.patch->material[0].mu_static = mu;
  rig.patch->material[0].mu_dynamic = 0.7 * mu;
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.5);
  rig.run(0.5);
  Pose beside = rig.goal;
  beside.p.x() += aside;
  rig.move(beside, 0.5);
  rig.run(0.5);
}

TEST(HapticLoopFriction, UnderTheLimitTheTipStaysWhereItIsForTenSeconds) {
  LoopRig rig;
  press_aside(rig, 0.002, 0.5);
  rig.run(1.5);  // what passivity took away while the press came in returns at rest
  ASSERT_TRUE(rig.record.stylus.contact);
  const Vec3 F = rig.record.stylus.F_I_T.force;
  const double tangential = F.head<2>().norm(), normal = F.z();
  EXPECT_GT(tangential, 0.05 * normal) << "friction carries part of the push";
  EXPECT_LT(tangential, 0.9 * 0.5 * normal) << "below the limit";
  const auto mean_tip = [&] {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 200; ++i) sum += rig.tick().stylus.X_TI.p;
    return Vec3(sum / 200);
  };
  const Vec3 before = mean_tip();
  rig.run(9.8);
  EXPECT_LT((mean_tip() - before).norm(), 1e-4);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive);
  EXPECT_EQ(rig.allocations, 0u);
}

TEST(HapticLoopFriction, DraggedToAndFroItOnlyTakesEnergy) {
  LoopRig rig;
  press_aside(rig, 0.002, 0.3);
  const double before = rig.record.stylus.energy_j, lowest = rig.record.min_energy_j;
  for (int k = 0; k < 4; ++k) {
    Pose there = rig.goal;
    there.p.x() += k % 2 == 0 ? 0.02 : -0.02;
    rig.move(there, 0.5);
  }
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive) << fault_name(rig.record.stylus.fault.code);
  EXPECT_GT(rig.record.stylus.energy_j - before, 1e-3) << "J that friction turned into heat over 80 mm";
  EXPECT_GE(rig.record.min_energy_j, lowest - 1e-6) << "the observer never fell below where it was";
  EXPECT_EQ(rig.allocations, 0u);
}

TEST(HapticLoopFriction, GrasperAndHeldObjectAllocateNothing) {
  HapticLoopConfig config;
  config.tool.jaw_length_m = 0.020;
  LoopRig rig({}, config);
  rig.patch->held = {{0.008, 0, 0}, {-0.008, 0, 0}, 0.003};
  press_aside(rig, 0.004, 0.3);
  rig.squeeze(0.006, 0.4);
  rig.run(0.2);
  EXPECT_TRUE(rig.record.stylus.contact);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive) << fault_name(rig.record.stylus.fault.code);
  EXPECT_EQ(rig.allocations, 0u);
}

}  // namespace
}  // namespace trocar::haptic_loop_friction_test
