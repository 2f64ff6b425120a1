#include "tissue/thin/rod_ring.h"

#include <algorithm>

#include "tissue/thin/stick_slip.h"

namespace trocar {
namespace {

constexpr double kSharpest = 0.3;  // 1 + cosine of the corner, below which tension is not told from what presses
constexpr double kLeastRingStiffness = 1e-3;  // N/m: a load without stiffness is a long spring
// Two rings on one taut rod both answer its tension, and so do those of a knot: each takes a share.
constexpr double kAnswers = 0.3, kForesees = 0.3;
constexpr double kFastest = 0.01;  // m in a step
constexpr double kGoesOn = 0.05;   // of friction's limit: pulled with less, a slack rod does not slide on

/// Direction of the rod before and behind the segment in a ring.
std::pair<Vec3, Vec3> either_side(const ElasticRod& rod, double arc_m) {
  const std::size_t at = rod.segment_at(arc_m);
  const auto direction = [&](std::size_t segment) {
    const RodSegment& there = rod.segments()[segment];
    return there.whole ? there.frame.t : rod.segments()[at].frame.t;
  };
  return {direction(at > 0 ? at - 1 : at), direction(std::min(at + 1, rod.segments().size() - 1))};
}

}  // namespace

void RodRing::add_springs(const ElasticRod& rod, const Vec3& at_T, double stiffness_n_per_m,
                          std::vector<RodSpring>& springs) {
  arc_m += foreseen_m;
  const Vec3 apart = rod.place_at(arc_m) - at_T;
  for (int axis = 0; axis < 3; ++axis)
    springs.push_back({arc_m, Vec3::Unit(axis), stiffness_n_per_m, apart[axis], false, 0});
}

void RodRing::take(std::span<const RodSpring> springs) {
  force_T = Vec3::Zero();
  for (const RodSpring& spring : springs) force_T += spring.force_n * spring.direction;
}

void RodRing::add_loads(const ElasticRod& rod, const NodeShares& place, double stiffness_n_per_m,
                        std::vector<SoftSpring>& springs) const {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 direction = Vec3::Unit(axis);
    const double yields = stiffness_n_per_m * rod.compliance(arc_m, direction);
    const double stiffness = std::max(stiffness_n_per_m * (1 - std::min(1.0, yields)), kLeastRingStiffness);
    springs.push_back({place, direction, stiffness, -force_T[axis] / stiffness, false, 0});
  }
}

void RodRing::settle(const ElasticRod& rod, double stiffness_n_per_m, double limit_n, double mu, double from_m,
                     double to_m) {
  const auto [before, behind] = either_side(rod, arc_m);
  const Vec3 both = before + behind;
  // More pull on the side of greater arcs draws smaller arcs into the ring.
  const double drive = force_T.dot(both) / std::max(1 + before.dot(behind), kSharpest);
  const Vec3 middle = both.normalized();
  const double limit = limit_n + mu * (force_T - force_T.dot(middle) * middle).norm();
  const double was = arc_m - foreseen_m;
  const bool stops = foreseen_m == 0 ? false : std::copysign(drive, -foreseen_m * drive) < kGoesOn * limit_n;
  const double gone =
      stops ? 0 : std::clamp(slide(-foreseen_m, drive, limit, stiffness_n_per_m / kAnswers), -kFastest, kFastest);
  arc_m = std::clamp(was - gone, std::min(from_m, to_m), std::max(from_m, to_m));
  slid_m = arc_m - was;
  foreseen_m = slid_m == 0 ? 0 : foreseen_m + kForesees * (slid_m - foreseen_m);
}

}  // namespace trocar
