#include "tissue/collision/surface_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "haptics/control/segment_triangle.h"

namespace trocar {
namespace {

constexpr std::int32_t kLeafSize = 4;

std::array<Vec3, 3> corners(const TriangleSurface& surface, std::int32_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  return {surface.vertices[a], surface.vertices[b], surface.vertices[c]};
}

/// Lower bound of the distance between a box and the segment a-b: the larger of the segment's own box against it, and the
/// segment against the ball round the box (which is what prunes beside an oblique segment).
double lower_bound(const Eigen::AlignedBox3d& box, const Vec3& a, const Vec3& b) {
  const double boxes = box.exteriorDistance(Eigen::AlignedBox3d(a.cwiseMin(b), a.cwiseMax(b)));
  const Vec3 along = b - a, centre = box.center();
  const double length_squared = along.squaredNorm();
  const double t = length_squared > 0 ? std::clamp((centre - a).dot(along) / length_squared, 0.0, 1.0) : 0;
  return std::max(boxes, (a + t * along - centre).norm() - 0.5 * box.sizes().norm());
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleSurface& surface) : surface_(&surface), order_(surface.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centres;
  centres.reserve(order_.size());
  for (const std::int32_t triangle : order_) {
    const auto tri = corners(surface, triangle);
    centres.push_back((tri[0] + tri[1] + tri[2]) / 3);
  }
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()), centres);
}

std::int32_t SurfaceTree::build(std::int32_t first, std::int32_t count, const std::vector<Vec3>& centres) {
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({{}, first, count, -1});
  for (std::int32_t i = first; i < first + count; ++i) {
    for (const Vec3& corner : corners(*surface_, order_[i])) nodes_[index].box.extend(corner);
  }
  if (count <= kLeafSize) return index;

  Eigen::Index axis = 0;
  nodes_[index].box.sizes().maxCoeff(&axis);
  const std::int32_t half = count / 2;
  // Ties by triangle number: the tree is the same on every run.
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::int32_t left, std::int32_t right) {
                     const double l = centres[left][axis], r = centres[right][axis];
                     return l != r ? l < r : left < right;
                   });
  build(first, half, centres);
  const std::int32_t right = build(first + half, count - half, centres);
  nodes_[index].count = 0;
  nodes_[index].right = right;
  return index;
}

void SurfaceTree::within(std::span<const Segment> segments, double distance, std::vector<Hit>& hits) const {
  hits.clear();
  if (nodes_.empty()) return;
  std::array<std::int32_t, 64> stack;  // depth of a median-split tree over 2^31 triangles is below 32
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::int32_t index = stack[--top];
    const Node& node = nodes_[index];
    const auto far = [&](const Segment& s) { return lower_bound(node.box, s.a, s.b) > distance; };
    if (std::all_of(segments.begin(), segments.end(), far)) continue;
    if (node.count == 0) {
      stack[top++] = node.right;
      stack[top++] = index + 1;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const auto tri = corners(*surface_, order_[i]);
      double d = std::numeric_limits<double>::infinity();
      for (const Segment& s : segments) d = std::min(d, closest_segment_triangle(s.a, s.b, tri).distance);
      if (d <= distance) hits.push_back({order_[i], d});
    }
  }
}

}  // namespace trocar
