// Trainees, their attempts and the cohort as JSON, for the --json of the commands that read the database.
#pragma once

#include <string>
#include <vector>

#include "trainees/attempt_store.h"
#include "trainees/cohort.h"
#include "trainees/trainee_store.h"

namespace trocar {

/// One JSON array or object each, indented, with a closing newline. Absent scores are null.
std::string trainees_json(const std::vector<Trainee>& trainees);
std::string trainee_json(const Trainee& trainee, const std::vector<AttemptSummary>& attempts);
std::string cohort_json(const std::vector<CohortRow>& rows);
std::string problems_json(const Database& database, const std::vector<std::string>& problems);

}  // namespace trocar
