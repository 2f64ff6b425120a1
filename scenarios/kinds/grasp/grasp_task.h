// Limited grasp: the lit block is picked, lifted, carried over and set down within its ring.
//
// Events beside those of the carry (director/carry_watch.h), value in brackets: TARGET_LIT; CRUSH [N], DROP [m] when a
// block falls; PLACED [m off the ring's centre] when it rests within its ring after it was lifted high enough and set
// down, not dropped; MISPLACED [m] when it rests elsewhere after a carry; REMOVED when a placed block leaves its ring
// again; LOST [m], critical, when it rests too far outside the board: it is not asked for again, and the attempt never
// counts as finished. A critical number of crushed blocks makes the last CRUSH critical. Frame T, SI units.
// Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "scenarios/director/carry_watch.h"
#include "scenarios/kinds/grasp/grasp_rules.h"

namespace trocar {

class GraspTask final : public ExerciseTask {
 public:
  GraspTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return lit_ < 0; }
  std::int32_t object() const override { return lit_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  /// What has become of one block.
  struct Block {
    CarryWatch carry = {};  ///< heights of its lowest corner over the board
    bool crushed = false, placed = false, lost = false;
    bool judged = true;    ///< its last letting go has been judged
    bool dropped = false;  ///< it fell since it was grasped last
  };
  bool gone(std::int32_t index) const;
  void light_next(EventLog& log);
  void follow_grip(const TissueFrame& frame, std::int32_t index, double grip_n, EventLog& log);
  void take_out(std::int32_t index, EventLog& log);
  void follow_free(const ObjectState& object, std::int32_t index, EventLog& log);
  bool has_left(const ObjectState& object, std::int32_t index, EventLog& log);
  void judge_rest(const ObjectState& object, std::int32_t index, EventLog& log);
  void describe_message(double grip_n, DirectorStatus& status) const;

  GraspRules rules_;
  GraspLevel level_;
  std::string display_;
  std::vector<Target> rings_;
  std::vector<Block> blocks_;
  std::int32_t lit_ = -1;
  int done_ = 0, crushed_ = 0, errors_ = 0;
  std::string toast_;
  double toast_s_ = 1e9;
};

}  // namespace trocar
