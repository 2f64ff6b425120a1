// A device as it was identified, in TOML: weights as base parameters and friction of each joint.
//
//   plant = "simulated, seed 7"  what was identified; may be missing
//   [gravity]                    first moments of weight, N m (IdentifiedGravity in haptics/device/device_model.h)
//   platform_n_m = [x, y, z]     in P'
//   link2_n_m = [x, y]           in frame 4; wrist_n_m in 5, stylus_n_m in S
//   [[joint]]                    six times, th1 to th6
//   coulomb_n_m = 0.0075
//   viscous_n_m_s_per_rad = 0.005
// Strict as strict_toml.h. Everything else of the model stays nominal. Thread: loading only.
#pragma once

#include <filesystem>
#include <string>

#include "haptics/device/device_model.h"

namespace trocar {

/// @param comment lines that open the file, without their '#'. @param plant what was identified; empty: not said.
/// @throws InputError for a model without identified gravity.
std::string device_toml(const DeviceModel& model, const std::string& comment, const std::string& plant = "");

/// @throws InputError with file, line and column.
DeviceModel load_device(const std::filesystem::path& file);

/// The same from its text. @param file name for messages. @param plant if given, takes what the file says was
/// identified.
DeviceModel parse_device(const std::string& text, const std::string& file, std::string* plant = nullptr);

}  // namespace trocar
