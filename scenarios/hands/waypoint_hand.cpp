#include "scenarios/hands/waypoint_hand.h"

#include <algorithm>

#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kPress_s = 0.100, kBetweenPresses_s = 0.350;  // s: an exchange takes 0.23 s

}  // namespace

Vec3 WaypointHand::goal(const ScriptedMove& move) const {
  return move.relative_to_ready ? Vec3(ready_T_ + move.to_m) : move.to_m;
}

bool WaypointHand::takes_instrument(const ScriptedMove& move, const Percept& percept, double dt_s) {
  since_press_s_ += dt_s;
  intent_.exchange = intent_.exchange && since_press_s_ < kPress_s;
  if (presses_ > 0 && since_press_s_ < kBetweenPresses_s) return false;
  const bool there = !move.instrument || percept.instrument == *move.instrument;
  if (there || presses_ == static_cast<int>(kMostInstruments)) return true;
  ++presses_;
  since_press_s_ = 0;
  intent_.exchange = true;
  return false;
}

HandIntent WaypointHand::update(const Percept& percept, double dt_s) {
  if (!ready_) {
    if (!seen_ || percept.device_ready) intent_.X_TI = {percept.R_TI, percept.tip_T};
    seen_ = true;
    ready_ = percept.device_ready;
    ready_T_ = from_T_ = intent_.X_TI.p;
    R_from_ = intent_.X_TI.R;
    from_jaw_m_ = intent_.jaw_opening_m;
    return intent_;
  }
  if (index_ >= moves_.size()) return intent_;
  const ScriptedMove& move = moves_[index_];
  if (in_move_s_ == 0 && !takes_instrument(move, percept, dt_s)) return intent_;
  in_move_s_ += dt_s;
  const double share = minimum_jerk(in_move_s_ / move.seconds);
  const Mat3 rolled = Eigen::AngleAxisd(share * move.roll_rad, Vec3::UnitZ()).toRotationMatrix();
  intent_.X_TI.R = R_from_ * rolled;
  if (move.about_m)
    intent_.X_TI.p = *move.about_m + R_from_ * rolled * R_from_.transpose() * (from_T_ - *move.about_m);
  else
    intent_.X_TI.p = from_T_ + share * (goal(move) - from_T_);
  intent_.jaw_opening_m = from_jaw_m_ + share * (move.jaw_m - from_jaw_m_);
  intent_.clutch = move.clutch;
  intent_.pedal = move.pedal;
  if (in_move_s_ >= move.seconds + move.hold_s) {
    if (move.clutch) intent_ = {.X_TI = {R_from_, from_T_}, .jaw_opening_m = intent_.jaw_opening_m};  // it stayed there
    from_T_ = intent_.X_TI.p;
    R_from_ = intent_.X_TI.R;
    from_jaw_m_ = intent_.jaw_opening_m;
    in_move_s_ = 0;
    presses_ = 0;
    intent_.pedal = false;
    ++index_;
  }
  return intent_;
}

}  // namespace trocar
