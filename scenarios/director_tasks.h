// The parts of a run that the director strings together: discs to press, a block to squeeze, and the watch on safety.
//
// Each is told of one haptic state per tissue period and writes events to a log. Frame T, SI units. Deterministic.
#pragma once

#include <string>
#include <vector>

#include "haptics/exchange/stylus_state.h"
#include "scenarios/director.h"
#include "scenarios/exercise.h"
#include "scenarios/threshold_monitor.h"

namespace trocar {

/// Events so far, stamped with the present time and tip.
struct EventLog {
  std::vector<Event> events;
  double t_s = 0;
  Vec3 tip_T = Vec3::Zero();

  void add(const std::string& type, Severity severity, std::int32_t object = -1, double value = 0,
           const std::string& unit = "");
};

/// EXCESS_FORCE, CRITICAL_FORCE, TOOL_COLLISION, DEVICE_LIMIT.
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
};

/// Lights the discs one after the other: TARGET_LIT, TARGET_TOUCHED, WRONG_PLACE, TARGET_HELD.
class DiscTask {
 public:
  DiscTask(const Exercise& exercise, const ExerciseLevel& level, const std::vector<Target>& targets);
  void begin(EventLog& log);
  void update(const StylusState& state, double dt_s, EventLog& log);
  bool finished() const { return index_ >= static_cast<int>(targets_.size()); }
  int index() const { return index_; }
  double progress() const { return hold_.progress(); }
  int wrong_places() const { return wrong_places_; }
  /// The tip is on the lit disc now (within half the wrong-place margin of its edge).
  bool on_disc() const { return on_disc_; }
  bool touching() const { return touching_; }
  double since_wrong_place_s() const { return since_wrong_place_s_; }

 private:
  void light(EventLog& log);
  bool leaving_last_disc(const Vec3& point_T) const;
  void judge_contact(const StylusState& state, bool new_contact, double dt_s, EventLog& log);

  double wrong_place_m_, band_low_n_, band_high_n_;
  std::vector<Target> targets_;
  HoldTimer hold_;
  int index_ = 0, wrong_places_ = 0;
  bool touched_ = false, touching_ = false, on_disc_ = false;
  bool strayed_ = false;        ///< a wrong place has been counted for the lit disc
  Vec3 last_contact_T_ = Vec3::Zero();
  double astray_s_ = 0;         ///< touching beside the discs without a break
  double free_s_ = 1, lit_at_s_ = 0, since_wrong_place_s_ = 1e9;
};

/// Offers the block between open jaws: GRIP_OFFERED, GRIP_TOUCHED, GRIP_EXCESS, GRIP_HELD.
class SqueezeTask {
 public:
  SqueezeTask(const GripTask& task, std::int32_t object);
  void update(const StylusState& state, double dt_s, EventLog& log);
  bool offered() const { return offered_; }
  bool finished() const { return finished_; }
  bool too_hard() const { return excess_.above(); }
  int excess_count() const { return excess_count_; }
  double progress() const { return hold_.progress(); }
  /// What lies between the jaws now.
  GripBlock block() const;

 private:
  GripTask task_;
  std::int32_t object_;
  HoldTimer hold_;
  ThresholdMonitor excess_;
  bool offered_ = false, touched_ = false, finished_ = false;
  int excess_count_ = 0;
  double offered_at_s_ = 0;
};

}  // namespace trocar
