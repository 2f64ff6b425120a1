#include "scenarios/hands/hand_senses.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kUsedTime = 0.25;  // s in which the fingers get used to a force that stays
constexpr double kLearnTime = 0.5;  // s of looking at the bar in which they learn what it makes of it

HandJob task_of(const Percept& percept) {
  switch (percept.cue) {
    case Cue::kWait:
      return {HandJob::Kind::kStart, -1};
    case Cue::kReach:
    case Cue::kPress:
    case Cue::kRelease:
      return {percept.asked_instrument ? HandJob::Kind::kClips : HandJob::Kind::kDisc, percept.target_index};
    case Cue::kGrip:
      return {HandJob::Kind::kGrip, -1};
    case Cue::kFinished:
      return {HandJob::Kind::kFinished, -1};
    case Cue::kOrient:
      return {HandJob::Kind::kPen, percept.target_index};
    case Cue::kPick:
    case Cue::kCarry:
    case Cue::kPlace:
      return {HandJob::Kind::kBlock, percept.target_index};
    case Cue::kSearch:
      return {HandJob::Kind::kSearch, -1};
    case Cue::kTake:
    case Cue::kLift:
    case Cue::kLower:
      return {percept.answers_T.front() == percept.answers_T.back() ? HandJob::Kind::kLift : HandJob::Kind::kAnswer,
              percept.target_index};  // lifted to be looked beneath: what is read is then told
    case Cue::kRead:
      return {HandJob::Kind::kAnswer, percept.target_index};
    case Cue::kClip:
    case Cue::kSever:
      return {HandJob::Kind::kClips, percept.target_index};
    case Cue::kSnip:
      return {HandJob::Kind::kSnips, -1};
    case Cue::kTakeNeedle:
    case Cue::kDrive:
    case Cue::kPull:
      return {HandJob::Kind::kSewing, percept.target_index};
    case Cue::kHook:
    case Cue::kSeal:
      return {HandJob::Kind::kHooking, percept.target_index};
    case Cue::kExchange:
      return {HandJob::Kind::kExchange, percept.target_index};
    case Cue::kNone:
      break;
  }
  return {};
}

}  // namespace

double LateSignal::update(double value, double dt_s) {
  const int slots = std::clamp(static_cast<int>(std::lround(delay_s_ / std::max(dt_s, 1e-6))), 0, kSlots - 1);
  ring_[static_cast<std::size_t>(head_)] = value;
  const double late = ring_[static_cast<std::size_t>((head_ + kSlots - slots) % kSlots)];
  head_ = (head_ + 1) % kSlots;
  value_ += (late - value_) * std::min(1.0, dt_s / smooth_s_);
  return value_;
}

void HandSenses::update(const Percept& percept, double pause_s, double dt_s) {
  const bool pulls = percept.cue == Cue::kLift || percept.cue == Cue::kLower;  // then what is held pulls the other way
  if (pulls != pulls_) free_n_ = -free_n_;
  pulls_ = pulls;
  const double felt = (pulls ? -1 : 1) * percept.felt_force_T.dot(percept.target_normal_T);
  const double touch = touch_.update(felt, dt_s);
  if (gets_used_) free_n_ += (touch - free_n_) * std::min(1.0, dt_s / kUsedTime);
  const bool bar = percept.foam_count > 0 && std::isfinite(percept.shown_grip_n);
  grip_.update(bar ? percept.shown_grip_n : percept.felt_grip_n, dt_s);
  const bool shown = std::isfinite(percept.shown_force_n);
  knows_bar_ = knows_bar_ || shown;
  if (shown) missing_n_ += (percept.shown_force_n - (felt - free_n_) - missing_n_) * std::min(1.0, dt_s / kLearnTime);
  force_.update(shown ? percept.shown_force_n : std::max(0.0, felt - free_n_ + missing_n_), dt_s);
  const HandJob now = task_of(percept);
  noticed_for_s_ = now == seen_ ? noticed_for_s_ + dt_s : 0;
  seen_ = now;
  if (noticed_for_s_ >= reaction_s_ + pause_s) task_ = seen_;
}

}  // namespace trocar
