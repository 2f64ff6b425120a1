// Friction feed-forward in free air: what DAC rounding owes the passivity budget may be forgiven, a contact's debt may
// not.
#include <gtest/gtest.h>

#include "haptics/control/gravity.h"
#include "loop_rig.h"

namespace trocar {
namespace {

struct Fed {
  double share = 0;   ///< of the moving ticks in which friction was fed forward
  double torque = 0;  ///< its mean magnitude over those of weight alone, joint 1, N m
};

/// Leads the stylus to and fro in the air and counts the ticks whose torque is more than the weight's.
Fed lead_through_air(double debt_j) {
  HapticLoopConfig config;
  config.friction = {0.7, 0.06, 0.02, debt_j};
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  test::LoopRig rig(device, config);
  rig.start();
  rig.move(test::working_pose(), 1.0);
  rig.keep = true;
  Pose aside = test::working_pose();
  aside.p.z() += 0.04;
  rig.move(aside, 0.5);
  rig.move(test::working_pose(), 0.5);
  Fed fed;
  double moving = 0;
  for (const TickRecord& r : rig.records) {
    if (std::abs(r.qd[3]) < 0.1) continue;
    const JointVector weight = gravity_torque(rig.config.device, arm_state(r.q.head<kArmJoints>()));
    const double more = std::abs(r.torque[3] - weight[3]);
    moving += 1;
    fed.share += more > 1e-3 ? 1 : 0;  // 0.7 of 7.5 mN m where it is on, rounding where it is off
    fed.torque += more;
  }
  EXPECT_GT(moving, 300);
  fed.share /= moving, fed.torque /= moving;
  return fed;
}

TEST(FrictionDebt, ForgivingRoundingKeepsTheFeedForwardOn) {
  const Fed strict = lead_through_air(0), forgiving = lead_through_air(1e-5);
  EXPECT_GT(forgiving.share, 0.95);
  EXPECT_LT(strict.share, 0.5) << "the default switches on and off with the rounding of codes";
  EXPECT_GT(forgiving.torque, 3e-3);
}

TEST(FrictionDebt, DefaultForgivesNothing) {
  EXPECT_EQ(FrictionFeedForward{}.debt_j, 0);
  const HapticLoopConfig config;
  EXPECT_EQ(config.friction.debt_j, 0) << "recordings were made with it";
}

}  // namespace
}  // namespace trocar
