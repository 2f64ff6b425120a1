// A cohort to look at before there is one: eight invented trainees, a hundred attempts of learning hands on the
// simulated plant.
//
// Real attempts in every way but who made them: recorded, graded, stored and chained. Their dates are invented, spread
// over nine weeks that end yesterday. They stand in a database of their own, which says so since it was made
// (trainees/records/demo_record.h).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/session/setup/scene.h"
#include "trainees/store/database.h"

namespace trocar {

/// demo.db beside the given database.
std::filesystem::path demo_database_beside(const std::filesystem::path& database);

struct DemoCohortOptions {
  std::filesystem::path database;
  int jobs = 0;            ///< threads; 0: one a core
  int least_attempts = 0;  ///< of each trainee, in place of all: short forms for tests; 0: all
  std::function<bool(int done, int all)> going = {};  ///< asked after each attempt: false stops
};

/// Makes it: beside its place first, moved when whole, so that what is there is complete.
/// @return attempts stored; 0 when it was stopped, and then nothing is left. @throws InputError: exists already.
/// EnvironmentError.
int make_demo_cohort(const DemoCohortOptions& options, const AssetRoots& assets);

/// Moves database, anchor, recordings, films and live folder into a new folder beside it; nothing is erased.
/// @return that folder. @throws InputError: no demo, or an attempt in it is not invented. EnvironmentError.
std::filesystem::path remove_demo_cohort(const std::filesystem::path& database);

}  // namespace trocar
