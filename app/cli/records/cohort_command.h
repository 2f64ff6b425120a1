// `trocar cohort`: who tried what, how often, how well. InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "trainees/progress/rules.h"
#include "trainees/store/database.h"

namespace trocar {

struct CohortOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::string trainee;             ///< empty: all
  bool json = false;
  bool deactivated = false;  ///< those too
};

/// Those in force; tells on `err` why newer ones are not.
ProgressRules rules_told(Database& database, std::ostream& err);

/// @return exit code 0
int cohort_command(const CohortOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
