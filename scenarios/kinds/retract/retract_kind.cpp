#include "scenarios/kinds/retract/retract_kind.h"

#include <memory>

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/retract/retract_rules.h"
#include "scenarios/kinds/retract/retract_task.h"
#include "scenarios/kinds/touch/disc_layout.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kMilli;

std::shared_ptr<const RetractRules> read_rules(StrictTable table) {
  RetractRules rules;
  rules.reach_m = table.number("reach_mm", 1, 50) * kMilli;
  rules.exposed_share = table.number("exposed_share", 0.1, 1);
  rules.too_hard_share = table.number("too_hard_share", 0.01, 1);
  rules.grip_low_n = table.number("grip_low_n", 0.1, 20);
  rules.grip_high_n = table.number("grip_high_n", 0.1, 20);
  rules.grip_critical_n = table.number("grip_critical_n", 0.1, 50);
  if (rules.grip_high_n <= rules.grip_low_n) table.fail("grip_high_n", "'grip_high_n' must be above 'grip_low_n'");
  if (rules.grip_critical_n <= rules.grip_high_n)
    table.fail("grip_critical_n", "'grip_critical_n' must be above 'grip_high_n'");
  table.finish();
  return std::make_shared<const RetractRules>(rules);
}

void read_retract(StrictTable& document, Exercise& exercise) {
  exercise.counted_hold_s = exercise.hold_s = document.number("hold_s", 0.5, 120);
  // Tissue that stands still cannot be lifted.
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  exercise.own = read_rules(document.table("retract"));
}

void read_retract_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  read_bands(keys, exercise, level);
  RetractLevel own = level.own ? own_rules<RetractLevel>(level) : RetractLevel{};
  keys.number("lift_mm", 0.5, 60, kMilli, own.lift_m);
  level.own = std::make_shared<const RetractLevel>(own);
}

Board lay_out_retract(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_discs(place.organ_T, exercise, level, board, place.behind_tip, place.strands_T);
}

std::vector<std::unique_ptr<ExerciseTask>> retract_tasks(const Exercise& exercise, const ExerciseLevel& level,
                                                         const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  tasks.push_back(std::make_unique<RetractTask>(exercise, level, board.targets));
  return tasks;
}

}  // namespace

KindDescription retract_kind() {
  return {.kind = ExerciseKind::kRetract,
          .name = "retract",
          .on_organ = true,
          .oriented = false,
          .jaws_hold = true,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits =
              [](const Exercise& exercise, const ExerciseLevel&, const Board&, int) {
                return JudgedForces{exercise.hard_force_n, own_rules<RetractRules>(exercise).grip_critical_n};
              },
          .read_targets = read_discs,
          .read = read_retract,
          .read_level = read_retract_level,
          .lay_out = lay_out_retract,
          .tasks = retract_tasks,
          .account = account_held_targets};
}

}  // namespace trocar
