#include "scenarios/kinds/camera/cup_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/input_error.h"
#include "scenarios/kinds/camera/cup.h"
#include "scenarios/kinds/camera/scope_view.h"
#include "scenarios/layout/board_random.h"

namespace trocar {
namespace {

constexpr int kDraws = 20000, kRestarts = 20;
constexpr double kCupsApart = 0.004;    // m between two cups
constexpr double kSightApart = 0.003;   // m between a line of sight and another cup
constexpr double kLensApart = 0.012;    // m between a lens in its place and any cup
constexpr double kFootOver = 0.004;     // m of a cup's foot over the plate
constexpr double kPlateMargin = 0.004;  // m within the plate's edge

/// Least distance of two segments, sampled: cups are coarse things.
double distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  constexpr int kSteps = 12;
  const Vec3 way = b1 - b0;
  double least = 1e9;
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 p = a0 + (a1 - a0) * (static_cast<double>(i) / kSteps);
    const double share = std::clamp((p - b0).dot(way) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - b0 - share * way).norm());
  }
  return least;
}

Vec3 drawn_axis(const CameraRules& rules, const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& lens_T,
                BoardRandom& random) {
  const double swing = rules.swing_rad * std::sqrt(random.uniform());
  const double towards = 2 * std::numbers::pi * random.uniform();
  if (level.mapping == Mapping::kFulcrum) return (lens_T - level.port_m).normalized();
  const Vec3 sideways(std::cos(towards), std::sin(towards), 0);
  return (R_TI_rest * Eigen::AngleAxisd(swing, sideways).toRotationMatrix()).col(2);
}

/// Do both have room, with what each is looked at along?
bool apart(const Target& a, const Cup& cup_a, const Target& b, const Cup& cup_b) {
  const double both = cup_a.outer_radius_m() + cup_b.outer_radius_m();
  const double one = cup_a.outer_radius_m();
  return distance(cup_a.foot_T(), cup_a.rim_T(), cup_b.foot_T(), cup_b.rim_T()) > both + kCupsApart &&
         distance(a.centre_T, cup_a.sphere_T, cup_b.foot_T(), cup_b.rim_T()) > one + kSightApart &&
         distance(b.centre_T, cup_b.sphere_T, cup_a.foot_T(), cup_a.rim_T()) > one + kSightApart &&
         cup_a.distance_m(b.centre_T) > kLensApart && cup_b.distance_m(a.centre_T) > kLensApart;
}

bool on_plate(const CameraRules& rules, const Cup& cup) {
  const double beside = std::sqrt(std::max(0.0, 1 - std::pow(cup.axis_T.z(), 2)));
  const double lowest = cup.foot_T().z() - beside * cup.outer_radius_m();
  const double reach = cup.foot_T().head<2>().cwiseAbs().maxCoeff() + cup.outer_radius_m();
  return lowest > rules.board_z_m + kFootOver && reach < rules.board_half_m - kPlateMargin;
}

std::vector<Target> drawn(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest,
                          BoardRandom& random) {
  const TargetLayout& layout = exercise.layout;
  const CameraRules& rules = own_rules<CameraRules>(exercise);
  std::vector<Target> targets;
  std::vector<Cup> cups;
  for (int draw = 0; draw < kDraws && static_cast<int>(targets.size()) < layout.count; ++draw) {
    const auto within = [&](double extent) { return (random.uniform() - 0.5) * extent; };
    Target target;
    target.centre_T.x() = within(layout.region_x_m);
    target.centre_T.y() = within(layout.region_y_m);
    target.centre_T.z() = within(2 * layout.relief_m);
    target.R_TI = level_instrument(drawn_axis(rules, level, R_TI_rest, target.centre_T, random));
    target.normal_T = -target.R_TI.col(2);
    const Cup cup = cup_of(target, rules, own_rules<CameraLevel>(level));
    if (cup.axis_T.z() > std::sin(rules.steepest_rad) || !on_plate(rules, cup)) continue;
    bool free = true;
    for (std::size_t i = 0; i < targets.size() && free; ++i)
      free = (targets[i].centre_T - target.centre_T).norm() >= layout.min_spacing_m &&
             apart(targets[i], cups[i], target, cup);
    if (!free) continue;
    targets.push_back(target);
    cups.push_back(cup);
  }
  return targets;
}

}  // namespace

Board lay_out_cups(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest, int board) {
  const CameraRules& rules = own_rules<CameraRules>(exercise);
  const auto wanted = static_cast<std::size_t>(exercise.layout.count);
  BoardRandom random(board);
  Board result;
  for (int n = 0; n < kRestarts && result.targets.size() < wanted; ++n) {
    std::vector<Target> targets = drawn(exercise, level, R_TI_rest, random);
    if (targets.size() > result.targets.size()) result.targets = std::move(targets);
  }
  if (result.targets.size() < wanted) {
    throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id + "', level " + level.name +
                     ": there is room for " + std::to_string(result.targets.size()) + " of " + std::to_string(wanted) +
                     " cups");
  }
  result.start_T = exercise.start_above_m;
  BoardPlate plate;
  plate.half_extent_m = rules.board_half_m;
  plate.top_z_m = rules.board_z_m;
  plate.material.stiffness_n_per_m = rules.board_stiffness_n_per_m;
  result.rigid.board = plate;
  return result;
}

}  // namespace trocar
