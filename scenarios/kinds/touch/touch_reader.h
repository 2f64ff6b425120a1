// What exercise files say of places and forces on an organ, for every kind that takes place on one.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"

namespace trocar {

/// [targets] of discs on an organ.
void read_discs(StrictTable& table, TargetLayout& layout);
/// [surface] of an organ that stands still; a stage has its operation's.
void read_surface(StrictTable& document, Exercise& exercise);
/// "band_n" or "bands_n" of a level.
void read_bands(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
