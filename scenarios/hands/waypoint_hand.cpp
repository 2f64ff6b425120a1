#include "scenarios/hands/waypoint_hand.h"

#include <algorithm>

#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

Vec3 WaypointHand::goal(const ScriptedMove& move) const {
  return move.relative_to_ready ? Vec3(ready_T_ + move.to_m) : move.to_m;
}

HandIntent WaypointHand::update(const Percept& percept, double dt_s) {
  if (!ready_) {
    if (!seen_ || percept.device_ready) intent_.X_TI = {percept.R_TI, percept.tip_T};
    seen_ = true;
    ready_ = percept.device_ready;
    ready_T_ = from_T_ = intent_.X_TI.p;
    from_jaw_m_ = intent_.jaw_opening_m;
    return intent_;
  }
  if (index_ >= moves_.size()) return intent_;
  const ScriptedMove& move = moves_[index_];
  in_move_s_ += dt_s;
  const double share = minimum_jerk(in_move_s_ / move.seconds);
  intent_.X_TI.p = from_T_ + share * (goal(move) - from_T_);
  intent_.jaw_opening_m = from_jaw_m_ + share * (move.jaw_m - from_jaw_m_);
  intent_.clutch = move.clutch;
  if (in_move_s_ >= move.seconds + move.hold_s) {
    if (move.clutch)
      intent_ = {{intent_.X_TI.R, from_T_}, intent_.jaw_opening_m, false};  // the instrument stayed there
    from_T_ = intent_.X_TI.p;
    from_jaw_m_ = intent_.jaw_opening_m;
    in_move_s_ = 0;
    ++index_;
  }
  return intent_;
}

}  // namespace trocar
