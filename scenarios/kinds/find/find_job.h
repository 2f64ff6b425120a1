// How a simulated person lifts a flap and tells what lies beneath: takes it as any tissue (retract_job.h), swings it
// about its hinge, pulls as is wanted and keeps in mind what is to be seen, swings it back, lets go, and brings the tip
// to the ball with the same symbol. Who has seen none guesses.
//
// Knows nothing but the Percept. Frame T, m, N. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include "scenarios/kinds/retract/retract_job.h"

namespace trocar {

class FindJob final : public RetractJob {
 public:
  explicit FindJob(const HandSkill& skill) : RetractJob(skill) {}

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return !telling_ && RetractJob::touches(); }

 private:
  void begin_lift(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void lift(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
            HandRandom& random) override;
  void tell(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random);
  void reach_answer(const Percept& percept, const HandIntent& intent, HandRandom& random);

  ReachPlan way_;
  int symbol_ = -1;
  double telling_s_ = 0, thought_s_ = 0;
  bool telling_ = false, taut_ = false;
};

}  // namespace trocar
