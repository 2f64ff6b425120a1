// The result of one attempt as rows: events, score, metrics, sub-scores, caps. Internal to trainees/.
#pragma once

#include <cstdint>
#include <string>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/records/attempt_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {

/// Writes `result` and ends the attempt with its status. Call inside a transaction while the attempt is running. What
/// somebody put in for it meanwhile goes, and another attempt's recording in the place of its own is not taken for it;
/// both are told in `integrity`.
/// @param recording as stored_recording_path() names it. @param ended_utc when it ended, empty: now.
void write_result(sqlite3* connection, std::int64_t attempt, AttemptResult result, std::string recording,
                  const std::string& ended_utc = "");

/// Takes away all that write_result() writes beside the attempt's own row: of one that runs, where nothing is yet
/// unless somebody put it in, or of one whose training data are erased. @returns how many rows went.
std::int64_t remove_attempt_rows(sqlite3* connection, std::int64_t attempt);

/// SELECT and FROM of what summary_of() reads: `attempt a`, its first `score s` (perhaps none), the newest decision
/// `o`.
/// @param code what stands for the trainee's code. @param joins behind `attempt a`, such as the table of the code.
std::string summary_query(const std::string& code, const std::string& joins);
/// A row of that query.
AttemptSummary summary_of(const sql::Statement& row);

/// Fills events and the lists of result.grade.
void read_attempt_rows(sqlite3* connection, std::int64_t attempt, AttemptResult& result);

}  // namespace trocar
