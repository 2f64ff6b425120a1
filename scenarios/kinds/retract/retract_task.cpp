#include "scenarios/kinds/retract/retract_task.h"

#include <algorithm>

#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

constexpr double kTissueSlipFrom = 0.002;  // m of creep that count as a slip
constexpr double kFirmFrom = 0.7;          // of the lowest wanted grip: from here on it can be lifted
constexpr double kLiesDown = 0.3;          // of the exposure: lower than this the tissue may be let go
constexpr double kCoveredBelow = 0.85;     // of what counts as exposed: breath comes and goes

}  // namespace

RetractTask::RetractTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& places)
    : rules_(own_rules<RetractRules>(exercise)),
      places_(places),
      band_{level.band_low_n, level.band_high_n},
      display_(level.force_display),
      lift_m_(own_rules<RetractLevel>(level).lift_m),
      hold_s_(exercise.hold_s),
      hard_n_(exercise.hard_force_n) {}

void RetractTask::begin(EventLog& log) { light(log); }

void RetractTask::light(EventLog& log) {
  lit_at_s_ = log.t_s;
  holds_ = firm_ = taken_ = exposed_ = judged_ = slipping_ = told_ = false;
  held_s_ = hard_s_ = exposure_ = lifted_m_ = 0;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, index_);
}

void RetractTask::follow_grip(const TaskInput& input, EventLog& log) {
  const TissueFrame& frame = *input.tissue;
  const Vec3 off = input.stylus.X_TI.p - place().centre_T;  // however deep the jaws were pressed
  const bool near = (off - place().normal_T * place().normal_T.dot(off)).norm() <= rules_.reach_m;
  const bool holds = frame.held() && (holds_ || near);
  if (holds && !holds_) {
    const bool again = taken_;
    log.add(again ? event_type::kRegrasp : event_type::kTissueTaken, again ? Severity::kMinor : Severity::kInfo, index_,
            input.stylus.grip_force_n, "N");
    taken_ = true;
    slip_from_m_ = frame.slipped_m;
    taken_z_m_ = input.stylus.X_TI.p.z();
  }
  if (!holds && holds_ && exposure_ > kLiesDown) {
    log.add(event_type::kLetGo, Severity::kMinor, index_, lifted_m_, "m");
    ++lost_;
  }
  holds_ = holds;
  firm_ = holds && (firm_ || input.stylus.grip_force_n >= kFirmFrom * rules_.grip_low_n);
  const bool creeps = holds && !complete() && frame.grip == GripState::kSlipping;
  if (!creeps) slip_from_m_ = frame.slipped_m;
  if (creeps && !slipping_ && frame.slipped_m - slip_from_m_ > kTissueSlipFrom) {
    slipping_ = true;
    ++lost_;
    log.add(event_type::kSlip, Severity::kMinor, index_, frame.slipped_m - slip_from_m_, "m");
  }
  slipping_ = slipping_ && creeps;
}

void RetractTask::follow_lift(const TaskInput& input, EventLog& log) {
  lifted_m_ = holds_ ? input.stylus.X_TI.p.z() - taken_z_m_ : 0;
  exposure_ = std::clamp(lifted_m_ / lift_m_, 0.0, 1.0);
  if (enough() && !exposed_) {
    exposed_ = true;
    log.add(event_type::kExposed, Severity::kInfo, index_, log.t_s - lit_at_s_, "s");
    if (!judged_) log.add(event_type::kTargetTouched, Severity::kInfo, index_, lifted_m_, "m");
    judged_ = true;
  } else if (exposed_ && exposure_ < kCoveredBelow * rules_.exposed_share) {
    exposed_ = false;
    if (!complete()) {
      ++lost_;
      log.add(event_type::kCovered, Severity::kMinor, index_, lifted_m_, "m");
    }
  }
}

void RetractTask::judge_pull(double force_n, double dt_s, EventLog& log) {
  if (force_n > hard_n_) hard_s_ += dt_s;
  if (told_ || hard_s_ <= rules_.too_hard_share * hold_s_) return;
  told_ = true;
  log.add(event_type::kExcessForce, Severity::kCritical, index_, force_n, "N");
}

void RetractTask::update(const TaskInput& input, EventLog& log) {
  if (finished() || !input.tissue) return;
  follow_grip(input, log);
  follow_lift(input, log);
  if (!complete()) {
    if (judged_) judge_pull(input.stylus.F_I_T.force.norm(), input.dt_s, log);
    if (enough() && !frozen(input.stylus)) held_s_ += input.dt_s;
    if (!complete()) return;
    log.add(event_type::kTargetHeld, Severity::kInfo, index_, log.t_s - lit_at_s_, "s");
  }
  if (holds_) return;
  ++index_;
  light(log);
}

void RetractTask::describe_message(const StylusState& stylus, DirectorStatus& status) const {
  const double pull_n = stylus.F_I_T.force.norm();
  const std::string pull = "Pull with " + band_text(band_) + ".";
  if (complete()) return say(status, "Let it down and let go", "Slowly, until it lies as before.");
  if (!holds_) {
    if (judged_) return say(status, "Take it again", "It was lost: hold it tighter, and calmly.", true);
    return say(status, "Take the tissue at the lit disc", "Open jaws on it, press a little, close.");
  }
  if (slipping_) return say(status, "It slips - hold it tighter", pull, true);
  const bool shown = display_ != "after";
  if (shown && stylus.grip_force_n < rules_.grip_low_n)
    return say(status, "Hold it tighter", "Grip with " + band_text({rules_.grip_low_n, rules_.grip_high_n}) + ".",
               true);
  if (shown && pull_n > band_.high_n) return say(status, "A little softer", pull);
  if (!enough()) return say(status, "Lift it further", pull);
  if (shown && pull_n < band_.low_n) return say(status, "A little more", pull);
  say(status, "Good - hold", pull);
}

void RetractTask::describe(const TaskInput& input, DirectorStatus& status) const {
  const std::int32_t done = index_ + (complete() ? 1 : 0);
  status.targets_done = done;
  for (std::int32_t i = 0; i < done; ++i) status.done.set(static_cast<std::size_t>(i));
  status.target_index = object();
  status.wrong_places = lost_;
  status.exposure = exposure_;
  status.hold_progress = finished() ? 0 : std::min(1.0, held_s_ / hold_s_);
  if (finished()) return;
  SurfacePlace seen{place().centre_T, place().normal_T};
  if (!holds_ && input.tissue && index_ < input.tissue->place_count)
    seen = input.tissue->place[static_cast<std::size_t>(index_)];
  status.demand = {seen.point_T, seen.normal_T, place().radius_m, false, Mat3::Identity(), 0, band_};
  const Vec3 from_T = holds_ ? Vec3(place().centre_T.x(), place().centre_T.y(), taken_z_m_) : place().centre_T;
  status.demand.goal_T = from_T + Vec3(0, 0, lift_m_);
  status.demand.foam[0] = {0, rules_.grip_low_n, rules_.grip_high_n};
  status.demand.foam_count = 1;
  status.cue = complete() ? Cue::kLower : firm_ ? Cue::kLift : Cue::kTake;
  const double pull = input.stylus.F_I_T.force.norm();
  status.force_shown = force_shown(display_, holds_ && (pull < band_.low_n || pull > band_.high_n));
  describe_message(input.stylus, status);
}

}  // namespace trocar
