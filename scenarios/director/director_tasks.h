// The parts of surface touch (E02), discs to press and a block to squeeze, and the watch on safety that every run has.
// The parts of the other kinds: pose_task.h, grasp_task.h.
//
// Frame T, SI units. Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "haptics/exchange/stylus_state.h"
#include "scenarios/director/exercise_task.h"
#include "scenarios/director/threshold_monitor.h"

namespace trocar {

/// EXCESS_FORCE, CRITICAL_FORCE, TOOL_COLLISION, DEVICE_LIMIT, CLUTCH, PORT_HOLD.
class SafetyWatch {
 public:
  explicit SafetyWatch(const Exercise& exercise);
  void update(const StylusState& state, double dt_s, std::int32_t object, EventLog& log);
  bool too_hard() const { return excess_.above(); }
  int excess_count() const { return excess_count_; }
  double peak_n() const { return peak_n_; }

 private:
  ThresholdMonitor excess_, critical_, collision_, limit_;
  int excess_count_ = 0;
  double peak_n_ = 0;
  bool clutched_ = false, held_ = false;
};

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
  void coach(const TaskInput& input, const WantedForce& band, DirectorStatus& status) const;
  bool leaving_last_disc(const Vec3& point_T) const;
  void judge_contact(const StylusState& state, bool new_contact, double dt_s, EventLog& log);

  double wrong_place_m_;
  std::string display_;
  std::vector<Target> targets_;
  HoldTimer hold_;
  int index_ = 0, wrong_places_ = 0;
  bool touched_ = false, touching_ = false, on_disc_ = false;  ///< on it: within half the wrong-place margin
  bool strayed_ = false;                                       ///< a wrong place has been counted for the lit disc
  Vec3 last_contact_T_ = Vec3::Zero();
  double astray_s_ = 0;  ///< touching beside the discs without a break
  double free_s_ = 1, lit_at_s_ = 0, since_wrong_place_s_ = 1e9;
};

/// Offers the block between open jaws: GRIP_OFFERED, GRIP_TOUCHED, GRIP_EXCESS, GRIP_HELD.
class SqueezeTask final : public ExerciseTask {
 public:
  SqueezeTask(const GripTask& task, const ExerciseLevel& level, std::int32_t object);
  void begin(EventLog&) override {}
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return finished_; }
  std::int32_t object() const override { return -1; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  GripBlock block() const;

  GripTask task_;
  std::string display_;
  std::int32_t object_;
  HoldTimer hold_;
  ThresholdMonitor excess_;
  bool offered_ = false, touched_ = false, finished_ = false;
  int excess_count_ = 0;
  double offered_at_s_ = 0;
};

}  // namespace trocar
