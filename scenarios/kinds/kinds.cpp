#include "scenarios/kinds/kind.h"

#include <algorithm>

#include "scenarios/director/director.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/kinds/camera/camera_kind.h"
#include "scenarios/kinds/clip/clip_kind.h"
#include "scenarios/kinds/dissect/dissect_kind.h"
#include "scenarios/kinds/find/find_kind.h"
#include "scenarios/kinds/gauze/gauze_kind.h"
#include "scenarios/kinds/grasp/grasp_kind.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/needle/needle_kind.h"
#include "scenarios/kinds/operation/operation_kind.h"
#include "scenarios/kinds/palpate/palpate_kind.h"
#include "scenarios/kinds/pegs/pegs_kind.h"
#include "scenarios/kinds/reach/reach_kind.h"
#include "scenarios/kinds/retract/retract_kind.h"
#include "scenarios/kinds/touch/touch_kind.h"
#include "scenarios/kinds/wire/wire_kind.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {

const std::vector<KindDescription>& all_kinds() {
  static const std::vector<KindDescription> kinds{
      reach_kind(),   touch_kind(),   grasp_kind(), camera_kind(), pegs_kind(),   wire_kind(),    find_kind(),
      retract_kind(), palpate_kind(), clip_kind(),  gauze_kind(),  needle_kind(), dissect_kind(), operation_kind()};
  return kinds;
}

JudgedForces judge_hard_force(const Exercise& exercise, const ExerciseLevel&, const Board&, int) {
  return {exercise.hard_force_n, {}};
}

void read_places(StrictTable& targets, TargetLayout& layout) {
  layout.radius_m = targets.number("diameter_mm", 1, 50) / 2 * file_units::kMilli;
  layout.max_slope_rad = targets.number("max_slope_deg", 1, 80) * file_units::kDegrees;
}

void read_giving_tissue(StrictTable& document, Exercise& exercise) {
  if (exercise.is_stage) return;
  exercise.tissue = document.choice_or("tissue", {kTissueWords.begin() + 1, kTissueWords.end()}, kNormalTissue);
}

const KindDescription& kind_of(const Exercise& exercise) {
  return *std::find_if(all_kinds().begin(), all_kinds().end(),
                       [&](const KindDescription& kind) { return kind.kind == exercise.kind; });
}

const KindDescription* kind_named(const std::string& name) {
  for (const KindDescription& kind : all_kinds())
    if (name == kind.name) return &kind;
  return nullptr;
}

JudgedForces judged_forces(const Exercise& exercise, const ExerciseLevel& level, const Board& board) {
  return kind_of(exercise).limits(exercise, level, board, -1);
}

JudgedForces judged_forces(const Exercise& exercise, const ExerciseLevel& level, const Board& board,
                           const DirectorStatus& status) {
  return kind_of(exercise).limits(exercise, level, board, std::max(0, status.target_index));
}

WatchedForce watched_now(const Exercise& exercise, const DirectorStatus& status) {
  const bool grips = status.cue == Cue::kGrip || status.cue == Cue::kTake;
  return grips ? WatchedForce::kGrip : kind_of(exercise).watched;
}

bool judges_pull(const Exercise& exercise) {
  const KindDescription& kind = kind_of(exercise);
  return kind.jaws_hold && kind.watched == WatchedForce::kTip;
}

const Exercise& judged_part(const Exercise& exercise, std::string_view metric) {
  for (const ExerciseStage& stage : exercise.stages)
    if (metric.starts_with(stage_metric(stage.name, ""))) return *stage.exercise;
  return exercise;
}

bool hold_shown(const Exercise& exercise, const ExerciseLevel& level) {
  return kind_of(exercise).watched == WatchedForce::kNone || level.force_display != "after";
}

}  // namespace trocar
