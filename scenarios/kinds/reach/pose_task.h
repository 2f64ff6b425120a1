// Reach and orient: pens light one after the other; tip and orientation must match and stay matched for a moment.
//
// Events: TARGET_LIT, TARGET_HELD (s since lit), and with it POSITION_ERROR (m) and ANGLE_ERROR (rad), the means over
// the second half of the hold; TARGET_TIMEOUT when a pen was not matched in its time: an error, and the pen comes back
// after the others, so that nobody gets past a pen by waiting. The angle is that of the whole rotation between
// instrument and pen, roll included. Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <deque>
#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"

namespace trocar {

class PoseTask final : public ExerciseTask {
 public:
  PoseTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& pens);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return waiting_.empty(); }
  std::int32_t object() const override { return finished() ? -1 : waiting_.front(); }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  void light(EventLog& log);
  void matched(EventLog& log);

  std::vector<Target> pens_;
  double position_tolerance_m_, angle_tolerance_rad_, timeout_s_;
  HoldTimer hold_;
  std::deque<std::int32_t> waiting_;  ///< pens still to match; the first is lit
  int timeouts_ = 0;
  double lit_at_s_ = 0;
  double position_error_m_ = 0, angle_error_rad_ = 0;
  double judged_s_ = 0, position_sum_ = 0, angle_sum_ = 0;  ///< over the second half of the hold
};

/// Angle of the rotation that takes one orientation into the other, rad.
double rotation_between(const Mat3& R_a, const Mat3& R_b);

}  // namespace trocar
