// The watch on what is done to an organ that gives way: CUT, TEAR, CLIP, REFUSED, BLEEDING, BURN, NEEDLE, PUNCTURE,
// STITCH, THROW.
//
// It tells what SurgeryState and SutureState count from one step to the next; nobody grades it. Frame T, SI units,
// blood in mL, temperatures in deg C. Deterministic. Thread: the tissue task's.
#pragma once

#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class SurgeryWatch {
 public:
  SurgeryWatch();
  /// What was done before the run is nobody's event.
  void skip(const TissueFrame& now) { seen_ = now.surgery, sewn_ = now.suture; }
  void update(const SurgeryState& now, double dt_s, EventLog& log);
  void update(const SutureState& now, EventLog& log);

 private:
  void tell_blood(const SurgeryState& now, double dt_s, EventLog& log);

  SurgeryState seen_;
  SutureState sewn_;
  ThresholdMonitor bleeds_, burns_;
  double told_ml_per_min_ = 0;
};

}  // namespace trocar
