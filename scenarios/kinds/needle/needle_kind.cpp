#include "scenarios/kinds/needle/needle_kind.h"

#include <memory>
#include <tuple>

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/needle/needle_layout.h"
#include "scenarios/kinds/needle/needle_rules.h"
#include "scenarios/kinds/needle/needle_task.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

std::shared_ptr<const NeedleRules> read_rules(StrictTable table) {
  NeedleRules rules;
  rules.apart_m = table.number("apart_mm", 2, 40) * kMilli;
  rules.pair_gap_m = table.number("pair_gap_mm", 2, 40) * kMilli;
  std::tie(rules.grip_low_share, rules.grip_high_share) = table.pair("grip_from_point", 0.05, 0.95);
  if (rules.grip_high_share <= rules.grip_low_share)
    table.fail("grip_from_point", "'grip_from_point' must be [least, most]");
  rules.tip_grip_m = table.number("point_grip_mm", 0, 10) * kMilli;
  rules.tip_out_m = table.number("point_out_mm", 1, 20) * kMilli;
  rules.stand_m = table.vector("stand_mm", -100, 100) * kMilli;
  rules.most_lean_rad = table.number("most_lean_deg", 5, 89) * kDegrees;
  rules.turn_rad = table.number("turn_deg", 0, 90) * kDegrees;
  rules.shift_m = table.number("shift_mm", 0, 50) * kMilli;
  rules.field_m = table.number("field_mm", 20, 200) * kMilli;
  table.finish();
  return std::make_shared<const NeedleRules>(rules);
}

void read_needle(StrictTable& document, Exercise& exercise) {
  // What stands still takes no needle.
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  exercise.own = read_rules(document.table("needle"));
  if (exercise.layout.count < 2 || exercise.layout.count % 2 != 0)
    document.fail("targets", "'targets': 'count' must be even: a pair has two dots");
}

void read_needle_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  if (!exercise.suture) keys.table.fail("name", "the exercise needs a needle: [suture]");
  if (level.mapping != Mapping::kFulcrum)
    keys.table.fail("name", "a needle is driven through a port: mapping = \"fulcrum\"");
  const double radius_m = needle_of(exercise).radius_m();
  if (own_rules<NeedleRules>(exercise).apart_m >= 2 * radius_m)
    keys.table.fail("name", "the dots of a pair lie further apart than the needle's circle is wide");
  NeedleLevel own = level.own ? own_rules<NeedleLevel>(level) : NeedleLevel{};
  keys.number("tolerance_mm", 0.1, 20, kMilli, own.tolerance_m);
  level.own = std::make_shared<const NeedleLevel>(own);
}

/// A pair is one thing asked for.
void account_pairs(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  Board pairs = board;
  pairs.targets.resize(board.targets.size() / 2);
  account_held_targets(pairs, events, context);
}

}  // namespace

KindDescription needle_kind() {
  return {.kind = ExerciseKind::kNeedle,
          .name = "needle",
          .on_organ = true,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits = judge_hard_force,
          .read_targets = read_places,
          .read = read_needle,
          .read_level = read_needle_level,
          .lay_out = lay_out_needle,
          .tasks = one_task<NeedleTask>,
          .account = account_pairs};
}

}  // namespace trocar
