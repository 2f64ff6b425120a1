#include "scenarios/kinds/gauze/gauze_reader.h"

#include <algorithm>

#include "scenarios/files/file_units.h"
#include "scenarios/kinds/gauze/gauze_rules.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

constexpr double kBesideLine = 0.010;  // m of gauze that a line leaves at the rim

GauzeRules read_line(StrictTable table) {
  GauzeRules rules;
  rules.step_m = table.number("step_mm", 1, 20) * kMilli;
  rules.line_m = table.number("line_mm", 0.2, 5) * kMilli;
  std::tie(rules.press_low_n, rules.press_high_n) = table.pair("press_n", 0.05, 10);
  if (rules.press_high_n <= rules.press_low_n) table.fail("press_n", "'press_n' must be [least, most]");
  rules.most_pull_n = table.number("pull_n", 0.1, 20);
  if (rules.most_pull_n <= rules.press_high_n) table.fail("pull_n", "'pull_n' must be above 'press_n'");
  rules.shift_m = table.number("shift_mm", 0, 30) * kMilli;
  rules.way_in_rad = table.number("way_in_deg", 0, 45) * kDegrees;
  table.finish();
  return rules;
}

}  // namespace

void read_gauze(StrictTable& document, Exercise& exercise) {
  // What stands still cannot be cut.
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  if (!document.has("sheets")) document.fail("sheets", "a 'gauze' exercise needs 'sheets': the first is the gauze");
  exercise.own = std::make_shared<const GauzeRules>(read_line(document.table("line")));
}

void read_gauze_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  const SheetPlan& plan = exercise.sheets.front();
  if (!plan.organ.empty()) keys.table.fail("name", "the gauze must name no 'organ': it is spread in a frame");
  GauzeLevel own = level.own ? own_rules<GauzeLevel>(level) : GauzeLevel{};
  keys.number("long_mm", 10, 100, kMilli, own.long_m);
  keys.number("across_mm", 10, 100, kMilli, own.across_m);
  keys.number("off_mm", 0.1, 10, kMilli, own.off_m);
  if (own.across_m > own.long_m) keys.table.fail("across_mm", "'across_mm' must not be above 'long_mm'");
  const double room = std::min(plan.along_m.norm(), plan.across_m) - 2 * own_rules<GauzeRules>(exercise).shift_m;
  if (own.long_m > room - 2 * kBesideLine) keys.table.fail("long_mm", "the gauze has no room for 'long_mm'");
  level.own = std::make_shared<const GauzeLevel>(own);
}

}  // namespace trocar
