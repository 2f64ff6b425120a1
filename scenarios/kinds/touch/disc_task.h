// The discs of surface touch: each is pressed within its band of force for a while.
//
// Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "haptics/exchange/stylus_state.h"
#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"

namespace trocar {

/// Lights the discs one after the other: TARGET_LIT, TARGET_TOUCHED, WRONG_PLACE, TARGET_HELD.
class DiscTask final : public ExerciseTask {
 public:
  DiscTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& targets);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return index_ >= static_cast<int>(targets_.size()); }
  std::int32_t object() const override { return finished() ? -1 : index_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  void light(EventLog& log);
  void hints(const TaskInput& input, const WantedForce& band, DirectorStatus& status) const;
  bool leaving_last_disc(const Vec3& point_T) const;
  void judge_contact(const Vec3& point_T, bool new_contact, double dt_s, EventLog& log);

  double wrong_place_m_;
  std::string display_;
  std::vector<Target> targets_;  ///< at rest
  HoldTimer hold_;
  int index_ = 0, wrong_places_ = 0;
  bool touched_ = false, touching_ = false, on_disc_ = false;  ///< on it: within half the wrong-place margin
  bool strayed_ = false;                                       ///< a wrong place has been counted for the lit disc
  Vec3 last_contact_T_ = Vec3::Zero();
  double astray_s_ = 0;  ///< touching beside the discs without a break
  double free_s_ = 1, lit_at_s_ = 0, since_wrong_place_s_ = 1e9;
};

}  // namespace trocar
