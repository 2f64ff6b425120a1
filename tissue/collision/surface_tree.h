// Bounding-box tree over the triangles of a surface: which triangles lie nearest to some segments.
//
// Plain binary tree of axis-aligned float boxes (rounded outwards), split at the median of the longest axis, 4
// triangles a leaf. CGAL's and FCL's trees either cannot be refitted or answer wrongly after it. refit() follows moved
// vertices and keeps the topology; the boxes stay exact, so after it, too, no triangle within the distance is ever
// missed (tests/tissue/collision/collision_test.cpp against brute force). Frame of the surface, m. Thread: const but
// for refit().
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Axis of a capsule.
struct QuerySegment {
  Vec3 a, b;
};

class SurfaceTree {
 public:
  /// The surface must outlive the tree.
  explicit SurfaceTree(const TriangleSurface& surface);

  /// The surface's vertices have moved; its triangles are the same. Allocates nothing.
  void refit();

  /// A triangle found, with its distance from the nearest segment.
  struct Hit {
    std::int32_t triangle;
    double distance;
    /// Nearer first, then by number: the same order on every run.
    bool operator<(const Hit& other) const {
      return distance != other.distance ? distance < other.distance : triangle < other.triangle;
    }
  };

  /// All triangles within `distance` of any of the segments, unordered. @param hits cleared first; reused between
  /// calls.
  void within(std::span<const QuerySegment> segments, double distance, std::vector<Hit>& hits) const;

  /// The `most` nearest of them, nearest first. @return 0 when these are all; else some measure of what was left out.
  std::int64_t nearest(std::span<const QuerySegment> segments, double distance, std::size_t most,
                       std::vector<Hit>& hits) const;

  const TriangleSurface& surface() const { return *surface_; }

 private:
  using Corner = Eigen::Vector4f;  ///< x y z and a lane that only keeps it aligned
  struct Node {
    Corner low = Corner::Zero(), high = Corner::Zero();
    std::int32_t first, count;  ///< range of order_ in a leaf; count 0: inner node
    std::int32_t right;         ///< inner: index of the right child; the left one follows its parent
  };

  std::int32_t build(std::int32_t first, std::int32_t count, const std::vector<Vec3>& centres);
  /// Lower bound of the distance between a node's triangles and the nearest segment.
  double lower_bound(const Node& node, std::span<const QuerySegment> segments) const;
  double distance(std::int32_t triangle, std::span<const QuerySegment> segments) const;

  const TriangleSurface* surface_;
  std::vector<std::int32_t> order_;
  std::vector<std::array<std::int32_t, 3>> ordered_;  ///< triangles of the surface in the order of the leaves
  std::vector<Corner> corner_;                        ///< vertices as floats, for refit
  std::vector<Node> nodes_;                           ///< every parent before its children
};

}  // namespace trocar
