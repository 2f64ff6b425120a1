#include "scenarios/kinds/reach/pose_task.h"

#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kSettled = 0.5;  // of the hold: before, the instrument is still arriving

}  // namespace

double rotation_between(const Mat3& R_a, const Mat3& R_b) {
  const Mat3 R = R_a.transpose() * R_b;
  // Half angle from the Frobenius distance: well conditioned at small angles, where acos of the trace is not.
  const double half = std::min(1.0, (R - Mat3::Identity()).norm() / (2 * std::numbers::sqrt2));
  return 2 * std::asin(half);
}

PoseTask::PoseTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& pens)
    : pens_(pens),
      position_tolerance_m_(level.position_tolerance_m),
      angle_tolerance_rad_(level.angle_tolerance_rad),
      timeout_s_(exercise.pens.timeout_s),
      hold_(exercise.hold_s, kHoldGrace) {
  for (std::size_t i = 0; i < pens_.size(); ++i) waiting_.push_back(static_cast<std::int32_t>(i));
}

void PoseTask::begin(EventLog& log) { light(log); }

void PoseTask::light(EventLog& log) {
  hold_.reset();
  judged_s_ = position_sum_ = angle_sum_ = 0;
  lit_at_s_ = log.t_s;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, object());
}

void PoseTask::matched(EventLog& log) {
  log.add(event_type::kTargetHeld, Severity::kInfo, object(), log.t_s - lit_at_s_, "s");
  log.add(event_type::kPositionError, Severity::kInfo, object(), position_sum_ / judged_s_, "m");
  log.add(event_type::kAngleError, Severity::kInfo, object(), angle_sum_ / judged_s_, "rad");
  waiting_.pop_front();
  light(log);
}

void PoseTask::update(const TaskInput& input, EventLog& log) {
  if (finished()) return;
  const Target& pen = pens_[static_cast<std::size_t>(object())];
  position_error_m_ = (input.stylus.X_TI.p - pen.centre_T).norm();
  angle_error_rad_ = rotation_between(input.stylus.X_TI.R, pen.R_TI);
  const bool inside = position_error_m_ <= position_tolerance_m_ && angle_error_rad_ <= angle_tolerance_rad_;
  const bool complete = input.held(hold_, inside);
  if (hold_.progress() >= kSettled) {
    judged_s_ += input.dt_s;
    position_sum_ += position_error_m_ * input.dt_s;
    angle_sum_ += angle_error_rad_ * input.dt_s;
  }
  if (complete) return matched(log);
  if (hold_.progress() == 0) judged_s_ = position_sum_ = angle_sum_ = 0;
  if (log.t_s - lit_at_s_ < timeout_s_) return;
  ++timeouts_;
  log.add(event_type::kTargetTimeout, Severity::kMinor, object(), timeout_s_, "s");
  waiting_.push_back(waiting_.front());
  waiting_.pop_front();
  light(log);
}

void PoseTask::describe(const TaskInput&, DirectorStatus& status) const {
  status.targets_done = static_cast<int>(pens_.size() - waiting_.size());
  status.target_index = object();
  for (std::size_t i = 0; i < pens_.size(); ++i) status.done.set(i);
  for (const std::int32_t pen : waiting_) status.done.reset(static_cast<std::size_t>(pen));
  status.timeouts = timeouts_;
  status.hold_progress = hold_.progress();
  status.cue = Cue::kOrient;
  status.force_shown = false;
  if (finished()) return;
  const Target& pen = pens_[static_cast<std::size_t>(object())];
  status.demand = {pen.centre_T, pen.normal_T, position_tolerance_m_, true, pen.R_TI, angle_tolerance_rad_, {}};
  status.position_error_m = position_error_m_;
  status.angle_error_rad = angle_error_rad_;
  const std::string count = std::to_string(status.targets_done + 1) + " of " + std::to_string(pens_.size());
  if (hold_.progress() > 0) return say(status, "Good - hold", "Pen " + count + ".");
  if (position_error_m_ > position_tolerance_m_)
    return say(status, "Bring the tip to the lit pen", "Pen " + count + ".");
  if (angle_error_rad_ > angle_tolerance_rad_)
    return say(status, "Turn the instrument along the pen", "The tip is right.");
  say(status, "Good - hold", "Pen " + count + ".");
}

}  // namespace trocar
