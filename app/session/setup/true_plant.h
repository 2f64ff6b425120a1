// The simulated device that a command works on: the one of a plant file where one is given, else the one that the seed
// draws. Nothing of it reaches the controller. Thread: loading only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "scenarios/files/plant_file.h"

namespace trocar {

struct TruePlant {
  PlantParameters parameters;
  std::string words;  ///< "seed 1", or "plant file arm.toml, sha256 0123abcd"
};

/// @param file empty: by the seed. @throws InputError.
TruePlant true_plant(const std::filesystem::path& file, std::uint64_t seed);

/// "plant file arm.toml, sha256 0123abcd": eight digits, enough to tell files apart.
std::string plant_words(const PlantFile& plant);

/// For a device's run report: {"file": ..., "sha256": ...}.
std::string plant_json(const PlantFile& plant);

}  // namespace trocar
