#include "tissue/thin/rod_hook.h"

#include <algorithm>
#include <cmath>

#include "tissue/thin/rod_contact.h"

namespace trocar {
namespace {

constexpr double kLeastSine = 0.2;    // of the angle between rod and foot: along it, nothing is lifted
constexpr double kMostAside = 0.003;  // m that a held place slides across the foot before another is held

enum HookSpring : std::size_t { kPush, kRub, kHeel, kHookSprings };

}  // namespace

void RodHook::let_go() {
  held_.reset();
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
    const Vec3 point = a + share * (b - a), normal = (b - a).normalized().cross(Vec3::UnitY());
    if (!on_foot(point.y()) || normal.norm() < kLeastSine) continue;
    const Vec3 away = (normal.z() < 0 ? 1 : -1) * normal.normalized();
    const double over = away.z() * (point.z() - options_.foot_z_m);
    if (std::abs(over) > options_.crook_m || (best && std::abs(over) >= std::abs(best->over_m))) continue;
    best = {segment.arc_from_m + share * (segment.arc_to_m - segment.arc_from_m), away, over};
  }
  return best;
}

void RodHook::reach(const Pose& X_TI, const ElasticRod& rod, std::vector<RodSpring>& springs) {
  if (!X_TI.R.allFinite() || !X_TI.p.allFinite()) return let_go();
  const double clear = options_.wire_radius_m + rod.options().outer_radius_m;
  if (!held_) {
    const auto now = crossing(X_TI, rod);
    if (!now) return let_go();
    const bool over = now->over_m >= clear;
    passed_through_ = passed_through_ || (!inside_ && !over);
    inside_ = !passed_through_;
    arc_m_ = now->arc_m;
    if (inside_ && !over) held_ = Held{now->away_I, 0};
  }
  if (!held_) return;
  const Vec3 point = X_TI.inverse() * rod.place_at(arc_m_);
  if (!on_foot(point.y())) return let_go();
  const Vec3 off = point - Vec3(0, point.y(), options_.foot_z_m), aside = Vec3::UnitY().cross(held_->away_I);
  springs.push_back(
      {arc_m_, -(X_TI.R * held_->away_I), options_.push_n_per_m, clear - held_->away_I.dot(off), true, 0});
  springs.push_back({arc_m_, X_TI.R * aside, options_.push_n_per_m, aside.dot(off) - held_->aside_m, false, 0});
  springs.push_back({arc_m_, X_TI.R.col(1), options_.push_n_per_m, clear + point.y(), true, 0});
}

void RodHook::feel(const Pose& X_TI, std::span<const RodSpring> springs, const ElasticRod& rod) {
  hold_ = {};
  load_n_ = 0;
  if (!held_ || springs.size() != kHookSprings) return;
  load_n_ = std::max(0.0, springs[kPush].force_n);
  const double rub = springs[kRub].force_n, most = options_.friction * load_n_;
  const double slid = std::copysign(std::max(0.0, std::abs(rub) - most), rub);
  held_->aside_m += slid / options_.push_n_per_m;
  const Vec3 pull_T = load_n_ * springs[kPush].direction + (rub - slid) * springs[kRub].direction +
                      std::max(0.0, springs[kHeel].force_n) * springs[kHeel].direction;
  if (load_n_ <= 0 || std::abs(held_->aside_m) > kMostAside) held_.reset();
  if (load_n_ <= 0) return;
  hold_.point_I = X_TI.inverse() * rod.place_at(arc_m_);
  hold_.stiffness_n_per_m =
      std::min(options_.most_loop_n_per_m, loop_stiffness(rod, arc_m_, pull_T.normalized(), options_.push_n_per_m));
  hold_.anchor_T = X_TI * hold_.point_I + pull_T / hold_.stiffness_n_per_m;
}

}  // namespace trocar
