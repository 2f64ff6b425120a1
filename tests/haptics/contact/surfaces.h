// Closed surfaces by formula for the contact and collision tests.
#pragma once

#include <map>
#include <utility>

#include "tests/haptics/haptics_fixtures.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar::test {

inline TriangleSurface octahedron() {
  TriangleSurface s;
  s.vertices = {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
  s.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return s;
}

/// Unit sphere: every level quarters the triangles and pushes new vertices out.
inline TriangleSurface unit_sphere(int levels) {
  TriangleSurface s = octahedron();
  for (int level = 0; level < levels; ++level) {
    TriangleSurface fine{s.vertices, {}};
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    const auto mid = [&](std::int32_t a, std::int32_t b) {
      const auto [place, fresh] =
          middle.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(fine.vertices.size()));
      if (fresh) fine.vertices.push_back((s.vertices[std::size_t(a)] + s.vertices[std::size_t(b)]).normalized());
      return place->second;
    };
    for (const auto& [a, b, c] : s.triangles) {
      const std::int32_t ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
      fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s = std::move(fine);
  }
  return s;
}

/// Sphere of 8 * 4^levels triangles and this radius.
inline TriangleSurface sphere(int levels, double radius) {
  TriangleSurface s = unit_sphere(levels);
  for (Vec3& v : s.vertices) v *= radius;
  return s;
}

/// The same with bumps of 6 % of the radius.
inline TriangleSurface lumpy_sphere(int levels, double radius) {
  TriangleSurface s = unit_sphere(levels);
  for (Vec3& v : s.vertices) v *= radius * (1 + 0.06 * std::sin(5 * v.x()) * std::cos(4 * v.y() + v.z()));
  return s;
}

/// The triangles of a surface whose centre lies within `reach` of p, as a patch in the order of the surface.
inline void patch_near(const TriangleSurface& s, const Vec3& p, double reach, ContactPatch& patch) {
  patch.clear();
  for (const auto& [a, b, c] : s.triangles) {
    const Vec3 &u = s.vertices[std::size_t(a)], &v = s.vertices[std::size_t(b)], &w = s.vertices[std::size_t(c)];
    if (((u + v + w) / 3 - p).norm() < reach && patch.count < kMaxPatchTriangles) add_triangle(patch, u, v, w);
  }
}

}  // namespace trocar::test
