// The foot of a place on a surface that moves, found from where it was a step ago.
//
// From the vertex that was nearest it goes on over edges while that leads nearer, so that a look costs some vertices
// and not the surface. Where the surface is folded it may stay on its fold: what is asked for the first time looks at
// all vertices. m. Thread: immutable, any.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "haptics/exchange/material_point.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct SurfaceFoot {
  MaterialPoint place;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< out of the surface there
  double height_m = 0;                                ///< of the place over it, negative inside
};

class SurfaceWalk {
 public:
  explicit SurfaceWalk(const TriangleSurface& surface);

  /// Of vertices that are the surface's, wherever they are now. @param from the vertex that was nearest; -1: looks at
  /// all. @return the nearest one
  std::int32_t nearest(std::span<const Vec3> vertices, const Vec3& place, std::int32_t from) const;
  /// @param vertex as `from`; becomes the nearest
  SurfaceFoot foot(std::span<const Vec3> vertices, const Vec3& place, std::int32_t& vertex) const;

 private:
  std::span<const std::int32_t> round(std::int32_t vertex) const;  ///< triangles at a vertex

  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::int32_t> first_, at_vertex_;
};

}  // namespace trocar
