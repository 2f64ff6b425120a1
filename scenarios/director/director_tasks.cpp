#include "scenarios/director/director_tasks.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kRearmShare = 0.8, kRearmTime = 0.2;  // of the limit; s (shared events of the catalogue)
constexpr double kHoldGrace = 0.1;                     // s out of the band that only pause the hold
constexpr double kNewContactAfter = 0.2;  // s without contact before a contact counts as new: bouncing is one contact
constexpr double kHop = 0.005;           // m from where the last contact ended: lands there anew, however short the hop
constexpr double kDragTime = 0.3;        // s of touching beside the discs before it counts as a wrong place
constexpr double kLiftOff = 0.003;       // m round the disc just held within which the tip may still be leaving
constexpr double kExcessRepeat = 1.0;    // s above the limit that count as one more excess
constexpr double kCollisionForce = 2.0;  // N of the shaft on the tissue
constexpr double kLimitRearm = 0.5;      // s
constexpr double kToastTime = 1.5;       // s for which a wrong place is shown
constexpr double kJawClearance = 0.001;  // m that the jaws must be wider than the block before it is offered
constexpr double kGripTouch = 0.05;      // N

}  // namespace

SafetyWatch::SafetyWatch(const Exercise& exercise)
    : excess_(exercise.hard_force_n, kRearmShare * exercise.hard_force_n, kRearmTime, kExcessRepeat),
      critical_(exercise.critical_force_n, kRearmShare * exercise.critical_force_n, kRearmTime),
      collision_(kCollisionForce, kRearmShare * kCollisionForce, kRearmTime),
      limit_(0.5, 0.5, kLimitRearm) {}

void SafetyWatch::update(const StylusState& state, double dt_s, std::int32_t object, EventLog& log) {
  const double force = state.F_I_T.force.norm();
  peak_n_ = std::max(peak_n_, force);
  if (excess_.update(force, dt_s)) {
    ++excess_count_;
    log.add("EXCESS_FORCE", Severity::kMajor, object, force, "N");
  }
  if (critical_.update(force, dt_s)) log.add("CRITICAL_FORCE", Severity::kCritical, object, force, "N");
  const double shaft_force = state.contact && !state.tip_contact ? force : 0;
  if (collision_.update(shaft_force, dt_s)) log.add("TOOL_COLLISION", Severity::kMinor, object, force, "N");
  if (limit_.update(state.saturated ? 1 : 0, dt_s))
    log.add("DEVICE_LIMIT", Severity::kInfo, object, state.rendered_force_T.norm(), "N");
  if (state.clutched && !clutched_) log.add("CLUTCH", Severity::kInfo, object);
  if (state.port_held && !held_) log.add("PORT_HOLD", Severity::kMinor, object, state.depth_in_port_m, "m");
  clutched_ = state.clutched;
  held_ = state.port_held;
}

DiscTask::DiscTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& targets)
    : wrong_place_m_(exercise.layout.wrong_place_m),
      display_(level.force_display),
      targets_(targets),
      hold_(exercise.hold_s, kHoldGrace) {}

void DiscTask::begin(EventLog& log) { light(log); }

void DiscTask::light(EventLog& log) {
  hold_.reset();
  touched_ = on_disc_ = strayed_ = false;
  astray_s_ = 0;
  lit_at_s_ = log.t_s;
  if (!finished()) log.add("TARGET_LIT", Severity::kInfo, index_);
}

bool DiscTask::leaving_last_disc(const Vec3& point_T) const {
  if (index_ == 0) return false;
  const Target& last = targets_[static_cast<std::size_t>(index_) - 1];
  return (point_T - last.centre_T).norm() - last.radius_m <= wrong_place_m_ + kLiftOff;
}

void DiscTask::judge_contact(const StylusState& state, bool new_contact, double dt_s, EventLog& log) {
  const Target& target = targets_[static_cast<std::size_t>(index_)];
  const double distance = (state.contact_point_T - target.centre_T).norm();
  const double outside = distance - target.radius_m;
  const bool astray = outside > wrong_place_m_ && !leaving_last_disc(state.contact_point_T);
  astray_s_ = astray ? astray_s_ + dt_s : 0;
  const bool dragged = astray_s_ > kDragTime && !strayed_;  // once a disc: sliding there instead of lifting
  if ((new_contact && outside > wrong_place_m_) || dragged) {
    ++wrong_places_;
    strayed_ = true;
    since_wrong_place_s_ = 0;
    log.add("WRONG_PLACE", Severity::kMinor, index_, outside, "m");
  }
  if (!touched_ && outside <= wrong_place_m_) {
    touched_ = true;
    log.add("TARGET_TOUCHED", Severity::kInfo, index_, distance, "m");
  }
  on_disc_ = outside <= wrong_place_m_ / 2;
}

void DiscTask::update(const TaskInput& input, EventLog& log) {
  if (finished()) return;
  const StylusState& state = input.stylus;
  const double dt_s = input.dt_s;
  since_wrong_place_s_ += dt_s;
  touching_ = state.contact && state.tip_contact;
  on_disc_ = false;
  if (touching_) {
    const bool hopped = free_s_ > 0 && (state.contact_point_T - last_contact_T_).norm() > kHop;
    judge_contact(state, free_s_ >= kNewContactAfter || hopped, dt_s, log);
    last_contact_T_ = state.contact_point_T;
  }
  free_s_ = touching_ ? 0 : free_s_ + dt_s;
  const double force = state.F_I_T.force.norm();
  const WantedForce& band = targets_[static_cast<std::size_t>(index_)].band;
  const bool wanted = on_disc_ && force >= band.low_n && force <= band.high_n;
  if (!hold_.update(wanted, dt_s)) return;
  log.add("TARGET_HELD", Severity::kInfo, index_, log.t_s - lit_at_s_, "s");
  ++index_;
  light(log);
}

void DiscTask::coach(const TaskInput& input, const WantedForce& band, DirectorStatus& status) const {
  const double force = input.stylus.F_I_T.force.norm();
  const std::string wanted = band_text(band);
  if (input.too_hard && display_ != "after") {
    status.cue = Cue::kRelease;
    return say(status, "Too hard - ease off", "Stay between " + wanted + ".", true);
  }
  if (since_wrong_place_s_ < kToastTime)
    return say(status, "Wrong place", "Lift off and touch inside the lit disc.", true);
  if (!touching_) {
    const std::string count = std::to_string(index_ + 1) + " of " + std::to_string(targets_.size());
    return say(status, "Touch the lit disc", "Disc " + count + ": " + wanted + ".");
  }
  if (!on_disc_) return say(status, "Move onto the lit disc", "The tip is beside it.");
  if (display_ == "after") return say(status, "Hold by feel", "Wanted: " + wanted + ".");
  if (force > band.high_n) return say(status, "A little softer", "Stay between " + wanted + ".");
  if (force < band.low_n) return say(status, "Press gently", "Reach " + wanted + " and hold.");
  say(status, "Good - hold", "Keep the force steady.");
}

void DiscTask::describe(const TaskInput& input, DirectorStatus& status) const {
  status.target_index = index_;
  status.targets_done = index_;
  for (int i = 0; i < index_; ++i) status.done.set(static_cast<std::size_t>(i));
  status.hold_progress = hold_.progress();
  status.wrong_places = wrong_places_;
  status.cue = on_disc_ ? Cue::kPress : Cue::kReach;
  if (finished()) return;
  const Target& target = targets_[static_cast<std::size_t>(index_)];
  status.demand = {target.centre_T, target.normal_T, target.radius_m, false, Mat3::Identity(), 0, target.band};
  const double force = input.stylus.F_I_T.force.norm();
  status.force_shown = force_shown(display_, touching_ && (force < target.band.low_n || force > target.band.high_n));
  coach(input, target.band, status);
}

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
    log.add("GRIP_OFFERED", Severity::kInfo, object_, task_.block_thickness_m, "m");
    return;
  }
  const double grip = state.grip_force_n;
  if (!touched_ && grip > kGripTouch) {
    touched_ = true;
    log.add("GRIP_TOUCHED", Severity::kInfo, object_, grip, "N");
  }
  if (excess_.update(grip, dt_s)) {
    ++excess_count_;
    log.add("GRIP_EXCESS", Severity::kMajor, object_, grip, "N");
  }
  if (!hold_.update(grip >= task_.low_n && grip <= task_.high_n, dt_s)) return;
  finished_ = true;
  log.add("GRIP_HELD", Severity::kInfo, object_, log.t_s - offered_at_s_, "s");
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
  if (display_ == "after") return say(status, "Squeeze the block by feel", "Wanted: " + wanted + ".");
  if (excess_.above()) return say(status, "Too tight - ease off", "Squeeze with " + wanted + ".", true);
  if (grip > band.high_n) return say(status, "A little softer", "Squeeze with " + wanted + ".");
  if (grip < band.low_n) return say(status, "Squeeze the block", "Reach " + wanted + " and hold.");
  say(status, "Good - hold", "Keep the squeeze steady.");
}

}  // namespace trocar
