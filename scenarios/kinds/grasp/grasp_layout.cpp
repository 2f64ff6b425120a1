#include "scenarios/kinds/grasp/grasp_layout.h"

#include "scenarios/layout/board_random.h"

namespace trocar {
namespace {

constexpr std::int32_t kNeutralColour = -1;

FoamBlock block_of(const GraspRules& rules, const GraspLevel& level, std::int32_t kind) {
  const FoamKind& foam = rules.kinds[static_cast<std::size_t>(kind)];
  FoamBlock block;
  block.size_m = rules.block_m;
  block.mass_kg = rules.block_mass_kg;
  block.stiffness_n_per_m = foam.stiffness_n_per_m;
  block.slip_below_n = foam.slip_below_n;
  block.crush_above_n = foam.crush_above_n;
  block.kind = kind;
  block.colour = level.colour_cue ? kind : kNeutralColour;
  return block;
}

struct Place {
  double x = 0, y = 0;
};

/// Middles of the blocks, row by row; block and ring lie symmetrically about the board's middle.
std::vector<Place> places_of(const GraspRules& rules) {
  std::vector<Place> places;
  for (int row = 0; row < rules.rows; ++row) {
    for (int column = 0; column < rules.columns; ++column) {
      places.push_back({-rules.carry_m / 2 + (column - (rules.columns - 1) / 2.0) * rules.column_m,
                        (row - (rules.rows - 1) / 2.0) * rules.row_m});
    }
  }
  return places;
}

}  // namespace

Board lay_out_blocks(const Exercise& exercise, const ExerciseLevel& level, int board) {
  const GraspRules& rules = exercise.grasp;
  const GraspLevel& asked = level.grasp;
  BoardRandom random(board);
  std::vector<Place> places = places_of(rules);
  std::vector<std::int32_t> kinds;
  for (std::size_t i = 0; i < places.size(); ++i) kinds.push_back(static_cast<std::int32_t>(i % rules.kinds.size()));
  random.shuffle(places);
  random.shuffle(kinds);

  Board result;
  result.start_T = exercise.start_above_m;
  BoardPlate plate;
  plate.half_extent_m = rules.board_half_m;
  plate.material.stiffness_n_per_m = rules.board_stiffness_n_per_m;
  result.rigid.board = plate;
  const auto spread = [&](double half) { return (2 * random.uniform() - 1) * half; };
  for (std::size_t i = 0; i < places.size(); ++i) {
    FoamBlock block = block_of(rules, asked, kinds[i]);
    const double yaw = asked.yaw_rad + spread(asked.yaw_spread_rad);
    block.X_TO.R = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
    const Vec3 shift(spread(asked.place_spread_m), spread(asked.place_spread_m), 0);
    block.X_TO.p = Vec3(places[i].x, places[i].y, rules.block_m.z() / 2) + shift;
    const Vec3 ring = Vec3(places[i].x + rules.carry_m, places[i].y, 0) +
                      Vec3(spread(asked.place_spread_m), spread(asked.place_spread_m), 0);
    result.rigid.blocks.push_back(block);
    result.rigid.rings.push_back({ring, rules.ring_radius_m, block.colour});
    const GripWindow window = grip_window(rules.kinds[static_cast<std::size_t>(kinds[i])], asked);
    Target target;
    target.centre_T = ring;
    target.radius_m = asked.place_tolerance_m;
    target.band = {window.low_n, window.high_n};
    result.targets.push_back(target);
  }
  return result;
}

}  // namespace trocar
