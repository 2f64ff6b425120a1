#include "scenarios/kinds/palpate/palpate_reader.h"

#include "scenarios/director/director.h"
#include "scenarios/files/file_units.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/palpate/palpate_rules.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

void read_nodules(StrictTable table, PalpateRules& rules) {
  for (const auto& [diameter, top] : table.pairs("diameter_top_mm", 0.5, 60))
    rules.nodules.push_back({diameter / 2 * kMilli, top * kMilli});
  rules.hit_m = table.number("hit_mm", 0, 30) * kMilli;
  table.finish();
}

void read_mark(StrictTable table, PalpateRules& rules) {
  rules.mark_n = table.number("pinch_n", 0.05, 20);
  rules.mark_hold_s = table.number("hold_s", 0.1, 10);
  rules.still_m = table.number("still_mm", 0.5, 30) * kMilli;
  rules.pad_thickness_m = table.number("pad_mm", 0.5, 18) * kMilli;
  rules.pad_n_per_m = table.number("pad_n_per_m", 10, 5000);
  if (2 * rules.mark_n / rules.pad_n_per_m > rules.pad_thickness_m)
    table.fail("pad_mm", "the pad is too thin to be squeezed with twice 'pinch_n'");
  table.finish();
}

void read_search(StrictTable table, const Exercise& exercise, PalpateRules& rules) {
  const auto [low, high] = table.pair("press_n", 0.01, 50);
  if (high <= low) table.fail("press_n", "'press_n' must be [low, high] with low below high");
  if (high > exercise.hard_force_n) table.fail("press_n", "'press_n' reaches above 'hard_n'");
  rules.press_low_n = low;
  rules.press_high_n = high;
  rules.searched_cell_m = table.number("cell_mm", 2, 100) * kMilli;
  rules.searched_n = table.number("searched_n", 0.01, 20);
  table.finish();
}

}  // namespace

void read_nodule_places(StrictTable& table, TargetLayout& layout) {
  layout.radius_m = table.number("margin_mm", 0.5, 60) * kMilli;
  layout.max_slope_rad = table.number("max_slope_deg", 1, 80) * kDegrees;
  if (layout.min_spacing_m < 2 * layout.radius_m)
    table.fail("min_spacing_mm", "'min_spacing_mm' must be at least twice 'margin_mm'");
}

void read_palpate(StrictTable& document, Exercise& exercise) {
  auto rules = std::make_shared<PalpateRules>();
  read_giving_tissue(document, exercise);
  read_nodules(document.table("nodules"), *rules);
  read_mark(document.table("mark"), *rules);
  read_search(document.table("search"), exercise, *rules);
  if (static_cast<int>(rules->nodules.size()) != exercise.layout.count)
    document.fail("nodules", "'diameter_top_mm' must have as many entries as 'count' of [targets] says");
  if (exercise.layout.count > kMostMarks)
    document.fail("targets", "'count': at most " + std::to_string(kMostMarks) + " nodules can be marked");
  exercise.own = std::move(rules);
}

void read_palpate_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& of) {
  auto level = std::make_shared<PalpateLevel>(of.own ? own_rules<PalpateLevel>(of) : PalpateLevel());
  keys.number("ratio", 1.01, 50, 1, level->ratio);
  level->decoys = keys.table.integer_or("decoys", 0, kMostMarks, level->decoys);
  level->decoy_ratio = keys.table.number_or("decoy_ratio", 1, 50, level->decoy_ratio);
  level->found_shown = keys.table.flag_or("found_shown", level->found_shown);
  if (level->decoy_ratio >= level->ratio)
    keys.table.fail("decoy_ratio", "'decoy_ratio' must be below 'ratio': what is not to be marked is less stiff");
  const PalpateRules& rules = own_rules<PalpateRules>(exercise);
  of.bands = {{rules.press_low_n, rules.press_high_n}};
  of.band_low_n = rules.press_low_n;
  of.band_high_n = rules.press_high_n;
  of.own = std::move(level);
}

}  // namespace trocar
