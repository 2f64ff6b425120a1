// The result of one attempt as rows: events, score, metrics, sub-scores, caps. Internal to trainees/.
#pragma once

#include <cstdint>
#include <string>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/attempt_store.h"
#include "trainees/sqlite_handle.h"

namespace trocar {

/// Writes `result` and ends the attempt with its status. Call inside a transaction while the attempt is running.
/// @param recording as stored_recording_path() names it.
void write_result(sqlite3* connection, std::int64_t attempt, const AttemptResult& result, const std::string& recording);

/// A row whose columns are: id, uuid, code, exercise, level, hand, started, seed, board, status, score, passed, grade, synthetic, version,
/// ruleset, integrity.
AttemptSummary summary_of(const sql::Statement& row);

/// Fills events and the lists of result.grade.
void read_attempt_rows(sqlite3* connection, std::int64_t attempt, AttemptResult& result);

}  // namespace trocar
