// Rows that belong to one attempt: events, metrics, sub-scores, caps. Internal to trainees/.
#pragma once

#include <cstdint>

#include "scenarios/scoring/attempt_result.h"

struct sqlite3;

namespace trocar {

/// Inserts all rows of `result`; call inside a transaction while the attempt is running.
void insert_attempt_rows(sqlite3* connection, std::int64_t attempt, const AttemptResult& result);

/// Fills events and the lists of result.grade.
void read_attempt_rows(sqlite3* connection, std::int64_t attempt, AttemptResult& result);

}  // namespace trocar
