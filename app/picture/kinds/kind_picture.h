// What picture and display show of a kind of exercise: one table, one source a kind.
//
// Frame T, m. Pure: same moment, same picture. Thread: any.
#pragma once

#include <vector>

#include "app/picture/scene/scene_view.h"
#include "app/session/session.h"
#include "scenarios/kinds/kind.h"

namespace trocar {

/// How far a run is: for the list of steps.
struct RunStage {
  bool started = false;  ///< the clock runs, or has run
  bool targets = false;  ///< all are done
  bool done = false;     ///< the run itself
};

struct KindPicture {
  ExerciseKind kind;
  /// After the rest at the start.
  std::vector<HudStep> (*steps)(const RunStage&);
  std::vector<HudRow> (*rows)(const Scene&, const DirectorStatus&);
  std::vector<ForceBar> (*bars)(const SessionView&);
  /// Beside organ, discs, board and blocks, which every picture has of its scene.
  void (*add_objects)(const SessionView&, std::vector<SceneObject>&);
  /// Everything that must be in the field; empty: the region on the organ.
  Eigen::AlignedBox3d (*work)(const Scene&);
  /// A moment that tells what is done here, once half of the targets are.
  bool (*telling)(const SessionView&);
  /// The instrument is the scope: what it sees from there. nullptr: somebody else holds the scope.
  Camera (*sees)(const Scene&, const Pose& X_TI) = nullptr;
  /// On the organ, beside the board's targets; nullptr: nothing.
  void (*add_marks)(const SessionView&, std::vector<TargetMark>&) = nullptr;
};

const KindPicture& picture_of(const Exercise&);

}  // namespace trocar
