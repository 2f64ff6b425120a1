// The director: runs one exercise against what the instrument does. READY -> ARMED -> RUN -> DONE | TIMEOUT | FAULT.
//
// Called at the tissue rate (100 Hz) with the newest haptic state; emits cues (for screen and hand), events and the
// block between the jaws. Knows nothing of the device. Deterministic: same states in, same events out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptics/device/hand.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/stylus_state.h"
#include "scenarios/exercise.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// One disc on the organ.
struct Target {
  Vec3 centre_T = Vec3::Zero();
  Vec3 normal_T = Vec3::UnitZ();
  double radius_m = 0;
};

/// Targets of one board, drawn by the board number (board_layout.h).
struct Board {
  Vec3 centre_T = Vec3::Zero();        ///< centre of the region on the surface
  Vec3 start_T = Vec3::Zero();         ///< centre of the start sphere
  std::vector<Target> targets;
};

enum class Phase : std::uint8_t { kReady, kArmed, kRun, kDone, kTimeout, kFault };

/// What screen, hand and session see of the exercise at this moment.
struct DirectorStatus {
  Phase phase = Phase::kReady;
  Cue cue = Cue::kNone;
  int target_index = -1;
  int targets_done = 0;
  double run_time_s = 0;               ///< since RUN began
  double hold_progress = 0;            ///< 0..1 of the present hold
  int wrong_places = 0, excess_forces = 0;
  double peak_force_n = 0;
  GripBlock grip;                      ///< between the jaws now
  std::string message, hint;           ///< toast, empty when none
  bool warning = false;
};

class Director {
 public:
  Director(const Exercise& exercise, const ExerciseLevel& level, Board board);
  ~Director();
  Director(Director&&) noexcept;

  /// Advances by one tissue period. @param state newest haptic state.
  void update(const StylusState& state);
  const DirectorStatus& status() const;
  const Board& board() const;
  /// Events so far, in order of time.
  const std::vector<Event>& events() const;
  bool finished() const;               ///< DONE, TIMEOUT or FAULT
  AttemptStatus outcome() const;       ///< kAborted while not finished

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
