#include "scenarios/hands/cheating_hand.h"

namespace trocar {
namespace {

constexpr double kThereFor = 0.3;  // s at the place, after which the clutch is held
constexpr double kThere = 2;       // of the place's radius

}  // namespace

bool CheatingHand::tempted(const Percept& percept, double dt_s) {
  const bool next = percept.target_index != target_;
  const bool first_done = next && target_ >= 0;
  target_ = percept.target_index;
  if (target_ < 0 || target_ == tricked_) return false;
  if (cheat_.trick == Cheat::Trick::kDwell) {
    const bool carries = percept.cue == Cue::kCarry || percept.cue == Cue::kLift;
    return tricked_ < 0 && (carries || first_done);
  }
  const bool there = !next && (percept.tip_T - percept.target_T).norm() < kThere * percept.target_radius_m;
  there_s_ = there ? there_s_ + dt_s : 0;
  return there_s_ > kThereFor;
}

HandIntent CheatingHand::update(const Percept& percept, double dt_s) {
  if (left_s_ <= 0 && tempted(percept, dt_s)) {
    tricked_ = target_;
    there_s_ = 0;
    left_s_ = cheat_.for_s;
  }
  if (left_s_ > 0) {  // as still as it was
    left_s_ -= dt_s;
    intent_.clutch = cheat_.trick == Cheat::Trick::kClutch;
    return intent_;
  }
  intent_ = who_->update(percept, dt_s);
  return intent_;
}

}  // namespace trocar
