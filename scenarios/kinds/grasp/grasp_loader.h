// The parts of an exercise file that only limited grasp has: [blocks] with its kinds, [board], and keys of its levels.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// Reads [blocks], [[blocks.kinds]] and [board] into exercise.grasp. @param exercise its [targets] read before.
void read_grasp(StrictTable& document, Exercise& exercise);

/// @param derived keys that are left out keep the value that `level` has already.
void read_grasp_level(StrictTable& table, bool derived, const GraspRules& rules, GraspLevel& level);

}  // namespace trocar
