// The surface of a rod for pictures and contact: a ring of vertices at each node, a strip of triangles each segment,
// a cap at each end.
//
// The rings turn with the rod's material frames, so nothing jumps when it moves; they are flat where the lumen is
// squeezed. A cut leaves the numbers of vertices and triangles as they are: the strip that was cut now ends at the new
// ring, the other half of it, two caps and their vertices follow (surface_growth.h). Closed and manifold before and
// after. T, m. Thread: tissue task.
#pragma once

#include <cstdint>
#include <vector>

#include "haptics/exchange/material_point.h"
#include "tissue/mesh/surface/surface_growth.h"
#include "tissue/surface_snapshot.h"
#include "tissue/thin/elastic_rod.h"
#include "tissue/thin/lumen.h"

namespace trocar {

class RodSurface {
 public:
  /// @param rod not cut yet. @param sides of a ring, >= 3
  explicit RodSurface(const ElasticRod& rod, int sides = 12);

  /// After a step. @param lumen where it is flat; nullptr: round everywhere
  void follow(const ElasticRod& rod, const Lumen* lumen = nullptr);

  const SurfacePtr& surface() const { return surface_; }
  std::uint64_t topology() const { return rest_->topology; }
  /// What the last follow() added: empty unless the rod was cut.
  const std::vector<VertexOrigin>& added() const { return added_; }
  /// Where on the rod a point of the surface is.
  double arc_of(const MaterialPoint& place) const;

 private:
  struct Ring {
    std::int32_t first = 0;
    std::int32_t centre = -1;  ///< of its cap
    std::int32_t cap = -1;     ///< its first triangle
    std::int32_t strip = -1;   ///< first triangle of the strip behind it
  };
  void add_ring(std::int32_t id);
  void add_centre(std::int32_t id);
  void set_strip(std::int32_t from, std::int32_t to);
  void set_cap(std::int32_t id, bool at_start);
  void join(const ElasticRod& rod);
  void grow(const ElasticRod& rod);
  std::vector<Vec3> outline(const ElasticRod& rod, const Lumen* lumen) const;

  int sides_;
  std::size_t drawn_nodes_ = 0;
  std::uint64_t cuts_ = 0;
  std::vector<Ring> rings_;   ///< by the node's id
  std::vector<double> arcs_;  ///< of vertices
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<VertexOrigin> added_;
  SurfacePtr rest_, surface_;
};

}  // namespace trocar
