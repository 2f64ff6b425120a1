// What is known of one device, in TOML: how it is homed, the pinch's hardware, how a force sensor sits, and as it was
// identified weights as base parameters and friction of each joint.
//
//   plant = "simulated, seed 7"  what was identified; may be missing
//   [gravity]                    first moments of weight, N m (IdentifiedGravity in haptics/device/device_model.h)
//   platform_n_m = [x, y, z]     in P'
//   link2_n_m = [x, y]           in frame 4; wrist_n_m in 5, stylus_n_m in S
//   [[joint]]                    six times, th1 to th6
//   coulomb_n_m = 0.0075
//   viscous_n_m_s_per_rad = 0.005
//   [homing]                     (haptics/control/homing.h); may be missing
//   method = "light"             or "edges" or "index"; see_dark = true
//   marks_123_counts = [..]      index: from home to the mark of each joint, and marks_456_counts
//   [pinch]                      thesis 5.2; missing: a pulley on the motor
//   design = "geared"            or "potentiometer" or "direct"; m_per_rad of the motor, most_force_n
//   closed_counts, open_counts   two points of the slide, travel_m apart; home_m: where the jig holds it
//   noise_counts, jaw_length_m
//   [sensor]                     a real force/torque sensor at the stylus (SensorMount)
//   rpy_deg = [0, 0, 90]         from the stylus frame S to the sensor's axes F: turned by roll about x, pitch about y,
//                                yaw about z of S, in this order; missing: no force is compared
//   body = "hand"                holds the sensor's body, and the device acts on its tool side; or "device"
//   fixture_kg = 0.08            what hangs on the tool side, and fixture_com_mm = [x, y, z] in F
//   lag_ms = 150                 of its readings with its filter; missing: the thesis' sensor's 150
//   counts_per_n, counts_per_nm  of the calibration sheet; missing: as a Net F/T box says, 192 and 10560 (Nano25,
//                                serial)
// A file with [homing], [pinch] or [sensor] may do without [gravity] and [[joint]]. Strict as strict_toml.h. Everything
// else of the model stays nominal. Thread: loading only.
#pragma once

#include <filesystem>
#include <string>

#include "haptics/device/device_model.h"

namespace trocar {

/// @param comment lines that open the file, without their '#'. @param plant what was identified; empty: not said.
/// @throws InputError for a model of which nothing is known beyond the nominal one.
std::string device_toml(const DeviceModel& model, const std::string& comment, const std::string& plant = "");

/// @throws InputError with file, line and column.
DeviceModel load_device(const std::filesystem::path& file);

/// The same from its text. @param file name for messages. @param plant if given, takes what the file says was
/// identified.
DeviceModel parse_device(const std::string& text, const std::string& file, std::string* plant = nullptr);

}  // namespace trocar
