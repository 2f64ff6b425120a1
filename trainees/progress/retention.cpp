#include "trainees/progress/retention.h"

#include <algorithm>
#include <limits>

#include "trainees/progress/calendar.h"

namespace trocar {
namespace {

using State = RetentionDate::State;

const CurveAttempt* first_graded(const std::vector<CurveAttempt>& attempts, std::int64_t from, std::int64_t to) {
  const CurveAttempt* found = nullptr;
  for (const CurveAttempt& attempt : attempts)
    if (attempt.score && !attempt.broken && attempt.started_s >= from && attempt.started_s < to &&
        (found == nullptr || attempt.started_s < found->started_s))
      found = &attempt;
  return found;
}

}  // namespace

const char* retention_state_name(State state) {
  switch (state) {
    case State::kUpcoming:
      return "upcoming";
    case State::kDue:
      return "due";
    case State::kKept:
      return "kept";
    case State::kNotKept:
      return "not kept";
    case State::kMissed:
      return "missed";
  }
  return "unknown";
}

std::vector<RetentionDate> retention_dates(const std::string& certified_utc, const std::vector<CurveAttempt>& attempts,
                                           const ProgressRules& rules, const std::string& now_utc) {
  std::vector<RetentionDate> dates;
  const auto certified = seconds_of_utc(certified_utc), now = seconds_of_utc(now_utc);
  if (!certified || !now) return dates;
  const auto due = [&](std::size_t k) { return *certified + rules.retention_days[k] * kSecondsADay; };
  // Never before the certificate, however early one may come.
  const auto opens = [&](std::size_t k) {
    return std::max(*certified + 1, due(k) - rules.retention_early_days * kSecondsADay);
  };
  for (std::size_t k = 0; k < rules.retention_days.size(); ++k) {
    const std::int64_t closes =
        k + 1 < rules.retention_days.size() ? opens(k + 1) : std::numeric_limits<std::int64_t>::max();
    RetentionDate date;
    date.days = rules.retention_days[k];
    date.due_utc = utc_of_seconds(due(k));
    if (const CurveAttempt* attempt = first_graded(attempts, opens(k), closes)) {
      date.state = attempt->passed ? State::kKept : State::kNotKept;
      date.done_utc = utc_of_seconds(attempt->started_s);
    } else if (*now >= closes) {
      date.state = State::kMissed;
    } else if (*now >= due(k)) {
      date.state = State::kDue;
    }
    dates.push_back(date);
  }
  return dates;
}

}  // namespace trocar
