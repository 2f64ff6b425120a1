// The watch on safety that every run has, whatever its kind.
//
// Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include "haptics/exchange/stylus_state.h"
#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"

namespace trocar {

/// EXCESS_FORCE, CRITICAL_FORCE, TOOL_COLLISION, DEVICE_LIMIT, CLUTCH, PORT_HOLD, INSTRUMENT_FREE.
class SafetyWatch {
 public:
  explicit SafetyWatch(const Exercise& exercise);
  void update(const StylusState& state, double dt_s, std::int32_t object, EventLog& log);
  bool too_hard() const { return excess_.above(); }
  int excess_count() const { return excess_count_; }
  double peak_n() const { return peak_n_; }

 private:
  ThresholdMonitor excess_, critical_, collision_, limit_;
  int excess_count_ = 0;
  double peak_n_ = 0, frozen_s_ = 0;
  bool clutched_ = false, held_ = false;
};

}  // namespace trocar
