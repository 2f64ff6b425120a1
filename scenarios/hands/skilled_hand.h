// A simulated person at the exercise: sees late and noisily, reaches in minimum-jerk movements, looks and corrects,
// comes down onto the tissue, presses until the felt force is what it wants, withdraws, and finally squeezes the block.
//
// Knows nothing but its Percept. Its intent pulls the stylus through the impedance of the hand, so while pressing the
// intent lies inside the tissue. Frame T, m, N. Orientation: kept as seen when the device became ready, until a pen
// asks for another. Thread: the hand task's, once a loop period; does not allocate.
#pragma once

#include <array>
#include <memory>

#include "scenarios/hands/force_grip.h"
#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_random.h"
#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_senses.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"
#include "scenarios/hands/turn_plan.h"

namespace trocar {

class SkilledHand : public Hand {
 public:
  SkilledHand(const HandSkill& skill, std::uint64_t seed);
  HandIntent update(const Percept& percept, double dt_s) override;

 private:
  enum class Step : std::uint8_t { kStill, kReach, kLook, kDescend, kPress, kSqueeze };

  Percept attend(const Percept& percept);
  void act(const Percept& percept, double dt_s);
  void begin_task(const Percept& percept);
  void reach(const Percept& percept, const Vec3& goal_T, bool lift);
  void reach_target(const Percept& percept, bool lift);
  void turn(const Percept& percept);
  bool off_target(const Percept& percept) const;
  void look(const Percept& percept);
  void descend(const Percept& percept, double dt_s);
  void press(const Percept& percept, double dt_s);
  void squeeze(const Percept& percept, double dt_s);
  HandWork* work() const { return works_[static_cast<std::size_t>(task_.kind)].get(); }
  HandIntent move_work(HandWork& work, const Percept& percept, double dt_s);
  void on_unexpected_touch(const Percept& percept);
  void draw_anew(std::uint64_t part);
  void start_pressing(const Percept& percept);
  Vec3 sideways_error(const Percept& percept) const;
  static double height_over(const Percept& percept);
  Vec3 tremor(double t_s) const;

  std::uint64_t seed_, jobs_ = 0;
  HandRandom random_;  ///< of the present job
  HandSkill skill_;
  HandSenses senses_;
  ForceGrip press_, squeeze_;
  std::array<std::unique_ptr<HandWork>, HandJob::kKinds> works_;  ///< by the kind of job; nullptr: the hand's own
  HandIntent job_intent_;                                         ///< of the present work, without tremor
  ReachPlan plan_;
  TurnPlan turn_;
  HandJob task_;
  Percept attended_;  ///< target and band that the person works on
  Step step_ = Step::kStill;
  Pose ready_;  ///< pose seen when the device became ready
  Vec3 intent_T_ = Vec3::Zero();
  Mat3 intent_R_ = Mat3::Identity();
  Vec3 tremor_phase_ = Vec3::Zero();
  double jaw_m_, time_s_ = 0, in_step_s_ = 0, aside_s_ = 0;
  int corrections_ = 0;
  bool opened_ = false;  ///< the jaws have been opened for the squeeze
  bool seen_ = false, is_ready_ = false;
};

}  // namespace trocar
