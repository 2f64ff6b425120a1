// Needle driving: the needle is taken, driven in at one dot and out at the other, taken at its point and drawn through;
// pair after pair.
//
// Judged is what the tissue's frame tells of the needle, by places of the tissue at rest. While clutch or port stand
// the instrument still nothing moves, so nothing is judged either; time goes on.
//
// Events: TARGET_LIT, TARGET_HELD (s since lit) of each pair; NEEDLE_GRIPPED (share of the needle's length from its
// point), minor where it is grasped outside its share, or oftener than once to drive and once to draw; BITE_BEGUN
// (m from the first dot) once the point has been in for 0.3 s, or is through: what ends sooner is a point that slides
// over the surface, and no bite; BITE_THROUGH (m from the second) as it has come out; both minor beyond the level's
// tolerance; BITE_UNDONE: drawn back out, which is to be done again; NEEDLE_DRAWN (deg): angle between the
// point's way in and that of a circle through both dots across the shaft, and mean angle between the point's way
// through the tissue and its own direction, together, once it is in no tissue any more; NEEDLE_LOST (m from the
// region's centre): let go and in no tissue for so long that another takes its place; critical outside the field. A
// critical TEAR (N across the needle): torn out sideways. Frame T, SI. Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/needle/needle_rules.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class NeedleTask final : public ExerciseTask {
 public:
  NeedleTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return pair_ >= pairs_; }
  std::int32_t object() const override { return finished() ? -1 : pair_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  enum class Step : std::uint8_t { kTake, kDrive, kTakePoint, kDraw };
  struct Told {
    const char* message = "";
    const char* hint = "";
    double at_s = -1;
  };

  void light(EventLog& log);
  void follow_grip(const TissueFrame& frame, EventLog& log);
  void follow_bite(const TissueFrame& frame, EventLog& log);
  void follow_point(const NeedleSight& needle);
  void tell_bite(EventLog& log);
  void end_bite(const TissueFrame& frame, EventLog& log);
  void follow_needles(const TissueFrame& frame, EventLog& log);
  void blame(Told told, EventLog& log);
  SurfacePlace dot(const TaskInput& input, int target) const;
  double out_m(const TaskInput& input) const;
  bool held_too_near_the_point(const TaskInput& input) const;
  Step step_of(const TaskInput& input) const;
  void say_step(Step step, DirectorStatus& status) const;

  NeedleRules rules_;
  NeedleBoard own_;
  std::vector<Target> targets_;
  Vec3 port_T_, centre_T_;
  std::string display_;
  double soft_n_, tolerance_m_;
  int pairs_, pair_ = 0, errors_ = 0;
  int grips_ = 0, point_grips_ = 0;  ///< of this pair
  bool held_ = false, drawn_ = false, in_ = false;
  bool told_in_ = false;   ///< that it is in
  bool threaded_ = false;  ///< drawn through the first bite of a pair, while its point has bitten once more
  NeedleBite bite_;        ///< the present one, as it was seen last
  double in_since_s_ = 0, entry_deg_ = 0, way_deg_m_ = 0, way_m_ = 0;
  Vec3 point_T_ = Vec3::Zero(), point_along_T_ = Vec3::UnitZ(), needle_T_ = Vec3::Zero();
  std::int32_t tears_ = 0, needles_ = 0, stitches_ = 0;
  double lit_at_s_ = 0, now_s_ = 0;
  Told told_;
};

}  // namespace trocar
