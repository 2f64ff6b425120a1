// The director: runs one exercise against what the instrument does. READY <-> ARMED -> RUN -> DONE | TIMEOUT | FAULT |
// VOID; waiting too long for the start is a TIMEOUT too, or VOID. ARMED: the tip rests in the start
// sphere (not the loop's ARMED).
//
// Called at the tissue rate (100 Hz) with the newest haptic state; emits cues (for screen and hand), events and the
// block between the jaws. A device that is switched off by its deadman during RUN would be a pause: the attempt is
// void. Knows nothing else of the device. Deterministic: same states in, same events out.
#pragma once

#include <array>
#include <bitset>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/stylus_state.h"
#include "scenarios/exercise.h"
#include "scenarios/hands/percept.h"
#include "scenarios/scoring/trace.h"
#include "tissue/rigid/rigid_scene.h"

namespace trocar {

struct TissueFrame;  // tissue/tissue_frame.h

/// One disc on the organ, or one pen to match.
struct Target {
  Vec3 centre_T = Vec3::Zero();  ///< of the disc; where the tip shall be
  Vec3 normal_T = Vec3::UnitZ();
  double radius_m = 0;           ///< of the disc; position tolerance of a pen
  WantedForce band = {};         ///< disc: wanted force
  Mat3 R_TI = Mat3::Identity();  ///< pen: wanted orientation of the instrument
};

/// A ball of other stiffness in tissue that gives way: it is felt and not seen.
struct HiddenNodule {
  Vec3 centre_T = Vec3::Zero();  ///< while the organ is at rest
  double radius_m = 0;
  double stiffness_ratio = 1;  ///< of its shear modulus to that of what is round it
};

/// Targets of one board, drawn by the board number as the exercise's kind lays them out.
struct Board {
  Vec3 centre_T = Vec3::Zero();       ///< centre of the region on the surface
  Vec3 start_T = Vec3::Zero();        ///< centre of the start sphere
  std::vector<Target> targets;        ///< discs, pens, or the rings in which blocks shall stand
  RigidScene rigid;                   ///< board, blocks, ring marks, port; empty on an organ
  std::vector<Vec3> wire_T;           ///< centre line from end to end; empty without
  std::vector<HiddenNodule> nodules;  ///< empty without
  /// Where the exercise's ducts run on this board, one path each; empty: as the exercise names them.
  std::vector<std::vector<Vec3>> ducts_T;
  std::vector<Board> stages;  ///< operation: of each stage; targets and ducts are theirs, one after the other
  double spacing_m = 0;       ///< least distance that the targets were laid out with; 0 where none was asked
  std::shared_ptr<const KindRules> own;  ///< what only its kind lays out, read with own_rules(); nullptr: nothing
};

enum class Phase : std::uint8_t { kReady, kArmed, kRun, kDone, kTimeout, kFault, kVoid };
/// Before the clock runs.
constexpr bool waits_for_start(Phase phase) { return phase == Phase::kReady || phase == Phase::kArmed; }

/// What is asked for at this moment: a place, perhaps an orientation, perhaps a force.
struct Demand {
  Vec3 centre_T = Vec3::Zero();
  Vec3 normal_T = Vec3::UnitZ();
  double radius_m = 0;    ///< of the place, or its tolerance
  bool oriented = false;  ///< R_TI counts
  Mat3 R_TI = Mat3::Identity();
  double angle_tolerance_rad = 0;
  WantedForce band;            ///< of contact force, or of grip while the cue asks to grip; 0 to 0: not told
  SeenObject object = {};      ///< to pick, carry and place
  Vec3 goal_T = Vec3::Zero();  ///< where it shall stand, or to where tissue shall be lifted
  std::optional<InstrumentKind> instrument = {};  ///< to be in hand for it; none: any
  std::array<FoamLore, kMostFoams> foam = {};
  std::int32_t foam_count = 0;
  std::array<Vec3, kMostAnswers> answers_T = {};  ///< where each symbol is told
};

inline constexpr int kMostMarks = 8;

/// What screen, hand and session see of the exercise at this moment.
struct DirectorStatus {
  Phase phase = Phase::kReady;
  Cue cue = Cue::kNone;
  Demand demand;
  bool force_shown = true;  ///< feedback mode of the level: the bar is visible now
  int target_index = -1;
  int targets_done = 0;
  std::bitset<32> done;      ///< of the board's targets: done for good
  double run_time_s = 0;     ///< since RUN began
  double hold_progress = 0;  ///< 0..1 of the present hold
  int wrong_places = 0, excess_forces = 0;
  int timeouts = 0;                                  ///< objects not done in their time
  double position_error_m = 0, angle_error_rad = 0;  ///< to the lit pen
  double horizon_rad = 0;                            ///< camera: roll of the picture against the theatre's up
  double exposure = 0;                               ///< retract: share of the hidden place that is to be seen, 0 to 1
  std::array<Vec3, kMostMarks> marks_T = {};         ///< palpate: places that were marked ...
  int mark_count = 0;                                ///< ... so many
  double peak_force_n = 0;
  GripBlock grip;                          ///< between the jaws now
  std::shared_ptr<const RingOnWire> ring;  ///< wire: the ring that the instrument holds; nullptr while it is off it
  int shown_symbol = -1;                   ///< find: which of the symbols is to be seen now
  std::string message, hint;               ///< toast, empty when none
  bool warning = false;
};

/// What becomes of an attempt whose tip never rests in the start sphere within the time limit.
enum class Unbegun : std::uint8_t {
  kTimeout,  ///< graded like any other that was not done
  kVoid      ///< not graded, and it does not count
};

class Director {
 public:
  Director(const Exercise& exercise, const ExerciseLevel& level, Board board, Unbegun unbegun = Unbegun::kTimeout);
  ~Director();
  Director(Director&&) noexcept;
  Director& operator=(Director&&) noexcept;

  /// Advances by one tissue period. @param state newest haptic state. @param tissue newest frame of the world's
  /// objects, nullptr when it has none.
  void update(const StylusState& state, const TissueFrame* tissue = nullptr);
  const DirectorStatus& status() const;
  const Board& board() const;
  /// Events so far, in order of time.
  const std::vector<Event>& events() const;
  bool finished() const;          ///< DONE, TIMEOUT, FAULT or VOID
  AttemptStatus outcome() const;  ///< kAborted while not finished

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
