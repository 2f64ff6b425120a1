// The files that tell a loop more of its device than the nominal model: amplifier gains and offsets (JSON, written by
// `trocar device calibrate`), weights and friction (TOML, written by `trocar device identify`).
//
// Their text is kept whole in a recording's header, so that a replay needs neither file. Thread: loading only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "haptics/device/device_model.h"

namespace trocar {

/// A file as it was read.
struct DeviceFile {
  std::string text;
  std::string name;  ///< for messages
};

struct DeviceFiles {
  std::optional<DeviceFile> calibration, identified;
};

/// Reads what is named; an empty path means none. @throws InputError naming the file when it cannot be read.
DeviceFiles read_device_files(const std::filesystem::path& calibration, const std::filesystem::path& identified);

/// The nominal model with what the files say in its place. @throws InputError naming file and place.
DeviceModel device_model(const DeviceFiles& files);

/// The same as a loop on that back-end takes it. On a real device the receiver must always have been seen dark, or a
/// lamp that is stuck at "received" would home any pose, and method `light` gives way to `edges`.
/// @param asked_for method in place of the files', taken as it is. @throws InputError also: method index on boards that
/// tell of no index.
DeviceModel device_model(const DeviceFiles& files, const std::string& backend,
                         const std::optional<HomingMethod>& asked_for = {});

/// A simulated device in words, as these files name it: "simulated, seed 7".
std::string simulated_plant_words(std::uint64_t seed);
/// @param which as true_plant.h words it: "seed 1", "plant file arm.toml, sha256 0123abcd".
std::string simulated_plant_words(const std::string& which);

/// A line for each file that says it was made on another device than `plant`. One that does not say is not doubted.
std::vector<std::string> device_doubts(const DeviceFiles& files, const std::string& plant);

}  // namespace trocar
