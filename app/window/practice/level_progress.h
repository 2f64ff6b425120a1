// What a trainee has done at a level of an exercise, from the attempts alone: what opens levels, and what to do next.
//
// A level opens after three passes in a row, on three boards, at the level before it; once open it stays so. What
// breaks a row: trainees/progress/unlock.h. Pure. Thread: any.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/exercise.h"
#include "trainees/progress/unlock.h"

namespace trocar {

/// One level of an exercise, as the trainee has passed it.
struct LevelProgress {
  int attempts = 0, passed = 0;
  int passed_in_a_row = 0;           ///< on different boards, newest attempts first
  std::optional<double> best, last;  ///< scores
  bool unlocked = true;              ///< levels open one after the other: three passes in a row
  std::vector<AttemptSummary> newest_first = {};
};

/// What to practise next: the first exercise in the order given, all of them at a level before the next level, that is
/// open and has not had its three passes. One rule for every page. @param progress at a level of an exercise. @return
/// nothing when all is passed.
struct NextStep {
  const Exercise* exercise = nullptr;
  std::string level = {};
  LevelProgress progress = {};
};
std::optional<NextStep> next_step(const std::vector<const Exercise*>& order,
                                  const std::function<LevelProgress(const Exercise&, const std::string&)>& progress);

/// The catalogue's order; a guest begins with what is felt (touch).
std::vector<const Exercise*> practice_order(const std::vector<Exercise>& all, bool guest);

/// A run by a scripted hand: shown as a demonstration, and nobody's pass.
bool by_scripted_hand(const AttemptSummary& attempt);

/// @param attempts of one trainee at one exercise, all levels, newest first. Those graded by a rubric that is not the
/// exercise's (Exercise::names) are nobody's: neither counted nor shown.
LevelProgress level_progress(const Exercise& exercise, const std::string& level,
                             const std::vector<AttemptSummary>& attempts);

}  // namespace trocar
