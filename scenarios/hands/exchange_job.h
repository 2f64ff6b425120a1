// How a simulated person changes instruments: straight up out of what it stands in, then the switch, until the one that
// is asked for is seen in hand.
//
// Frame T, m. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

/// Presses the switch that asks for the next instrument, again and again.
class ExchangeSwitch {
 public:
  /// @return true: none is asked for, or it is in hand
  bool press(const Percept& percept, double dt_s, HandIntent& intent);

 private:
  double since_press_s_ = 0;
};

class ExchangeJob : public HandWork {
 public:
  explicit ExchangeJob(const HandSkill& skill) : skill_(skill) {}

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;

 private:
  HandSkill skill_;
  ReachPlan plan_;
  ExchangeSwitch switch_;
  double in_step_s_ = 0;
};

}  // namespace trocar
