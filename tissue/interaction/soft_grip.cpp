#include "tissue/interaction/soft_grip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trocar {
namespace {

constexpr std::size_t kMostPlaces = 12;  // two pads of six
constexpr std::size_t kFewestPlaces = 2;
constexpr double kTakes = 0.1, kKeeps = 0.05;  // N of squeeze
constexpr double kPadReach = 0.002;            // m beyond the pads in which the surface counts as between them
constexpr double kOpenEnough = 0.002;          // m: jaws more closed than that let nothing in
constexpr double kNoContactRound = 0.012;      // m round the fold, at rest
constexpr double kClear = 0.004;               // m between jaws and tissue that is to be felt again
constexpr int kAxes = 3;

Vec3 middle(const TriangleSurface& surface, std::int32_t triangle) {
  const auto& [a, b, c] = surface.triangles[static_cast<std::size_t>(triangle)];
  return (surface.vertices[static_cast<std::size_t>(a)] + surface.vertices[static_cast<std::size_t>(b)] +
          surface.vertices[static_cast<std::size_t>(c)]) /
         3;
}

}  // namespace

std::vector<std::int32_t> SoftGrip::between(const Pose& X_TI, double opening_m, const SoftOrgan& organ) const {
  std::vector<std::int32_t> found;
  const Pose X_IT = X_TI.inverse();
  for (std::size_t t = 0; t < organ.surface()->triangles.size(); ++t) {
    const Vec3 p = X_IT * middle(*organ.surface(), static_cast<std::int32_t>(t));
    if (std::abs(p.x()) < options_.pad_width_m / 2 + kPadReach && std::abs(p.y()) < opening_m / 2 + kPadReach &&
        p.z() > -options_.pad_length_m && p.z() < kPadReach)
      found.push_back(static_cast<std::int32_t>(t));
  }
  return found;
}

void SoftGrip::take(const Pose& X_TI, const std::vector<std::int32_t>& triangles, const SoftOrgan& organ) {
  places_.clear();
  const std::size_t stride = (triangles.size() + kMostPlaces - 1) / kMostPlaces;
  Vec3 fold = Vec3::Zero();
  for (std::size_t i = 0; i < triangles.size(); i += stride) {
    const Vec3 now = middle(*organ.surface(), triangles[i]);
    places_.push_back(
        {triangles[i], organ.shares_of({triangles[i], {1.0 / 3, 1.0 / 3, 1.0 / 3}}), X_TI.inverse() * now});
    fold += middle(*organ.rest(), triangles[i]);
  }
  fold /= static_cast<double>(places_.size());
  no_contact_.assign(organ.rest()->triangles.size(), false);
  for (std::size_t t = 0; t < no_contact_.size(); ++t)
    no_contact_[t] = (middle(*organ.rest(), static_cast<std::int32_t>(t)) - fold).norm() < kNoContactRound;
  slipped_m_ = 0;
  state_ = GripState::kHolding;
}

void SoftGrip::let_go() {
  places_.clear();
  hold_ = {};
  block_ = {};
  pull_T_ = Vec3::Zero();
  squeeze_n_ = slipped_m_ = 0;
  state_ = GripState::kEmpty;
}

void SoftGrip::follow_cut(const SoftOrgan& organ) {
  for (Place& place : places_) place.shares = organ.shares_of({place.triangle, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
  if (!no_contact_.empty()) no_contact_.resize(organ.rest()->triangles.size(), false);
}

double SoftGrip::rupture_n_per_m(const SoftOrgan& organ) const {
  return places_.empty() ? std::numeric_limits<double>::infinity()
                         : organ.material(places_.front().triangle).rupture_n_per_m;
}

Vec3 SoftGrip::middle_of_places(const TriangleSurface& surface) const {
  Vec3 sum = Vec3::Zero();
  for (const Place& place : places_) sum += middle(surface, place.triangle) / static_cast<double>(places_.size());
  return sum;
}

Vec3 SoftGrip::middle_T(const SoftOrgan& organ) const { return middle_of_places(*organ.surface()); }

Vec3 SoftGrip::middle_rest_T(const SoftOrgan& organ) const { return middle_of_places(*organ.rest()); }

bool SoftGrip::jaws_clear(const Pose& X_TI, const SoftOrgan& organ) const {
  const Pose X_IT = X_TI.inverse();
  for (std::size_t t = 0; t < no_contact_.size(); ++t) {
    if (!no_contact_[t]) continue;
    const Vec3 p = X_IT * middle(*organ.surface(), static_cast<std::int32_t>(t));
    const double along = std::clamp(p.z(), -options_.pad_length_m, 0.0);
    if ((p - Vec3(0, 0, along)).norm() < kClear) return false;
  }
  return true;
}

void SoftGrip::reach(const Pose& X_TI, double opening_m, const SoftOrgan& organ, std::vector<SoftSpring>& springs) {
  const bool holding = !places_.empty();
  std::vector<std::int32_t> fold;
  if (!holding) {
    fold = between(X_TI, opening_m, organ);
    if (!no_contact_.empty() && jaws_clear(X_TI, organ)) no_contact_.clear();
    const bool enters = state_ == GripState::kAround || opening_m > kOpenEnough;
    if (fold.size() < kFewestPlaces || !enters) {
      let_go();
      return;
    }
    if (state_ == GripState::kEmpty) {
      const TissueSolid& tissue = organ.material(fold.front());
      const double area = options_.pad_length_m * options_.pad_width_m;
      block_.thickness_m = std::min(options_.fold_m, opening_m);
      block_.stiffness_n_per_m =
          options_.fold_stiffening * tissue.young_pa / (1 - tissue.poisson * tissue.poisson) * area / options_.fold_m;
      state_ = GripState::kAround;
    }
  }
  squeeze_n_ = block_.stiffness_n_per_m * std::max(0.0, block_.thickness_m - opening_m);
  if (holding && squeeze_n_ < kKeeps) {
    let_go();
    return;
  }
  if (!holding && squeeze_n_ >= kTakes) take(X_TI, fold, organ);
  for (const Place& place : places_) {
    const Vec3 apart = middle(*organ.surface(), place.triangle) - X_TI * place.point_I;
    const double stiffness = options_.hold_n_per_m / static_cast<double>(places_.size());
    for (int axis = 0; axis < kAxes; ++axis)
      springs.push_back({place.shares, Vec3::Unit(axis), stiffness, apart[axis], false, 0});
  }
}

void SoftGrip::feel(const Pose& X_TI, std::span<const SoftSpring> springs, const SoftOrgan& organ) {
  hold_ = {};
  if (places_.empty() || springs.size() != kAxes * places_.size()) return;
  pull_T_ = Vec3::Zero();
  for (std::size_t s = 0; s < springs.size(); ++s) pull_T_ += springs[s].force_n * springs[s].direction;
  const double most = 2 * options_.friction * squeeze_n_, pull = pull_T_.norm();
  const double kept = pull > most ? most / pull : 1;
  state_ = kept < 1 ? GripState::kSlipping : GripState::kHolding;
  NodeShares all;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Place& place = places_[i];
    Vec3 stretch;
    for (int axis = 0; axis < kAxes; ++axis)
      stretch[axis] =
          springs[kAxes * i + static_cast<std::size_t>(axis)].force_n / springs[kAxes * i].stiffness_n_per_m;
    place.point_I += X_TI.R.transpose() * ((1 - kept) * stretch);
    hold_.point_I += place.point_I / static_cast<double>(places_.size());
    for (std::size_t n = 0; n < place.shares.node.size(); ++n) {
      all.node.push_back(place.shares.node[n]);
      all.share.push_back(place.shares.share[n] / static_cast<float>(places_.size()));
    }
  }
  slipped_m_ += (1 - kept) * pull / options_.hold_n_per_m;
  pull_T_ *= kept;
  // What has slid off the pads is lost.
  std::erase_if(places_, [this](const Place& place) {
    return std::abs(place.point_I.x()) > options_.pad_width_m / 2 + kPadReach || place.point_I.z() > kPadReach ||
           place.point_I.z() < -options_.pad_length_m - kPadReach;
  });
  if (places_.size() < kFewestPlaces) {
    let_go();
    return;
  }
  const Vec3 direction = pull > 0 ? Vec3(pull_T_.normalized()) : Vec3::UnitZ();
  hold_.stiffness_n_per_m = organ.loop_stiffness(all, direction, options_.hold_n_per_m);
  hold_.anchor_T = X_TI * hold_.point_I + pull_T_ / hold_.stiffness_n_per_m;
}

}  // namespace trocar
