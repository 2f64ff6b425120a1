// Finds gain and offset of every amplifier from torque cells on the motor shafts, by least squares.
//
// First a command grows until a cell shows torque: that finds a gain of 5 before it can hurt anything. Then each torque
// from -80 to 80 mN m is approached from below and from above:
//   reading - zero = g v + b - d c     (v command in V, d = +1 from below, -1 from above, c stiction of the brushes)
//   A/V = g / Kt nominal,  offset = b / g in V
// An error of the torque constant is part of the gain found and comes right with it. The cells' own zero is taken with
// the amplifiers inhibited; standard deviations come from the residuals, the cells' scale is added to that of the gain.
// Thread: any.
#pragma once

#include <array>

#include "app/session/calibration/torque_rig.h"
#include "haptics/device/device_model.h"

namespace trocar {

struct ChannelCalibration {
  double amps_per_volt = 0, amps_per_volt_sd = 0;  ///< A/V
  double offset_v = 0, offset_sd_v = 0;            ///< V that the chain adds to the command
  double stiction_nm = 0;                          ///< found between the two approaches, at the motor
  double residual_nm = 0;                          ///< RMS
};

using AmplifierCalibration = std::array<ChannelCalibration, kChannels>;

/// @throws InputError naming the channel when it gives no torque at 5 V or turns the wrong way.
AmplifierCalibration calibrate_amplifiers(TorqueRig& rig, const DeviceModel& nominal);

/// The model with the gains and offsets found.
DeviceModel calibrated(DeviceModel model, const AmplifierCalibration& found);

/// Torque that the model asks for against what the cells read: largest |read / asked - 1| of each channel at +-40 and
/// +-75 mN m, mean of both approaches.
ChannelVector rendering_error(TorqueRig& rig, const DeviceModel& model);

}  // namespace trocar
