// Retract and hold: tissue is taken at the lit place, lifted until what lies behind it is to be seen, held so with a
// wanted pull, and let down.
//
// How much is exposed is told by the lift: how far up the tip has carried the tissue since it took it, as a share of
// the level's lift. It needs no camera, and is the same on every organ; that it is not had by pressing down first and
// taking then is the matter of the pull, which is judged meanwhile. The hold counts the time in which enough is
// exposed, together; while clutch or port stand the instrument still no time counts. Events: TARGET_LIT; TISSUE_TAKEN
// (grip, N), REGRASP after the first; EXPOSED (s since lit) each time that the lift becomes enough, COVERED (m of lift)
// when it no longer is; TARGET_TOUCHED with the first EXPOSED, from when on the pull is judged; SLIP (m); LET_GO (m of
// lift) before it lies down; TARGET_HELD (s since lit); a critical EXCESS_FORCE (N) for a pull above the hard limit
// over too much of the hold. Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/retract/retract_rules.h"

namespace trocar {

class RetractTask final : public ExerciseTask {
 public:
  RetractTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& places);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return index_ >= static_cast<std::int32_t>(places_.size()); }
  std::int32_t object() const override { return finished() ? -1 : index_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  const Target& place() const { return places_[static_cast<std::size_t>(index_)]; }
  bool complete() const { return held_s_ >= hold_s_; }
  bool enough() const { return exposure_ >= rules_.exposed_share; }
  void light(EventLog& log);
  void follow_grip(const TaskInput& input, EventLog& log);
  void follow_lift(const TaskInput& input, EventLog& log);
  void judge_pull(double force_n, double dt_s, EventLog& log);
  void describe_message(const StylusState& stylus, DirectorStatus& status) const;

  RetractRules rules_;
  std::vector<Target> places_;
  WantedForce band_;
  std::string display_;
  double lift_m_, hold_s_, hard_n_;
  std::int32_t index_ = 0;
  bool holds_ = false, firm_ = false, taken_ = false, exposed_ = false, judged_ = false, slipping_ = false,
       told_ = false;
  double lit_at_s_ = 0, lifted_m_ = 0, exposure_ = 0, held_s_ = 0, hard_s_ = 0, slip_from_m_ = 0, taken_z_m_ = 0;
  int lost_ = 0;
};

}  // namespace trocar
