// The squeeze that ends surface touch: a block between the jaws, held within a band of grip.
//
// Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include "haptics/exchange/stylus_state.h"
#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"

namespace trocar {

/// Offers the block between open jaws: GRIP_OFFERED, GRIP_TOUCHED, GRIP_EXCESS, GRIP_HELD.
class SqueezeTask final : public ExerciseTask {
 public:
  SqueezeTask(const GripTask& task, const ExerciseLevel& level, std::int32_t object);
  void begin(EventLog&) override {}
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return finished_; }
  std::int32_t object() const override { return -1; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  GripBlock block() const;

  GripTask task_;
  std::string display_;
  std::int32_t object_;
  HoldTimer hold_;
  ThresholdMonitor excess_;
  bool offered_ = false, touched_ = false, finished_ = false;
  int excess_count_ = 0;
  double offered_at_s_ = 0;
};

}  // namespace trocar
