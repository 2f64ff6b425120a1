// What each drive really gives for what its DAC codes ask: a force and torque sensor at the held stylus as the scale.
//
// At home the device renders five wrenches either way, 1.5 N along Y6 and Z6, 0.15 N m about X6, Y6 and Z6; half the
// difference of the two readings, taken back through the Jacobian, is the torque that came in every joint, and its
// least-squares slope over the torque asked for is the drive's scale. A joint alone would ask up to 9 N along X6, which
// hardly moves a joint there and bends the fixture. Weight, friction and offsets fall out of the difference; the
// offsets of the drives are told by the identification itself. SI. Thread: one owner; some seconds of CPU.
#pragma once

#include <cstdint>
#include <string>

#include "app/session/calibration/amplifier_calibration.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/identification/identify.h"

namespace trocar {

struct DriveWeighing {
  JointVector scale = JointVector::Ones();      ///< torque that came over torque asked for
  JointVector deviation = JointVector::Zero();  ///< standard deviation of that, from what the slope leaves over
  int taken = 0, left_out = 0;                  ///< readings, and those that the sensor did not vouch for
};

/// @param line "net-ft" or "serial": the sensor's driver that the readings come through.
/// @throws InputError: another line; a drive that gives nothing, turns the wrong way or is off by more than half, with
/// its joint; no reading. EnvironmentError: no loopback, no pseudo-terminal.
DriveWeighing weigh_drives(const PlantParameters& truth, const DeviceModel& nominal, const std::string& line,
                           std::uint64_t seed);

/// The model with the drives as weighed.
DeviceModel weighed(DeviceModel model, const DriveWeighing& found);

/// Gains by the sensor and offsets by the identification with weighed(): the calibration that goes with its device
/// file. The pinch, which no sensor weighed, stays as the model has it.
AmplifierCalibration as_calibration(const DriveWeighing& found, const Identification& id);

}  // namespace trocar
