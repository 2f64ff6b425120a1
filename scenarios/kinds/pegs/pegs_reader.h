// Reads what only peg transfer has in an exercise file. Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"

namespace trocar {

void read_pegs(StrictTable& document, Exercise& exercise);
void read_pegs_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
