#include "tests/scenarios/support/test_organs.h"

#include <cmath>

namespace trocar {

TriangleSurface bumpy_ellipsoid(const Vec3& half_axes, int rings, double bump_m) {
  TriangleSurface surface;
  const int sectors = 2 * rings;
  const auto point = [&](double theta, double phi) {
    const Vec3 unit(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    const double bump = bump_m * std::sin(5 * unit.x()) * std::sin(4 * unit.z() + 1);
    return Vec3(unit.cwiseProduct(half_axes) + bump * unit);
  };
  surface.vertices.push_back(point(0, 0));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) surface.vertices.push_back(point(M_PI * i / rings, 2 * M_PI * j / sectors));
  surface.vertices.push_back(point(M_PI, 0));
  const auto at = [&](int ring, int sector) { return 1 + (ring - 1) * sectors + sector % sectors; };
  const auto last = static_cast<std::int32_t>(surface.vertices.size()) - 1;
  for (int j = 0; j < sectors; ++j) {
    surface.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    surface.triangles.push_back({at(rings - 1, j), last, at(rings - 1, j + 1)});
  }
  return surface;
}

TriangleSurface liver_like() { return bumpy_ellipsoid(Vec3(0.11, 0.07, 0.09), 39, 0.004); }

TriangleSurface gallbladder_like() { return bumpy_ellipsoid(Vec3(0.016, 0.015, 0.035), 20, 0.0); }

TriangleSurface plate(double edge, double top_m) {
  TriangleSurface out;
  const int n = static_cast<int>(std::lround(edge / 0.002));
  const auto at = [n](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) out.vertices.push_back({edge * i / n - edge / 2, edge * j / n - edge / 2, top_m});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return out;
}

TriangleSurface box(const Vec3& size) {
  TriangleSurface surface;
  for (int i = 0; i < 8; ++i)
    surface.vertices.emplace_back((i & 1) * size.x(), (i >> 1 & 1) * size.y(), (i >> 2) * size.z());
  surface.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return surface;
}

}  // namespace trocar
