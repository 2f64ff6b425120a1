// `trocar exercises` and `trocar check`: the catalogue, the metrics explained, files validated.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct ExercisesOptions {
  bool json = false;
  std::string explain;   ///< a metric's name; empty: list the exercises
};

/// @return 0. @throws InputError for an unknown metric, listing the known ones.
int exercises_command(const ExercisesOptions& options, std::ostream& out, std::ostream& err);

/// Validates exercises (id or file) and lays out boards 0 to 19 of each on an organ. @return 0 when all are sound, else 2.
int check_command(const std::vector<std::string>& subjects, const std::string& organ, std::ostream& out,
                  std::ostream& err);

}  // namespace trocar
