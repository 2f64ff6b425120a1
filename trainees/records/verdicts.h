// Whether an attempt passed: the one place that decides it.
//
// The score has a verdict of its own (score.passed), and people may decide otherwise (verdict_override): the newest
// decision by the audit trail, not by a clock, holds wherever passes count; one whose row is not as its signed entry
// says is none. What the device ended (fault, void) is never passed. The score itself never changes. Thread: that of
// the Database.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/records/assessments.h"

namespace trocar {

struct Verdict {
  bool passed = false;                           ///< what counts
  bool by_score = false;                         ///< what the score says
  std::optional<VerdictOverride> decision = {};  ///< the newest, where there is one
};

/// The rule. @param decided of the newest decision.
bool judged_passed(bool ended_by_device, bool by_score, const std::optional<bool>& decided);

Verdict verdict_of(AttemptStatus status, bool by_score, const std::optional<VerdictOverride>& newest);
/// Of a stored attempt.
Verdict verdict_of(Database& database, const AttemptResult& result);

namespace sql {

/// The same rule for queries. Behind `attempt a` and its `score s`: the newest decision as `o`.
const std::string& decision();
/// 1 or 0.
inline constexpr const char* kPassed =
    "(CASE WHEN a.status IN ('fault', 'void') THEN 0 ELSE coalesce(o.passed, s.passed, 0) END)";

/// 1 where the device ended the attempt, or its record is unfit: it is in no curve. Who opens the deadman while the
/// clock runs has ended it himself: void, but tried, and not passed.
inline constexpr const char* kEndedByDevice =
    "(CASE a.status WHEN 'fault' THEN 1 WHEN 'void' THEN NOT EXISTS"
    " (SELECT 1 FROM event e WHERE e.attempt_id = a.id AND e.type = 'DEADMAN_OPEN') ELSE 0 END)";
/// 1 where it was live on a device and the system refused its loop real-time priority: soft_real_time() of pacing.h.
inline constexpr const char* kSoftRealTime =
    "(instr(a.device_realtime, '\"refused\"') > 0 AND coalesce(a.device_backend, '') <> 'pointer')";
/// 0 where its clock never started; looked up only for what has no number.
inline constexpr const char* kBegun =
    "(CASE WHEN a.status IN ('fault', 'void') THEN EXISTS"
    " (SELECT 1 FROM event e WHERE e.attempt_id = a.id AND e.type = 'START') ELSE 1 END)";

}  // namespace sql

/// The same two of a result.
bool ended_by_device(const AttemptResult& result);
bool begun(const AttemptResult& result);

/// Newest decision of every attempt that has one, by its row: for queries that read whole columns.
std::map<std::int64_t, bool> newest_decisions(const Database& database);

}  // namespace trocar
