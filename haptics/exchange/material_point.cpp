#include "haptics/exchange/material_point.h"

namespace trocar {

Barycentric barycentric_of(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0], d = p - t[0];
  const double a = e1.dot(e1), b = e1.dot(e2), c = e2.dot(e2), f = e1.dot(d), g = e2.dot(d);
  const double det = a * c - b * b;
  if (det <= 1e-12 * a * c) return {1, 0, 0};  // a needle: its first corner stands for it
  const double v = (c * f - b * g) / det, w = (a * g - b * f) / det;
  return {1 - v - w, v, w};
}

}  // namespace trocar
