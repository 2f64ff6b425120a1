// The tables [[ducts]] of an exercise file: ducts and vessels beside the organ.
//
// Thread: loading only.
#pragma once

#include <vector>

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// @return empty where the file names none. @throws InputError with line and column
std::vector<DuctPlan> read_ducts(StrictTable& document);

}  // namespace trocar
