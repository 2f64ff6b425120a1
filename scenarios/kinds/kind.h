// What a kind of exercise is: the answers that the rest of the program asks for, and the steps in which kinds differ.
//
// Each kind describes itself in its own room, kinds/<kind>/<kind>_kind.cpp; kinds.cpp lists them. Nothing outside the
// rooms asks which kind an exercise is of: it asks for a value below. Frame T, SI units. Thread: constants; the steps
// say theirs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/exercise.h"
#include "scenarios/scoring/scoring_context.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

class ExerciseTask;     // scenarios/director/exercise_task.h
class ShaftRoom;        // scenarios/layout/shaft_room.h
class StrictTable;      // scenarios/files/strict_toml.h
struct Board;           // scenarios/director/director.h
struct DirectorStatus;  // the same
struct LevelKeys;       // scenarios/files/level_keys.h
struct TriangleSurface;

/// The force that bars, plots, tones and the desk watch, but while a cue asks to grip or take: then it is the grip's.
enum class WatchedForce : std::uint8_t { kNone, kTip, kGrip };

enum class ToolKind : std::uint8_t { kProbe, kGrasper };

/// Above these a force is far too much, N; nothing: that force is not judged.
struct JudgedForces {
  std::optional<double> tip_n, grip_n;
};

/// Where a board is laid out.
struct BoardPlace {
  const TriangleSurface& organ_T;         ///< without triangles where there is no organ
  const ShaftRoom* behind_tip = nullptr;  ///< room for the shaft; nullptr: only the tip is asked for
  Mat3 R_TI_rest = Mat3::Identity();      ///< instrument while the device rests
  std::span<const Vec3> strands_T = {};   ///< places of what other stages stretch over the organ
};

struct KindDescription {
  ExerciseKind kind;
  const char* name;  ///< in exercise files
  bool on_organ;     ///< else on a board in a box trainer
  bool
      oriented;  ///< a target has an orientation and is approached along it; else from above, the instrument as at rest
  bool jaws_hold;  ///< objects of the world lie between the jaws
  ToolKind tool;
  WatchedForce watched;
  bool rolls_stylus = false;  ///< without a port, the instrument has to be rolled about its shaft as through one
  /// @param lit -1: of all objects
  JudgedForces (*limits)(const Exercise&, const ExerciseLevel&, const Board&, int lit) =
      [](const Exercise&, const ExerciseLevel&, const Board&, int) { return JudgedForces{}; };

  // While loading. The keys of [targets], of the document and of a level that only this kind has.
  void (*read_targets)(StrictTable& targets, TargetLayout&) = [](StrictTable&, TargetLayout&) {};
  void (*read)(StrictTable& document, Exercise&);
  void (*read_level)(LevelKeys&, const Exercise&, ExerciseLevel&);
  Board (*lay_out)(const Exercise&, const ExerciseLevel&, int board, const BoardPlace&);

  /// The parts of a run in their order; they keep copies of what they need.
  std::vector<std::unique_ptr<ExerciseTask>> (*tasks)(const Exercise&, const ExerciseLevel&, const Board&);
  /// For scoring: objects asked for and done, and the ideal way past those that were done.
  void (*account)(const Board&, const std::vector<Event>&, ScoringContext&);
  /// For scoring: what metrics need of the exercise's own rules.
  void (*account_rules)(const Exercise&, ScoringContext&) = [](const Exercise&, ScoringContext&) {};
};

/// All kinds, in the order of their exercises.
const std::vector<KindDescription>& all_kinds();
const KindDescription& kind_of(const Exercise&);
/// As exercise files name it; nullptr: none.
const KindDescription* kind_named(const std::string& name);

/// Limits of the exercise as a whole: of its hardest object.
JudgedForces judged_forces(const Exercise&, const ExerciseLevel&, const Board&);
/// Limits that hold now. Where nothing tells the trainee what the lit object bears, they are those of the hardest.
JudgedForces judged_forces(const Exercise&, const ExerciseLevel&, const Board&, const DirectorStatus&);
/// The force that is judged now. Who is judged at which limit: judged_forces() of this.
WatchedForce watched_now(const Exercise&, const DirectorStatus&);
/// The force of the tip that is judged is the pull of tissue in the jaws, not a press.
bool judges_pull(const Exercise&);
/// The stage of an operation that a metric is of, by its name; of the whole: the exercise itself.
const Exercise& judged_part(const Exercise&, std::string_view metric);
/// May the progress of a hold be seen during the run? Where the force is hidden it would tell that it is right.
bool hold_shown(const Exercise&, const ExerciseLevel&);

}  // namespace trocar
