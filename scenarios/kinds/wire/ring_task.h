// Moving the ring along the wire, gate by gate.
//
// The ring is followed along the wire from where it was a moment ago, so that no gate can be passed but along it; going
// back and forth passes no gate twice. Events: TARGET_LIT; TARGET_HELD (s since lit) as a gate is passed, and with it
// ANGLE_ERROR (rad), the angle between the ring's normal and the wire, mean over the new stretch of wire; WIRE_TOUCHED
// (s) once a contact of more than 20 ms is over, contacts less than 0.2 s apart being one; RING_OFF (m beyond the play)
// when the ring is pulled off through the wire. Then it is to be put on again where it came off. Frame T, SI units.
// Deterministic. Thread: the tissue task's.
#pragma once

#include <vector>

#include "scenarios/director/exercise_task.h"

namespace trocar {

class RingTask final : public ExerciseTask {
 public:
  RingTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override { light(log); }
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return gate_ >= static_cast<std::int32_t>(gates_.size()); }
  std::int32_t object() const override { return finished() ? -1 : gate_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  void light(EventLog& log);
  void follow(const TaskInput& input, EventLog& log);
  void come_off(double offset_m, EventLog& log);
  void advance(double along_m, double angle_rad);
  void watch_touch(const TaskInput& input, EventLog& log);
  void end_touch(EventLog& log);
  /// Points of the wire within `reach_m` of where the ring is: first and one past the last.
  std::pair<std::size_t, std::size_t> near(double reach_m) const;

  RingOnWire ring_;      ///< without the wire
  double most_depth_m_;  ///< beyond the play, at which the ring comes off
  double angle_tolerance_rad_;
  std::vector<Vec3> wire_T_;
  std::vector<double> along_;  ///< m from the beginning to each point
  std::vector<Target> gates_;
  std::vector<double> gate_at_m_;
  std::int32_t gate_ = 0;
  bool on_ = false;
  double at_m_ = 0, reached_m_ = 0;  ///< where the ring is, and the furthest that it was
  double angle_rad_ = 0, offset_m_ = 0;
  double angle_sum_ = 0, angle_way_m_ = 0;  ///< over new wire since the last gate
  double lit_at_s_ = 0;
  double touch_s_ = 0, free_s_ = 1e9;
  int touches_ = 0;
  bool touching_ = false, lost_ = false;  ///< lost: it came off
};

}  // namespace trocar
