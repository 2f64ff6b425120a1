// The result of one attempt as rows: events, score, metrics, sub-scores, caps. Internal to trainees/.
#pragma once

#include <cstdint>
#include <string>

#include "scenarios/scoring/attempt_result.h"

struct sqlite3;

namespace trocar {

/// Writes `result` and ends the attempt with its status. Call inside a transaction while the attempt is running.
/// @param recording as stored_recording_path() names it.
void write_result(sqlite3* connection, std::int64_t attempt, const AttemptResult& result, const std::string& recording);

/// Fills events and the lists of result.grade.
void read_attempt_rows(sqlite3* connection, std::int64_t attempt, AttemptResult& result);

}  // namespace trocar
