// `trocar study timing`: can this machine run the haptic loop at 1 kHz, and how do others wait beside it?
//
// Every pattern of loop_patterns.h in short slices that take turns, in the same minute, once with a busy process for
// each processor (two at least) and once without. It measures this machine at this minute: the one study whose numbers
// change from run to run, and that no test judges by its times. Thread: the caller's.
#pragma once

#include <vector>

#include "app/studies/study.h"
#include "app/studies/timing/loop_patterns.h"

namespace trocar {

/// The patterns of one load: ours first, its wait alone, then the others.
struct TimedLoad {
  int busy = 0;  ///< processes beside it
  std::vector<PatternRun> runs;
};

inline constexpr double kAverageTolerance = 0.05;  ///< Hz: 1000.0 to one decimal
inline constexpr double kMostOfCyclictest = 1.5;   ///< a percentile of ours against cyclictest's

/// What runs come to; no clock is read. @param machine in words.
StudyResult timing_result(const TimedLoad& busy, const TimedLoad& idle, const std::string& machine);

StudyResult timing_study(const StudyRequest& request);

}  // namespace trocar
