// A calibration as a file: what `trocar device calibrate` found, as JSON, and back again.
//
// {"plant": what was calibrated (may be missing), "channels":[{"channel":"joint
// 1","amps_per_volt","amps_per_volt_sd","gain_over_nominal","offset_v","offset_sd_v", "stiction_nm","residual_nm"} ...
// "pinch"]}: seven channels in this order. Thread: any.
#pragma once

#include <filesystem>
#include <string>

#include "app/session/calibration/amplifier_calibration.h"

namespace trocar {

/// "joint 1" to "joint 6", "pinch".
const char* calibration_channel(int channel);

/// @param plant what was calibrated; empty: not said.
std::string calibration_json(const AmplifierCalibration& found, const DeviceModel& nominal,
                             const std::string& plant = "");

/// @throws InputError naming file and key: no such file, no JSON, other channels, a gain that is not positive, an
/// offset of a volt or more, a number that is missing or not finite. EnvironmentError is left to the writer.
AmplifierCalibration read_calibration(const std::filesystem::path& file);

/// The same from its text. @param file name for messages. @param plant if given, takes what the file says was
/// calibrated.
AmplifierCalibration parse_calibration(const std::string& text, const std::string& file, std::string* plant = nullptr);

}  // namespace trocar
