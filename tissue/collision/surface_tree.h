// Bounding-box tree over the triangles of a surface: which triangles lie within a distance of some segments.
//
// Plain binary tree of axis-aligned boxes, split at the median of the longest axis, 4 triangles a leaf. CGAL's and FCL's
// trees either cannot be refitted or answer wrongly after it; this one keeps the topology that a refit needs. Exact: a
// triangle within the distance is never missed (tests/tissue/collision_test.cpp against brute force).
// Frame of the surface, m. Thread: const after construction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tissue/mesh/triangle_surface.h"

namespace trocar {

/// Axis of a capsule.
struct Segment {
  Vec3 a, b;
};

class SurfaceTree {
 public:
  /// The surface must outlive the tree.
  explicit SurfaceTree(const TriangleSurface& surface);

  /// A triangle found, with its distance from the nearest segment.
  struct Hit {
    std::int32_t triangle;
    double distance;
  };

  /// All triangles within `distance` of any of the segments, unordered. @param hits cleared first; reused between calls.
  void within(std::span<const Segment> segments, double distance, std::vector<Hit>& hits) const;

  const TriangleSurface& surface() const { return *surface_; }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::int32_t first, count;  ///< range of order_ in a leaf; count 0: inner node
    std::int32_t right;         ///< inner: index of the right child; the left one follows its parent
  };

  std::int32_t build(std::int32_t first, std::int32_t count, const std::vector<Vec3>& centres);

  const TriangleSurface* surface_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace trocar
