#include "tissue/thin/rod_bend.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kFoldedBack = 1e-4;  // of 1 + t_a . t_b: nearer to a fold than that has no direction to bend in

double bend_divisor(const SegmentFrame& a, const SegmentFrame& b) { return std::max(1 + a.t.dot(b.t), kFoldedBack); }

Vec3 curvature_binormal(const SegmentFrame& a, const SegmentFrame& b) {
  return 2 * a.t.cross(b.t) / bend_divisor(a, b);
}

}  // namespace

Vec3 carried_over(const Vec3& d, const Vec3& from, const Vec3& to) {
  const double divisor = 1 + from.dot(to);
  Vec3 carried = divisor > kFoldedBack ? Vec3(d - d.dot(to) / divisor * (from + to)) : d;
  carried -= carried.dot(to) * to;
  const double length = carried.norm();
  return length > 1e-9 ? Vec3(carried / length) : Vec3(to.unitOrthogonal());
}

BendStrain bend_strain(const SegmentFrame& a, const SegmentFrame& b, double near_twist) {
  const Vec3 kb = curvature_binormal(a, b);
  const Vec3 carried = carried_over(a.d1, a.t, b.t);
  const double twist = std::atan2(carried.cross(b.d1).dot(b.t), carried.dot(b.d1));
  constexpr double kTurn = 2 * std::numbers::pi;
  return {0.5 * (a.d2 + b.d2).dot(kb), -0.5 * (a.d1 + b.d1).dot(kb),
          twist + kTurn * std::round((near_twist - twist) / kTurn)};
}

BendGradient bend_gradient(const SegmentFrame& a, const SegmentFrame& b, const BendStrain& strain) {
  const double divisor = bend_divisor(a, b);
  const Vec3 kb = curvature_binormal(a, b);
  const Vec3 t = (a.t + b.t) / divisor, d1 = (a.d1 + b.d1) / divisor, d2 = (a.d2 + b.d2) / divisor;
  BendGradient g;
  g.by_a.row(0) = (-strain[0] * t + b.t.cross(d2)) / a.length_m;
  g.by_b.row(0) = (-strain[0] * t - a.t.cross(d2)) / b.length_m;
  g.by_a.row(1) = (-strain[1] * t - b.t.cross(d1)) / a.length_m;
  g.by_b.row(1) = (-strain[1] * t + a.t.cross(d1)) / b.length_m;
  g.by_a.row(2) = kb / (2 * a.length_m);
  g.by_b.row(2) = kb / (2 * b.length_m);
  g.by_turn_a = {-0.5 * a.d1.dot(kb), -0.5 * a.d2.dot(kb), -1};
  g.by_turn_b = {-0.5 * b.d1.dot(kb), -0.5 * b.d2.dot(kb), 1};
  return g;
}

}  // namespace trocar
