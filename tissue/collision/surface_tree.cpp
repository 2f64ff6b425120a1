#include "tissue/collision/surface_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "haptics/contact/segment_triangle.h"

namespace trocar {
namespace {

constexpr std::int32_t kLeafSize = 4;
constexpr std::size_t kStack = 64;        // depth of a median-split tree over 2^31 triangles is below 32
constexpr float kTreeRounding = 1.2e-7f;  // a double as float is off by less than this share of itself

std::array<Vec3, 3> triangle_corners(const TriangleSurface& surface, std::int32_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  return {surface.vertices[a], surface.vertices[b], surface.vertices[c]};
}

/// The larger of: the segment's own box against the box, and the segment against the ball round the box (which is what
/// prunes beside an oblique segment).
double box_to_segment(const Eigen::AlignedBox3d& box, const QuerySegment& segment) {
  const double boxes =
      box.exteriorDistance(Eigen::AlignedBox3d(segment.a.cwiseMin(segment.b), segment.a.cwiseMax(segment.b)));
  const Vec3 along = segment.b - segment.a, centre = box.center();
  const double length_squared = along.squaredNorm();
  const double t = length_squared > 0 ? std::clamp((centre - segment.a).dot(along) / length_squared, 0.0, 1.0) : 0;
  return std::max(boxes, (segment.a + t * along - centre).norm() - 0.5 * box.sizes().norm());
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleSurface& surface) : surface_(&surface), order_(surface.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centres;
  centres.reserve(order_.size());
  for (const std::int32_t triangle : order_) {
    const auto tri = triangle_corners(surface, triangle);
    centres.push_back((tri[0] + tri[1] + tri[2]) / 3);
  }
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()), centres);
  for (const std::int32_t triangle : order_) ordered_.push_back(surface.triangles[triangle]);
  corner_.resize(surface.vertices.size());
  refit();
}

std::int32_t SurfaceTree::build(std::int32_t first, std::int32_t count, const std::vector<Vec3>& centres) {
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({.first = first, .count = count, .right = -1});
  if (count <= kLeafSize) return index;
  Eigen::AlignedBox3d box;
  for (std::int32_t i = first; i < first + count; ++i) box.extend(centres[order_[i]]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
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

void SurfaceTree::refit() {
  for (std::size_t i = 0; i < corner_.size(); ++i) {
    corner_[i].head<3>() = surface_->vertices[i].cast<float>();
    corner_[i].w() = 0;
  }
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children before their parents
    Node& node = nodes_[n];
    if (node.count == 0) {
      node.low = nodes_[n + 1].low.cwiseMin(nodes_[node.right].low);
      node.high = nodes_[n + 1].high.cwiseMax(nodes_[node.right].high);
      continue;
    }
    Corner low = corner_[ordered_[node.first][0]], high = low;
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      for (const std::int32_t vertex : ordered_[i]) {
        low = low.cwiseMin(corner_[vertex]);
        high = high.cwiseMax(corner_[vertex]);
      }
    }
    node.low = low - kTreeRounding * low.cwiseAbs();
    node.high = high + kTreeRounding * high.cwiseAbs();
  }
}

double SurfaceTree::lower_bound(const Node& node, std::span<const QuerySegment> segments) const {
  const Eigen::AlignedBox3d box(node.low.head<3>().cast<double>(), node.high.head<3>().cast<double>());
  double nearest = std::numeric_limits<double>::infinity();
  for (const QuerySegment& s : segments) nearest = std::min(nearest, box_to_segment(box, s));
  return nearest;
}

double SurfaceTree::distance(std::int32_t triangle, std::span<const QuerySegment> segments) const {
  const auto tri = triangle_corners(*surface_, triangle);
  double nearest = std::numeric_limits<double>::infinity();
  for (const QuerySegment& s : segments) nearest = std::min(nearest, closest_segment_triangle(s.a, s.b, tri).distance);
  return nearest;
}

void SurfaceTree::within(std::span<const QuerySegment> segments, double distance_m, std::vector<Hit>& hits) const {
  nearest(segments, distance_m, std::numeric_limits<std::size_t>::max(), hits);
}

std::int64_t SurfaceTree::nearest(std::span<const QuerySegment> segments, double distance_m, std::size_t most,
                                  std::vector<Hit>& hits) const {
  hits.clear();
  if (nodes_.empty() || most == 0) return 0;
  std::int64_t left_over = 0;
  double reach = distance_m;  // shrinks to the furthest hit once there are enough: `hits` is then a heap
  struct Visit {
    std::int32_t node;
    double bound;
  };
  std::array<Visit, kStack> stack;
  std::size_t top = 0;
  const Visit root{0, lower_bound(nodes_[0], segments)};
  if (root.bound <= distance_m) stack[top++] = root;
  while (top > 0) {
    const Visit visit = stack[--top];
    if (visit.bound > reach) {  // it may hold triangles within the distance, only further than the full heap
      ++left_over;
      continue;
    }
    const Node& node = nodes_[visit.node];
    if (node.count == 0) {
      Visit near{visit.node + 1, lower_bound(nodes_[visit.node + 1], segments)};
      Visit far{node.right, lower_bound(nodes_[node.right], segments)};
      if (far.bound < near.bound) std::swap(near, far);
      if (far.bound <= distance_m) stack[top++] = far;
      if (near.bound <= distance_m) stack[top++] = near;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Hit hit{order_[i], distance(order_[i], segments)};
      if (hit.distance > distance_m) continue;
      if (hits.size() < most) {
        hits.push_back(hit);
        if (hits.size() == most) std::make_heap(hits.begin(), hits.end());
      } else {
        ++left_over;
        if (!(hit < hits.front())) continue;
        std::pop_heap(hits.begin(), hits.end());
        hits.back() = hit;
        std::push_heap(hits.begin(), hits.end());
      }
      if (hits.size() == most) reach = hits.front().distance;
    }
  }
  std::sort(hits.begin(), hits.end());
  return left_over;
}

}  // namespace trocar
