#include "haptics/contact/contact_friction.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

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

Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to) * v;
}

Vec3 across(const Vec3& v, const Vec3& normal) { return v - normal * normal.dot(v); }

std::array<double, 3> barycentric_of(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0], d = p - t[0];
  const double a = e1.dot(e1), b = e1.dot(e2), c = e2.dot(e2), f = e1.dot(d), g = e2.dot(d);
  const double det = a * c - b * b;
  if (det <= 1e-12 * a * c) return {1, 0, 0};  // a needle: its first corner stands for it
  const double v = (c * f - b * g) / det, w = (a * g - b * f) / det;
  return {1 - v - w, v, w};
}

double stribeck(const ContactMaterial& m, double speed_m_s) {
  const double ratio = m.stribeck_m_s > 0 ? speed_m_s / m.stribeck_m_s : 1e3;
  return m.mu_dynamic + (m.mu_static - m.mu_dynamic) * std::exp(-std::min(50.0, ratio * ratio));
}

}  // namespace

FrictionResult ContactFriction::update(const PressingTool& tool, std::span<const PressedPlace> places,
                                       double stiffness_n_per_m, const ContactPatch& patch) {
  FrictionResult result;
  std::array<PressedPlace, kMaxPlaces> merged;
  const int count = merge(places, merged);
  double depth = 0;
  for (int i = 0; i < count; ++i) depth += merged[i].share;
  std::array<Anchor, kMaxPlaces> next;
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const PressedPlace& place = merged[i];
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
    const bool held = known && stretch(anchor, place, X_TC, patch);
    if (!held) anchor.u = turned(anchor.u, anchor.normal, place.normal);
    anchor.normal = place.normal;
    anchor.foot = place.foot;
    const Vec3 lever = place.foot - tool.y - tool.X_TI.p;
    const Vec3 speed = across(tool.V_TI_T.linear + tool.V_TI_T.angular.cross(lever), place.normal);
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
  }
  anchor_ = next;
  count_ = kept;
  return result;
}

int ContactFriction::merge(std::span<const PressedPlace> places, std::array<PressedPlace, kMaxPlaces>& merged) const {
  int count = 0;
  for (const PressedPlace& place : places) {
    int into = 0;
    while (into < count &&
           !(merged[into].capsule == place.capsule && merged[into].normal.dot(place.normal) > kMergeCosine &&
             (merged[into].foot - place.foot).norm() < kMergeDistance)) {
      ++into;
    }
    if (into == count) {
      merged[count++] = place;
      continue;
    }
    PressedPlace& m = merged[into];
    const double sum = m.share + place.share;
    if (place.share > m.share) m.index = place.index;
    m.foot = (m.foot * m.share + place.foot * place.share) / sum;
    const Vec3 pressed = m.normal * m.share + place.normal * place.share;
    m.normal = pressed.normalized();
    m.share = pressed.norm();
  }
  return count;
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
  if (anchor.index >= patch.count || patch.triangle[anchor.index].id != anchor.id) {
    std::int32_t i = 0;
    while (i < patch.count && patch.triangle[i].id != anchor.id) ++i;
    if (i == patch.count) return false;
    anchor.index = i;
  }
  const auto& v = patch.triangle[anchor.index].vertex;
  const auto& b = anchor.barycentric;
  const Vec3 on_tissue = b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
  const Vec3 apart = X_TC * anchor.on_tool - on_tissue - anchor.origin;
  anchor.u = turned(across(apart, anchor.normal_then), anchor.normal_then, place.normal);
  anchor.normal = place.normal;
  return (place.foot - on_tissue).norm() < kRolledDistance && anchor.normal_then.dot(place.normal) > kRolledCosine;
}

void ContactFriction::take_points(Anchor& anchor, const PressedPlace& place, const Pose& X_TC, const Vec3& y,
                                  const ContactPatch& patch) const {
  const PatchTriangle& triangle = patch.triangle[place.index];
  anchor.index = place.index;
  anchor.id = triangle.id;
  anchor.barycentric = barycentric_of(place.foot, triangle.vertex);
  const auto& b = anchor.barycentric;
  const Vec3 on_tissue = b[0] * triangle.vertex[0] + b[1] * triangle.vertex[1] + b[2] * triangle.vertex[2];
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
