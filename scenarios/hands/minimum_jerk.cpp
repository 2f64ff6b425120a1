#include "scenarios/hands/minimum_jerk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kTravelAfter = 0.6;    // share of the withdrawal after which the crossing starts
constexpr double kDescentAfter = 0.75;  // share of the crossing after which the descent starts
constexpr double kLeastWidth = 1e-4;    // m or rad that a person aims at: what is not told has none

}  // namespace

double minimum_jerk(double s) {
  const double u = std::clamp(s, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

double reach_time_s(double distance_m, double width_m, double speed_factor) {
  return speed_factor * (0.12 + 0.11 * std::log2(2 * distance_m / std::max(width_m, kLeastWidth) + 1));
}

ReachPlan::ReachPlan(const Vec3& from, const Vec3& to, const Shape& shape)
    : from_(from + Vec3(0, 0, shape.sunk_m)), to_(to), shape_(shape) {
  travel_start_s_ = kTravelAfter * shape.lift_time_s;
  descent_start_s_ = travel_start_s_ + kDescentAfter * shape.travel_time_s;
  duration_s_ = std::max(travel_start_s_ + shape.travel_time_s, descent_start_s_ + shape.lift_time_s);
}

Vec3 ReachPlan::at(double t_s) const {
  const double share = minimum_jerk((t_s - travel_start_s_) / shape_.travel_time_s);
  Vec3 point = from_ + share * (to_ - from_) + std::sin(std::numbers::pi * share) * shape_.bulge;
  if (shape_.lift_time_s > 0) {
    const double up = minimum_jerk(t_s / shape_.lift_time_s);
    point.z() +=
        shape_.lift_m * (up - minimum_jerk((t_s - descent_start_s_) / shape_.lift_time_s)) - shape_.sunk_m * (1 - up);
  }
  return point;
}

ReachPlan aimed_reach(const Vec3& from_T, const Vec3& way, double width_m, double least_s, const HandSkill& skill,
                      HandRandom& random) {
  constexpr double kNominal = 0.060, kAtRest = 0.15;  // m of travel with the nominal aim error; its share at rest
  const double distance = way.norm();
  ReachPlan::Shape shape;
  shape.travel_time_s = std::max(least_s, reach_time_s(distance, width_m, skill.speed_factor));
  const Vec3 across = Vec3::UnitZ().cross(way);
  if (across.norm() > 1e-6)
    shape.bulge = across.normalized() * (skill.path_bulge * distance * (random.uniform() < 0.5 ? -1 : 1));
  const double noise = std::sqrt(std::min(1.0, distance / kNominal) + kAtRest);
  const Vec3 error = noise * Vec3(skill.aim_lateral_m * random.normal(), skill.aim_lateral_m * random.normal(),
                                  skill.aim_depth_m * random.normal());
  return ReachPlan(from_T, from_T + way + error, shape);
}

}  // namespace trocar
