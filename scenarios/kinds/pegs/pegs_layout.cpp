#include "scenarios/kinds/pegs/pegs_layout.h"

#include <cmath>
#include <numbers>

#include "scenarios/kinds/pegs/pegs_rules.h"
#include "scenarios/layout/board_random.h"

namespace trocar {
namespace {

/// Feet of the pegs of one side, column by column from the middle outwards. @param side -1 left, 1 right
std::vector<Vec3> side_of(const PegsRules& rules, double gap_m, double side) {
  std::vector<Vec3> feet;
  for (int column = 0; column < rules.columns; ++column) {
    const double stagger = (column % 2 - (rules.columns > 1 ? 0.5 : 0)) * rules.row_m / 2;
    for (int row = 0; row < rules.rows; ++row)
      feet.emplace_back(side * (gap_m / 2 + column * rules.column_m),
                        (row - (rules.rows - 1) / 2.0) * rules.row_m + stagger, 0);
  }
  return feet;
}

FoamBlock ring_of(const PegsRules& rules) {
  const double height = rules.ring_side_m * std::sqrt(3.0) / 2;
  FoamBlock ring;
  ring.size_m = {height, height, rules.ring_height_m};
  ring.hole_radius_m = rules.hole_radius_m;
  ring.mass_kg = rules.ring_mass_kg;
  ring.stiffness_n_per_m = rules.ring_stiffness_n_per_m;
  ring.slip_below_n = rules.slip_below_n;
  ring.crush_above_n = rules.mark_above_n;
  ring.crushed_thickness = ring.crushed_stiffness = 1;  // rubber: it is marked, and springs back
  return ring;
}

}  // namespace

Board lay_out_pegs(const Exercise& exercise, const ExerciseLevel& level, int board) {
  const auto& rules = own_rules<PegsRules>(exercise);
  const auto& asked = own_rules<PegsLevel>(level);
  BoardRandom random(board);
  const double gap = asked.least_gap_m + random.uniform() * (asked.widest_gap_m - asked.least_gap_m);
  std::vector<Vec3> left = side_of(rules, gap, -1), right = side_of(rules, gap, 1);

  Board result;
  result.start_T = exercise.start_above_m;
  BoardPlate plate;
  plate.half_extent_m = rules.board_half_m;
  plate.material.stiffness_n_per_m = rules.board_stiffness_n_per_m;
  result.rigid.board = plate;
  for (const std::vector<Vec3>& side : {left, right})
    for (const Vec3& foot : side) result.rigid.pegs.push_back({foot, rules.peg_radius_m, rules.peg_height_m});

  random.shuffle(left);
  random.shuffle(right);
  for (const Vec3& foot : left) {
    FoamBlock ring = ring_of(rules);
    const double turn = random.uniform() * 2 * std::numbers::pi / 3;
    ring.X_TO = {Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix(), foot + Vec3(0, 0, rules.ring_height_m / 2)};
    result.rigid.blocks.push_back(ring);
  }
  for (const std::vector<Vec3>& side : {right, left}) {
    for (const Vec3& foot : side) {
      Target target;
      target.centre_T = foot;
      target.radius_m = asked.place_tolerance_m;
      target.band = rules.wanted;
      result.targets.push_back(target);
    }
  }
  return result;
}

}  // namespace trocar
