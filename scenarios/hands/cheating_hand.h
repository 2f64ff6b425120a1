// A hand that knows a trick by which a score once rose: that it does not rise any more is kept as tests
// (scenarios/tests) and can be swept like any hand.
//
//   clutch   at each lit place, once it is there, the clutch is held for a while: pose and force stand still without
//            effort
//   dwell    what goes well is drawn out: the first object is carried, lifted or pressed on for a while at rest
// Otherwise the hand is that of somebody else. Frame T. Thread: the hand task's; does not allocate.
#pragma once

#include <memory>

#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_script.h"

namespace trocar {

class CheatingHand final : public Hand {
 public:
  CheatingHand(std::unique_ptr<Hand> who, const Cheat& cheat) : who_(std::move(who)), cheat_(cheat) {}
  HandIntent update(const Percept& percept, double dt_s) override;

 private:
  /// Is this the moment to begin?
  bool tempted(const Percept& percept, double dt_s);

  std::unique_ptr<Hand> who_;
  Cheat cheat_;
  HandIntent intent_;
  std::int32_t target_ = -1, tricked_ = -1;  ///< lit in the last period; at which the trick was played last
  double there_s_ = 0, left_s_ = 0;          ///< at the lit place; of the trick
};

}  // namespace trocar
