// Peg transfer: the lit ring is taken off its peg, carried to the lit peg and put over it; all rings across, then all
// back, each to the peg that it came from.
//
// Events name the transfer; beside those of the carry (director/carry_watch.h), value in brackets: TARGET_LIT;
// GRIP_EXCESS [N] each time that the grip leaves a mark; BUMP [m from the peg's middle] when a carried ring comes down
// on a peg, or against one, too far from its middle; DROP [m] when a ring falls and is on no peg then; MISPLACED [m]
// when it rests after a carry and not on its peg; TARGET_HELD [m] when it lies on its peg, and is free: done for good;
// LOST [m], critical, when a ring rests too far outside the board: it is not asked for again, and the attempt never
// counts as finished. Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "scenarios/director/carry_watch.h"
#include "scenarios/kinds/pegs/pegs_rules.h"

namespace trocar {

class PegTask final : public ExerciseTask {
 public:
  PegTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return lit_ < 0; }
  std::int32_t object() const override { return lit_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  /// What has become of one ring.
  struct Ring {
    bool across = false, back = false, lost = false;
    CarryWatch carry = {};  ///< heights over where it was grasped, of its present transfer
    bool marking = false;   ///< the grip leaves a mark now
    bool judged = true;     ///< its last letting go has been judged
    double from_z_m = 0;    ///< of its middle when it was grasped
    int over = -1;          ///< peg on or beside which it is; none: it is free to come down on one
  };
  std::int32_t rings() const { return static_cast<std::int32_t>(rings_.size()); }
  std::int32_t transfer_of(std::int32_t ring) const;
  bool gone(std::int32_t transfer) const;
  void light_next(EventLog& log);
  void follow_grip(const TissueFrame& frame, std::int32_t ring, double grip_n, EventLog& log);
  void follow_pegs(const ObjectState& object, std::int32_t ring, EventLog& log);
  void follow_free(const ObjectState& object, std::int32_t ring, EventLog& log);
  bool has_left(const ObjectState& object, std::int32_t ring, EventLog& log);
  void judge_rest(const ObjectState& object, std::int32_t ring, EventLog& log);
  int peg_under(const ObjectState& object) const;
  void warn(const char* message);
  void describe_message(double grip_n, DirectorStatus& status) const;
  SeenObject seen(const ObjectState& object, const TaskInput& input) const;

  PegsRules rules_;
  PegsLevel level_;
  std::string display_;
  std::vector<Target> goals_;
  std::vector<PegPost> pegs_;
  std::vector<Ring> rings_;
  std::int32_t lit_ = -1;
  int done_ = 0, errors_ = 0;
  const char* toast_ = "";
  double toast_s_ = 1e9;
};

}  // namespace trocar
