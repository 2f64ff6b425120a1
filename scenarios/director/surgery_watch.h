// The watch on what is done to an organ that gives way: CUT, TEAR, CLIP, REFUSED, BLEEDING, BURN.
//
// It tells what SurgeryState counts from one step to the next; nobody grades it. Frame T, SI units, blood in mL,
// temperatures in deg C. Deterministic. Thread: the tissue task's.
#pragma once

#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class SurgeryWatch {
 public:
  SurgeryWatch();
  /// What was done before the run is nobody's event.
  void skip(const SurgeryState& now) { seen_ = now; }
  void update(const SurgeryState& now, double dt_s, EventLog& log);

 private:
  void tell_blood(const SurgeryState& now, double dt_s, EventLog& log);

  SurgeryState seen_;
  ThresholdMonitor bleeds_, burns_;
  double told_ml_per_min_ = 0;
};

}  // namespace trocar
