// The parts of an exercise file that only limited grasp has: [blocks] with its kinds, [board], and keys of its levels.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"

namespace trocar {

/// Reads [blocks], [[blocks.kinds]] and [board] into exercise.grasp. @param exercise its [targets] read before.
void read_grasp(StrictTable& document, Exercise& exercise);

/// Into level.grasp.
void read_grasp_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
