// What the program says of a device that stopped: the cause in words and what the operator should do about it.
#pragma once

#include <string>

#include "haptics/exchange/stylus_state.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// "encoder-jump on channel 2 at 3.001 s: the counter jumped by 1000 counts. Check ...". Empty without a fault.
std::string fault_words(const RunReport& device);

/// Why an attempt that was not graded ended, in a sentence. @param loop state of the device at the end.
/// @param reached_run whether the clock of the exercise had begun. @param homing as it stood at the end.
std::string end_words(AttemptStatus status, const RunReport& device, LoopState loop, bool reached_run,
                      const HomingReport& homing = {});

}  // namespace trocar
