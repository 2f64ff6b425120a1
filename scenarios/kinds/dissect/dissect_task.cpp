#include "scenarios/kinds/dissect/dissect_task.h"

#include <algorithm>
#include <cmath>

#include "haptics/contact/tool_shape.h"

namespace trocar {
namespace {

constexpr double kFarthest_m = 0.1;    // of the tip off the organ, infinite where none is near: an event holds a number
constexpr double kDissectToldFor = 3;  // s for which a mistake is shown
constexpr double kTellEvery = 1;       // s of current from one event to the next
constexpr double kAimOver = 0.0035;    // m over the least lift, to where a strand is asked to be lifted

}  // namespace

DissectTask::DissectTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<DissectRules>(exercise)),
      targets_(board.targets),
      centre_T_(board.centre_T),
      display_(level.force_display) {}

void DissectTask::begin(EventLog& log) {
  lit_at_s_ = log.t_s;
  log.add(event_type::kTargetLit, Severity::kInfo, asked_);
}

/// As the organ has it now. A vessel is asked for where it bleeds: the organ opens it at the nearest of its vertices,
/// which may lie as far from the board's place as current seals.
SurfacePlace DissectTask::place(const TissueFrame& frame, int target) const {
  const auto i = static_cast<std::size_t>(target);
  if (!is_strand(target) && target - rules_.strands < frame.wound_count) {
    const Vec3& normal = target < frame.place_count ? frame.place[i].normal_T : targets_[i].normal_T;
    return {frame.wound[i - static_cast<std::size_t>(rules_.strands)].place_T, normal};
  }
  if (target < frame.place_count) return frame.place[i];
  return {targets_[i].centre_T, targets_[i].normal_T};
}

void DissectTask::blame(Told told, EventLog& log) {
  ++errors_;
  told_ = told;
  told_.at_s = log.t_s;
}

void DissectTask::finish(int target, EventLog& log) {
  done_.set(static_cast<std::size_t>(target));
  log.add(event_type::kTargetHeld, Severity::kInfo, target, log.t_s - lit_at_s_, "s");
}

void DissectTask::ask_next(EventLog& log) {
  int next = 0;
  while (next < aims() && done_[static_cast<std::size_t>(next)]) ++next;
  if (next == asked_) return;
  tell_current(log);
  asked_ = next;
  lit_at_s_ = log.t_s;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, asked_);
}

void DissectTask::tell_current(EventLog& log) {
  if (untold_.safe_s > 0) log.add(event_type::kCurrentUsed, Severity::kInfo, asked_, untold_.safe_s, "s");
  if (untold_.unsafe_s > 0) log.add(event_type::kUnsafeCurrent, Severity::kMinor, asked_, untold_.unsafe_s, "s");
  untold_ = {};
}

void DissectTask::follow_current(const TaskInput& input, EventLog& log) {
  const TissueFrame& frame = *input.tissue;
  const auto lit = static_cast<std::size_t>(asked_);
  const Vec3& tip = input.stylus.X_TI.p;
  const bool at_strand = is_strand(asked_) && hooked_;
  const bool at_vessel = !is_strand(asked_) && (tip - place(frame, asked_).point_T).norm() < rules_.beside_m;
  beside_ = at_vessel;
  const bool in_view = (tip - centre_T_).norm() < rules_.field_m;
  bool unsafe = false;
  if (!input.stylus.pedal) {
    if (untold_.safe_s + untold_.unsafe_s > 0) tell_current(log);
  } else if (gap_m_ < rules_.near_m && !at_vessel) {
    near_s_[lit] += input.dt_s;
    unsafe = near_s_[lit] > rules_.forgiven_s;
  } else if (!in_view) {
    unsafe = true;
  } else if ((at_strand || (at_vessel && frame.surgery.contact_c > 0)) && safe_s_[lit] < rules_.counted_s) {
    safe_s_[lit] += input.dt_s;
    untold_.safe_s += input.dt_s;
  }
  if (unsafe) untold_.unsafe_s += input.dt_s;
  if (unsafe && !unsafe_)
    blame(in_view ? Told{"Current too near to the liver", "Lift before you press the pedal."}
                  : Told{"Current out of view", "Press the pedal only where you see the hook."},
          log);
  unsafe_ = unsafe || (unsafe_ && input.stylus.pedal);
  if (untold_.safe_s + untold_.unsafe_s > kTellEvery) tell_current(log);
}

void DissectTask::follow_strands(const TissueFrame& frame, bool live, EventLog& log) {
  const std::int32_t touched = frame.touched_duct;
  hooked_ = touched == asked_;
  if (touched >= 0 && touched < rules_.strands && gap_m_ >= rules_.lift_m &&
      !lifted_[static_cast<std::size_t>(touched)]) {
    lifted_.set(static_cast<std::size_t>(touched));
    log.add(event_type::kStrandLifted, Severity::kInfo, touched, gap_m_, "m");
  }
  for (const DuctMark& mark : std::span(frame.duct_mark).first(static_cast<std::size_t>(frame.duct_mark_count))) {
    const bool parts = mark.kind == DuctMark::Kind::kCut || mark.kind == DuctMark::Kind::kTorn;
    if (!parts || mark.duct >= rules_.strands || done_[static_cast<std::size_t>(mark.duct)]) continue;
    const bool torn = mark.kind == DuctMark::Kind::kTorn || !live;
    const bool good = !torn && gap_m_ >= rules_.lift_m;
    const Severity severity = torn ? Severity::kMajor : good ? Severity::kInfo : Severity::kMinor;
    log.add(event_type::kStrandDivided, severity, mark.duct, gap_m_, "m");
    if (torn)
      blame({"A strand tore", "Lift gently, and let the current divide it."}, log);
    else if (!good)
      blame({"Divided too low", "Lift the strand clear of the liver first."}, log);
    finish(mark.duct, log);
  }
}

void DissectTask::follow_vessels(const TissueFrame& frame, EventLog& log) {
  if (frame.wound_count > 0 && !spurting_) {
    spurting_ = true;
    log.add(event_type::kSpurts, Severity::kInfo, -1, frame.surgery.blood_ml, "mL");
  }
  for (int vessel = 0; spurting_ && vessel < std::min(aims() - rules_.strands, frame.wound_count); ++vessel) {
    const int target = rules_.strands + vessel;
    const auto i = static_cast<std::size_t>(target);
    if (done_[i]) continue;
    if (frame.wound[static_cast<std::size_t>(vessel)].open_vessels == 0) {
      log.add(event_type::kSealed, Severity::kInfo, target, frame.surgery.blood_ml, "mL");
      finish(target, log);
    } else if (target == asked_ && log.t_s - lit_at_s_ > rules_.seal_s && !late_[i]) {
      late_.set(i);
      log.add(event_type::kSealedLate, Severity::kMinor, target, rules_.seal_s, "s");
      blame({"It bleeds for too long", "Press the tip on it and keep the pedal down."}, log);
    }
  }
}

void DissectTask::update(const TaskInput& input, EventLog& log) {
  now_s_ = log.t_s;
  if (finished() || !input.tissue) return;
  const TissueFrame& frame = *input.tissue;
  gap_m_ = std::min(frame.tip_gap_m, kFarthest_m);
  if (cut_m2_ < 0) cut_m2_ = frame.surgery.cut_m2;
  follow_strands(frame, input.stylus.pedal, log);
  follow_current(input, log);
  follow_vessels(frame, log);
  if (!perforated_ && frame.surgery.cut_m2 - cut_m2_ > rules_.perforated_m2) {
    perforated_ = true;
    log.add(event_type::kPerforated, Severity::kCritical, asked_, frame.surgery.cut_m2 - cut_m2_, "m2");
    blame({"The hook has cut into the liver", "Never draw the live hook over it."}, log);
  }
  ask_next(log);
}

void DissectTask::describe_message(const TissueFrame& frame, DirectorStatus& status) const {
  if (told_.at_s >= 0 && now_s_ - told_.at_s < kDissectToldFor) return say(status, told_.message, told_.hint, true);
  if (!is_strand(asked_)) {
    if (beside_ && frame.surgery.contact_c > 0)
      return say(status, "Good - hold", "Keep the pedal down until it is dry.");
    return say(status, "Stop the bleeding", "Set the tip on the spurting vessel and press the pedal.");
  }
  if (!hooked_) return say(status, "Hook the lit strand", "Slide the foot of the hook under it from the side.");
  if (gap_m_ < rules_.lift_m) return say(status, "Lift the strand", "Clear of the liver before any current.");
  say(status, "Divide the strand", "Press the pedal until it parts, then let go.");
}

void DissectTask::describe(const TaskInput& input, DirectorStatus& status) const {
  for (std::size_t i = 0; i < done_.size(); ++i) status.done.set(i, done_[i]);
  status.targets_done = static_cast<int>(done_.count());
  status.target_index = object();
  status.wrong_places = errors_;
  if (finished() || !input.tissue) return;
  const SurfacePlace at = place(*input.tissue, asked_);
  const Target& target = targets_[static_cast<std::size_t>(asked_)];
  const double bow = is_strand(asked_) ? rules_.bow_m : 0;
  status.cue = is_strand(asked_) ? Cue::kHook : Cue::kSeal;
  status.demand.centre_T = at.point_T + bow * at.normal_T;
  status.demand.normal_T = at.normal_T;
  status.demand.radius_m = target.radius_m;
  status.demand.goal_T = at.point_T + (rules_.lift_m + kAimOver + ToolShape{}.radius_m) * at.normal_T;
  status.exposure = hooked_ ? std::clamp(gap_m_ / rules_.lift_m, 0.0, 1.0) : 0;
  status.force_shown = force_shown(display_, false);
  describe_message(*input.tissue, status);
}

}  // namespace trocar
