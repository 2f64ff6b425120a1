// What exercise files say of a flap to be lifted.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"

namespace trocar {

void read_find(StrictTable& document, Exercise& exercise);
void read_find_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
