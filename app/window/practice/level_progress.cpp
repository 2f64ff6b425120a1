#include "app/window/practice/level_progress.h"

#include <algorithm>

#include "app/window/input/input_event.h"
#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

/// By the exercise's own rubric: an edited one may pass anybody.
std::vector<AttemptSummary> at_level(const Exercise& exercise, const std::string& level,
                                     const std::vector<AttemptSummary>& attempts) {
  std::vector<AttemptSummary> out;
  std::copy_if(attempts.begin(), attempts.end(), std::back_inserter(out), [&](const AttemptSummary& a) {
    return a.level == level && exercise.names(a.rubric_sha256, a.started_utc);
  });
  return out;
}

}  // namespace

std::optional<NextStep> next_step(const std::vector<const Exercise*>& order,
                                  const std::function<LevelProgress(const Exercise&, const std::string&)>& progress) {
  std::size_t most = 0;
  for (const Exercise* e : order) most = std::max(most, e->levels.size());
  for (std::size_t i = 0; i < most; ++i) {
    for (const Exercise* e : order) {
      if (i >= e->levels.size()) continue;
      LevelProgress s = progress(*e, e->levels[i].name);
      if (s.unlocked && !opens_next(s.newest_first)) return NextStep{e, e->levels[i].name, std::move(s)};
    }
  }
  return std::nullopt;
}

std::vector<const Exercise*> practice_order(const std::vector<Exercise>& all, bool guest) {
  std::vector<const Exercise*> order;
  for (const Exercise& e : all) order.push_back(&e);
  if (guest) std::stable_partition(order.begin(), order.end(), [](const Exercise* e) { return kind_of(*e).on_organ; });
  return order;
}

bool by_scripted_hand(const AttemptSummary& attempt) {
  for (const InputKind kind :
       {InputKind::kMouse, InputKind::kKeyboard, InputKind::kPad, InputKind::kSpaceMouse, InputKind::kDevice})
    if (attempt.hand == input_name(kind)) return false;
  return !attempt.hand.empty();
}

LevelProgress level_progress(const Exercise& exercise, const std::string& level,
                             const std::vector<AttemptSummary>& attempts) {
  LevelProgress out;
  out.newest_first = at_level(exercise, level, attempts);
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
  if (at != exercise.levels.begin() && at != exercise.levels.end())
    out.unlocked = opens_next(at_level(exercise, std::prev(at)->name, attempts));
  return out;
}

}  // namespace trocar
