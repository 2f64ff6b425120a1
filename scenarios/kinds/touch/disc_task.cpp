#include "scenarios/kinds/touch/disc_task.h"

#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

constexpr double kNewContactAfter = 0.2;  // s without contact before a contact counts as new: bouncing is one contact
constexpr double kHop = 0.005;      // m from where the last contact ended: lands there anew, however short the hop
constexpr double kDragTime = 0.3;   // s of touching beside the discs before it counts as a wrong place
constexpr double kLiftOff = 0.003;  // m round the disc just held within which the tip may still be leaving
constexpr double kWrongPlaceToast = 1.5;  // s for which a wrong place is shown

}  // namespace

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
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, index_);
}

bool DiscTask::leaving_last_disc(const Vec3& point_T) const {
  if (index_ == 0) return false;
  const Target& last = targets_[static_cast<std::size_t>(index_) - 1];
  return (point_T - last.centre_T).norm() - last.radius_m <= wrong_place_m_ + kLiftOff;
}

void DiscTask::judge_contact(const Vec3& point_T, bool new_contact, double dt_s, EventLog& log) {
  const Target& target = targets_[static_cast<std::size_t>(index_)];
  const double distance = (point_T - target.centre_T).norm();
  const double outside = distance - target.radius_m;
  const bool astray = outside > wrong_place_m_ && !leaving_last_disc(point_T);
  astray_s_ = astray ? astray_s_ + dt_s : 0;
  const bool dragged = astray_s_ > kDragTime && !strayed_;  // once a disc: sliding there instead of lifting
  if ((new_contact && outside > wrong_place_m_) || dragged) {
    ++wrong_places_;
    strayed_ = true;
    since_wrong_place_s_ = 0;
    log.add(event_type::kWrongPlace, Severity::kMinor, index_, outside, "m");
  }
  if (!touched_ && outside <= wrong_place_m_) {
    touched_ = true;
    log.add(event_type::kTargetTouched, Severity::kInfo, index_, distance, "m");
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
    // On tissue that gives way what counts is where on it: discs and contact are compared at rest.
    const bool moved = input.tissue && input.tissue->touched_rest_T;
    const Vec3 point = moved ? *input.tissue->touched_rest_T : state.contact_point_T;
    const bool hopped = free_s_ > 0 && (point - last_contact_T_).norm() > kHop;
    judge_contact(point, free_s_ >= kNewContactAfter || hopped, dt_s, log);
    last_contact_T_ = point;
  }
  free_s_ = touching_ ? 0 : free_s_ + dt_s;
  const double force = state.F_I_T.force.norm();
  const WantedForce& band = targets_[static_cast<std::size_t>(index_)].band;
  const bool wanted = on_disc_ && force >= band.low_n && force <= band.high_n;
  if (!input.held(hold_, wanted)) return;
  log.add(event_type::kTargetHeld, Severity::kInfo, index_, log.t_s - lit_at_s_, "s");
  ++index_;
  light(log);
}

void DiscTask::hints(const TaskInput& input, const WantedForce& band, DirectorStatus& status) const {
  const double force = input.stylus.F_I_T.force.norm();
  const std::string wanted = band_text(band);
  if (input.too_hard && display_ != "after") {
    status.cue = Cue::kRelease;
    return say(status, "Too hard - ease off", "Keep to " + wanted + ".", true);
  }
  if (since_wrong_place_s_ < kWrongPlaceToast)
    return say(status, "Wrong place", "Lift off and touch inside the lit disc.", true);
  if (!touching_) {
    const std::string count = std::to_string(index_ + 1) + " of " + std::to_string(targets_.size());
    return say(status, "Touch the lit disc", "Disc " + count + ": " + wanted + ".");
  }
  if (!on_disc_) return say(status, "Move onto the lit disc", "The tip is beside it.");
  if (display_ == "after") return say(status, "Hold the force steady", "Wanted: " + wanted + ".");
  if (force > band.high_n) return say(status, "A little softer", "Keep to " + wanted + ".");
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
  SurfacePlace place{target.centre_T, target.normal_T};
  if (input.tissue && index_ < input.tissue->place_count) place = input.tissue->place[static_cast<std::size_t>(index_)];
  status.demand = {place.point_T, place.normal_T, target.radius_m, false, Mat3::Identity(), 0, target.band};
  const double force = input.stylus.F_I_T.force.norm();
  status.force_shown = force_shown(display_, touching_ && (force < target.band.low_n || force > target.band.high_n));
  hints(input, target.band, status);
}

}  // namespace trocar
