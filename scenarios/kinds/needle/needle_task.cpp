#include "scenarios/kinds/needle/needle_task.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/kinds/needle/needle_layout.h"

namespace trocar {
namespace {

constexpr double kToldNeedleFor = 3;     // s for which a mistake is shown
constexpr double kSlides = 0.3;          // s in which a point that opens the surface and is out again has slid
constexpr double kPointWayStep = 0.001;  // m of the point's way that is judged at once: less is tremor
constexpr double kInDegrees = 180 / std::numbers::pi;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

}  // namespace

NeedleTask::NeedleTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<NeedleRules>(exercise)),
      own_(own_rules<NeedleBoard>(board)),
      targets_(board.targets),
      port_T_(level.port_m),
      centre_T_(board.centre_T),
      display_(level.force_display),
      soft_n_(exercise.soft_force_n),
      tolerance_m_(own_rules<NeedleLevel>(level).tolerance_m),
      pairs_(static_cast<int>(board.targets.size()) / 2) {}

void NeedleTask::begin(EventLog& log) { light(log); }

void NeedleTask::light(EventLog& log) {
  lit_at_s_ = log.t_s;
  grips_ = point_grips_ = 0;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, pair_);
}

void NeedleTask::blame(Told told, EventLog& log) {
  ++errors_;
  told_ = told;
  told_.at_s = log.t_s;
}

void NeedleTask::follow_grip(const TissueFrame& frame, EventLog& log) {
  const bool held = frame.suture.held, taken = held && !held_;
  held_ = held;
  if (!taken || drawn_) return;
  const double share = 1 - frame.needle.held_share;
  const bool at_point = in_ && bite_.through;
  const bool again = (at_point ? point_grips_ : grips_) > 0;
  const bool beside = !at_point && (share < rules_.grip_low_share || share > rules_.grip_high_share);
  ++(at_point ? point_grips_ : grips_);
  log.add(event_type::kNeedleGripped, again || beside ? Severity::kMinor : Severity::kInfo, pair_, share);
  if (beside) blame({"Grasped at the wrong place", "Half to two thirds of its length from the point."}, log);
}

/// Of the point's way through the tissue, how far it leads off its own direction.
void NeedleTask::follow_point(const NeedleSight& needle) {
  const Vec3 point = needle.X_TN * own_.shape.place(own_.shape.length_m), way = point - point_T_;
  if (way.norm() < kPointWayStep) return;
  const Vec3 along = needle.X_TN.R * own_.shape.tangent(own_.shape.length_m);
  way_deg_m_ += way.norm() * kInDegrees * angle_between(way, along + point_along_T_);
  way_m_ += way.norm();
  point_T_ = point;
  point_along_T_ = along;
}

void NeedleTask::follow_bite(const TissueFrame& frame, EventLog& log) {
  const NeedleSight& needle = frame.needle;
  const auto of_pair = [&](int half) { return static_cast<std::size_t>(half * pairs_ + pair_); };
  const bool in = needle.bite_count > 0;
  const bool left = in_ && (!in || needle.bite[0].number != bite_.number);
  if (left && in && (threaded_ || frame.suture.stitches > stitches_)) {
    threaded_ = true;  // another needle comes only once this one is out of all
    bite_.number = needle.bite[0].number;
  } else if (left) {
    end_bite(frame, log);
  }
  if (finished()) return;
  if (in && !in_ && !drawn_) {
    bite_ = needle.bite[0];
    bite_.through = false;
    in_ = true;
    const Target& entry = targets_[of_pair(0)];
    const Target& exit = targets_[of_pair(1)];
    const Vec3 shaft = entry.R_TI.col(2);
    const BiteCircle circle =
        bite_circle(own_.shape, entry.centre_T, exit.centre_T, entry.normal_T + exit.normal_T, shaft);
    const Pose wanted = needle_across(own_.shape, circle.middle_T, circle.up_T, shaft, circle.entry_rad);
    entry_deg_ = kInDegrees * angle_between(bite_.entry_along_T, wanted.R * own_.shape.tangent(own_.shape.length_m));
    way_deg_m_ = way_m_ = 0;
    point_T_ = needle.X_TN * own_.shape.place(own_.shape.length_m);
    point_along_T_ = needle.X_TN.R * own_.shape.tangent(own_.shape.length_m);
    in_since_s_ = log.t_s;
    told_in_ = false;
  }
  if (!in_ || !in) return;
  if (!told_in_ && (needle.bite[0].through || log.t_s - in_since_s_ >= kSlides)) tell_bite(log);
  const bool came_out = needle.bite[0].through && !bite_.through;
  if (!needle.bite[0].through && held_) follow_point(needle);
  bite_ = needle.bite[0];
  if (!came_out) return;
  const double off = (bite_.end_rest_T - targets_[of_pair(1)].centre_T).norm();
  log.add(event_type::kBiteThrough, off > tolerance_m_ ? Severity::kMinor : Severity::kInfo, pair_, off, "m");
  if (off > tolerance_m_) blame({"Out beside the dot", "Follow the needle's own circle."}, log);
}

void NeedleTask::tell_bite(EventLog& log) {
  told_in_ = true;
  const double off = (bite_.entry_rest_T - targets_[static_cast<std::size_t>(pair_)].centre_T).norm();
  log.add(event_type::kBiteBegun, off > tolerance_m_ ? Severity::kMinor : Severity::kInfo, pair_, off, "m");
  if (off > tolerance_m_) blame({"Beside the dot", "Draw it back out, or take more care at the next one."}, log);
}

void NeedleTask::end_bite(const TissueFrame& frame, EventLog& log) {
  const bool stitched = threaded_ || frame.suture.stitches > stitches_;
  in_ = threaded_ = false;
  if (frame.suture.tears > tears_) {
    log.add(event_type::kTear, Severity::kCritical, pair_, bite_.load_n, "N");
    return blame({"The tissue is torn", "Turn the needle about its circle, never across it."}, log);
  }
  if (!stitched) {
    if (!told_in_) return;
    log.add(event_type::kBiteUndone, Severity::kMinor, pair_);
    grips_ = std::min(grips_, 1);
    return blame({"Drawn back out", "Go in anew at the dot."}, log);
  }
  log.add(event_type::kNeedleDrawn, Severity::kInfo, pair_, entry_deg_ + (way_m_ > 0 ? way_deg_m_ / way_m_ : 0), "deg");
  log.add(event_type::kTargetHeld, Severity::kInfo, pair_, log.t_s - lit_at_s_, "s");
  drawn_ = true;
  ++pair_;
  light(log);
}

/// Another needle stands ready: the last one was drawn through, or lost.
void NeedleTask::follow_needles(const TissueFrame& frame, EventLog& log) {
  const bool another = frame.suture.needles > needles_ && needles_ > 0;
  needles_ = frame.suture.needles;
  if (another && !drawn_) {
    const double off = (needle_T_ - centre_T_).norm();
    const bool lost = off > rules_.field_m;
    log.add(event_type::kNeedleLost, lost ? Severity::kCritical : Severity::kMinor, pair_, off, "m");
    grips_ = 0;
    blame({"The needle was dropped", "Another one stands ready."}, log);
  }
  if (another) drawn_ = false;
  needle_T_ = frame.needle.X_TN.p;
}

void NeedleTask::update(const TaskInput& input, EventLog& log) {
  now_s_ = log.t_s;
  if (finished() || !input.tissue || !input.tissue->needle.there) return;
  const TissueFrame& frame = *input.tissue;
  follow_needles(frame, log);
  follow_bite(frame, log);
  if (!finished()) follow_grip(frame, log);
  tears_ = frame.suture.tears;
  stitches_ = frame.suture.stitches;
}

SurfacePlace NeedleTask::dot(const TaskInput& input, int target) const {
  const Target& rest = targets_[static_cast<std::size_t>(target)];
  if (input.tissue && target < input.tissue->place_count) return input.tissue->place[static_cast<std::size_t>(target)];
  return {rest.centre_T, rest.normal_T};
}

/// Of the point, beyond where it has come out: the hole goes along with the dot beside it.
double NeedleTask::out_m(const TaskInput& input) const {
  const int exit = pairs_ + pair_;
  const Vec3 hole = dot(input, exit).point_T + bite_.end_rest_T - targets_[static_cast<std::size_t>(exit)].centre_T;
  return own_.shape.length_m - beside_needle(own_.shape, input.tissue->needle.X_TN.inverse() * hole).arc_m;
}

/// Less of it stands before the jaws than the way from dot to dot: it can never come out there.
bool NeedleTask::held_too_near_the_point(const TaskInput& input) const {
  const double before_jaws = (1 - input.tissue->needle.held_share) * own_.shape.length_m;
  const auto pair = static_cast<std::size_t>(pair_), exit = static_cast<std::size_t>(pairs_ + pair_);
  return before_jaws < (targets_[exit].centre_T - targets_[pair].centre_T).norm();
}

NeedleTask::Step NeedleTask::step_of(const TaskInput& input) const {
  if (drawn_ || !input.tissue || !input.tissue->needle.there) return Step::kTake;
  if (threaded_) return held_ ? Step::kDraw : Step::kTakePoint;
  if (!in_ && held_ && held_too_near_the_point(input)) return Step::kTake;
  if (!in_ || !bite_.through) return held_ ? Step::kDrive : Step::kTake;
  const double out = out_m(input);
  if (held_ && (1 - input.tissue->needle.held_share) * own_.shape.length_m < out) return Step::kDraw;
  return held_ && out < rules_.tip_out_m ? Step::kDrive : Step::kTakePoint;
}

void NeedleTask::say_step(Step step, DirectorStatus& status) const {
  switch (step) {
    case Step::kTake:
      if (drawn_ && held_) return say(status, "Let go of the needle", "Another one stands ready.");
      return say(status, held_ ? "Let go of the needle" : "Take the needle",
                 "Half to two thirds of its length from the point.");
    case Step::kDrive:
      if (!in_) return say(status, "Go in at the lit dot", "Lower the point onto it, then roll.");
      return say(status, "Roll it on to the other dot", "Follow the needle's own circle.");
    case Step::kTakePoint:
      if (held_) return say(status, "Let go, take the point", "Enough of it stands out.");
      return say(status, "Take the needle near its point", "Then draw it out.");
    case Step::kDraw:
      return say(status, "Draw it through", "Roll on until it is out, then lift.");
  }
}

void NeedleTask::describe(const TaskInput& input, DirectorStatus& status) const {
  for (int pair = 0; pair < pair_; ++pair) status.done.set(static_cast<std::size_t>(pair));
  status.targets_done = pair_;
  status.target_index = object();
  status.wrong_places = errors_;
  if (finished()) return;
  const Step step = step_of(input);
  const SurfacePlace entry = dot(input, pair_), exit = dot(input, pairs_ + pair_);
  const Target& target = targets_[static_cast<std::size_t>(pair_)];
  const bool seen = input.tissue && input.tissue->needle.there && !drawn_;
  const Pose X_TN = seen ? input.tissue->needle.X_TN : own_.X_TN_stand;
  status.demand = {.centre_T = entry.point_T,
                   .normal_T = (entry.normal_T + exit.normal_T).normalized(),
                   .radius_m = target.radius_m,
                   .R_TI = target.R_TI,
                   .band = {}};
  status.demand.object = {X_TN, Vec3(2, 1, 0) * own_.shape.radius_m()};
  status.demand.goal_T = exit.point_T;
  constexpr Cue kCues[] = {Cue::kTakeNeedle, Cue::kDrive, Cue::kTakeNeedle, Cue::kPull};
  status.cue = kCues[static_cast<int>(step)];
  if (status.cue == Cue::kTakeNeedle) {
    const double from_point = step == Step::kTakePoint ? rules_.tip_grip_m / own_.shape.length_m
                                                       : (rules_.grip_low_share + rules_.grip_high_share) / 2;
    const Pose grip = grasping(own_.shape, X_TN, 1 - from_point, target.R_TI, port_T_);
    status.demand.goal_T = grip.p;
    status.demand.R_TI = grip.R;
  }
  status.demand.band = {0, soft_n_};
  status.force_shown = force_shown(display_, input.stylus.F_I_T.force.norm() > soft_n_);
  if (told_.at_s >= 0 && now_s_ - told_.at_s < kToldNeedleFor) return say(status, told_.message, told_.hint, true);
  say_step(step, status);
}

}  // namespace trocar
