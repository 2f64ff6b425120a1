// `trocar exercises`: the catalogue with levels and rubrics, and every number of it explained.
#pragma once

#include <iosfwd>
#include <string>

namespace trocar {

struct ExercisesOptions {
  bool json = false;
  std::string explain;  ///< a metric, an exercise (id or number) or a sub-score; empty: list the exercises
};

/// @return 0. @throws InputError when there is nothing of that name, listing what there is.
int exercises_command(const ExercisesOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
