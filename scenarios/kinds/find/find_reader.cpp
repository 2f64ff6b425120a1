#include "scenarios/kinds/find/find_reader.h"

#include "scenarios/files/file_units.h"
#include "scenarios/kinds/find/find_rules.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

void read_flap(StrictTable table, FindRules& rules) {
  rules.reach_m = table.number("reach_mm", 1, 50) * kMilli;
  rules.edge_m = table.number("edge_mm", 0, 50) * kMilli;
  rules.seen_rad = table.number("seen_deg", 10, 90) * kDegrees;
  rules.pin_radius_m = table.number("pin_mm", 1, 20) / 2 * kMilli;
  rules.grip_low_n = table.number("grip_low_n", 0.1, 20);
  rules.grip_high_n = table.number("grip_high_n", 0.1, 20);
  rules.grip_most_n = table.number("grip_most_n", 0.1, 50);
  if (rules.grip_high_n <= rules.grip_low_n) table.fail("grip_high_n", "'grip_high_n' must be above 'grip_low_n'");
  if (rules.grip_most_n <= rules.grip_high_n) table.fail("grip_most_n", "'grip_most_n' must be above 'grip_high_n'");
  table.finish();
}

void read_answers(StrictTable table, FindRules& rules) {
  rules.answer_m = table.number("diameter_mm", 2, 30) / 2 * kMilli;
  rules.answer_hold_s = table.number("hold_s", 0.2, 10);
  rules.answers_before_m = table.number("before_mm", 0, 100) * kMilli;
  rules.answers_apart_m = table.number("apart_mm", 2, 100) * kMilli;
  rules.answers_above_m = table.number("above_mm", 0, 100) * kMilli;
  if (rules.answers_apart_m <= 2 * rules.answer_m) table.fail("apart_mm", "'apart_mm' lets the balls overlap");
  table.finish();
}

}  // namespace

void read_find(StrictTable& document, Exercise& exercise) {
  exercise.counted_hold_s = exercise.hold_s = document.number("hold_s", 0.5, 60);
  // Tissue that stands still has no flap.
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  if (!document.has("sheets")) document.fail("sheets", "a 'find' exercise needs 'sheets': the first is the flap");
  FindRules rules;
  read_flap(document.table("flap"), rules);
  read_answers(document.table("answers"), rules);
  exercise.own = std::make_shared<const FindRules>(rules);
}

void read_find_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  read_bands(keys, exercise, level);
}

}  // namespace trocar
