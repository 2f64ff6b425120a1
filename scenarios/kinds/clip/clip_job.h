// How a simulated person names, clips and cuts: take the instrument that is asked for, reach over the place with open
// jaws turned across the structure, look, go in until the tips stand beyond it, look again; stay there to name it, else
// close, try a clip by a gentle pull, open, draw back. What came to nothing is tried again from there, then from
// outside.
//
// Knows nothing but the Percept. Frame T, m, N. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include "scenarios/hands/exchange_job.h"
#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"
#include "scenarios/hands/turn_plan.h"

namespace trocar {

class ClipJob : public HandWork {
 public:
  explicit ClipJob(const HandSkill& skill) : skill_(skill) {}

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return step_ >= Step::kAdvance; }

 private:
  enum class Step : std::uint8_t { kWithdraw, kExchange, kReach, kLook, kAdvance, kCheck, kStay, kClose, kTug, kOpen };

  void enter(Step step);
  void leave(const Percept& percept, double dt_s, HandIntent& intent);
  void exchange(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random);
  void go(Step step, const Percept& percept, double over_m, const HandIntent& intent, HandRandom& random);
  void look(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void close(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random);
  void tug(const HandSenses& senses, HandIntent& intent);
  void open(const Percept& percept, double dt_s, HandIntent& intent);
  static void set_jaws(const Percept& percept, double dt_s, HandIntent& intent);
  static double free_jaw(const Percept& percept);
  static Vec3 way_to(const Percept& percept, double over_m);
  bool off_place(const Percept& percept, const Vec3& way) const;

  HandSkill skill_;
  ReachPlan plan_;
  TurnPlan turn_;
  Step step_ = Step::kWithdraw;
  ExchangeSwitch switch_;
  double in_step_s_ = 0, pull_n_ = 0;
  bool planned_ = false, moves_on_ = false;
  int corrections_ = 0, tries_ = 0;
};

}  // namespace trocar
