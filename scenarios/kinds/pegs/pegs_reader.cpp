#include "scenarios/kinds/pegs/pegs_reader.h"

#include <cmath>

#include "scenarios/files/file_units.h"
#include "scenarios/kinds/pegs/pegs_rules.h"
#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

using file_units::kMilli;

void read_posts(StrictTable table, PegsRules& rules) {
  rules.peg_radius_m = table.number("diameter_mm", 0.5, 20) / 2 * kMilli;
  rules.peg_height_m = table.number("height_mm", 5, 60) * kMilli;
  rules.rows = table.integer("rows", 1, 8);
  rules.columns = table.integer("columns", 1, 8);
  if (rules.rings() > kMaxObjects)
    table.fail("rows", "'rows' times 'columns' must be at most " + std::to_string(kMaxObjects));
  const auto [column, row] = table.pair("pitch_mm", 5, 100);
  rules.column_m = column * kMilli;
  rules.row_m = row * kMilli;
  table.finish();
}

void read_rings(StrictTable table, PegsRules& rules) {
  rules.ring_side_m = table.number("side_mm", 5, 60) * kMilli;
  rules.ring_height_m = table.number("height_mm", 2, 40) * kMilli;
  rules.hole_radius_m = table.number("hole_mm", 1, 40) / 2 * kMilli;
  rules.ring_mass_kg = table.number("mass_g", 0.1, 200) * kMilli;
  rules.ring_stiffness_n_per_m = table.number("stiffness_n_per_m", 10, 5000);
  rules.slip_below_n = table.number("slip_below_n", 0.1, 20);
  rules.mark_above_n = table.number("mark_above_n", 0.1, 50);
  const auto [gentlest, firmest] = table.pair("hold_with_n", 0.1, 50);
  rules.wanted = {gentlest, firmest};
  rules.lift_m = table.number("lift_mm", 1, 100) * kMilli;
  rules.drop_m = table.number("drop_mm", 0.5, 50) * kMilli;
  if (rules.hole_radius_m <= rules.peg_radius_m) table.fail("hole_mm", "the peg does not fit into 'hole_mm'");
  if (rules.hole_radius_m >= rules.ring_side_m / (2 * std::sqrt(3.0)))
    table.fail("hole_mm", "'hole_mm' is wider than the ring");
  if (rules.mark_above_n <= rules.slip_below_n)
    table.fail("mark_above_n", "'mark_above_n' must be above 'slip_below_n'");
  if (gentlest < rules.slip_below_n || firmest > rules.mark_above_n || firmest <= gentlest)
    table.fail("hold_with_n", "'hold_with_n' must rise, and lie between 'slip_below_n' and 'mark_above_n'");
  table.finish();
}

void read_plate(StrictTable table, PegsRules& rules) {
  rules.board_half_m = table.number("side_mm", 10, 400) / 2 * kMilli;
  rules.board_stiffness_n_per_m = table.number("stiffness_n_per_m", 10, 5000);
  rules.lost_margin_m = table.number("lost_beyond_mm", 0, 100) * kMilli;
  table.finish();
}

}  // namespace

void read_pegs(StrictTable& document, Exercise& exercise) {
  auto rules = std::make_shared<PegsRules>();
  read_posts(document.table("pegs"), *rules);
  read_rings(document.table("rings"), *rules);
  read_plate(document.table("board"), *rules);
  if (2 * rules->rings() != exercise.layout.count)
    document.fail("pegs", "twice 'rows' times 'columns' must be the 'count' of [targets]: every ring across and back");
  if (rules->lift_m < rules->peg_height_m) document.fail("rings", "'lift_mm' is lower than the pegs");
  exercise.own = std::move(rules);
}

void read_pegs_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  const auto& rules = own_rules<PegsRules>(exercise);
  auto asked = std::make_shared<PegsLevel>(level.own ? own_rules<PegsLevel>(level) : PegsLevel{});
  keys.number("least_gap_mm", 10, 200, kMilli, asked->least_gap_m);
  keys.number("widest_gap_mm", 10, 200, kMilli, asked->widest_gap_m);
  keys.number("place_tolerance_mm", 0.5, 20, kMilli, asked->place_tolerance_m);
  if (asked->widest_gap_m < asked->least_gap_m)
    keys.table.fail("widest_gap_mm", "'widest_gap_mm' must not be below 'least_gap_mm'");
  if (asked->widest_gap_m / 2 + (rules.columns - 1) * rules.column_m > rules.board_half_m)
    keys.table.fail("widest_gap_mm", "'widest_gap_mm' puts pegs outside the board");
  if (asked->place_tolerance_m > rules.hole_radius_m - rules.peg_radius_m)
    keys.table.fail("place_tolerance_mm", "'place_tolerance_mm' is wider than the play of a ring on its peg");
  level.own = std::move(asked);
}

}  // namespace trocar
