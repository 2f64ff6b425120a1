// Faults injected where the controller cannot know of them: amplifiers off within two ticks, latched; and no
// allocation.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/haptics/loop_rig.h"

namespace trocar::haptic_loop_faults_test {
namespace {

using test::LoopRig;
using test::working_pose;

constexpr double kFaultAt = 3.0;

/// Runs past the fault and checks: off within two ticks of the SYNC at which it shows, the right code, latched.
void expect_fault(const InjectedFault& injected, FaultCode code, int channel) {
  SimulatedDaqConfig device;
  device.faults.push_back(injected);
  LoopRig rig(device);
  rig.start();
  rig.move(working_pose(), 1.0);
  rig.put_floor(0.0005, 150);
  while (rig.daq.time_s() < injected.at_s - 1.5e-3) {
    rig.tick();
    ASSERT_TRUE(rig.record.amplifiers_armed) << fault_name(rig.record.stylus.fault.code);
  }
  int ticks = 0;
  while (rig.record.amplifiers_armed && ticks < 50) {
    rig.tick();
    ticks += rig.daq.time_s() > injected.at_s - 0.5e-3;
  }
  EXPECT_LE(ticks, 2);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kFault);
  EXPECT_EQ(rig.record.stylus.fault.code, code) << fault_name(rig.record.stylus.fault.code);
  EXPECT_EQ(rig.record.stylus.fault.channel, channel);
  EXPECT_EQ(rig.daq.plant().motor_loads().norm(), 0) << "no torque at the motors";
  const Fault first = rig.record.stylus.fault;
  rig.run(0.5);
  EXPECT_FALSE(rig.record.amplifiers_armed) << "latched";
  EXPECT_EQ(rig.record.stylus.fault.tick, first.tick);
  EXPECT_EQ(rig.record.stylus.fault.code, code);
  for (const std::int32_t c : rig.record.out.codes) EXPECT_EQ(c, 0);
}

TEST(HapticLoopFaults, EncoderJump) {
  expect_fault({InjectedFaultKind::kEncoderJump, kFaultAt, 0, 2, 500}, FaultCode::kEncoderJump, 2);
}

TEST(HapticLoopFaults, PinchEncoderJump) {
  expect_fault({InjectedFaultKind::kEncoderJump, kFaultAt, 0, kPinchChannel, -400}, FaultCode::kEncoderJump,
               kPinchChannel);
}

TEST(HapticLoopFaults, InvalidChannel) {
  expect_fault({InjectedFaultKind::kChannelInvalid, kFaultAt, 0.001, 4, 0}, FaultCode::kChannelInvalid, 4);
}

TEST(HapticLoopFaults, HandWithoutANumber) {
  expect_fault({InjectedFaultKind::kHandNaN, kFaultAt, 0.01, 0, 0}, FaultCode::kHandNonFinite, -1);
}

/// An active loop 2 mm deep in a floor, jaws on a block.
void press_and_pinch(LoopRig& rig) {
  rig.start();
  rig.move(working_pose(), 1.0);
  rig.run(0.4);
  rig.put_floor(0.002, 150);
  rig.patch->grip = {0.012, 500};
  rig.squeeze(0.009, 0.2);
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.5);
}

void expect_nan_stops(LoopRig& rig, const std::function<void(ContactPatch&, double)>& poison) {
  press_and_pinch(rig);
  ASSERT_TRUE(rig.record.stylus.contact);
  ASSERT_TRUE(rig.record.amplifiers_armed);
  const ContactPatch clean = *rig.patch;
  poison(*rig.patch, std::numeric_limits<double>::quiet_NaN());
  ++rig.patch->stamp;  // triangles are looked at when a new patch arrives
  rig.tick();
  rig.tick();
  EXPECT_EQ(rig.record.stylus.fault.code, FaultCode::kNonFinite) << fault_name(rig.record.stylus.fault.code);
  EXPECT_FALSE(rig.record.amplifiers_armed);
  EXPECT_TRUE(rig.record.torque.allFinite());
  for (const std::int32_t c : rig.record.out.codes) EXPECT_EQ(c, 0);
  EXPECT_EQ(rig.daq.plant().motor_loads().norm(), 0);
  *rig.patch = clean;
  rig.run(0.3);
  EXPECT_EQ(rig.record.stylus.fault.code, FaultCode::kNonFinite) << "latched";
  // The heat model must outlive the fault: after a reset it still protects the motors.
  EXPECT_TRUE(std::isfinite(rig.record.winding_c));
  EXPECT_GT(rig.record.winding_c, 25.01);
}

TEST(HapticLoopFaults, NotANumberInTheStiffness) {
  LoopRig rig;
  expect_nan_stops(rig, [](ContactPatch& patch, double nan) { patch.material[0].stiffness_n_per_m = nan; });
}

TEST(HapticLoopFaults, NotANumberInTheBlock) {
  LoopRig rig;
  expect_nan_stops(rig, [](ContactPatch& patch, double nan) { patch.grip.stiffness_n_per_m = nan; });
}

TEST(HapticLoopFaults, NotANumberInTheDamping) {
  LoopRig rig;
  expect_nan_stops(rig, [](ContactPatch& patch, double nan) { patch.material[0].damping_s_per_m = nan; });
}

TEST(HapticLoopFaults, NotANumberInTheVertices) {
  LoopRig rig;
  expect_nan_stops(rig, [](ContactPatch& patch, double nan) { patch.vertex[0].x() = nan; });
}

TEST(HapticLoopFaults, NotANumberInTheVelocities) {
  LoopRig rig;
  expect_nan_stops(rig, [](ContactPatch& patch, double nan) {
    patch.moving = true;
    patch.velocity.fill(Vec3::Constant(nan));
  });
}

TEST(HapticLoopFaults, ATriangleWithoutVertices) {
  LoopRig rig;
  expect_nan_stops(rig, [](ContactPatch& patch, double) {
    patch.triangle[0].corner[2] = static_cast<std::int16_t>(patch.vertex_count);
  });
}

TEST(HapticLoopFaults, FewMissedPeriodsAreRiddenOut) {
  // Three of every 500: below the one in a hundred that is borne.
  SimulatedDaqConfig device;
  for (int i = 0; i < 6; ++i) device.faults.push_back({InjectedFaultKind::kMissedSync, 3.6 + 0.5 * i, 0, 0, 3});
  LoopRig rig(device);
  press_and_pinch(rig);
  rig.run(3.0);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive) << fault_name(rig.record.stylus.fault.code);
  EXPECT_NEAR(rig.record.stylus.t_s, rig.daq.time_s(), 1e-9) << "time counts periods, not ticks";
}

TEST(HapticLoopFaults, AStuckEncoderStaysHarmless) {
  // No fault code tells a stuck encoder (the reference asks for a warning only): the loop must neither jump nor push.
  SimulatedDaqConfig device;
  device.faults.push_back({InjectedFaultKind::kEncoderStuck, 4.0, 0.4, 1, 0});
  LoopRig rig(device);
  press_and_pinch(rig);
  double fastest = 0;
  for (int k = 0; k < 1500; ++k) {
    rig.tick();
    fastest = std::max(fastest, rig.daq.plant().motion().V_BS.linear.norm());
  }
  EXPECT_LT(fastest, 0.3);
}

TEST(HapticLoopFaults, ResetNeedsHomingAgain) {
  SimulatedDaqConfig device;
  device.faults.push_back({InjectedFaultKind::kEncoderJump, 4.0, 0, 0, 500});
  LoopRig rig(device);
  press_and_pinch(rig);
  rig.run(1.0);
  ASSERT_EQ(rig.record.stylus.loop, LoopState::kFault);
  rig.loop.reset_fault();
  rig.daq.press_deadman(false);
  rig.run(2.0);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kUnhomed) << "the jig is far away: no beam, no homing";
  EXPECT_FALSE(rig.record.amplifiers_armed);
  EXPECT_FALSE(rig.record.stylus.fault);
}

TEST(HapticLoopAllocation, NoTickTouchesTheHeap) {
  SimulatedDaqConfig device;
  device.faults.push_back({InjectedFaultKind::kEncoderJump, 5.2, 0, 0, 500});
  LoopRig rig(device);
  press_and_pinch(rig);
  std::uint64_t contacts = 0, grips = 0, after_fault = 0;
  for (int k = 0; k < 2000; ++k) {
    rig.tick();
    contacts += rig.record.stylus.contact;
    grips += rig.record.stylus.grip_force_n > 0;
    after_fault += rig.record.stylus.loop == LoopState::kFault;
  }
  EXPECT_EQ(rig.allocations, 0u);
  EXPECT_GE(rig.record.stylus.tick, 5000u);
  EXPECT_GT(contacts, 500u);
  EXPECT_GT(grips, 500u);
  EXPECT_GT(after_fault, 100u);
}

}  // namespace
}  // namespace trocar::haptic_loop_faults_test
