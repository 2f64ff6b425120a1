// A plant file: the TRUE device that is simulated, which nobody tells the controller; in TOML.
//
//   seed = 7               start from the device that this seed draws; without it from the nominal one
//   variation = "all"      with a seed: draw also what seeds leave nominal (draw_everything)
//   [arm] [wrist_motors] [link1] [elbow_motor] [stylus] [jaw] [electronics]   numbers by plant_fields.h
//   [joints]               of all six joints; [th1] to [th6] of one, which goes before [joints]; [pinch]
//   [cable] [encoder] [delay] [heat]   options (plant_options.h): a table that is there switches its option on
//   [sensor] [hand]        the force sensor and the person at the stylus, where a command has them
// What the file does not give stays as drawn or nominal. Strict as strict_toml.h; a device that cannot be is refused at
// the line that makes it so (plant_check.h). docs/plant.md explains every key. Thread: loading only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "haptics/device/plant/hand_model.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/force_sensor/simulated_wrench_sensor.h"

namespace trocar {

struct PlantFile {
  PlantParameters parameters;
  std::optional<HandParameters> hand;
  std::optional<WrenchSensorConfig> sensor;
  std::string name;    ///< of the file, without its folder
  std::string sha256;  ///< of its bytes
};

/// @throws InputError with file, line and column.
PlantFile load_plant(const std::filesystem::path& file);
/// @param name of the file, for messages.
PlantFile parse_plant(const std::string& text, const std::string& name);

/// A whole plant file: every value with its source, options that are off as comments.
/// @param comment lines that open the file, without their '#'.
std::string plant_toml(const PlantParameters& parameters, const std::string& comment);

}  // namespace trocar
