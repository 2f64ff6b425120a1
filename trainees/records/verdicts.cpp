#include "trainees/records/verdicts.h"

#include <algorithm>

#include "scenarios/scoring/event_types.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {

const std::string& sql::decision() {
  static const std::string kJoin =
      " LEFT JOIN verdict_override o ON o.id = (SELECT v.id FROM verdict_override v WHERE v.attempt_id = a.id AND"
      " row_holds('verdict_override', v.id)" +
      newest_first("verdict_override", "v", "attempt_id") + " LIMIT 1)";
  return kJoin;
}

bool judged_passed(bool ended_by_device, bool by_score, const std::optional<bool>& decided) {
  return !ended_by_device && decided.value_or(by_score);
}

Verdict verdict_of(AttemptStatus status, bool by_score, const std::optional<VerdictOverride>& newest) {
  const bool ended_by_device = status == AttemptStatus::kFault || status == AttemptStatus::kVoid;
  return {judged_passed(ended_by_device, by_score, newest ? std::optional(newest->passed) : std::nullopt), by_score,
          newest};
}

Verdict verdict_of(Database& database, const AttemptResult& result) {
  const auto decisions = AssessmentStore(database).overrides_of(result.uuid);
  return verdict_of(result.grade.status, result.grade.passed,
                    decisions.empty() ? std::nullopt : std::optional(decisions.front()));
}

namespace {

bool has(const AttemptResult& result, EventType type) {
  return std::any_of(result.events.begin(), result.events.end(),
                     [type](const Event& event) { return event.type == type; });
}

}  // namespace

bool ended_by_device(const AttemptResult& result) {
  const AttemptStatus status = result.grade.status;
  return status == AttemptStatus::kFault || (status == AttemptStatus::kVoid && !has(result, event_type::kDeadmanOpen));
}

bool begun(const AttemptResult& result) {
  const AttemptStatus status = result.grade.status;
  return (status != AttemptStatus::kFault && status != AttemptStatus::kVoid) || has(result, event_type::kStart);
}

std::map<std::int64_t, bool> newest_decisions(const Database& database) {
  std::map<std::int64_t, bool> out;
  sql::Statement rows(database.connection(),
                      "SELECT attempt_id, passed FROM verdict_override v WHERE"
                      " row_holds('verdict_override', v.id)" +
                          newest_first("verdict_override", "v", "attempt_id"));
  while (rows.step()) out.emplace(rows.integer(0), rows.integer(1) != 0);
  return out;
}

}  // namespace trocar
