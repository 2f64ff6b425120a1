// The parts of an exercise file that belong to its levels: [[levels]] and the [rubric] as each level sees it.
//
// A level with `like = "L2"` starts from the values of that level, which must stand above it; its own keys win.
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/strict_toml.h"

namespace trocar {

/// Reads every level of the document into exercise.levels. @param exercise the rest of it, read before.
void read_levels(StrictTable& document, Exercise& exercise);

/// @param expert_time_s of the level; 0: the table's own, which need only exist when an anchor is given in its units.
Rubric read_rubric(StrictTable table, double expert_time_s);

}  // namespace trocar
