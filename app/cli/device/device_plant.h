// `trocar device plant`: the simulated device as a plant file, every value with its source; or the check of one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

namespace trocar {

struct PlantOptionsGiven {
  std::optional<std::uint64_t> seed;  ///< the device that this seed draws; none: the nominal one
  bool all = false;                   ///< draw also what seeds leave nominal
  std::filesystem::path plant;        ///< a plant file: check it and print it complete
  std::filesystem::path out;          ///< instead of standard output
};

/// @return 0. @throws InputError for a plant that cannot be, EnvironmentError.
int device_plant(const PlantOptionsGiven& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
