// How a simulated person works with the hook. At a strand: over its side, look, down beside it, slide the foot under
// it, look, lift, look, press the pedal until it is seen to part. At a vessel that spurts: over it, look, down onto it,
// press the pedal until it is seen to be dry, draw back. A strand that is not seen to come along is tried again, lower.
//
// Knows nothing but the Percept, and the shape of the hook. Frame T, m. Thread: the hand task's, once a loop period;
// does not allocate.
#pragma once

#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

class HookJob : public HandWork {
 public:
  explicit HookJob(const HandSkill& skill) : skill_(skill) {}

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return step_ == Step::kPress; }

 private:
  enum class Step : std::uint8_t {
    kDrawBack,
    kReach,
    kLook,
    kAdvance,
    kCheck,
    kSlide,
    kUnder,
    kLift,
    kWeigh,
    kBurn,
    kPress
  };
  void enter(Step step);
  void go(Step step, const Percept& percept, const Vec3& to_T, const HandIntent& intent, HandRandom& random);
  void rise(const Percept& percept, double way_m, const HandIntent& intent);
  Vec3 beside(const Percept& percept, double out_m, double over_m) const;
  Vec3 over_T(const Percept& percept) const;
  Vec3 down_T(const Percept& percept) const;
  void arrive(const Percept& percept, HandIntent& intent, HandRandom& random);
  void look(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void lift(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void weigh(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void burn(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent);

  HandSkill skill_;
  Step step_ = Step::kReach;
  ReachPlan plan_;
  double in_step_s_ = 0;
  double enough_ = 1;  ///< share of the wanted lift at which this person presses the pedal, this time
  int corrections_ = 0, tries_ = 0;
};

}  // namespace trocar
