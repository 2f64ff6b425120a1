// `trocar device identify`: weights, inertias and friction of a simulated device that the identifier is never told.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct IdentifyOptions {
  std::uint64_t seed = 1;  ///< of the simulated device, the poses and the trajectories
  int poses = 60;
  double span = 1;        ///< share of workspace and amplitude that is used
  double payload_kg = 0;  ///< a mass on the stylus, 30 mm down the roll axis, that nobody tells the identifier
  bool quick = false;     ///< 20 poses, one trajectory
  bool json = false;
  std::filesystem::path out;                   ///< device file (TOML) to write; none when empty
  std::filesystem::path plant = {};            ///< plant file instead of the device of the seed; empty: none
  std::string sensor = {};                     ///< "net-ft", "serial": weighs the drives first; empty: no sensor
  std::filesystem::path calibration_out = {};  ///< what the sensor found of the drives; none when empty
};

/// @return 0; 1 when the result is physically inconsistent. @throws InputError, EnvironmentError.
int identify_command(const IdentifyOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
