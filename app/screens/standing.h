// How a trainee stands to an exercise at a level, from the attempts alone: what opens levels, and what to do next.
//
// A level opens after three passes in a row, on three boards, at the level before it; once open it stays so. An attempt that was left
// (aborted) counts as not passed; one that the device ended (fault, void) does not count. Pure. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "scenarios/exercise.h"
#include "trainees/progress/unlock.h"

namespace trocar {

/// One exercise of the catalogue at one level, as the trainee stands to it.
struct Standing {
  int attempts = 0, passed = 0;
  int passed_in_a_row = 0;               ///< on different boards, newest attempts first
  std::optional<double> best, last;      ///< scores
  bool unlocked = true;                  ///< levels open one after the other: three passes in a row
  std::vector<AttemptSummary> newest_first = {};
};

/// @param attempts of one trainee at one exercise, all levels, newest first.
Standing standing_of(const Exercise& exercise, const std::string& level, const std::vector<AttemptSummary>& attempts);

}  // namespace trocar
