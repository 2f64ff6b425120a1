#include "haptics/contact/gliding_patch.h"

#include <algorithm>
#include <numeric>

namespace trocar {

const ContactPatch& GlidingPatch::follow(const ContactPatch& newest, const SolvedContacts& pressed, double stored_j,
                                         double thinnest_m) {
  moved_m_ = 0;
  if (newest.glide_s <= 0) {
    force_share_ = 1;
    forget();
    return newest;
  }
  if (!filled_) tank_j_ = parameters_.tank_j;
  filled_ = true;
  if (newest.stamp != stamp_) take(newest);
  age_s_ += parameters_.period_s;
  double step = std::min(1 - progress_, parameters_.period_s / newest.glide_s);
  if (longest_m_ * step > parameters_.most_step * thinnest_m) step = parameters_.most_step * thinnest_m / longest_m_;
  const double cost = step * cost_of_rest(pressed, stored_j);
  if (parameters_.metered && cost > tank_j_) step *= std::max(0.0, tank_j_) / cost;
  tank_j_ = std::min(parameters_.tank_j, tank_j_ - std::min(cost, std::max(0.0, tank_j_)));
  move(step);
  // Back as it went, only faster: news is no blow.
  const double wanted = std::clamp(1 - (age_s_ - parameters_.stale_s) / parameters_.fade_s, 0.0, 1.0);
  force_share_ =
      pressed.count == 0 ? wanted : std::min(wanted, force_share_ + parameters_.period_s / parameters_.return_s);
  return present_;
}

void GlidingPatch::dissipated(double energy_j) {
  tank_j_ = std::min(parameters_.tank_j, tank_j_ + std::max(0.0, energy_j));
}

GlidingPatch::Places GlidingPatch::places_in_present(const ContactPatch& newest) const {
  if (newest.follows == stamp_) return newest.previous;
  // A patch between them was lost: the triangles' ids tell.
  Places places;
  places.fill(-1);
  std::array<std::int16_t, kMaxPatchTriangles> by_id;
  const auto last = by_id.begin() + present_.count;
  std::iota(by_id.begin(), last, std::int16_t{0});
  const auto id = [this](std::int16_t i) { return present_.triangle[static_cast<std::size_t>(i)].id; };
  std::sort(by_id.begin(), last, [&](std::int16_t a, std::int16_t b) { return id(a) < id(b); });
  for (int t = 0; t < newest.count; ++t) {
    const PatchTriangle& triangle = newest.triangle[static_cast<std::size_t>(t)];
    const auto found =
        std::lower_bound(by_id.begin(), last, triangle.id, [&](std::int16_t i, std::int32_t of) { return id(i) < of; });
    if (found == last || id(*found) != triangle.id) continue;
    for (std::size_t c = 0; c < 3; ++c)
      places[static_cast<std::size_t>(triangle.corner[c])] =
          present_.triangle[static_cast<std::size_t>(*found)].corner[c];
  }
  return places;
}

void GlidingPatch::take(const ContactPatch& newest) {
  const bool known = stamp_ != 0 && newest.topology == present_.topology;
  Places places;
  if (known) places = places_in_present(newest);
  longest_m_ = 0;
  for (int i = 0; i < newest.vertex_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::int16_t before = known ? places[at] : std::int16_t{-1};
    end_[at] = newest.vertex[at];
    start_[at] = before >= 0 ? present_.vertex[static_cast<std::size_t>(before)]
                             : Vec3(newest.vertex[at] - newest.glide_s * newest.velocity[at]);
    longest_m_ = std::max(longest_m_, (end_[at] - start_[at]).norm());
  }
  for (std::size_t m = 0; m < kMaxPatchMaterials; ++m) {
    stiff_end_[m] = newest.material[m].stiffness_n_per_m;
    stiff_start_[m] = stamp_ != 0 ? present_.material[m].stiffness_n_per_m : stiff_end_[m];
  }
  // A grip comes and goes by its stiffness; its anchor has no place while there is none.
  hold_start_ = stamp_ != 0 ? present_.hold : newest.hold;
  hold_end_ = newest.hold;
  if (hold_start_.stiffness_n_per_m <= 0) hold_start_ = {hold_end_.point_I, hold_end_.anchor_T, 0};
  if (hold_end_.stiffness_n_per_m <= 0) hold_end_ = {hold_start_.point_I, hold_start_.anchor_T, 0};
  present_.stamp = newest.stamp;
  present_.topology = newest.topology;
  present_.count = newest.count;
  present_.vertex_count = newest.vertex_count;
  present_.dropped = newest.dropped;
  present_.reach_m = newest.reach_m;
  present_.moving = true;
  present_.glide_s = newest.glide_s;
  std::copy_n(newest.triangle.begin(), newest.count, present_.triangle.begin());
  std::copy_n(start_.begin(), newest.vertex_count, present_.vertex.begin());
  present_.material = newest.material;
  present_.grip = newest.grip;
  present_.held = newest.held;
  present_.balls.count = -1;  // made where the vertices end: here they are still on their way
  stamp_ = newest.stamp;
  progress_ = 0;
  age_s_ = 0;
  dissipated(newest.given_j);
}

/// Of F^2 / 2 k, as both go over in straight lines.
double GlidingPatch::cost_of_hold() const {
  const double k = present_.hold.stiffness_n_per_m;
  if (k <= 0) return 0;
  const auto force = [this](const GripHold& hold) {
    return Vec3(hold.stiffness_n_per_m * (hold.anchor_T - X_TI_ * hold.point_I));
  };
  const double stiffer = hold_end_.stiffness_n_per_m - hold_start_.stiffness_n_per_m;
  return pull_T_.dot(force(hold_end_) - force(hold_start_)) / k - 0.5 * stiffer * pull_T_.squaredNorm() / (k * k);
}

double GlidingPatch::cost_of_rest(const SolvedContacts& pressed, double stored_j) const {
  if (progress_ >= 1) return 0;
  double cost = cost_of_hold(), force = 0, stiffer = 0;
  for (int i = 0; i < pressed.count; ++i) {
    const SolvedContact& contact = pressed.at[static_cast<std::size_t>(i)];
    const auto end = present_.triangle.begin() + present_.count;
    const auto found = std::find_if(present_.triangle.begin(), end,
                                    [&](const PatchTriangle& t) { return t.id == contact.place.triangle; });
    if (found == end) continue;
    const auto way = [this](std::int16_t corner) -> Vec3 {
      return end_[static_cast<std::size_t>(corner)] - start_[static_cast<std::size_t>(corner)];
    };
    const auto& [a, b, c] = found->corner;
    cost += contact.force_T.dot(interpolate(contact.place.weight, {way(a), way(b), way(c)}));
    const auto material = static_cast<std::size_t>(found->material);
    const double now = present_.material[material].stiffness_n_per_m;
    if (now > 0) stiffer += contact.force_T.norm() * (stiff_end_[material] - stiff_start_[material]) / now;
    force += contact.force_T.norm();
  }
  return force > 0 ? cost + stored_j * stiffer / force : cost;
}

void GlidingPatch::move(double share) {
  progress_ = std::min(1.0, progress_ + share);
  moved_m_ = share * longest_m_;
  const double rate = share / parameters_.period_s;
  for (int i = 0; i < present_.vertex_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Vec3 way = end_[at] - start_[at];
    present_.vertex[at] = start_[at] + progress_ * way;
    present_.velocity[at] = rate * way;
  }
  // Of the grip the force goes over in a straight line. Stiffness and anchor each for itself would make it bulge: a
  // soft spring's anchor is far away.
  const double at_start = (1 - progress_) * hold_start_.stiffness_n_per_m,
               at_end = progress_ * hold_end_.stiffness_n_per_m, k = at_start + at_end, of_end = k > 0 ? at_end / k : 0;
  const auto between = [of_end](const Vec3& from, const Vec3& to) -> Vec3 { return from + of_end * (to - from); };
  present_.hold = {between(hold_start_.point_I, hold_end_.point_I), between(hold_start_.anchor_T, hold_end_.anchor_T),
                   k};
  for (std::size_t m = 0; m < kMaxPatchMaterials; ++m)
    present_.material[m].stiffness_n_per_m = stiff_start_[m] + progress_ * (stiff_end_[m] - stiff_start_[m]);
}

}  // namespace trocar
