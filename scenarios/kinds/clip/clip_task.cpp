#include "scenarios/kinds/clip/clip_task.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tissue/thin/duct_system.h"

namespace trocar {
namespace {

constexpr double kWholeWidth = 0.999;
constexpr double kToldFor = 3;  // s for which a mistake is shown

/// What the screen says of one structure.
struct StructureWords {
  const char *touch, *clip, *cut;
};
constexpr std::array<StructureWords, kClipStructures> kWords{
    {{"Touch the cystic duct", "Clip the cystic duct", "Cut the cystic duct"},
     {"Touch the cystic artery", "Clip the cystic artery", "Cut the cystic artery"}}};
constexpr std::array<const char*, kClipsEach> kClipHints{{"First clip: where it comes from, clear of the large vessel.",
                                                          "Second clip: beside the first, with a gap.",
                                                          "Third clip: towards the gallbladder, with room to cut."}};

/// A closing that a person meant: not one that was given up, nor blades.
bool spends_clip(std::int32_t refusal) {
  return refusal > refusal_code(ClipRefusal::kMagazineEmpty) && refusal < refusal_code(ClipRefusal::kNotShut);
}

}  // namespace

ClipTask::ClipTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<ClipRules>(exercise)),
      instruments_(exercise.instruments),
      targets_(board.targets),
      display_(level.force_display),
      naming_(rules_.touch_s, kHoldGrace),
      astray_(rules_.touch_s, kHoldGrace) {
  for (std::size_t i = 0; i < kClipStructures; ++i)
    parent_radius_m_[i] = exercise.ducts[kClipStructures + i].outer_radius_m;
}

void ClipTask::begin(EventLog& log) {
  lit_at_s_ = log.t_s;
  log.add(event_type::kTargetLit, Severity::kInfo, asked_);
}

bool ClipTask::in_hand(const StylusState& stylus, InstrumentKind kind) const {
  return instruments_[static_cast<std::size_t>(stylus.instrument)] == kind;
}

/// Steps of a structure that is divided are past.
void ClipTask::ask_next(EventLog& log) {
  const int before = asked_;
  asked_ = 0;
  while (asked_ < kClipAims && ((done_ | spent_)[static_cast<std::size_t>(asked_)] ||
                                divided_[static_cast<std::size_t>(clip_aim(asked_).structure)]))
    ++asked_;
  if (asked_ == before) return;
  naming_.reset();
  astray_.reset();
  strayed_ = true;  // what was named last must be left first
  lit_at_s_ = log.t_s;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, asked_);
}

void ClipTask::finish_step(int aim, EventLog& log) {
  done_.set(static_cast<std::size_t>(aim));
  log.add(event_type::kTargetHeld, Severity::kInfo, aim, log.t_s - lit_at_s_, "s");
}

void ClipTask::blame(Told told, EventLog& log) {
  ++errors_;
  told_ = told;
  told_.at_s = log.t_s;
}

void ClipTask::follow_touch(const TaskInput& input, EventLog& log) {
  const ClipAim aim = clip_aim(asked_);
  const bool names = aim.step == ClipStep::kName && in_hand(input.stylus, InstrumentKind::kGrasper);
  const std::int32_t touched = names ? input.tissue->touched_duct : -1;
  touches_asked_ = touched == aim.structure;
  const bool stray = touched >= 0 && !touches_asked_;
  if (input.held(astray_, stray) && !strayed_) {
    strayed_ = true;
    log.add(event_type::kWrongStructure, Severity::kMinor, asked_, touched);
    blame({"That is another structure", "Look where it comes from and where it goes."}, log);
  }
  if (!stray) strayed_ = strayed_ && astray_.progress() > 0;
  if (!input.held(naming_, touches_asked_)) return;
  log.add(event_type::kNamed, Severity::kInfo, asked_, rules_.touch_s, "s");
  finish_step(asked_, log);
}

void ClipTask::follow_refusals(const SurgeryState& surgery, EventLog& log) {
  if (refusals_ >= 0 && surgery.refusals > refusals_ && spends_clip(surgery.refusal)) {
    log.add(event_type::kClipWasted, Severity::kMinor, -1, surgery.refusal);
    blame({"That clip would not have held", "Draw back, look, and set it anew."}, log);
  }
  refusals_ = surgery.refusals;
}

/// Why a clip does not count; an empty message: it does.
ClipTask::Told ClipTask::fault_of(const DuctMark& clip) const {
  if (!done_[0] || !done_[1]) return {"Clipped before both were named", "First touch duct and artery as asked."};
  if (clip.share < kWholeWidth || clip.tip_beyond_m < 0)
    return {"The clip does not shut all of it", "Its tips must show beyond the structure."};
  if (clip.angle_rad > rules_.angle_rad) return {"The clip lies askew", "Set it straight across."};
  const auto duct = static_cast<std::size_t>(clip.duct);
  for (const Known& other : known_) {
    const bool beside = other.mark.kind == DuctMark::Kind::kClip && other.mark.duct == clip.duct;
    if (beside && std::abs(other.mark.arc_m - clip.arc_m) - rules_.clip_width_m < rules_.clip_gap_m)
      return {"Too near to the other clip", "Leave a gap between them."};
  }
  if (clip.arc_m - parent_radius_m_[duct] - rules_.clip_width_m / 2 < rules_.spared_m)
    return {"Too near to what must be spared", "Keep the clip further from the large vessel."};
  if (nearest_free(clip, done_) < 0) return {"More clips than are needed", "Two where it comes from, one beyond."};
  return {};
}

int ClipTask::nearest_free(const DuctMark& clip, const std::bitset<kClipAims>& taken) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kClipsEach; ++i) {
    const int aim = kFirstClipAim + clip.duct * kClipsEach + i;
    const double off = std::abs(clip.arc_m - rules_.clip_at_m[static_cast<std::size_t>(i)]);
    if (taken[static_cast<std::size_t>(aim)] || off >= least) continue;
    least = off;
    best = aim;
  }
  return best;
}

void ClipTask::judge_clip(const DuctMark& clip, EventLog& log) {
  known_.push_back({clip});
  if (clip.duct >= kClipStructures) {
    log.add(event_type::kWrongStructure, Severity::kCritical, -1, clip.arc_m, "m");
    return blame({"That must be spared", "It is neither the cystic duct nor the cystic artery."}, log);
  }
  known_.pop_back();
  const Told fault = fault_of(clip);
  const int aim = *fault.message == 0 ? nearest_free(clip, done_) : -1;
  known_.push_back({clip, aim});
  if (aim < 0) {
    if (const int spent = nearest_free(clip, done_ | spent_); spent >= 0) spent_.set(static_cast<std::size_t>(spent));
    log.add(event_type::kClipWasted, Severity::kMinor, -1, clip.arc_m, "m");
    return blame(fault, log);
  }
  log.add(event_type::kClipSet, Severity::kInfo, aim, clip.angle_rad * 180 / std::numbers::pi, "deg");
  finish_step(aim, log);
}

/// A cut, a nick or a tear, against the clips that are on.
void ClipTask::judge_opening(const DuctMark& opening, std::span<const DuctMark> marks, EventLog& log) {
  known_.push_back({opening});
  if (opening.duct >= kClipStructures) {
    log.add(event_type::kWrongStructure, Severity::kCritical, -1, opening.arc_m, "m");
    return blame({"That must be spared", "It is neither the cystic duct nor the cystic artery."}, log);
  }
  bool& divided = divided_[static_cast<std::size_t>(opening.duct)];
  if (divided) return;
  int before = 0, beyond = 0;
  double last = -1, first = -1;
  for (const DuctMark& clip : marks) {
    if (clip.kind != DuctMark::Kind::kClip || clip.duct != opening.duct || clip.share < kWholeWidth) continue;
    if (clip.arc_m < opening.arc_m) ++before, last = std::max(last, clip.arc_m);
    if (clip.arc_m > opening.arc_m) ++beyond, first = first < 0 ? clip.arc_m : std::min(first, clip.arc_m);
  }
  const int aim = kFirstCutAim + opening.duct;
  const bool too_soon = before < kClipsBefore || beyond < kClipsEach - kClipsBefore;
  if (too_soon || opening.kind == DuctMark::Kind::kTorn) {
    log.add(event_type::kCutTooSoon, Severity::kCritical, aim, before + beyond / 10.0);
    blame({"Opened without enough clips", "Two before the cut and one beyond it."}, log);
  }
  if (opening.kind == DuctMark::Kind::kNick) return;
  divided = true;
  const double middle = before > 0 && beyond > 0 ? (last + first) / 2 : rules_.cut_at_m;
  const double gap = std::min(before > 0 ? opening.arc_m - last : 1.0, beyond > 0 ? first - opening.arc_m : 1.0);
  const bool close = gap - rules_.clip_width_m / 2 < rules_.cut_gap_m;
  log.add(event_type::kDivided, close ? Severity::kMinor : Severity::kInfo, aim, std::abs(opening.arc_m - middle), "m");
  if (close && !too_soon) blame({"Cut too near to a clip", "It may slip off the stump."}, log);
  finish_step(aim, log);
}

void ClipTask::follow_losses(std::span<const DuctMark> marks, EventLog& log) {
  for (auto known = known_.begin(); known != known_.end();) {
    const bool is_clip = known->mark.kind == DuctMark::Kind::kClip;
    if (!is_clip || std::find(marks.begin(), marks.end(), known->mark) != marks.end()) {
      ++known;
      continue;
    }
    if (known->mark.duct < kClipStructures) {
      log.add(event_type::kClipWasted, Severity::kMinor, known->aim, known->mark.arc_m, "m");
      blame({"A clip came off", "Pull less on what is clipped."}, log);
    }
    if (known->aim >= 0) done_.reset(static_cast<std::size_t>(known->aim));
    known = known_.erase(known);
  }
}

void ClipTask::follow_marks(std::span<const DuctMark> marks, EventLog& log) {
  follow_losses(marks, log);
  for (const DuctMark& mark : marks) {
    const bool judged =
        std::any_of(known_.begin(), known_.end(), [&](const Known& known) { return known.mark == mark; });
    if (judged) continue;
    if (mark.kind == DuctMark::Kind::kClip)
      judge_clip(mark, log);
    else
      judge_opening(mark, marks, log);
  }
}

void ClipTask::keep_watch(const TaskInput& input, EventLog& log) {
  if (!input.tissue) return;
  const TissueFrame& frame = *input.tissue;
  follow_losses(std::span(frame.duct_mark).first(static_cast<std::size_t>(frame.duct_mark_count)), log);
}

void ClipTask::update(const TaskInput& input, EventLog& log) {
  now_s_ = log.t_s;
  if (finished() || !input.tissue) return;
  const TissueFrame& frame = *input.tissue;
  follow_touch(input, log);
  follow_refusals(frame.surgery, log);
  follow_marks(std::span(frame.duct_mark).first(static_cast<std::size_t>(frame.duct_mark_count)), log);
  if (!bled_ && frame.surgery.blood_ml > rules_.blood_ml) {
    bled_ = true;
    log.add(event_type::kBleeding, Severity::kCritical, -1, frame.surgery.blood_ml, "mL");
  }
  ask_next(log);
}

void ClipTask::describe_message(const StylusState& stylus, double now_s, DirectorStatus& status) const {
  if (told_.at_s >= 0 && now_s - told_.at_s < kToldFor) return say(status, told_.message, told_.hint, true);
  const ClipAim aim = clip_aim(asked_);
  const StructureWords& words = kWords[static_cast<std::size_t>(aim.structure)];
  if (!in_hand(stylus, *status.demand.instrument)) return say_take(status, *status.demand.instrument);
  switch (aim.step) {
    case ClipStep::kName:
      if (touches_asked_) return say(status, "Good - hold", "Stay on it.");
      return say(status, words.touch, "Lay the jaws round it, gently, until it is named.");
    case ClipStep::kClip:
      return say(status, words.clip, kClipHints[static_cast<std::size_t>(aim.clip)]);
    case ClipStep::kCut:
      return say(status, words.cut, "In the middle between the second and the third clip.");
  }
}

void ClipTask::describe(const TaskInput& input, DirectorStatus& status) const {
  for (std::size_t i = 0; i < done_.size(); ++i) status.done.set(i, done_[i]);
  status.targets_done = static_cast<int>(done_.count());
  status.target_index = object();
  status.wrong_places = errors_;
  status.hold_progress = finished() ? 0 : std::min(1.0, naming_.progress());
  if (finished()) return;
  const ClipAim aim = clip_aim(asked_);
  const Target& target = targets_[static_cast<std::size_t>(asked_)];
  status.demand = {target.centre_T, target.normal_T,  target.radius_m,
                   false,  // no dials: how the jaws lie is to be seen
                   target.R_TI,     rules_.angle_rad, {rules_.pull_low_n, rules_.pull_high_n}};
  status.demand.goal_T = target.centre_T - rules_.tips_beyond_m * target.normal_T;
  constexpr InstrumentKind kInstrument[] = {InstrumentKind::kGrasper, InstrumentKind::kClipApplier,
                                            InstrumentKind::kScissors};
  status.demand.instrument = kInstrument[static_cast<int>(aim.step)];
  constexpr Cue kCue[] = {Cue::kReach, Cue::kClip, Cue::kSever};
  status.cue = touches_asked_ && aim.step == ClipStep::kName ? Cue::kPress : kCue[static_cast<int>(aim.step)];
  status.force_shown = force_shown(display_, input.stylus.F_I_T.force.norm() > rules_.pull_high_n);
  describe_message(input.stylus, now_s_, status);
}

}  // namespace trocar
