// The parts of an exercise file that belong to its levels: [[levels]] and the [rubric] as each level sees it.
//
// A level with `like = "L2"` starts from the values of that level, which must stand above it; its own keys win.
// Errors as strict_toml.h. Thread: loading only.
#pragma once

#include <string>
#include <vector>

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// That sub-scores and expectations may name: the catalogue's, and "<stage>/<metric>" of every stage.
std::vector<std::string> metric_names(const Exercise& exercise);

/// Reads every level of the document into exercise.levels. @param exercise the rest of it, read before.
void read_levels(StrictTable& document, Exercise& exercise);

/// @param level gives the units in which anchors may be written: its expert time (0: the table's own) and tolerances.
Rubric read_rubric(StrictTable table, const Exercise& exercise, const ExerciseLevel& level);

}  // namespace trocar
