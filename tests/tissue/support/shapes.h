// Surfaces and label maps of known volume for tests.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar::test {

/// Axis-parallel box, outward.
inline TriangleSurface box(const Vec3& low, const Vec3& high) {
  TriangleSurface surface;
  for (int corner = 0; corner < 8; ++corner)
    surface.vertices.emplace_back((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                                  (corner & 4) != 0 ? high.z() : low.z());
  surface.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return surface;
}

/// Octahedron whose triangles are split in four `levels` times and pushed onto the sphere.
inline TriangleSurface sphere(const Vec3& centre, double radius, int levels) {
  TriangleSurface surface;
  surface.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  surface.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(surface.vertices.size()));
      if (fresh)
        surface.vertices.push_back(
            (surface.vertices[static_cast<std::size_t>(a)] + surface.vertices[static_cast<std::size_t>(b)])
                .normalized());
      return entry->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : surface.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t :
           {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
        finer.push_back(t);
    }
    surface.triangles = finer;
  }
  for (Vec3& vertex : surface.vertices) vertex = centre + radius * vertex;
  return surface;
}

inline TriangleSurface joined(TriangleSurface a, const TriangleSurface& b) {
  const auto shift = static_cast<std::int32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + shift, j + shift, k + shift});
  return a;
}

inline double sphere_volume(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

/// Label 1 in a ball, on a cubic grid whose middle is the patient's origin.
inline LabelVolume ball_volume(int extent, double voxel_mm, const Eigen::Vector3d& centre_mm, double radius_mm) {
  LabelVolume volume;
  volume.size = {extent, extent, extent};
  volume.index_to_ras_mm.linear() *= voxel_mm;
  volume.index_to_ras_mm.translation().setConstant(-voxel_mm * (extent - 1) / 2);
  for (int k = 0; k < extent; ++k)
    for (int j = 0; j < extent; ++j)
      for (int i = 0; i < extent; ++i)
        volume.labels.push_back((volume.index_to_ras_mm * Eigen::Vector3d(i, j, k) - centre_mm).norm() < radius_mm ? 1
                                                                                                                   : 0);
  return volume;
}

/// ASCII PLY of the surface, coordinates multiplied by `scale`.
inline std::string ascii_ply(const TriangleSurface& surface, double scale) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(surface.vertices.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(surface.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& v : surface.vertices)
    text += std::to_string(v.x() * scale) + " " + std::to_string(v.y() * scale) + " " + std::to_string(v.z() * scale) +
            "\n";
  for (const auto& [a, b, c] : surface.triangles)
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return text;
}

}  // namespace trocar::test
