// How a simulated person moves a foam block: reach over it with open jaws, look, come down round it, close, feel what
// foam it is when no colour tells, squeeze, lift, carry, look, lower until it stands, let go, withdraw. A block that is
// lost on the way is fetched again; one that is seen to slip is held tighter.
//
// Knows nothing but the Percept. Frame T, m, N. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include "scenarios/hands/force_grip.h"
#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

class GraspJob : public HandWork {
 public:
  explicit GraspJob(const HandSkill& skill);

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;

 private:
  enum class Step : std::uint8_t {
    kReach,
    kLook,
    kDescend,
    kClose,
    kFeel,
    kSqueeze,
    kLift,
    kCarry,
    kLookAtRing,
    kLower,
    kOpen,
    kRetreat,
    kWait
  };

  void enter(Step step);
  void reach(const Percept& percept, const Vec3& goal_T, double width_m, double least_s, const HandIntent& intent,
             HandRandom& random);
  void reach_block(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void reach_ring(const Percept& percept, const HandIntent& intent, HandRandom& random);
  void withdraw(const Percept& percept, const HandIntent& intent);
  void straight(const Vec3& from_T, const Vec3& to_T, double seconds);
  void guide(const Percept& percept, double dt_s);
  void squeeze(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void approach(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void take(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void bring(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random);
  void leave(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random);
  void judge_foam(const Percept& percept, HandRandom& random);
  void watch_grip(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                  HandRandom& random);
  static Vec3 base_of(const SeenObject& object);
  Vec3 grip_point(const Percept& percept) const;
  static double thickness(const Percept& percept);
  static Vec3 way_out(const Percept& percept);
  double roll_off(const Percept& percept) const;
  static double turn_to(double roll, const Percept& percept, const HandIntent& intent);

  HandSkill skill_;
  ForceGrip grip_;
  ReachPlan plan_;
  Step step_ = Step::kWait;
  Mat3 R_from_ = Mat3::Identity();  ///< orientation before the present reach, which turns it by turn_
  Eigen::AngleAxisd turn_{0, Vec3::UnitX()};
  Vec3 aside_ = Vec3::Zero();      ///< of the way down, as corrected on it
  double low_n_ = 0, high_n_ = 0;  ///< window that the person believes in
  double in_step_s_ = 0, lost_s_ = 0, slip_s_ = 0;
  double felt_sum_n_ = 0, opening_sum_m_ = 0;
  int felt_count_ = 0, corrections_ = 0;
  bool snagged_ = false;  ///< the present withdrawal goes straight up
  bool due_ = false;      ///< the next block is lit, and will be reached for after the withdrawal
  int hits_ = 0;          ///< on the way down, one after the other
};

}  // namespace trocar
