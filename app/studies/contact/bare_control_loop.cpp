#include "app/studies/contact/bare_control_loop.h"

#include <utility>

namespace trocar {

BareControlLoop::BareControlLoop(SimulatedDaq& daq, TorqueLaw law, const JointVector& q, const DeviceModel& model)
    : daq_(daq), law_(std::move(law)), model_(model) {
  counts_.reset(daq.read().counts);
  start_.head<kArmJoints>() = q;
  arm_ = arm_state(q);
  daq_.arm(true);
}

void BareControlLoop::tick() {
  counts_.advance(daq_.read().counts);
  arm_ = arm_state(joint_positions(model_, counts_.total(), start_).head<kArmJoints>());
  ChannelVector torque = ChannelVector::Zero();
  torque.head<kArmJoints>() = law_(arm_);
  daq_.write(dac_codes(model_, torque, daq_.capabilities().dac_bits));
}

}  // namespace trocar
