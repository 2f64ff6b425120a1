// The barest loop on the simulated device: counts in, angles, one law for the torque, DAC codes out.
//
// Calibration, quantisation, saturation and delay are those of the haptic loop; nothing of its supervision. SI.
// Thread: one owner.
#pragma once

#include <functional>

#include "haptics/device/simulated_daq.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

using TorqueLaw = std::function<JointVector(const ArmState&)>;

class BareControlLoop {
 public:
  /// Turns the amplifiers on. @param q where the joints are now. @param model its transmissions count, calibrated or
  /// not.
  BareControlLoop(SimulatedDaq& daq, TorqueLaw law, const JointVector& q, const DeviceModel& model = {});
  /// One SYNC.
  void tick();
  const ArmState& arm() const { return arm_; }

 private:
  SimulatedDaq& daq_;
  TorqueLaw law_;
  DeviceModel model_;
  CountAccumulator counts_;
  ChannelVector start_ = ChannelVector::Zero();
  ArmState arm_;
};

}  // namespace trocar
