// How a simulated person cuts along a line: reach over the next place with open blades turned along the line, look, go
// down until the gauze is felt as much as is meant, close, and on to the next.
//
// Knows nothing but the Percept. Frame T, m, N. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"
#include "scenarios/hands/turn_plan.h"

namespace trocar {

class SnipJob : public HandWork {
 public:
  explicit SnipJob(const HandSkill& skill) : skill_(skill) {}

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return step_ >= Step::kPress; }

 private:
  enum class Step : std::uint8_t { kReach, kLook, kPress, kClose, kNext };

  void enter(Step step);
  double missing_roll(const Percept& percept) const;
  Wrist::Held rolled(const Percept& percept, double roll_rad) const;
  void reach(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void follow(const Percept& percept, double dt_s, HandIntent& intent) const;
  void look(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random);
  void press(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent);
  void close(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent);
  void set_blades(double to_m, double dt_s, HandIntent& intent) const;
  static Vec3 way_over(const Percept& percept, double over_m);
  static Vec3 aside_of(const Percept& percept);

  HandSkill skill_;
  ReachPlan plan_;
  Wrist wrist_;
  WristPlan turn_;
  Step step_ = Step::kReach;
  double in_step_s_ = 0, goal_n_ = 0;
  Vec3 lay_T_ = Vec3::Zero();  ///< where the place lay before it was pressed
};

}  // namespace trocar
