#include "scenarios/kinds/needle/needle_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/layout/board_random.h"
#include "scenarios/layout/height_field.h"
#include "scenarios/layout/target_ground.h"
#include "tissue/interaction/suturing.h"

namespace trocar {
namespace {

constexpr int kNeedleDraws = 1000;
constexpr double kShaftGap = 0.0025;   // m between organ and shaft with the tip on a dot: it goes down as it rolls
constexpr double kBeforeEntry = 0.25;  // rad by which a needle in the stand is turned back from where it goes in

Vec3 across(const Vec3& v, const Vec3& axis) { return (v - v.dot(axis) * axis).normalized(); }

/// The shaft from the port to a place, by the least turn.
Mat3 swung_to(const Mat3& R_TI, const Vec3& port_T, const Vec3& place_T) {
  return least_turn(R_TI.col(2), place_T - port_T).toRotationMatrix() * R_TI;
}

/// The dots of a board whose slit runs so through a place; empty: one of them cannot lie there.
std::vector<Target> laid_pairs(const Exercise& exercise, const ExerciseLevel& level, const TargetGround& ground,
                               const Vec3& middle_T, const Vec3& slit) {
  const NeedleRules& rules = own_rules<NeedleRules>(exercise);
  const Vec3 side = slit.cross(Vec3::UnitZ());
  const int pairs = exercise.layout.count / 2;
  std::vector<Target> dots;
  for (const double way : {-0.5, 0.5})
    for (int pair = 0; pair < pairs; ++pair) {
      const Vec3 at = middle_T + (pair - (pairs - 1) / 2.0) * rules.pair_gap_m * slit + way * rules.apart_m * side;
      const auto point = ground.field.top(at.x(), at.y());
      if (!point || !ground.is_even(*point)) return {};
      if (ground.room && ground.room->gap_m(point->position, point->normal) < kShaftGap) return {};
      const Vec3 shaft = (point->position - level.port_m).normalized();
      if (std::asin(std::clamp(-shaft.dot(point->normal), -1.0, 1.0)) > rules.most_lean_rad) return {};
      dots.push_back({.centre_T = point->position, .normal_T = point->normal, .radius_m = exercise.layout.radius_m});
    }
  return dots;
}

}  // namespace

Pose needle_across(const NeedleShape& shape, const Vec3& middle_T, const Vec3& up_T, const Vec3& shaft_T,
                   double point_rad) {
  const Vec3 up = across(up_T, shaft_T), side = shaft_T.cross(up);
  const double swage = point_rad - 2 * std::numbers::pi * shape.circle;
  Pose X;
  X.R.col(0) = std::cos(swage) * side + std::sin(swage) * up;
  X.R.col(2) = -shaft_T;
  X.R.col(1) = X.R.col(2).cross(X.R.col(0));
  X.p = middle_T;
  return X;
}

BiteCircle bite_circle(const NeedleShape& shape, const Vec3& entry_T, const Vec3& exit_T, const Vec3& normal_T,
                       const Vec3& shaft_T) {
  BiteCircle circle;
  circle.up_T = across(normal_T, shaft_T);
  const double half = std::min((exit_T - entry_T).norm() / 2, shape.radius_m());
  const double half_rad = std::asin(half / shape.radius_m());
  circle.middle_T = (entry_T + exit_T) / 2 + shape.radius_m() * std::cos(half_rad) * circle.up_T;
  circle.entry_rad = 1.5 * std::numbers::pi - half_rad;
  return circle;
}

Pose grasping(const NeedleShape& shape, const Pose& X_TN, double share_from_swage, const Mat3& R_TI_near,
              const Vec3& port_T) {
  const double arc = share_from_swage * shape.length_m;
  const Vec3 at = X_TN * shape.place(arc);
  const Mat3 R = swung_to(R_TI_near, port_T, at);
  const Vec3 shaft = R.col(2), radial = X_TN.R * shape.place(arc).normalized();
  // Of the two ways to lay the pads along the wire.
  double roll = std::atan2(radial.dot(R.col(0)), -radial.dot(R.col(1)));
  if (std::abs(roll) > std::numbers::pi / 2) roll -= std::copysign(std::numbers::pi, roll);
  const Vec3 beyond = needle_in_jaws(shape, share_from_swage).inverse().p - shape.place(arc);
  return {Eigen::AngleAxisd(roll, shaft).toRotationMatrix() * R, at + beyond.norm() * shaft};
}

Board lay_out_needle(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  const NeedleRules& rules = own_rules<NeedleRules>(exercise);
  const HeightField field(place.organ_T);
  const auto centre = field.top(0, 0);
  if (!centre) throw InputError("the organ does not lie under the middle of the board region: place it first");
  const TargetGround ground{field, exercise.layout, centre->position.z(), place.behind_tip};
  BoardRandom random(board);
  Board result;
  for (int draw = 0; draw < kNeedleDraws && result.targets.empty(); ++draw) {
    const double turn = random.either_way(rules.turn_rad);
    const Vec3 middle(random.either_way(rules.shift_m), random.either_way(rules.shift_m), 0);
    Vec3 slit = middle - level.port_m;
    slit.z() = 0;
    slit = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * slit.normalized();
    result.targets = laid_pairs(exercise, level, ground, middle, slit);
  }
  if (result.targets.empty())
    throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id +
                     "': the organ has no even place for the slit where the shaft has room: choose a larger one");
  result.centre_T = centre->position;
  result.start_T = centre->position + exercise.start_above_m;
  NeedleBoard own;
  own.shape = needle_of(exercise);
  const Vec3 stand = centre->position + rules.stand_m, shaft = (stand - level.port_m).normalized();
  const double entry = 1.5 * std::numbers::pi - std::asin(rules.apart_m / 2 / own.shape.radius_m());
  own.X_TN_stand = needle_across(own.shape, stand, Vec3::UnitZ(), shaft, entry - kBeforeEntry);
  result.own = std::make_shared<const NeedleBoard>(own);
  const double middle_share = 1 - (rules.grip_low_share + rules.grip_high_share) / 2;
  const std::size_t pairs = result.targets.size() / 2;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    Target& in = result.targets[pair];
    Target& out = result.targets[pairs + pair];
    const Vec3 along = ((in.centre_T + out.centre_T) / 2 - level.port_m).normalized();
    const Vec3 normal = (in.normal_T + out.normal_T).normalized();
    const BiteCircle circle = bite_circle(own.shape, in.centre_T, out.centre_T, normal, along);
    const Pose X_TN = needle_across(own.shape, circle.middle_T, circle.up_T, along, circle.entry_rad);
    in.R_TI = out.R_TI = (X_TN * needle_in_jaws(own.shape, middle_share).inverse()).R;
  }
  return result;
}

std::optional<Pose> needle_stand(const Exercise& exercise, const Board& board) {
  if (exercise.kind != ExerciseKind::kNeedle) return std::nullopt;
  return own_rules<NeedleBoard>(board).X_TN_stand;
}

}  // namespace trocar
