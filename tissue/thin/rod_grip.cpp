#include "tissue/thin/rod_grip.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tissue/thin/rod_contact.h"
#include "tissue/thin/rod_in_jaws.h"
#include "tissue/thin/rod_section.h"

namespace trocar {
namespace {

constexpr std::size_t kMostRodPlaces = 4;
constexpr double kTakesRod = 0.1, kKeepsRod = 0.05;  // N of squeeze, as SoftGrip
constexpr double kBeyondPads = 0.001;                // m
constexpr double kGripSampling = 0.0005;             // m
constexpr int kSpringAxes = 3;

}  // namespace

void RodGrip::let_go() {
  places_.clear();
  clips_.clear();
  hold_ = {};
  block_ = {};
  pull_T_ = Vec3::Zero();
  squeeze_n_ = slipped_m_ = flatness_ = 0;
  state_ = GripState::kEmpty;
}

std::vector<double> RodGrip::arcs() const {
  std::vector<double> arcs;
  for (const Place& place : places_) arcs.push_back(place.arc_m);
  return arcs;
}

/// Those that lie on the pads where the rod would be if their springs were not stretched.
void RodGrip::meet_clips(const Pose& X_TI, double opening_m, const ElasticRod& rod, std::span<const double> clips) {
  const Pose X_IT = X_TI.inverse();
  Vec3 behind_I = Vec3::Zero();
  for (const Place& place : places_)
    behind_I += (X_IT * rod.place_at(place.arc_m) - place.point_I) / static_cast<double>(places_.size());
  const double aside = opening_m / 2 + rod.options().outer_radius_m + kBeyondPads;
  const bool enters = options_.clip_legs_m <= 0 || opening_m >= 2 * rod.options().wall_m + options_.clip_legs_m;
  std::vector<double> between;
  for (const double arc : clips) {
    const Vec3 p = X_IT * rod.place_at(arc) - behind_I;
    const bool known = std::find(clips_.begin(), clips_.end(), arc) != clips_.end();
    if (on_pads(p) && std::abs(p.y()) < aside && (known || enters)) between.push_back(arc);
  }
  clips_ = std::move(between);
}

void RodGrip::squeeze(double opening_m, const ElasticRod& rod, double length_m) {
  const RodOptions& o = rod.options();
  const double width = rod_section(o, 1).half_width_m * 2;
  const double walls = o.young_pa / (1 - o.poisson * o.poisson) * length_m * width / (2 * o.wall_m);
  const double hard = std::min(walls, options_.most_stiffness_n_per_m);
  const double ring = std::min(ring_stiffness(o) * length_m, hard);
  flatness_ = flatness_between(o, opening_m);
  // The law's tangent as a block, so that fingers and friction have the same force.
  if (flatness_ < 1 && o.inner_radius_m() > 0) {
    block_ = {2 * o.outer_radius_m, ring};
  } else {
    block_ = {2 * o.wall_m + ring * 2 * o.inner_radius_m() / hard, hard};
  }
  squeeze_n_ = block_.stiffness_n_per_m * std::max(0.0, block_.thickness_m - opening_m);
  if (clips_.empty() || options_.clip_legs_m <= 0) return;
  const GripBlock clip{2 * o.wall_m + options_.clip_legs_m, options_.most_stiffness_n_per_m};
  const double on_clip = clip.stiffness_n_per_m * std::max(0.0, clip.thickness_m - opening_m);
  if (on_clip <= squeeze_n_) return;
  block_ = clip;
  squeeze_n_ = on_clip;
}

void RodGrip::take(const Pose& X_TI, const ElasticRod& rod) {
  places_.clear();
  const std::size_t count = std::min(kMostRodPlaces, between_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double arc = between_[(2 * i + 1) * between_.size() / (2 * count)];
    places_.push_back({arc, X_TI.inverse() * rod.place_at(arc)});
  }
  slipped_m_ = 0;
  state_ = GripState::kHolding;
}

bool RodGrip::on_pads(const Vec3& p) const {
  return std::abs(p.x()) < options_.pad_width_m / 2 + kBeyondPads && p.z() < kBeyondPads &&
         p.z() > -options_.pad_length_m - kBeyondPads;
}

void RodGrip::reach(const Pose& X_TI, double opening_m, const ElasticRod& rod, std::vector<RodSpring>& springs,
                    std::span<const double> clips) {
  if (!std::isfinite(opening_m) || !X_TI.R.allFinite() || !X_TI.p.allFinite()) return let_go();
  const JawSpace pads{options_.pad_length_m, options_.pad_width_m, opening_m};
  between_ = arcs_between(rod, X_TI, pads, kBeyondPads, kGripSampling);
  const bool holding = !places_.empty();
  if (!holding) {
    const bool enters = state_ == GripState::kAround || opening_m > 2 * rod.options().wall_m;
    if (between_.empty() || !enters) return let_go();
    state_ = GripState::kAround;
  }
  meet_clips(X_TI, opening_m, rod, clips);
  squeeze(opening_m, rod, std::max(kGripSampling, length_between(rod, X_TI, pads, 0)));
  if (holding && squeeze_n_ < kKeepsRod) {
    let_go();
    state_ = GripState::kAround;
    return;
  }
  if (!holding && squeeze_n_ >= kTakesRod) take(X_TI, rod);
  if (!between_.empty()) angle_ = angle_in_rod(rod, between_[between_.size() / 2], X_TI.R.col(1));
  for (const Place& place : places_) {
    const Vec3 apart = rod.place_at(place.arc_m) - X_TI * place.point_I;
    const double stiffness = options_.hold_n_per_m / static_cast<double>(places_.size());
    for (int axis = 0; axis < kSpringAxes; ++axis)
      springs.push_back({place.arc_m, Vec3::Unit(axis), stiffness, apart[axis], false, 0});
  }
}

void RodGrip::press(Lumen& lumen) const {
  if (state_ == GripState::kEmpty || flatness_ <= 0 || between_.empty()) return;
  lumen.press(between_.front(), between_.back(), flatness_, angle_);
}

void RodGrip::follow_through(const Pose& X_TI, const ElasticRod& rod) {
  for (std::size_t i = 0; i < places_.size();) {
    if (on_pads(places_[i].point_I)) {
      ++i;
      continue;
    }
    // The piece of rod between the pads that is farthest from the places that still hold; it takes over the stretch of
    // the one that it follows, so that the force goes on.
    const Vec3 stretch = rod.place_at(places_[i].arc_m) - X_TI * places_[i].point_I;
    double farthest = -1;
    Place next;
    for (const double arc : between_) {
      double nearest = 1;
      for (std::size_t k = 0; k < places_.size(); ++k)
        if (k != i) nearest = std::min(nearest, std::abs(places_[k].arc_m - arc));
      const Vec3 point_I = X_TI.inverse() * Vec3(rod.place_at(arc) - stretch);
      if (nearest <= farthest || !on_pads(point_I)) continue;
      farthest = nearest;
      next = {arc, point_I};
    }
    if (farthest >= kGripSampling) {
      places_[i] = next;
      ++i;
    } else {
      places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

void RodGrip::feel(const Pose& X_TI, std::span<const RodSpring> springs, const ElasticRod& rod) {
  hold_ = {};
  if (places_.empty() || springs.size() != kSpringAxes * places_.size()) return;
  pull_T_ = Vec3::Zero();
  for (const RodSpring& spring : springs) pull_T_ += spring.force_n * spring.direction;
  const double most = 2 * options_.friction * squeeze_n_, pull = pull_T_.norm();
  const double kept = pull > most ? most / pull : 1;
  state_ = kept < 1 ? GripState::kSlipping : GripState::kHolding;
  double arc = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Vec3 stretch = Vec3::Zero();
    for (int axis = 0; axis < kSpringAxes; ++axis) {
      const RodSpring& spring = springs[kSpringAxes * i + static_cast<std::size_t>(axis)];
      stretch[axis] = spring.stiffness_n_per_m > 0 ? spring.force_n / spring.stiffness_n_per_m : 0;
    }
    places_[i].point_I += X_TI.R.transpose() * ((1 - kept) * stretch);
  }
  slipped_m_ += (1 - kept) * pull / options_.hold_n_per_m;
  pull_T_ *= kept;
  follow_through(X_TI, rod);
  if (places_.empty()) return let_go();
  for (const Place& place : places_) {
    hold_.point_I += place.point_I / static_cast<double>(places_.size());
    arc += place.arc_m / static_cast<double>(places_.size());
  }
  const Vec3 direction = pull > 0 ? Vec3(pull_T_.normalized()) : Vec3::UnitZ();
  hold_.stiffness_n_per_m =
      std::min(options_.most_loop_n_per_m, loop_stiffness(rod, arc, direction, options_.hold_n_per_m));
  hold_.anchor_T = X_TI * hold_.point_I + pull_T_ / hold_.stiffness_n_per_m;
}

}  // namespace trocar
