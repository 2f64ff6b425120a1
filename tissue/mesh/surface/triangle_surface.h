// An indexed triangle surface: the form in which every organ surface lives at run time.
//
// Metres, counter-clockwise seen from outside. Plain data; CGAL, ITK and assimp stay behind the .cpp files that make
// or repair such surfaces. Thread: immutable after loading.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

struct TriangleSurface {
  std::vector<Vec3> vertices;                          ///< m
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< vertex indices, outward by the right-hand rule

  /// Where the corners of one of its triangles are, m.
  std::array<Vec3, 3> corners(const std::array<std::int32_t, 3>& triangle) const {
    const auto at = [this](std::int32_t vertex) -> const Vec3& { return vertices[static_cast<std::size_t>(vertex)]; };
    return {at(triangle[0]), at(triangle[1]), at(triangle[2])};
  }
  /// Area-weighted unit vertex normals (same order as vertices).
  std::vector<Vec3> vertex_normals() const;
  /// Signed enclosed volume (divergence theorem), m^3. Meaningful for closed surfaces only.
  double volume_m3() const;
  Eigen::AlignedBox3d bounds() const;
  /// Copy moved by a rigid transform.
  TriangleSurface transformed(const Pose& X) const;
};

}  // namespace trocar
