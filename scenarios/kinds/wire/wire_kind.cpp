#include "scenarios/kinds/wire/wire_kind.h"

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/wire/ring_task.h"
#include "scenarios/kinds/wire/wire_layout.h"
#include "scenarios/kinds/wire/wire_rules.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

void read_line(StrictTable table, WireRules& rules) {
  rules.radius_m = table.number("diameter_mm", 0.5, 20) / 2 * kMilli;
  rules.length_m = table.number("length_mm", 50, 1000) * kMilli;
  const auto [least, widest] = table.pair("bend_mm", 5, 200);
  rules.least_bend_m = least * kMilli;
  rules.widest_bend_m = widest * kMilli;
  if (widest < least) table.fail("bend_mm", "'bend_mm' must be [least, widest]");
  const auto [flat, steep] = table.pair("heading_deg", 5, 85);
  rules.least_heading_rad = flat * kDegrees;
  rules.most_heading_rad = steep * kDegrees;
  if (steep < flat) table.fail("heading_deg", "'heading_deg' must be [least, most]");
  rules.stiffness_n_per_m = table.number("stiffness_n_per_m", 10, 2000);
  rules.damping_s_per_m = table.number("damping_s_per_m", 0, 50);
  rules.holds_n = table.number("holds_n", 0.1, 20);
  rules.unhurried_s = table.number("unhurried_s", 0.1, 60);
  table.finish();
}

void read_ring(StrictTable table, WireRules& rules) {
  rules.ring_thickness_m = table.number("thickness_mm", 0.1, 10) * kMilli;
  rules.ring_turn_rad = table.number("turn_deg", -180, 180) * kDegrees;
  table.finish();
}

void read_wire(StrictTable& document, Exercise& exercise) {
  auto rules = std::make_shared<WireRules>();
  read_line(document.table("wire"), *rules);
  read_ring(document.table("ring"), *rules);
  exercise.counted_hold_s = rules->unhurried_s;
  exercise.own = std::move(rules);
}

void read_wire_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  auto asked = std::make_shared<WireLevel>(level.own ? own_rules<WireLevel>(level) : WireLevel{});
  double diameter = 2 * asked->ring_radius_m;
  keys.number("ring_diameter_mm", 1, 100, kMilli, diameter);
  asked->ring_radius_m = diameter / 2;
  if (asked->ring_radius_m <= own_rules<WireRules>(exercise).radius_m)
    keys.table.fail("ring_diameter_mm", "the wire does not fit into the ring");
  keys.number("angle_tolerance_deg", 0.5, 45, kDegrees, level.angle_tolerance_rad);
  level.position_tolerance_m = asked->ring_radius_m - own_rules<WireRules>(exercise).radius_m;
  level.own = std::move(asked);
}

Board wire_board(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_wire(exercise, level, place.R_TI_rest, board);
}

void account_gates(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  account_held_targets(board, events, context);
  context.ring_on_wire = true;
}

}  // namespace

KindDescription wire_kind() {
  return {.kind = ExerciseKind::kWire,
          .name = "wire",
          .on_organ = false,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kProbe,
          .watched = WatchedForce::kNone,
          .rolls_stylus = true,
          .read = read_wire,
          .read_level = read_wire_level,
          .lay_out = wire_board,
          .tasks = one_task<RingTask>,
          .account = account_gates};
}

}  // namespace trocar
