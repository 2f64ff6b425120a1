// Trainees, their attempts and the cohort as JSON, for the --json of the commands that read the database.
#pragma once

#include <string>
#include <vector>

#include "trainees/desk/queries/desk_queries.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/cohort.h"
#include "trainees/records/trainee_store.h"

namespace trocar {

/// Whether the line is of the row's trainee, exercise, level and rubric; a row takes all inputs together.
bool of_row(const CohortLine& line, const CohortRow& row);

/// One JSON array or object each, indented, with a closing newline. Absent scores are null.
std::string trainees_json(const std::vector<Trainee>& trainees);
/// @param lines of that trainee.
std::string trainee_json(const Trainee& trainee, const std::vector<AttemptSummary>& attempts,
                         const std::vector<CohortLine>& lines);
/// @param lines from which each row takes the judgements of its trainee, exercise, level and rubric.
std::string cohort_json(const std::vector<CohortRow>& rows, const std::vector<CohortLine>& lines);
std::string problems_json(const Database& database, const std::vector<std::string>& problems,
                          const std::vector<std::string>& remarks);

}  // namespace trocar
