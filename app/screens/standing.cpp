#include "app/screens/standing.h"

#include <algorithm>

namespace trocar {
namespace {

std::vector<AttemptSummary> at_level(const std::vector<AttemptSummary>& attempts, const std::string& level) {
  std::vector<AttemptSummary> out;
  std::copy_if(attempts.begin(), attempts.end(), std::back_inserter(out), [&level](const AttemptSummary& a) { return a.level == level; });
  return out;
}

}  // namespace

Standing standing_of(const Exercise& exercise, const std::string& level, const std::vector<AttemptSummary>& attempts) {
  Standing out;
  out.newest_first = at_level(attempts, level);
  for (const AttemptSummary& attempt : out.newest_first) {
    if (attempt.status == "running") continue;
    ++out.attempts;
    out.passed += attempt.passed ? 1 : 0;
    if (!attempt.score) continue;
    if (!out.last) out.last = attempt.score;
    out.best = std::max(out.best.value_or(*attempt.score), *attempt.score);
  }
  out.passed_in_a_row = passes_in_a_row(out.newest_first);
  const auto at = std::find_if(exercise.levels.begin(), exercise.levels.end(),
                               [&level](const ExerciseLevel& l) { return l.name == level; });
  if (at != exercise.levels.begin() && at != exercise.levels.end()) out.unlocked = opens_next(at_level(attempts, std::prev(at)->name));
  return out;
}

}  // namespace trocar
