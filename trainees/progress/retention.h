// When to come back after a certificate: attempts for keeping, derived from its date and never stored.
//
// Skills fade: 4 to 15 % at 12 to 18 months. Each date has a window: from some days before it until the window of the
// next begins. The first graded attempt in it counts. A date whose window closed without one was missed. Pure. Thread:
// any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trainees/progress/judgement.h"

namespace trocar {

struct RetentionDate {
  enum class State : std::uint8_t { kUpcoming, kDue, kKept, kNotKept, kMissed } state = State::kUpcoming;
  int days = 0;  ///< after the certificate
  std::string due_utc;
  std::string done_utc = {};  ///< start of the attempt that counts
};
const char* retention_state_name(
    RetentionDate::State state);  ///< "upcoming", "due", "kept", "not kept" (failed), "missed"

/// Empty without a certificate. @param attempts of the curve.
std::vector<RetentionDate> retention_dates(const std::string& certified_utc, const std::vector<CurveAttempt>& attempts,
                                           const ProgressRules& rules, const std::string& now_utc);

}  // namespace trocar
