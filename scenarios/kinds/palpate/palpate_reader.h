// The keys that only exercises of palpation have.
//
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// Of [targets]: how far inside the region nodules lie, and how steep it may be there.
void read_nodule_places(StrictTable& targets, TargetLayout& layout);
/// The tables [nodules], [mark] and [search]. @throws InputError.
void read_palpate(StrictTable& document, Exercise& exercise);
void read_palpate_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level);

}  // namespace trocar
