// What exercise files say of a line that is cut along.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"

namespace trocar {

void read_gauze(StrictTable& document, Exercise& exercise);
void read_gauze_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
