// The rules of progress as data: what opens a level, when somebody is stuck, unsafe, relapsed, ready, when to come
// back.
//
// Read from TOML with a version of their own (assets/progress.toml is the shipped one).
// Every decision names the version and the numbers it rests on. Sources: docs/progress_rules.md. Pure. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/progress/cusum.h"

namespace trocar {

struct ProgressRules {
  std::string version = "1";
  std::string unread = {};     ///< why newer ones that are kept do not rule, "" where none are
  int passes_to_unlock = 3;    ///< in a row, on as many boards
  int stuck_after = 5;         ///< attempts since the last pass, none of them passed
  int unsafe_window = 5;       ///< newest graded attempts looked at
  int unsafe_attempts = 2;     ///< of them with a critical event or a failed safety gate
  int integrity_window = 10;   ///< newest attempts looked at, void ones too
  int integrity_attempts = 2;  ///< of them void, ended by the device, late, or with force that was not rendered
  double late_share = 0.01;    ///< of the device loop's ticks missed, above which an attempt is late
  int plateau_window = 6;      ///< newest scores
  double plateau_rise = 2.0;   ///< points of gain over the window (Theil-Sen) below which it is flat
  CusumRule cusum = {};
  double least_reliability = 0.7;  ///< of the mean of the newest scores, for "ready"
  int reliability_window = 10;
  std::vector<int> retention_days = {14, 183};
  int retention_early_days = 3;  ///< an attempt counts for a date from so many days before it
  int rasch_least_attempts = 200;
  double rasch_largest_se = 0.5;  ///< logit; abilities with a larger one are not shown
};

/// What is not named keeps the values above; `version` must be named. @param name for messages. @throws InputError with
/// line and column: unknown key, a value that means nothing.
ProgressRules read_progress_rules(const std::string& toml, const std::string& name);

}  // namespace trocar
