// What the desk shows of an exercise file: force limits and pass mark of a level, as the attempt's own file had them.
// Thread: any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trainees/desk/routes/route.h"

namespace trocar {

/// @param exercise_text bytes of the file. The band is what a touch asks for; exercises without one have the hard limit
/// alone.
/// @throws InputError: a text that cannot be read, a level that it does not have.
review::LevelFacts desk_level_facts(const std::string& exercise_text, const std::string& level);

/// @throws as desk_level_facts.
std::vector<GripLimits> desk_grip_limits(const std::string& exercise_text, const std::string& level, int board);

/// What programmes may have steps of: every exercise file of the folder with its levels.
std::vector<review::ExerciseLevels> desk_exercises(const std::filesystem::path& folder);

/// Text of the progress rules beside the program's assets; "" when it cannot be read.
std::string shipped_progress_rules(const std::string& assets_folder);

}  // namespace trocar
