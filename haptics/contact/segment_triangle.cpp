#include "haptics/contact/segment_triangle.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kBeyond = 1e-6;  // share of the segment that all corners must lie ahead of its end: above rounding
constexpr double kInside = 1e-3;  // the same for ends that are certainly not the nearest point

struct SegmentPair {
  double s, t;  ///< parameters on the first and the second segment
};

/// Nearest points of two segments p + s d1, q + t d2 (s, t in [0, 1]).
SegmentPair closest_segments(const Vec3& p, const Vec3& d1, const Vec3& q, const Vec3& d2) {
  const Vec3 r = p - q;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
  if (a <= 0) return {0, e > 0 ? std::clamp(f / e, 0.0, 1.0) : 0};
  const double c = d1.dot(r);
  if (e <= 0) return {std::clamp(-c / a, 0.0, 1.0), 0};
  const double b = d1.dot(d2);
  const double denominator = a * e - b * b;
  double s = denominator > 1e-14 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0;
  double t = (b * s + f) / e;
  if (t < 0) {
    t = 0;
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((b - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

/// Whether a-b passes through the triangle; if so, `along` is where.
bool crosses(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& tri, double& along) {
  const Vec3 e1 = tri[1] - tri[0], e2 = tri[2] - tri[0], d = b - a;
  const Vec3 p = d.cross(e2);
  const double det = e1.dot(p);
  if (std::abs(det) <= 1e-14 * e1.norm() * e2.norm() * d.norm()) return false;
  const Vec3 s = a - tri[0];
  const double u = s.dot(p) / det;
  if (u < 0 || u > 1) return false;
  const Vec3 q = s.cross(e1);
  const double v = d.dot(q) / det;
  if (v < 0 || u + v > 1) return false;
  along = e2.dot(q) / det;
  return along >= 0 && along <= 1;
}

/// The nearest of several pairs of points; of equals the first.
struct Nearest {
  ClosestPair pair;
  double squared = -1;

  void offer(double s, const Vec3& on_segment, const Vec3& on_triangle) {
    const double distance2 = (on_segment - on_triangle).squaredNorm();
    if (squared >= 0 && distance2 >= squared) return;
    squared = distance2;
    pair.along = s;
    pair.on_segment = on_segment;
    pair.on_triangle = on_triangle;
  }
};

/// Nearest pair when all of the triangle lies ahead of the end a of a segment: the same digits as the long way round.
ClosestPair closest_to_end(const Vec3& a, const std::array<Vec3, 3>& tri) {
  Nearest nearest;
  nearest.offer(0, a, closest_point_on_triangle(a, tri));
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = tri[(i + 1) % 3] - tri[i];
    const double e = edge.squaredNorm(), f = edge.dot(a - tri[i]);
    nearest.offer(0, a, tri[i] + edge * (e > 0 ? std::clamp(f / e, 0.0, 1.0) : 0));
  }
  nearest.pair.distance = std::sqrt(nearest.squared);
  return nearest.pair;
}

}  // namespace

Vec3 closest_point_on_triangle(const Vec3& p, const std::array<Vec3, 3>& tri) {
  const auto& [a, b, c] = tri;
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

ClosestPair closest_segment_triangle(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& tri) {
  // Where the corners lie along the segment tells what cannot be the nearest pair, and most of it is never worked out:
  // a shaft presses with its end on a fine surface, and then no other point of it needs a look.
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double m0 = (tri[0] - a).dot(d), m1 = (tri[1] - a).dot(d), m2 = (tri[2] - a).dot(d);
  const double first = std::min({m0, m1, m2}), last = std::max({m0, m1, m2});
  if (last < -kBeyond * length2) return closest_to_end(a, tri);
  ClosestPair best;
  double along = 0;
  if (crosses(a, b, tri, along)) {
    best.along = along;
    best.on_segment = best.on_triangle = a + (b - a) * along;
    best.crossing = true;
    return best;
  }
  Nearest nearest;
  if (last >= (1 - kInside) * length2) nearest.offer(1, b, closest_point_on_triangle(b, tri));
  if (first <= kInside * length2) nearest.offer(0, a, closest_point_on_triangle(a, tri));
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = tri[(i + 1) % 3] - tri[i];
    const SegmentPair pair = closest_segments(a, d, tri[i], edge);
    nearest.offer(pair.s, a + d * pair.s, tri[i] + edge * pair.t);
  }
  nearest.pair.distance = std::sqrt(nearest.squared);
  return nearest.pair;
}

}  // namespace trocar
