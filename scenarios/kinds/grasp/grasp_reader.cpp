#include "scenarios/kinds/grasp/grasp_reader.h"

#include "scenarios/files/file_units.h"
#include "scenarios/hands/percept.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

FoamKind read_foam(StrictTable table, const Vec3& block_m) {
  FoamKind kind;
  kind.name = table.text("name");
  kind.stiffness_n_per_m = table.number("stiffness_n_per_m", 10, 2000);
  kind.slip_below_n = table.number("slip_below_n", 0.1, 20);
  kind.crush_above_n = table.number("crush_above_n", 0.1, 50);
  if (kind.crush_above_n <= kind.slip_below_n)
    table.fail("crush_above_n", "'crush_above_n' must be above 'slip_below_n'");
  if (kind.crush_above_n / kind.stiffness_n_per_m > block_m.head<2>().minCoeff())
    table.fail("stiffness_n_per_m", "foam '" + kind.name + "' is too soft to be squeezed with 'crush_above_n'");
  table.finish();
  return kind;
}

void read_blocks(StrictTable table, GraspRules& rules) {
  rules.block_m = table.vector("size_mm", 2, 60) * kMilli;
  rules.block_mass_kg = table.number("mass_g", 0.1, 200) * kMilli;
  rules.rows = table.integer("rows", 1, 8);
  rules.columns = table.integer("columns", 1, 8);
  rules.row_m = table.number("row_mm", 1, 200) * kMilli;
  rules.column_m = table.number("column_mm", 1, 200) * kMilli;
  rules.lift_m = table.number("lift_mm", 1, 200) * kMilli;
  rules.carry_m = table.number("carry_mm", 1, 300) * kMilli;
  rules.ring_radius_m = table.number("ring_mm", 1, 100) / 2 * kMilli;
  rules.drop_m = table.number("drop_mm", 0.5, 50) * kMilli;
  rules.critical_crushed = table.integer("critical_crushed", 1, 100);
  for (StrictTable& kind : table.tables("kinds")) rules.kinds.push_back(read_foam(kind, rules.block_m));
  if (rules.kinds.size() > kMostFoams) table.fail("kinds", "at most " + std::to_string(kMostFoams) + " kinds of foam");
  const double widest = rules.block_m.head<2>().norm();
  if (rules.row_m < widest) table.fail("row_mm", "'row_mm' lets blocks overlap");
  if (rules.column_m < widest) table.fail("column_mm", "'column_mm' lets blocks overlap");
  table.finish();
}

void read_board(StrictTable table, GraspRules& rules) {
  rules.board_half_m = table.number("side_mm", 10, 400) / 2 * kMilli;
  rules.board_stiffness_n_per_m = table.number("stiffness_n_per_m", 10, 5000);
  rules.lost_margin_m = table.number("lost_beyond_mm", 0, 100) * kMilli;
  table.finish();
}

}  // namespace

void read_grasp(StrictTable& document, Exercise& exercise) {
  GraspRules& rules = exercise.grasp;
  StrictTable blocks = document.table("blocks");
  exercise.counted_hold_s = blocks.number_or("counted_carry_s", 0.1, 60, 0);  // files of before it was graded by block
  read_blocks(std::move(blocks), rules);
  read_board(document.table("board"), rules);
  if (rules.rows * rules.columns != exercise.layout.count)
    document.fail("blocks", "'rows' times 'columns' must be the 'count' of [targets]");
}

void read_grasp_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& of) {
  const GraspRules& rules = exercise.grasp;
  GraspLevel& level = of.grasp;
  StrictTable& table = keys.table;
  level.colour_cue = table.flag_or("colour_cue", level.colour_cue);
  keys.number("window_margin", 0, 0.9, 1, level.window_margin);
  keys.number("place_tolerance_mm", 0.5, 50, kMilli, level.place_tolerance_m);
  keys.number("yaw_deg", -180, 180, kDegrees, level.yaw_rad);
  keys.number("yaw_spread_deg", 0, 45, kDegrees, level.yaw_spread_rad);
  keys.number("place_spread_mm", 0, 20, kMilli, level.place_spread_m);
  if (level.place_tolerance_m > rules.ring_radius_m)
    table.fail("place_tolerance_mm", "'place_tolerance_mm' is wider than the ring");
  for (const FoamKind& kind : rules.kinds) {
    const GripWindow window = grip_window(kind, level);
    if (window.high_n <= window.low_n)
      table.fail("window_margin", "'window_margin' leaves no grip for foam '" + kind.name + "'");
  }
}

}  // namespace trocar
