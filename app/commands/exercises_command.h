// `trocar exercises`: the catalogue, the metrics explained.
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

}  // namespace trocar
