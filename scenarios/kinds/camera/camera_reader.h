// The keys of an exercise file and of its levels that only camera navigation has.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"

namespace trocar {

void read_camera(StrictTable& document, Exercise& exercise);
void read_camera_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
