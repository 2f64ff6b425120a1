#include "tissue/thin/rod_hook.h"

#include <algorithm>
#include <cmath>

#include "tissue/thin/rod_contact.h"

namespace trocar {
namespace {

constexpr double kLeastSine = 0.2;  // of the angle between rod and foot: along it, nothing is lifted

}  // namespace

void RodHook::let_go() {
  crossing_.reset();
  inside_ = passed_through_ = false;
  load_n_ = 0;
  hold_ = {};
}

/// The nearest to the foot of the places where the rod passes the plane of foot and shaft.
std::optional<RodHook::Crossing> RodHook::crossing(const Pose& X_TI, const ElasticRod& rod) const {
  std::optional<Crossing> best;
  const Pose X_IT = X_TI.inverse();
  for (std::size_t i = 0; i < rod.segments().size(); ++i) {
    const RodSegment& segment = rod.segments()[i];
    if (!segment.whole) continue;
    const Vec3 a = X_IT * rod.nodes()[i].position, b = X_IT * rod.nodes()[i + 1].position;
    if ((a.x() < 0) == (b.x() < 0)) continue;
    const double share = a.x() / (a.x() - b.x());
    const Vec3 point = a + share * (b - a);
    const Vec3 foot(0, point.y(), options_.foot_z_m);
    const Vec3 normal = (b - a).normalized().cross(Vec3::UnitY());
    if (point.y() > options_.wire_radius_m || -point.y() > options_.foot_m || normal.norm() < kLeastSine) continue;
    const Vec3 away = (normal.z() < 0 ? 1 : -1) * normal.normalized();
    const double over = away.dot(point - foot);
    if (std::abs(over) > options_.crook_m || (best && std::abs(over) >= std::abs(best->over_m))) continue;
    best = {segment.arc_from_m + share * (segment.arc_to_m - segment.arc_from_m), foot, away, over};
  }
  return best;
}

void RodHook::reach(const Pose& X_TI, const ElasticRod& rod, std::vector<RodSpring>& springs) {
  if (!X_TI.R.allFinite() || !X_TI.p.allFinite()) return let_go();
  crossing_ = crossing(X_TI, rod);
  if (!crossing_) return let_go();
  const double clear = options_.wire_radius_m + rod.options().outer_radius_m;
  const bool over = crossing_->over_m >= clear;
  passed_through_ = passed_through_ || (!inside_ && !over);
  inside_ = !passed_through_;
  if (!inside_) return;
  springs.push_back({crossing_->arc_m, -(X_TI.R * crossing_->away_I), options_.push_n_per_m,
                     clear - crossing_->over_m, true, 0});
  springs.push_back(
      {crossing_->arc_m, X_TI.R.col(1), options_.push_n_per_m, clear + crossing_->foot_I.y(), true, 0});
}

void RodHook::feel(const Pose& X_TI, std::span<const RodSpring, kSprings> springs, const ElasticRod& rod) {
  hold_ = {};
  load_n_ = std::max(0.0, springs.front().force_n);
  Vec3 pull_T = Vec3::Zero();
  for (const RodSpring& spring : springs) pull_T += std::max(0.0, spring.force_n) * spring.direction;
  if (pull_T.isZero()) return;
  hold_.point_I = crossing_->foot_I;
  hold_.stiffness_n_per_m =
      std::min(options_.most_loop_n_per_m,
               loop_stiffness(rod, crossing_->arc_m, pull_T.normalized(), options_.push_n_per_m));
  hold_.anchor_T = X_TI * hold_.point_I + pull_T / hold_.stiffness_n_per_m;
}

}  // namespace trocar
