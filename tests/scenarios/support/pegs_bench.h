// Peg transfer without physics: a director that is told where each ring is and how hard the jaws hold, at 100 Hz, and a
// trace of it for scoring. Moves are told as they are seen: take, carry, let go, come to rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scenarios/director/director.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/pegs/pegs_layout.h"
#include "scenarios/scoring/score.h"
#include "tissue/tissue_frame.h"

namespace trocar {

inline Exercise peg_transfer() { return find_exercise("E05", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises"); }

class PegsBench {
 public:
  explicit PegsBench(const std::string& level = "L1", int board = 7)
      : exercise(peg_transfer()),
        asked(find_level(exercise, level)),
        director(exercise, asked, lay_out_pegs(exercise, asked, board)) {
    trace.rate_hz = 100;
    state.loop = LoopState::kActive;
    state.X_TI.p = director.board().start_T;
    const auto& rings = director.board().rigid.blocks;
    frame.object_count = static_cast<std::int32_t>(rings.size());
    for (std::size_t i = 0; i < rings.size(); ++i) {
      frame.object[i].X_TO = rings[i].X_TO;
      frame.object[i].size_m = rings[i].size_m;
    }
    feed(1.1);
  }

  ObjectState& ring(int index) { return frame.object[static_cast<std::size_t>(index)]; }
  const Target& goal(int transfer) const { return director.board().targets[static_cast<std::size_t>(transfer)]; }

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
      if (frame.held()) ring(frame.grip_object).X_TO.p = state.X_TI.p;
      feed(0.01);
    }
  }
  void take(int index, double grip_n = 2) {
    glide(ring(index).X_TO.p);
    frame.grip = GripState::kHolding;
    frame.grip_object = index;
    frame.slipped_m = 0;
    ring(index).motion = ObjectMotion::kHeld;
    state.grip_force_n = grip_n;
    feed(0.05);
  }
  /// Up, across, and down to a height of its middle over a place on the board.
  void carry(const Vec3& to, double down_to_m = 0.005) {
    glide(Vec3(state.X_TI.p.x(), state.X_TI.p.y(), kHigh));
    glide(Vec3(to.x(), to.y(), kHigh));
    glide(Vec3(to.x(), to.y(), down_to_m));
  }
  /// Opens the jaws; the ring falls, if it can, and rests at that height of its middle.
  void let_go(double rests_at_m = 0.005) {
    const int index = frame.grip_object;
    frame.grip = GripState::kEmpty;
    frame.grip_object = -1;
    state.grip_force_n = 0;
    ring(index).motion = ObjectMotion::kMoving;
    feed(0.05);
    ring(index).X_TO.p.z() = rests_at_m;
    feed(0.05);
    ring(index).motion = ObjectMotion::kResting;
    feed(0.05);
  }
  /// One faultless transfer.
  void transfer(int index) {
    take(index % frame.object_count);
    carry(goal(index).centre_T);
    let_go();
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

  static constexpr double kHigh = 0.039;  // m, of a ring's middle on its way
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
