#include "scenarios/kinds/clip/clip_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/clip/clip_rules.h"
#include "scenarios/layout/board_random.h"
#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

constexpr int kClipDraws = 200;

/// The instrument at a place without being rolled.
Mat3 unrolled(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& place_T) {
  if (level.mapping != Mapping::kFulcrum) return R_TI_rest;
  return least_turn(R_TI_rest.col(2), place_T - level.port_m).toRotationMatrix() * R_TI_rest;
}

/// The least roll that lays the jaws' hinge along a direction, either way round.
Mat3 rolled_along(const Mat3& R_TI, const Vec3& tangent_T) {
  const Vec3 shaft = R_TI.col(2), hinge = R_TI.col(0);
  double roll = std::atan2(hinge.cross(tangent_T).dot(shaft), hinge.dot(tangent_T));
  if (roll > std::numbers::pi / 2) roll -= std::numbers::pi;
  if (roll < -std::numbers::pi / 2) roll += std::numbers::pi;
  return Eigen::AngleAxisd(roll, shaft).toRotationMatrix() * R_TI;
}

/// Where the file's points lie with its middle there; those that dive at the tissue's height under them. Empty where
/// one dives beside the organ.
std::vector<std::vector<Vec3>> laid_paths(const Exercise& exercise, const Mat3& R, double mirror, Vec3 middle_T,
                                          const HeightField& organ) {
  const double clear_m = own_rules<ClipRules>(exercise).clear_m;
  const auto across = [&](const Vec3& drawn) -> Vec3 {
    return middle_T + R * Vec3(drawn.x(), mirror * drawn.y(), std::max(0.0, drawn.z()));
  };
  double lift = -std::numeric_limits<double>::infinity();
  for (const DuctPlan& plan : exercise.ducts)
    for (const Vec3& drawn : plan.path_m) {
      const Vec3 at = across(drawn);
      const auto top = organ.top(at.x(), at.y());
      if (!top && drawn.z() < 0) return {};
      if (top && drawn.z() >= 0) lift = std::max(lift, top->position.z() + clear_m - at.z());
    }
  middle_T.z() += lift;
  std::vector<std::vector<Vec3>> paths;
  for (const DuctPlan& plan : exercise.ducts) {
    paths.emplace_back();
    for (const Vec3& drawn : plan.path_m) {
      Vec3 at = across(drawn);
      if (drawn.z() < 0) at.z() = organ.top(at.x(), at.y())->position.z() + drawn.z();
      paths.back().push_back(at);
    }
  }
  return paths;
}

Target aimed_at(const Exercise& exercise, const ExerciseLevel& level, const Board& board, int target,
                const Mat3& R_TI_rest) {
  const ClipRules& rules = own_rules<ClipRules>(exercise);
  const ClipAim aim = clip_aim(target);
  const auto structure = static_cast<std::size_t>(aim.structure);
  const double arc = aim.step == ClipStep::kClip ? rules.clip_at_m[static_cast<std::size_t>(aim.clip)] : rules.cut_at_m;
  const PathPlace place = place_along(board.ducts_T[structure], arc);
  const Mat3 R = rolled_along(unrolled(level, R_TI_rest, place.point_T), place.tangent_T);
  return {.centre_T = place.point_T, .normal_T = -R.col(2), .radius_m = exercise.layout.radius_m, .R_TI = R};
}

}  // namespace

PathPlace place_along(std::span<const Vec3> path_T, double arc_m) {
  PathPlace place{path_T.front(), Vec3::UnitX()};
  for (std::size_t i = 1; i < path_T.size(); ++i) {
    const Vec3 step = path_T[i] - path_T[i - 1];
    const double length = step.norm();
    place.tangent_T = step / length;
    place.point_T = path_T[i - 1] + std::min(arc_m, length) * place.tangent_T;
    if (arc_m <= length) break;
    arc_m -= length;
  }
  return place;
}

Board lay_out_clips(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  const ClipRules& rules = own_rules<ClipRules>(exercise);
  const HeightField organ(place.organ_T);
  const auto centre = organ.top(0, 0);
  if (!centre) throw InputError("the organ does not lie under the middle of the board region: place it first");
  const Mat3 R_TI = unrolled(level, place.R_TI_rest, centre->position);
  BoardRandom random(board);
  Board result;
  for (int draw = 0; draw < kClipDraws && result.ducts_T.empty(); ++draw) {
    const double turn = random.either_way(rules.turn_rad), mirror = random.uniform() < 0.5 ? 1 : -1;
    const Vec3 middle(random.either_way(rules.shift_m), random.either_way(rules.shift_m), 0);
    // Its x the hinge, its z back along the shaft: y is mirrored by that.
    const Mat3 R = R_TI * Eigen::AngleAxisd(turn, Vec3::UnitZ()) * Vec3(1, -1, -1).asDiagonal();
    result.ducts_T = laid_paths(exercise, R, mirror, middle, organ);
  }
  if (result.ducts_T.empty())
    throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id +
                     "': the organ has no tissue where the ducts shall go into it: choose a larger one");
  result.centre_T = centre->position;
  result.start_T = centre->position + exercise.start_above_m;
  for (int target = 0; target < kClipAims; ++target)
    result.targets.push_back(aimed_at(exercise, level, result, target, place.R_TI_rest));
  return result;
}

}  // namespace trocar
