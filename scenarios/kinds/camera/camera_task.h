// Camera navigation: spheres light one after the other; each must be brought into the middle of the picture, at the
// right distance, seen along its cup, the picture level, and be kept there for a moment.
//
// Events: TARGET_LIT, TARGET_HELD (s since lit), TARGET_TIMEOUT (it comes back after the others); with the last two,
// of all the time the sphere has been lit so far, HORIZON_KEPT (share with a level picture; of that time only so much
// counts as a quick hand needs, of the other all) and VIEW_JERKS (peaks of the sphere's speed in the picture). Any
// time: HORIZON_LOST (rad, picture rolled too far for long, again after each such while), WALL_CONTACT (m/s, the lens
// meets a cup or the plate). Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <deque>
#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"
#include "scenarios/kinds/camera/camera_rules.h"
#include "scenarios/kinds/camera/cup.h"
#include "scenarios/kinds/camera/view_motion.h"

namespace trocar {

class CameraTask final : public ExerciseTask {
 public:
  CameraTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& poses);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return waiting_.empty(); }
  std::int32_t object() const override { return finished() ? -1 : waiting_.front(); }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  /// What the scope sees of the lit sphere.
  struct Sight {
    double distance_m = 0, off_middle_rad = 0;
    double horizon_rad = 0;  ///< roll of the picture; 0 where it cannot be told
    bool whole = false;      ///< past the cup's wall
    Vec3 sphere_C = Vec3::UnitZ();
  };
  /// Of one sphere, as long as it was lit.
  struct Account {
    double level_s = 0, rolled_s = 0;
    int jerks = 0;
  };

  Sight look(const Pose& X_TI) const;
  bool good(const Sight& sight) const;
  void light(EventLog& log);
  void watch_horizon(const TaskInput& input, EventLog& log);
  void watch_walls(const TaskInput& input, EventLog& log);
  void account(EventLog& log);
  void hints(DirectorStatus& status) const;

  CameraRules rules_;
  CameraLevel level_;
  Mat3 R_IC_;
  bool coached_;  ///< messages say what is wrong
  std::vector<Target> poses_;
  std::vector<Cup> cups_;
  std::vector<Account> accounts_;
  HoldTimer hold_;
  ThresholdMonitor wall_;
  ViewMotion motion_;
  std::deque<std::int32_t> waiting_;  ///< spheres still to find; the first is lit
  Sight sight_;
  int timeouts_ = 0, walls_ = 0;
  double lit_at_s_ = 0, lost_for_s_ = 0;
};

}  // namespace trocar
