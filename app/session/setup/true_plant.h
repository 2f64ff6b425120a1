// The simulated device that a command works on: the one of a plant file where one is given, else the one that the seed
// draws. Nothing of it reaches the controller. Thread: loading only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/session/setup/device_files.h"
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

/// For a device's run report: which arm it was, {"seed": ...} or {"file": ..., "sha256": ...}, and of which files the
/// loop knew it: "calibration" and "identification", each a file so named, or null where it took the nominal values.
/// @param plant null: the seed's.
std::string plant_json(const PlantFile* plant, std::int64_t seed, const DeviceFiles& known);

}  // namespace trocar
