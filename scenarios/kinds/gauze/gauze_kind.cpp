#include "scenarios/kinds/gauze/gauze_kind.h"

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/kinds/gauze/gauze_layout.h"
#include "scenarios/kinds/gauze/gauze_reader.h"
#include "scenarios/kinds/gauze/gauze_rules.h"
#include "scenarios/kinds/gauze/gauze_task.h"
#include "scenarios/kinds/kind_parts.h"

namespace trocar {

KindDescription gauze_kind() {
  return {.kind = ExerciseKind::kGauze,
          .name = "gauze",
          .on_organ = true,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits = judge_hard_force,
          .read_targets =
              [](StrictTable& targets, TargetLayout& layout) {
                layout.max_slope_rad = targets.number("max_slope_deg", 1, 80) * file_units::kDegrees;
              },
          .read = read_gauze,
          .read_level = read_gauze_level,
          .lay_out = lay_out_gauze,
          .tasks = one_task<GauzeTask>,
          .account = account_held_targets};
}

}  // namespace trocar
