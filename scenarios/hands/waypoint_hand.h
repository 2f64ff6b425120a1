// A hand that follows a fixed list of minimum-jerk moves and then stays; with an empty list it holds still.
// For tests and studies. Frame T, m. Thread: the hand task's; does not allocate after construction.
#pragma once

#include <vector>

#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_script.h"

namespace trocar {

class WaypointHand : public Hand {
 public:
  explicit WaypointHand(std::vector<ScriptedMove> moves) : moves_(std::move(moves)) {}
  HandIntent update(const Percept& percept, double dt_s) override;

 private:
  Vec3 goal(const ScriptedMove& move) const;
  /// Presses and lets go the exchange switch until the move's instrument is in hand. @return whether it is
  bool takes_instrument(const ScriptedMove& move, const Percept& percept, double dt_s);

  std::vector<ScriptedMove> moves_;
  HandIntent intent_;
  Vec3 ready_T_ = Vec3::Zero(), from_T_ = Vec3::Zero();
  Mat3 R_from_ = Mat3::Identity();
  double from_jaw_m_ = 0;
  bool seen_ = false, ready_ = false;
  std::size_t index_ = 0;
  double in_move_s_ = 0;
  int presses_ = 0;           ///< of the exchange switch before this move
  double since_press_s_ = 0;  ///< began
};

}  // namespace trocar
