// The tables [[ducts]] and [bed] of an exercise file: ducts and vessels beside the organ, and the organ bound to it.
//
// Thread: loading only.
#pragma once

#include <optional>
#include <vector>

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// @return empty where the file names none. @throws InputError with line and column
std::vector<DuctPlan> read_ducts(StrictTable& document);
/// @return none where the file names none. @throws InputError with line and column
std::optional<BedPlan> read_bed(StrictTable& document);

}  // namespace trocar
