#include "tissue/interaction/needle_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tissue/thin/stick_slip.h"

namespace trocar {
namespace {

constexpr double kLongestCut = 0.005;    // m, in a step: no jump goes through an organ
constexpr double kSkin = 5e-5;           // m of tissue before the surface, which only a puncture opens
constexpr double kFarFromEntry = 0.002;  // m of way after which what lies outside has come out, whatever its direction
constexpr double kFollows = 0.001;       // m of cutting on in which the end comes to lie before the tip
constexpr double kTearsOut = 0.015;      // m of a place from the axis: the needle is no longer in it

}  // namespace

double cutting_force(const TissueSolid& tissue, const NeedleShape& shape) {
  return tissue.toughness_j_per_m2 * 2 * shape.wire_radius_m;
}

double puncture_force(const TissueSolid& tissue, const NeedleShape& shape, const NeedleTissueOptions& options) {
  return options.puncture_over_cut * cutting_force(tissue, shape);
}

double pull_out_force(const TissueSolid& tissue, double bridge_m, const NeedleTissueOptions& options) {
  return std::min(options.most_pull_out_n, tissue.rupture_n_per_m * std::max(bridge_m, options.least_bridge_m));
}

NeedlePath::NeedlePath(const OrganView& view, const NeedleShape& shape, const Vec3& entry_rest_T, const Vec3& along_T,
                       std::int32_t number)
    : number_(number), entry_along_(along_T) {
  Place entry;
  entry.arc = shape.length_m;
  entry.rest = entry_rest_T;
  entry.shares = view.organ.shares_within(entry_rest_T);
  places_ = {entry, entry};
  end_before_ = entry_rest_T;
}

void NeedlePath::follow_cut(const SoftOrgan& organ) {
  for (Place& place : places_) place.shares = organ.shares_within(place.rest);
  vertex_ = -1;
}

void NeedlePath::locate(const SoftOrgan& organ, const NeedleShape& shape, const Pose& X_TN) {
  const Pose X_NT = X_TN.inverse();
  // Continued from where it was: behind the swage the circle goes on for longer than its gap.
  for (Place& place : places_)
    place.arc += std::remainder(beside_needle(shape, X_NT * organ.place_T(place.shares)).arc_m - place.arc,
                                2 * std::numbers::pi * shape.radius_m());
  const double deepest = std::min(shape.length_m, places_.back().arc);
  inside_ = std::max(0.0, deepest - std::max(0.0, places_.front().arc));
}

void NeedlePath::move_end(const OrganView& view, const Vec3& way_T) {
  Place& end = places_.back();
  end.rest = end_before_ + view.organ.gradient_within(end_before_).inverse() * way_T;
  end.shares = view.organ.shares_within(end.rest);
}

void NeedlePath::add_springs(const OrganView& view, const NeedleShape& shape, const NeedleTissueOptions& options,
                             const Pose& X_TN, double share, std::vector<NeedleSpring>& springs) {
  end_before_ = places_.back().rest;
  if (end_foreseen_ > 0) move_end(view, end_foreseen_ * (X_TN.R * shape.tangent(shape.length_m)));
  locate(view.organ, shape, X_TN);
  const Pose X_NT = X_TN.inverse();
  for (Place& place : places_) {
    const bool along = place.arc >= 0 && place.arc <= shape.length_m && !place.shares.node.empty();
    if (along && !place.held) place.stuck = place.arc, place.foreseen = 0;
    place.held = along;
    if (!along) continue;
    place.stuck += place.foreseen;
    const BesideNeedle beside = beside_needle(shape, X_NT * view.organ.place_T(place.shares));
    const Vec3 at = X_TN * shape.place(place.arc);
    const Vec3 outward = X_TN.R * shape.place(place.arc).normalized();
    const Vec3 along_T = X_TN.R * shape.tangent(place.arc);
    springs.push_back({{place.shares, outward, share * options.across_n_per_m, beside.outward_m, false, 0}, at});
    springs.push_back({{place.shares, X_TN.R.col(2), share * options.across_n_per_m, beside.across_m, false, 0}, at});
    if (slides(place))
      springs.push_back(
          {{place.shares, along_T, share * options.along_n_per_m, place.arc - place.stuck, false, 0}, at});
  }
  if (through_ || places_.back().shares.node.empty()) return;
  const Vec3 tip = X_TN * shape.place(shape.length_m), ahead = X_TN.R * shape.tangent(shape.length_m);
  const double pressed = ahead.dot(tip - view.organ.place_T(places_.back().shares));
  springs.push_back({{places_.back().shares, -ahead, options.tip_n_per_m, pressed, true, 0}, tip});
}

void NeedlePath::cut_on(const OrganView& view, const NeedleTissueOptions& options, const NeedleShape& shape,
                        const Pose& X_TN, double force_n, double stiffness) {
  const TissueSolid& tissue = view.organ.material();
  end_force_ = force_n;
  if (at_surface_ && force_n >= puncture_force(tissue, shape, options)) {
    through_ = came_out_ = true;
    places_.back().rest = view.walk.foot(view.organ.rest()->vertices, places_.back().rest, vertex_).point;
    places_.back().shares = view.organ.shares_within(places_.back().rest);
    end_foreseen_ = 0;
    return;
  }
  const double limit = cutting_force(tissue, shape);
  const double cut = at_surface_ ? 0 : std::clamp(slide(end_foreseen_, force_n, limit, stiffness), 0.0, kLongestCut);
  end_foreseen_ = cut;
  const Vec3 tip = X_TN * shape.place(shape.length_m), ahead = X_TN.R * shape.tangent(shape.length_m);
  const Vec3 off = tip - view.organ.place_T(places_.back().shares);
  const double follows = std::min(1.0, cut / kFollows);
  move_end(view, cut * ahead + follows * (off - off.dot(ahead) * ahead));
  if (cut <= 0) return;
  Place& end = places_.back();
  const SurfaceFoot foot = view.walk.foot(view.organ.rest()->vertices, end.rest, vertex_);
  const Vec3 ahead_rest = view.organ.gradient_within(end.rest).inverse() * ahead;
  const bool outwards = foot.normal.dot(ahead_rest) > 0 || (end.rest - entry_rest_T()).norm() > kFarFromEntry;
  if (foot.height_m > -kSkin && outwards) {
    end.rest = foot.point - kSkin * foot.normal;
    end.shares = view.organ.shares_within(end.rest);
    at_surface_ = true;
    end_foreseen_ = 0;
  } else if ((end.rest - places_[places_.size() - 2].rest).norm() > options.spacing_m) {
    places_.push_back(end);
    places_.back().held = false;
  }
}

NeedlePath::Event NeedlePath::feel(const OrganView& view, const NeedleShape& shape, const NeedleTissueOptions& options,
                                   const Pose& X_TN, std::span<const NeedleSpring> springs) {
  const auto count = static_cast<double>(std::count_if(
      places_.begin(), places_.end(), [this](const Place& place) { return place.held && slides(place); }));
  const double limit = options.friction_n_per_m * inside_ / std::max(1.0, count);
  Vec3 across = Vec3::Zero();
  std::size_t s = 0;
  for (Place& place : places_) {
    if (!place.held) continue;
    across += springs[s].on_needle() + springs[s + 1].on_needle();
    s += 2;
    if (!slides(place)) continue;
    const SoftSpring& along = springs[s++].soft;
    const double slid = slide(place.foreseen, along.force_n, limit, along.stiffness_n_per_m);
    place.stuck += slid - place.foreseen;
    place.foreseen = slid;
  }
  load_ = across.norm();
  came_out_ = false;
  end_force_ = 0;
  if (s < springs.size())
    cut_on(view, options, shape, X_TN, springs[s].soft.force_n, springs[s].soft.stiffness_n_per_m);
  const double step_s = view.organ.solid().options().step_s;
  overload_s_ = load_ > pull_out_force(view.organ.material(), bridge_m(), options) ? overload_s_ + step_s : 0;
  if (overload_s_ >= options.overload_s || furthest_m(view.organ, shape, X_TN) > kTearsOut) return Event::kTore;
  locate(view.organ, shape, X_TN);
  return came_out_ ? Event::kCameOut : Event::kNone;
}

double NeedlePath::furthest_m(const SoftOrgan& organ, const NeedleShape& shape, const Pose& X_TN) const {
  double most = 0;
  const Pose X_NT = X_TN.inverse();
  for (const Place& place : places_) {
    if (!place.held) continue;
    const BesideNeedle beside = beside_needle(shape, X_NT * organ.place_T(place.shares));
    most = std::max(most, std::hypot(beside.outward_m, beside.across_m));
  }
  return most;
}

}  // namespace trocar
