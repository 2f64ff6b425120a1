// Can such a device be? What no body, motor or encoder can have is refused before anything is simulated with it.
//
// Signs go by plant_fields.h; besides: the stylus' inertia tensor is positive definite and its principal moments hold
// the triangle inequality, stops are in order and hold the jig's pose, the links reach the jig, the mass matrix at home
// is positive definite. Plain bounds of a value are the reader's business. Thread: any; not for the loop.
#pragma once

#include <optional>
#include <string>

#include "haptics/device/plant/plant_parameters.h"

namespace trocar {

struct PlantRefusal {
  std::string table, key;  ///< where a plant file has it
  std::string reason;
  std::string text() const { return "[" + table + "] " + key + ": " + reason; }
};

/// The first thing that is wrong; nothing when the plant can be.
std::optional<PlantRefusal> plant_refusal(const PlantParameters& parameters);

}  // namespace trocar
