#include "scenarios/kinds/touch/squeeze_task.h"

namespace trocar {
namespace {

constexpr double kJawClearance = 0.001;  // m that the jaws must be wider than the block before it is offered
constexpr double kGripTouch = 0.05;      // N

}  // namespace

SqueezeTask::SqueezeTask(const GripTask& task, const ExerciseLevel& level, std::int32_t object)
    : task_(task),
      display_(level.force_display),
      object_(object),
      hold_(task.hold_s, kHoldGrace),
      excess_(task.excess_n, kRearmShare * task.excess_n, kRearmTime) {}

GripBlock SqueezeTask::block() const {
  if (!offered_ || finished_) return {};
  return {task_.block_thickness_m, task_.block_stiffness_n_per_m};
}

void SqueezeTask::update(const TaskInput& input, EventLog& log) {
  if (finished_) return;
  const StylusState& state = input.stylus;
  const double dt_s = input.dt_s;
  if (!offered_) {
    if (state.jaw_opening_m < task_.block_thickness_m + kJawClearance) return;
    offered_ = true;
    offered_at_s_ = log.t_s;
    log.add(event_type::kGripOffered, Severity::kInfo, object_, task_.block_thickness_m, "m");
    return;
  }
  const double grip = state.grip_force_n;
  if (!touched_ && grip > kGripTouch) {
    touched_ = true;
    log.add(event_type::kGripTouched, Severity::kInfo, object_, grip, "N");
  }
  if (excess_.update(grip, dt_s)) {
    ++excess_count_;
    log.add(event_type::kGripExcess, Severity::kMajor, object_, grip, "N");
  }
  if (!input.held(hold_, grip >= task_.low_n && grip <= task_.high_n)) return;
  finished_ = true;
  log.add(event_type::kGripHeld, Severity::kInfo, object_, log.t_s - offered_at_s_, "s");
}

void SqueezeTask::describe(const TaskInput& input, DirectorStatus& status) const {
  const double grip = input.stylus.grip_force_n;
  const WantedForce band{task_.low_n, task_.high_n};
  const std::string wanted = band_text(band);
  status.cue = Cue::kGrip;
  status.target_index = -1;
  status.targets_done = object_;  // the block comes after the discs
  for (int i = 0; i < object_; ++i) status.done.set(static_cast<std::size_t>(i));
  status.grip = block();
  status.hold_progress = hold_.progress();
  status.excess_forces += excess_count_;
  status.demand.band = band;
  status.force_shown = force_shown(display_, touched_ && (grip < band.low_n || grip > band.high_n));
  if (!offered_) return say(status, "Open the jaws", "A block will be placed between them.");
  if (display_ == "after") return say(status, "Squeeze the block", "Wanted: " + wanted + ".");
  if (excess_.above()) return say(status, "Too tight - ease off", "Squeeze with " + wanted + ".", true);
  if (grip > band.high_n) return say(status, "A little softer", "Squeeze with " + wanted + ".");
  if (grip < band.low_n) return say(status, "Squeeze the block", "Reach " + wanted + " and hold.");
  say(status, "Good - hold", "Keep the squeeze steady.");
}

}  // namespace trocar
