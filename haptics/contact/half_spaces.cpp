#include "haptics/contact/half_spaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trocar {
namespace {

constexpr double kParallel = 1e-9;  // sine under which two planes have no common line

/// How far s lies on the forbidden side.
double violation(const HalfSpace& h, const Vec3& s) { return -h.gap - h.normal.dot(s); }

/// Nearest point to w on the common line of planes a and b that the half-spaces before them allow.
Vec3 on_line(const Vec3& w, std::span<const HalfSpace> before, const HalfSpace& a, const HalfSpace& b) {
  const Vec3 across = a.normal.cross(b.normal);
  const double sine2 = across.squaredNorm(), cosine = a.normal.dot(b.normal);
  const double va = violation(a, w), vb = violation(b, w);
  const Vec3 foot = w + a.normal * ((va - cosine * vb) / sine2) + b.normal * ((vb - cosine * va) / sine2);
  const Vec3 direction = across / std::sqrt(sine2);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (const HalfSpace& h : before) {
    const double slope = h.normal.dot(direction), needed = violation(h, foot);
    if (slope > kParallel) low = std::max(low, needed / slope);
    if (slope < -kParallel) high = std::min(high, needed / slope);
  }
  if (low > high) low = high = (low + high) / 2;  // one point is left, and rounding has crossed its two bounds
  return foot + direction * std::clamp(0.0, low, high);
}

/// Nearest point to w on plane a that the half-spaces before it allow.
Vec3 on_plane(const Vec3& w, std::span<const HalfSpace> before, const HalfSpace& a, double tolerance) {
  Vec3 s = w + a.normal * violation(a, w);
  for (std::size_t j = 0; j < before.size(); ++j) {
    if (violation(before[j], s) <= tolerance) continue;
    if (a.normal.cross(before[j].normal).squaredNorm() < kParallel * kParallel) continue;
    s = on_line(w, before.first(j), a, before[j]);
  }
  return s;
}

}  // namespace

Vec3 nearest_allowed(const Vec3& w, std::span<const HalfSpace> half_spaces) {
  const double tolerance = 1e-13 * w.norm();
  Vec3 s = w;
  for (std::size_t i = 0; i < half_spaces.size(); ++i) {
    if (violation(half_spaces[i], s) > tolerance) s = on_plane(w, half_spaces.first(i), half_spaces[i], tolerance);
  }
  return s;
}

}  // namespace trocar
