#include "scenarios/kinds/find/find_task.h"

#include <algorithm>
#include <cmath>

#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

constexpr double kFlapSlipFrom = 0.002;                 // m of creep that count as a slip
constexpr double kFlapFirmFrom = 0.7;                   // of the lowest wanted grip: from here on it can be lifted
constexpr double kFlapLies = 0.3;                       // of the angle: lower than this the flap may be let go
constexpr double kCoveredFrom = 0.85;                   // of the angle: a hand trembles
constexpr double kUnfolded = 0.9;                       // of the way from the hinge to where the place lies
constexpr double kGoalAngle = 1.25, kGoalReach = 1.15;  // of the angle asked for, and of that way: where it is taut
constexpr double kAnswerToast = 1.5;                    // s for which an answer is spoken of

/// The axis about which what lies this way from the hinge turns up.
Vec3 up_about(const Vec3& lies) { return lies.cross(Vec3::UnitZ()).normalized(); }

}  // namespace

FindTask::FindTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<FindRules>(exercise)),
      board_(own_rules<FindBoard>(board)),
      places_(board.targets),
      band_{level.band_low_n, level.band_high_n},
      display_(level.force_display),
      hold_s_(exercise.hold_s),
      answer_(rules_.answer_hold_s, kHoldGrace) {}

void FindTask::begin(EventLog& log) { light(log); }

void FindTask::light(EventLog& log) {
  lit_at_s_ = log.t_s;
  holds_ = firm_ = taken_ = exposed_ = judged_ = slipping_ = false;
  held_s_ = exposure_ = 0;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, index_);
}

/// Square to the hinge.
Vec3 FindTask::from_hinge(const Vec3& place_T) const {
  const Vec3 off = place_T - board_.hinge_T;
  return off - off.dot(board_.along_T) * board_.along_T;
}

Vec3 FindTask::goal_T() const {
  const Vec3 lies = from_hinge(place().centre_T);
  return place().centre_T - lies +
         Eigen::AngleAxisd(kGoalAngle * rules_.seen_rad, up_about(lies)) * Vec3(kGoalReach * lies);
}

void FindTask::follow_grip(const TaskInput& input, EventLog& log) {
  const TissueFrame& frame = *input.tissue;
  const Vec3 off = input.stylus.X_TI.p - place().centre_T;  // however deep the jaws were pressed
  const bool near = (off - place().normal_T * place().normal_T.dot(off)).norm() <= rules_.reach_m;
  const bool holds = frame.held() && (holds_ || near);
  if (holds && !holds_) {
    log.add(taken_ ? event_type::kRegrasp : event_type::kTissueTaken, taken_ ? Severity::kMinor : Severity::kInfo,
            index_, input.stylus.grip_force_n, "N");
    taken_ = true;
    slip_from_m_ = frame.slipped_m;
  }
  if (!holds && holds_ && exposure_ > kFlapLies) {
    log.add(event_type::kLetGo, Severity::kMinor, index_, input.stylus.X_TI.p.z() - place().centre_T.z(), "m");
    ++lost_;
  }
  holds_ = holds;
  firm_ = holds && (firm_ || input.stylus.grip_force_n >= kFlapFirmFrom * rules_.grip_low_n);
  const bool creeps = holds && !complete() && frame.grip == GripState::kSlipping;
  if (!creeps) slip_from_m_ = frame.slipped_m;
  if (creeps && !slipping_ && frame.slipped_m - slip_from_m_ > kFlapSlipFrom) {
    slipping_ = true;
    ++lost_;
    log.add(event_type::kSlip, Severity::kMinor, index_, frame.slipped_m - slip_from_m_, "m");
  }
  slipping_ = slipping_ && creeps;
}

void FindTask::follow_lift(const TaskInput& input, EventLog& log) {
  const Vec3 lies = from_hinge(place().centre_T), now = from_hinge(input.stylus.X_TI.p);
  const double angle = std::atan2(up_about(lies).dot(lies.cross(now)), lies.dot(now));
  exposure_ =
      holds_ ? std::clamp(std::min(angle / rules_.seen_rad, now.norm() / (kUnfolded * lies.norm())), 0.0, 1.0) : 0;
  if (exposure_ >= 1 && !exposed_) {
    exposed_ = true;
    log.add(event_type::kExposed, Severity::kInfo, index_, log.t_s - lit_at_s_, "s");
    if (!judged_) log.add(event_type::kTargetTouched, Severity::kInfo, index_, input.stylus.F_I_T.force.norm(), "N");
    judged_ = true;
  } else if (exposed_ && exposure_ < kCoveredFrom) {
    exposed_ = false;
    if (complete() || !holds_) return;  // let go is one loss, and told already
    ++lost_;
    log.add(event_type::kCovered, Severity::kMinor, index_, input.stylus.X_TI.p.z() - place().centre_T.z(), "m");
  }
}

void FindTask::follow_answer(const TaskInput& input, EventLog& log) {
  std::int32_t in_ball = -1;
  for (std::int32_t n = 0; n < kMostAnswers; ++n)
    if ((input.stylus.X_TI.p - board_.answers_T[static_cast<std::size_t>(n)]).norm() <= rules_.answer_m) in_ball = n;
  if (in_ball >= 0 && in_ball != told_) answer_.reset();
  if (in_ball >= 0) told_ = in_ball;
  if (in_ball != last_ball_) last_ball_ = -1;
  if (!input.held(answer_, in_ball >= 0 && in_ball != last_ball_ && !holds_)) return;
  answer_.reset();
  last_ball_ = in_ball;
  last_right_ = complete() && told_ == board_.pins[static_cast<std::size_t>(index_)].symbol;
  log.add(last_right_ ? event_type::kAnswered : event_type::kWrongAnswer,
          last_right_ ? Severity::kInfo : Severity::kMajor, index_, log.t_s - lit_at_s_, "s");
  ++index_;
  light(log);
}

void FindTask::update(const TaskInput& input, EventLog& log) {
  if (finished() || !input.tissue) return;
  follow_grip(input, log);
  follow_lift(input, log);
  if (!complete() && exposed_ && !frozen(input.stylus)) {
    held_s_ += input.dt_s;
    if (complete()) log.add(event_type::kTargetHeld, Severity::kInfo, index_, log.t_s - lit_at_s_, "s");
  }
  follow_answer(input, log);
}

void FindTask::describe_message(const StylusState& stylus, DirectorStatus& status) const {
  const double pull_n = stylus.F_I_T.force.norm();
  const std::string pull = "Pull with " + band_text(band_) + ".";
  const bool shown = display_ != "after";
  if (complete() && holds_) return say(status, "Let it down and let go", "Slowly, until it lies as before.");
  if (complete()) return say(status, "Which symbol was it?", "Keep the tip in the ball that shows it.");
  if (!holds_) {
    if (judged_) return say(status, "Take it again", "It was lost: hold it tighter, and calmly.", true);
    const bool told = shown && index_ > 0 && status.run_time_s - lit_at_s_ < kAnswerToast;
    if (told && !last_right_) return say(status, "That was wrong", "Now the flap at the next disc.", true);
    return say(status, "Take the flap at the lit disc", "Open jaws on it, press a little, close.");
  }
  if (slipping_) return say(status, "It slips - hold it tighter", pull, true);
  if (shown && stylus.grip_force_n < rules_.grip_low_n)
    return say(status, "Hold it tighter", "Grip with " + band_text({rules_.grip_low_n, rules_.grip_high_n}) + ".",
               true);
  if (shown && pull_n > band_.high_n) return say(status, "A little softer", pull);
  if (!exposed_) return say(status, "Lift it further", pull);
  if (shown && pull_n < band_.low_n) return say(status, "A little more", pull);
  say(status, "Read the symbol and hold", pull);
}

void FindTask::describe_demand(const TaskInput& input, DirectorStatus& status) const {
  Demand& demand = status.demand;
  demand = {};
  demand.band = band_;
  demand.radius_m = place().radius_m;
  demand.goal_T = goal_T();
  demand.answers_T = board_.answers_T;
  demand.foam[0] = {0, rules_.grip_low_n, rules_.grip_high_n};
  demand.foam_count = 1;
  SurfacePlace seen{place().centre_T, place().normal_T};
  if (!holds_ && input.tissue && index_ < input.tissue->place_count)
    seen = input.tissue->place[static_cast<std::size_t>(index_)];
  demand.centre_T = seen.point_T + board_.thickness_m * seen.normal_T;
  demand.normal_T = seen.normal_T;
  if (firm_) demand.normal_T = from_hinge(demand.goal_T).normalized();  // the way of the pull
  if (!complete() || holds_) return;
  demand.band = {};
  demand.radius_m = rules_.answer_m;
  demand.normal_T = Vec3::UnitZ();
  demand.centre_T = Vec3::Zero();
  for (const Vec3& answer : board_.answers_T) demand.centre_T += answer / kMostAnswers;
}

void FindTask::describe(const TaskInput& input, DirectorStatus& status) const {
  status.targets_done = index_;
  for (std::int32_t i = 0; i < index_; ++i) status.done.set(static_cast<std::size_t>(i));
  status.target_index = object();
  status.wrong_places = lost_;
  status.exposure = exposure_;
  status.shown_symbol = -1;
  status.hold_progress = 0;
  if (finished()) return;
  if (exposed_) status.shown_symbol = board_.pins[static_cast<std::size_t>(index_)].symbol;
  status.hold_progress = complete() && !holds_ ? answer_.progress() : std::min(1.0, held_s_ / hold_s_);
  describe_demand(input, status);
  status.cue = complete() ? (holds_ ? Cue::kLower : Cue::kRead) : firm_ ? Cue::kLift : Cue::kTake;
  const double pull = input.stylus.F_I_T.force.norm();
  status.force_shown = force_shown(display_, holds_ && (pull < band_.low_n || pull > band_.high_n));
  describe_message(input.stylus, status);
}

}  // namespace trocar
