#include "haptics/contact/contact_friction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "haptics/least_turn.h"

namespace trocar {
namespace {

constexpr double kTangential = 0.8;       // k_t / k
constexpr double kMergeDistance = 3e-3;   // m
constexpr double kMergeCosine = 0.966;    // 15 deg
constexpr double kSameDistance = 6e-3;    // m: the same contact one period later, or the one that it split from
constexpr double kSameCosine = 0.5;       // 60 deg: a turn over a sharp edge in one period
constexpr double kRolledDistance = 5e-4;  // m: above encoder noise, so that a stuck contact keeps its points
constexpr double kRolledCosine = 0.990;   // 8 deg
constexpr double kBreakAway = 0.05;       // of the way from mu_s to mu(v) a period
constexpr double kAgeing = 0.02;          // of the way back to mu_s a period at rest

Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) { return least_turn(from, to) * v; }

Vec3 across(const Vec3& v, const Vec3& normal) { return v - normal * normal.dot(v); }

double stribeck(const ContactMaterial& m, double speed_m_s) {
  const double ratio = m.stribeck_m_s > 0 ? speed_m_s / m.stribeck_m_s : 1e3;
  return m.mu_dynamic + (m.mu_static - m.mu_dynamic) * std::exp(-std::min(50.0, ratio * ratio));
}

}  // namespace

FrictionResult ContactFriction::update(const PressingTool& tool, std::span<const PressedPlace> places,
                                       double stiffness_n_per_m, const ContactPatch& patch) {
  FrictionResult result;
  const bool ids_hold = std::exchange(topology_, patch.topology) == patch.topology;
  const Merged merged = merge(places);
  double depth = 0;
  for (int i = 0; i < merged.count; ++i) depth += merged.at[i].share;
  std::array<Anchor, kMaxPressedPlaces> next;
  int kept = 0;
  for (int i = 0; i < merged.count; ++i) {
    const PressedPlace& place = merged.at[i];
    const auto& material = patch.material[static_cast<std::size_t>(patch.triangle[place.index].material)];
    const Anchor* known = find(place);
    if (!known && material.mu_static <= 0) continue;
    const Pose X_TC = tool.X_TI * tool.capsules.at[place.capsule].X_IC;
    Anchor& anchor = next[kept++];
    if (known) anchor = *known;
    anchor.capsule = place.capsule;
    if (!known) {
      anchor.normal = place.normal;
      anchor.mu = material.mu_static;
    }
    const bool held = known && ids_hold && stretch(anchor, place, X_TC, patch);
    if (!held) anchor.u = turned(anchor.u, anchor.normal, place.normal);
    anchor.normal = place.normal;
    anchor.foot = place.foot;
    const Vec3 lever = place.foot - tool.y - tool.X_TI.p;
    const Vec3 speed = across(tool.V_TI_T.linear + tool.V_TI_T.angular.cross(lever) - place.velocity, place.normal);
    const double before = anchor.u.squaredNorm();
    slide(anchor, material, speed.norm(), depth / kTangential);
    const bool dragged = anchor.u.squaredNorm() < before;
    if (!held || dragged) take_points(anchor, place, X_TC, tool.y, patch);

    const double spring = kTangential * stiffness_n_per_m * place.share / depth;
    const Vec3 force = -spring * anchor.u;
    result.F_I_T.force += force;
    result.F_I_T.moment += lever.cross(force);
    result.stored_j += 0.5 * spring * anchor.u.squaredNorm();
    result.slipping = result.slipping || anchor.slipping;
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (merged.into[p] == i) result.at[p] = {force * (places[p].share / merged.pressed[i]), anchor.on_tissue};
    }
  }
  anchor_ = next;
  count_ = kept;
  return result;
}

ContactFriction::Merged ContactFriction::merge(std::span<const PressedPlace> places) {
  Merged merged;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const PressedPlace& place = places[p];
    int into = 0;
    while (into < merged.count &&
           !(merged.at[into].capsule == place.capsule && merged.at[into].normal.dot(place.normal) > kMergeCosine &&
             (merged.at[into].foot - place.foot).norm() < kMergeDistance)) {
      ++into;
    }
    merged.into[p] = into;
    merged.pressed[into] += place.share;
    PressedPlace& m = merged.at[into];
    if (into == merged.count) {
      m = place;
      ++merged.count;
      continue;
    }
    const double sum = m.share + place.share;
    if (place.share > m.share) m.index = place.index;
    m.foot = (m.foot * m.share + place.foot * place.share) / sum;
    m.velocity = (m.velocity * m.share + place.velocity * place.share) / sum;
    const Vec3 pressed = m.normal * m.share + place.normal * place.share;
    m.normal = pressed.normalized();
    m.share = pressed.norm();
  }
  return merged;
}

const ContactFriction::Anchor* ContactFriction::find(const PressedPlace& place) const {
  const Anchor* best = nullptr;
  double nearest = kSameDistance;
  for (int i = 0; i < count_; ++i) {
    const Anchor& a = anchor_[i];
    const double distance = (a.foot - place.foot).norm();
    if (a.capsule != place.capsule || distance >= nearest || a.normal.dot(place.normal) < kSameCosine) continue;
    best = &a;
    nearest = distance;
  }
  return best;
}

bool ContactFriction::stretch(Anchor& anchor, const PressedPlace& place, const Pose& X_TC,
                              const ContactPatch& patch) const {
  const std::int32_t id = anchor.on_tissue.triangle;
  if (anchor.index >= patch.count || patch.triangle[anchor.index].id != id) {
    std::int32_t i = 0;
    while (i < patch.count && patch.triangle[i].id != id) ++i;
    if (i == patch.count) return false;
    anchor.index = i;
  }
  const Vec3 on_tissue = interpolate(anchor.on_tissue.weight, patch.corners(anchor.index));
  const Vec3 apart = X_TC * anchor.on_tool - on_tissue - anchor.origin;
  anchor.u = turned(across(apart, anchor.normal_then), anchor.normal_then, place.normal);
  anchor.normal = place.normal;
  return (place.foot - on_tissue).norm() < kRolledDistance && anchor.normal_then.dot(place.normal) > kRolledCosine;
}

void ContactFriction::take_points(Anchor& anchor, const PressedPlace& place, const Pose& X_TC, const Vec3& y,
                                  const ContactPatch& patch) const {
  const std::array<Vec3, 3> triangle = patch.corners(place.index);
  anchor.index = place.index;
  anchor.on_tissue = {patch.triangle[place.index].id, barycentric_of(place.foot, triangle)};
  const Vec3 on_tissue = interpolate(anchor.on_tissue.weight, triangle);
  const Vec3 on_tool = place.foot - y;
  anchor.on_tool = X_TC.inverse() * on_tool;
  anchor.origin = on_tool - on_tissue - anchor.u;
  anchor.normal_then = place.normal;
}

void ContactFriction::slide(Anchor& anchor, const ContactMaterial& material, double speed_m_s, double limit_m) const {
  const bool already = anchor.slipping;
  anchor.slipping = anchor.u.norm() > anchor.mu * limit_m;
  if (anchor.slipping) {
    if (already) anchor.mu += kBreakAway * (stribeck(material, speed_m_s) - anchor.mu);
    const double length = anchor.u.norm(), allowed = anchor.mu * limit_m;
    if (length > allowed) anchor.u *= allowed / length;
  } else {
    const double way = material.mu_static - anchor.mu;
    anchor.mu += (way > 0 ? kAgeing : kBreakAway) * way;
  }
}

}  // namespace trocar
