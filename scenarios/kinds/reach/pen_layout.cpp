#include "scenarios/kinds/reach/pen_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/layout/board_random.h"

namespace trocar {
namespace {

constexpr int kPenDraws = 4000;

Vec3 tip_on_cap(const PenRules& pens, double relief_m, BoardRandom& random) {
  const double polar = std::acos(1 - random.uniform() * (1 - std::cos(pens.cap_rad)));
  const double round = 2 * std::numbers::pi * random.uniform();
  const Vec3 down(std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), -std::cos(polar));
  return Vec3(0, 0, pens.shell_radius_m - relief_m) + pens.shell_radius_m * down;
}

/// Rotation of the wanted instrument: the resting one swung (to the port's line, or freely by up to the tilt), then
/// rolled.
Mat3 pen_rotation(const PenRules& pens, const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& tip_T,
                  BoardRandom& random) {
  const double tilt = pens.tilt_rad * std::sqrt(random.uniform());
  const double towards = 2 * std::numbers::pi * random.uniform();
  const double roll = pens.roll_rad * (2 * random.uniform() - 1);
  const Mat3 rolled = Eigen::AngleAxisd(roll, Vec3::UnitZ()).toRotationMatrix();
  if (level.mapping == Mapping::kFulcrum) {
    const Vec3 axis = (tip_T - level.port_m).normalized();
    return least_turn(R_TI_rest.col(2), axis).toRotationMatrix() * R_TI_rest * rolled;
  }
  const Vec3 sideways(std::cos(towards), std::sin(towards), 0);
  return R_TI_rest * Eigen::AngleAxisd(tilt, sideways).toRotationMatrix() * rolled;
}

}  // namespace

Board lay_out_pens(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest, int board) {
  const TargetLayout& layout = exercise.layout;
  BoardRandom random(board);
  Board result;
  result.start_T = exercise.start_above_m;
  for (int draw = 0; draw < kPenDraws && static_cast<int>(result.targets.size()) < layout.count; ++draw) {
    const Vec3 tip = tip_on_cap(exercise.pens, layout.relief_m, random);
    const bool outside = std::abs(tip.x()) > layout.region_x_m / 2 || std::abs(tip.y()) > layout.region_y_m / 2 ||
                         std::abs(tip.z()) > layout.relief_m;
    const bool crowded = std::any_of(result.targets.begin(), result.targets.end(), [&](const Target& other) {
      return (other.centre_T - tip).norm() < layout.min_spacing_m;
    });
    if (outside || crowded) continue;
    const Mat3 R_TI = pen_rotation(exercise.pens, level, R_TI_rest, tip, random);
    result.targets.push_back({tip, -R_TI.col(2), level.position_tolerance_m, {}, R_TI});
  }
  if (static_cast<int>(result.targets.size()) < layout.count) {
    throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id + "': the cap has room for " +
                     std::to_string(result.targets.size()) + " of " + std::to_string(layout.count) + " pens");
  }
  return result;
}

}  // namespace trocar
