// `trocar device calibrate`: gain and offset of every amplifier, found on the bench rig with a simulated device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace trocar {

struct CalibrateOptions {
  std::uint64_t seed = 1;  ///< of the device and the rig
  double gain = 1;         ///< of the simulated amplifiers over nominal; 5 is the thesis'
  bool json = false;
  std::filesystem::path out;         ///< calibration as JSON; empty: none
  std::filesystem::path check;       ///< a calibration file: measure how it renders instead of finding one
  std::filesystem::path plant = {};  ///< plant file instead of the device of the seed; empty: none
};

/// @return 0, or 1 when the calibrated model renders a torque worse than 1 %. @throws InputError, EnvironmentError.
int device_calibrate(const CalibrateOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
