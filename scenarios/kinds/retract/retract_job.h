// How a simulated person retracts tissue: reach over the place with open jaws, look, press them down a little, close,
// lift until enough is to be seen, keep the pull that is wanted, let down, let go, withdraw. What was lost, or closed
// on nothing, is taken again, a little deeper.
//
// Knows nothing but the Percept. Frame T, m, N. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include "scenarios/hands/force_grip.h"
#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

class RetractJob : public HandWork {
 public:
  explicit RetractJob(const HandSkill& skill);

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return step_ >= Step::kDescend && step_ <= Step::kOpen; }

 protected:
  enum class Step : std::uint8_t { kReach, kLook, kDescend, kClose, kSqueeze, kLift, kLower, kOpen, kRetreat };

  /// Held firmly it is lifted from here on ...
  virtual void begin_lift(const Percept&, const HandIntent&, HandRandom&) {}
  /// ... and let down: one period of either.
  virtual void lift(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                    HandRandom& random);
  void enter(Step step);
  Step step() const { return step_; }
  double in_step_s() const { return in_step_s_; }
  const HandSkill& skill() const { return skill_; }
  ForceGrip& pull() { return pull_; }
  bool withdrawn() const { return step_ == Step::kRetreat && in_step_s_ > plan_.duration_s(); }

 private:
  void reach(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void approach(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void close(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void hold(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void leave(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random);
  void squeeze(const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void give_up(const Percept& percept, const HandIntent& intent);

  HandSkill skill_;
  ForceGrip pull_, grip_;
  ReachPlan plan_;
  Step step_ = Step::kRetreat;
  double in_step_s_ = 0, lost_s_ = 0, depth_m_ = 0;
  int corrections_ = 0, tries_ = 0;
};

}  // namespace trocar
