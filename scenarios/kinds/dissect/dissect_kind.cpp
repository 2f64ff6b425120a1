#include "scenarios/kinds/dissect/dissect_kind.h"

#include <memory>

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/dissect/dissect_layout.h"
#include "scenarios/kinds/dissect/dissect_rules.h"
#include "scenarios/kinds/dissect/dissect_task.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

std::shared_ptr<const DissectRules> read_dissect_rules(StrictTable table, int strands) {
  DissectRules rules;
  rules.strands = strands;
  std::tie(rules.bed_along_m, rules.bed_across_m) = table.pair("bed_mm", 10, 200);
  rules.bed_along_m *= kMilli;
  rules.bed_across_m *= kMilli;
  rules.span_m = table.number("span_mm", 10, 60) * kMilli;
  rules.bow_m = table.number("bow_mm", 0, 20) * kMilli;
  rules.lift_m = table.number("lift_mm", 0.5, 30) * kMilli;
  rules.near_m = table.number("near_mm", 0, 20) * kMilli;
  if (rules.near_m >= rules.lift_m) table.fail("near_mm", "'near_mm' must be below 'lift_mm'");
  rules.forgiven_s = table.number("forgiven_s", 0, 5);
  rules.counted_s = table.number("counted_s", 0.1, 20);
  rules.beside_m = table.number("beside_mm", 1, 20) * kMilli;
  rules.field_m = table.number("field_mm", 10, 200) * kMilli;
  rules.seal_s = table.number("seal_s", 1, 60);
  rules.vessel_radius_m = table.number("vessel_mm", 0.1, 2.5) / 2 * kMilli;
  rules.feed_m = table.number("feed_mm", 1, 1000) * kMilli;
  rules.perforated_m2 = table.number("perforated_mm2", 0, 1000) * kMilli * kMilli;
  rules.turn_rad = table.number("turn_deg", 0, 60) * kDegrees;
  rules.shift_m = table.number("shift_mm", 0, 50) * kMilli;
  table.finish();
  return std::make_shared<const DissectRules>(rules);
}

void read_dissect(StrictTable& document, Exercise& exercise) {
  // Strands on an organ that stands still cannot be lifted, and nothing bleeds there.
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  exercise.own = read_dissect_rules(document.table("dissect"), static_cast<int>(exercise.ducts.size()));
  const int vessels = exercise.layout.count - static_cast<int>(exercise.ducts.size());
  if (exercise.ducts.empty() || vessels < 0 || vessels > kMostSpurters)
    document.fail("targets", "'count' must be that of the strands, which are the 'ducts', and of up to three vessels");
}

/// Strands are counted by themselves.
void account_strands(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  account_held_targets(board, events, context);
  context.strands_total = static_cast<int>(board.ducts_T.size());
}

}  // namespace

KindDescription dissect_kind() {
  return {.kind = ExerciseKind::kDissect,
          .name = "dissect",
          .on_organ = true,
          .oriented = false,
          .jaws_hold = false,
          .tool = ToolKind::kProbe,
          .watched = WatchedForce::kTip,
          .limits = judge_hard_force,
          .read_targets = read_places,
          .read = read_dissect,
          .read_level = [](LevelKeys&, const Exercise&, ExerciseLevel&) {},
          .lay_out = lay_out_dissection,
          .tasks = one_task<DissectTask>,
          .account = account_strands,
          .account_rules =
              [](const Exercise& exercise, ScoringContext& context) {
                context.strand_lift_m = own_rules<DissectRules>(exercise).lift_m;
              }};
}

}  // namespace trocar
