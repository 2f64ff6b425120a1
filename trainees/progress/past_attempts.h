// Attempts of one trainee with all their numbers, for learning curves, own medians and export. Thread: that of the
// Database.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trainees/records/attempt_store.h"

namespace trocar {

struct PastAttempt {
  AttemptSummary summary = {};
  std::map<std::string, double> metrics = {};  ///< by name; what is undefined is missing
};

/// What a result would be when read back; a result knows all but the row.
PastAttempt past_attempt(const AttemptResult& result);

/// Finished attempts, newest first. @param exercise_id empty: all.
std::vector<PastAttempt> past_attempts(Database& database, const std::string& trainee,
                                       const std::string& exercise_id = "");

}  // namespace trocar
