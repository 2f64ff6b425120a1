// Which attempts an export takes, and one view of the database while it is made. Thread: the Database's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

/// Empty fields do not filter.
struct ExportFilter {
  std::string trainee = {};  ///< code
  std::string group = {}, exercise = {};
  std::string attempt = {};  ///< one alone, as AttemptStore::find takes it
};

struct ExportChoice {
  ExportFilter filter = {};
  std::vector<std::int64_t> attempts = {};  ///< rows of finished attempts, oldest first
  std::vector<std::int64_t> trainees = {};  ///< rows of whose they are
};

/// Without attempts whose training data were erased: what is left of them would read as failed.
/// @throws InputError: no such trainee, group, exercise or attempt; no finished attempt fits.
ExportChoice choose_attempts(Database& database, const ExportFilter& filter);

}  // namespace trocar
