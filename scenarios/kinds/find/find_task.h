// Lift and find: the flap is taken at the lit place, lifted until the symbol beneath is to be seen, held so with a
// wanted pull while it is read, let down; then the symbol is told in one of the balls beside.
//
// Lifted is what the tip holds, by its turn about the hinge, unless the flap is folded up: then the tip is nearer to
// the hinge than nine tenths of the way at which the place lies. The symbol is to be seen from the wanted angle on, and
// the hold counts the time in which it is, together; while clutch or port stand the instrument still no time counts.
// Jaws that hold the flap tell nothing, nor does the ball of the last answer until the tip has left it. What is told
// before the hold is complete is wrong, whatever was seen; one answer a pin. Events: TARGET_LIT; TISSUE_TAKEN (grip,
// N), REGRASP after the first; EXPOSED (s since lit) each time that the symbol comes to be seen, COVERED (m of lift)
// when it no longer is though it is held; TARGET_TOUCHED with the first EXPOSED, from when on the pull is judged; SLIP
// (m); LET_GO (m of lift) before it lies down; TARGET_HELD (s since lit); ANSWERED or WRONG_ANSWER (s since lit). Frame
// T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/find/find_rules.h"

namespace trocar {

class FindTask final : public ExerciseTask {
 public:
  FindTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return index_ >= static_cast<std::int32_t>(places_.size()); }
  std::int32_t object() const override { return finished() ? -1 : index_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  const Target& place() const { return places_[static_cast<std::size_t>(index_)]; }
  bool complete() const { return held_s_ >= hold_s_; }
  Vec3 from_hinge(const Vec3& place_T) const;
  Vec3 goal_T() const;
  void light(EventLog& log);
  void follow_grip(const TaskInput& input, EventLog& log);
  void follow_lift(const TaskInput& input, EventLog& log);
  void follow_answer(const TaskInput& input, EventLog& log);
  void describe_demand(const TaskInput& input, DirectorStatus& status) const;
  void describe_message(const StylusState& stylus, DirectorStatus& status) const;

  FindRules rules_;
  FindBoard board_;
  std::vector<Target> places_;
  WantedForce band_;
  std::string display_;
  double hold_s_;
  HoldTimer answer_;
  std::int32_t index_ = 0, told_ = -1;  ///< told: the ball that the tip is in
  std::int32_t last_ball_ = -1;         ///< of the last answer, until the tip has left it: it tells one once
  bool holds_ = false, firm_ = false, taken_ = false, exposed_ = false, judged_ = false, slipping_ = false,
       last_right_ = false;
  double lit_at_s_ = 0, exposure_ = 0, held_s_ = 0, slip_from_m_ = 0;
  int lost_ = 0;
};

}  // namespace trocar
