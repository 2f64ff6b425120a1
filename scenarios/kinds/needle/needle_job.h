// How a simulated person drives a needle: reach along the shaft with open jaws, look, close on the wire; bring the
// point over the dot, look, press it on until it is seen to go in, roll the needle about its own circle until enough of
// the point stands out; let go, take it there, roll on and lift. What came to nothing is rolled back and begun anew.
//
// A half circle is taken for granted. Knows nothing but the Percept. Frame T, m, rad. Thread: the hand task's, once a
// loop period; does not allocate.
#pragma once

#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"
#include "scenarios/hands/turn_plan.h"

namespace trocar {

class NeedleJob : public HandWork {
 public:
  explicit NeedleJob(const HandSkill& skill) : skill_(skill) {}

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return step_ >= Step::kPress; }

 private:
  enum class Step : std::uint8_t {
    kOpen,
    kBack,
    kReach,
    kLook,
    kAdvance,
    kCheck,
    kClose,
    kLift,
    kBring,
    kSee,
    kPress,
    kRoll,
    kUnroll,
    kDraw,
    kRaise
  };

  void enter(Step step);
  void start(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void open(const Percept& percept, double dt_s, HandIntent& intent);
  void go(Step step, const Percept& percept, double over_m, const HandIntent& intent, HandRandom& random);
  void look(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void shut(double dt_s, HandIntent& intent) const;
  void close(double dt_s, HandIntent& intent);
  void straight(Step step, const HandIntent& intent, const Vec3& way);
  void turn_to(const Percept& percept, const Mat3& R_goal, const HandIntent& intent, HandRandom& random);
  void bring(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void see(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void press(const Percept& percept, double dt_s, HandIntent& intent);
  void begin_roll(Step step, const Percept& percept, double by_rad, const HandIntent& intent, HandRandom& random);
  void roll(const Percept& percept, HandIntent& intent) const;
  void steer(const Percept& percept, double dt_s, HandIntent& intent);
  void rolled(const Percept& percept, const HandIntent& intent, HandRandom& random);
  bool moves(HandIntent& intent) const;

  HandSkill skill_;
  ReachPlan plan_;
  Wrist wrist_;
  WristPlan turn_;
  Step step_ = Step::kOpen;
  Cue cue_ = Cue::kNone;
  double in_step_s_ = 0, noticed_s_ = 0;
  Vec3 over_T_ = Vec3::Zero();      ///< over the dot, where the point is brought
  Vec3 aside_ = Vec3::Zero();       ///< moved sideways as it is pressed on or rolled
  Vec3 middle_T_ = Vec3::Zero();    ///< about which it is rolled,
  Vec3 shaft_T_ = Vec3::UnitZ();    ///< and along which,
  Pose from_;                       ///< from where,
  Vec3 hinge_T_ = Vec3::UnitX();    ///< as it was seen then,
  double over_m_ = 0;               ///< as the point is seen over its dot while it is pressed on,
  double in_for_s_ = 0;             ///< and since when it is seen to have gone in
  double by_rad_ = 0, roll_s_ = 1;  ///< by how much, in how long
  double rolled_rad_ = 0;           ///< since the point was pressed on
  int corrections_ = 0, in_vain_ = 0;
};

}  // namespace trocar
