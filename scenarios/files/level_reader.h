// The parts of an exercise file that belong to its levels: [[levels]] and the [rubric] as each level sees it.
//
// A level with `like = "L2"` starts from the values of that level, which must stand above it; its own keys win.
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// Reads every level of the document into exercise.levels. @param exercise the rest of it, read before.
void read_levels(StrictTable& document, Exercise& exercise);

/// @param level gives the units in which anchors may be written: its expert time (0: the table's own) and tolerances.
Rubric read_rubric(StrictTable table, const ExerciseLevel& level);

}  // namespace trocar
