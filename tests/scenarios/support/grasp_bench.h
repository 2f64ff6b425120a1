// Limited grasp without physics: a director that is told where each block is and how hard the jaws hold, at 100 Hz,
// and a trace of it for scoring. Moves are told as they are seen: take, carry, let go, come to rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/grasp/grasp_layout.h"
#include "scenarios/scoring/score.h"
#include "tissue/tissue_frame.h"

namespace trocar {

inline Exercise limited_grasp() {
  return find_exercise("E03", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
}

class GraspBench {
 public:
  explicit GraspBench(const std::string& level = "L1", int board = 7)
      : exercise(limited_grasp()),
        asked(find_level(exercise, level)),
        director(exercise, asked, lay_out_blocks(exercise, asked, board)) {
    trace.rate_hz = 100;
    state.loop = LoopState::kActive;
    state.X_TI.p = director.board().start_T;
    const auto& blocks = director.board().rigid.blocks;
    frame.object_count = static_cast<std::int32_t>(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      frame.object[i].X_TO = blocks[i].X_TO;
      frame.object[i].size_m = blocks[i].size_m;
    }
    feed(1.1);
  }

  ObjectState& block(int index) { return frame.object[static_cast<std::size_t>(index)]; }
  const Target& ring(int index) const { return director.board().targets[static_cast<std::size_t>(index)]; }
  double good_grip(int index) const { return (ring(index).band.low_n + ring(index).band.high_n) / 2; }
  double half_height() const { return exercise.grasp.block_m.z() / 2; }

  void feed(double seconds) {
    for (int i = 0, n = static_cast<int>(std::lround(seconds * 100)); i < n; ++i) {
      state.t_s = 0.01 * ++ticks_;
      director.update(state, &frame);
      TraceSample sample;
      sample.t_s = state.t_s;
      sample.tip_T = state.X_TI.p;
      sample.shaft_T = -Vec3::UnitZ();
      sample.grip_n = state.grip_force_n;
      trace.samples.push_back(sample);
    }
  }
  /// The tip goes there at 0.1 m/s, and what it holds with it.
  void glide(const Vec3& to) {
    const Vec3 from = state.X_TI.p;
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / 0.001)));
    for (int i = 1; i <= steps; ++i) {
      state.X_TI.p = from + (to - from) * i / steps;
      if (frame.held()) block(frame.grip_object).X_TO.p = state.X_TI.p;
      feed(0.01);
    }
  }
  void take(int index, double grip_n) {
    glide(block(index).X_TO.p);
    frame.grip = GripState::kHolding;
    frame.grip_object = index;
    frame.slipped_m = 0;
    block(index).motion = ObjectMotion::kHeld;
    state.grip_force_n = grip_n;
    feed(0.05);
  }
  void take(int index) { take(index, good_grip(index)); }
  /// Up, across and down to a place on the board; `lift_m` is the height under the block.
  void carry(const Vec3& to, double lift_m = 0.034) {
    glide(Vec3(state.X_TI.p.x(), state.X_TI.p.y(), half_height() + lift_m));
    glide(Vec3(to.x(), to.y(), half_height() + lift_m));
    glide(Vec3(to.x(), to.y(), half_height()));
  }
  /// Opens the jaws; the block falls, if it can, and rests.
  void let_go() {
    const int index = frame.grip_object;
    frame.grip = GripState::kEmpty;
    frame.grip_object = -1;
    state.grip_force_n = 0;
    block(index).motion = ObjectMotion::kMoving;
    feed(0.05);
    block(index).X_TO.p.z() = half_height();
    feed(0.05);
    block(index).motion = ObjectMotion::kResting;
    feed(0.05);
  }
  /// One faultless job.
  void place(int index) {
    take(index);
    carry(ring(index).centre_T);
    let_go();
  }
  void place_all() {
    for (int i = 0; i < frame.object_count; ++i) place(i);
  }

  int count(const std::string& type) const {
    return static_cast<int>(std::count_if(director.events().begin(), director.events().end(),
                                          [&](const Event& event) { return event.type == type; }));
  }
  /// Newest of a type; one without a type when there is none.
  Event last(const std::string& type) const {
    Event found;
    for (const Event& event : director.events())
      if (event.type == type) found = event;
    return found;
  }
  Grade grade(const std::vector<Event>& events) const {
    return score_attempt(trace, events, asked.rubric,
                         scoring_context(exercise, asked, director.board(), events, director.outcome()));
  }
  Grade grade() const { return grade(director.events()); }

  Exercise exercise;
  ExerciseLevel asked;
  Director director;
  StylusState state;
  TissueFrame frame;
  Trace trace;

 private:
  int ticks_ = 0;
};

}  // namespace trocar
