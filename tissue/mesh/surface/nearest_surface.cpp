#include "tissue/mesh/surface/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "haptics/contact/segment_triangle.h"

namespace trocar {
namespace {

constexpr double kRounding = 1e-6;   ///< of the extent: above the float rounding of a coordinate and of a difference
constexpr float kSlack = 1.000002F;  ///< above the float rounding of a sum of three squares
constexpr std::size_t kFan = 4;
constexpr std::size_t kStack =
    64;  ///< 16 levels over 2^32 triangles, three siblings left over on each, and the last four
constexpr float kNowhere = 1e30F;

/// Spreads 21 bits, two zeros between each.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// Place on the curve through the cube of this edge.
std::uint64_t curve_place(const Vec3& offset, double edge) {
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = edge > 0 ? std::clamp(offset[axis] / edge, 0.0, 1.0) : 0;
    place |= spread(static_cast<std::uint64_t>(share * 0x1fffff)) << axis;
  }
  return place;
}

}  // namespace

struct NearestSurface::Best {
  Vec3 place;
  double squared;
  std::size_t slot;
};

struct NearestSurface::Visit {
  std::uint32_t level, node;
  float bound;  ///< squared
};

NearestSurface::NearestSurface(const TriangleSurface& surface) {
  if (surface.triangles.empty()) throw std::invalid_argument("NearestSurface: no triangles");
  if (surface.triangles.size() >= std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("NearestSurface: too many triangles");
  sort_along_curve(surface);
  build_levels();
}

void NearestSurface::sort_along_curve(const TriangleSurface& surface) {
  const Eigen::AlignedBox3d box = surface.bounds();
  centre_ = box.center();
  const double edge = box.sizes().maxCoeff();
  margin_ = kRounding * edge;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(surface.triangles.size());
  const auto corner = [&](std::int32_t index) -> const Vec3& {
    return surface.vertices[static_cast<std::size_t>(index)];
  };
  for (const auto& [a, b, c] : surface.triangles)
    order.emplace_back(curve_place((corner(a) + corner(b) + corner(c)) / 3 - box.min(), edge),
                       static_cast<std::uint32_t>(order.size()));
  std::sort(order.begin(), order.end());
  corners_.reserve(order.size()), triangle_.reserve(order.size()), slot_.resize(order.size());
  for (const auto& [place, triangle] : order) {
    slot_[triangle] = static_cast<std::uint32_t>(triangle_.size());
    triangle_.push_back(triangle);
    const auto& [a, b, c] = surface.triangles[triangle];
    corners_.push_back({corner(a), corner(b), corner(c)});
  }
}

void NearestSurface::set_box(Node& node, Eigen::Index lane, const Vec3& low, const Vec3& high) const {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    node.low[static_cast<std::size_t>(axis)][lane] = static_cast<float>(low[axis] - margin_);
    node.high[static_cast<std::size_t>(axis)][lane] = static_cast<float>(high[axis] + margin_);
  }
}

void NearestSurface::build_levels() {
  Node empty;
  for (auto& lanes : empty.low) lanes = kNowhere;
  for (auto& lanes : empty.high) lanes = -kNowhere;
  levels_.emplace_back((corners_.size() + kFan - 1) / kFan, empty);
  for (std::size_t slot = 0; slot < corners_.size(); ++slot) {
    const auto& [a, b, c] = corners_[slot];
    set_box(levels_[0][slot / kFan], static_cast<Eigen::Index>(slot % kFan), a.cwiseMin(b).cwiseMin(c) - centre_,
            a.cwiseMax(b).cwiseMax(c) - centre_);
  }
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> above((below.size() + kFan - 1) / kFan, empty);
    for (std::size_t n = 0; n < below.size(); ++n)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        above[n / kFan].low[axis][static_cast<Eigen::Index>(n % kFan)] = below[n].low[axis].minCoeff();
        above[n / kFan].high[axis][static_cast<Eigen::Index>(n % kFan)] = below[n].high[axis].maxCoeff();
      }
    levels_.push_back(std::move(above));
  }
}

void NearestSurface::try_triangle(std::size_t slot, const Vec3& point, Best& best) const {
  Vec3 place = closest_point_on_triangle(point, corners_[slot]);
  if (!place.allFinite()) place = corners_[slot][0];  // no area, no direction: 0 / 0
  const double squared = (place - point).squaredNorm();
  if (squared < best.squared) best = {place, squared, slot};
}

NearestSurface::Hit NearestSurface::nearest(const Vec3& point, std::size_t guess) const {
  Best best{Vec3::Zero(), std::numeric_limits<double>::infinity(), 0};
  try_triangle(slot_[guess], point, best);
  const Eigen::Vector3f q = (point - centre_).cast<float>();
  std::array<Visit, kStack> stack;
  std::size_t top = 0;
  stack[top++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0, 0};
  while (top > 0) {
    const Visit visit = stack[--top];
    if (visit.bound > static_cast<float>(best.squared) * kSlack) continue;
    const Node& node = levels_[visit.level][visit.node];
    Lanes squared = Lanes::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float along = q[static_cast<Eigen::Index>(axis)];
      squared += (node.low[axis] - along).max(along - node.high[axis]).max(0.0F).square();
    }
    const std::size_t first = top;
    for (std::size_t child = 0; child < kFan; ++child) {  // the nearest on top
      const float bound = squared[static_cast<Eigen::Index>(child)];
      if (bound > static_cast<float>(best.squared) * kSlack) continue;
      std::size_t at = top++;
      for (; at > first && stack[at - 1].bound < bound; --at) stack[at] = stack[at - 1];
      stack[at] = {visit.level - 1, static_cast<std::uint32_t>(visit.node * kFan + child), bound};
    }
    if (visit.level > 0) continue;
    while (top > first)
      if (const Visit leaf = stack[--top]; leaf.bound <= static_cast<float>(best.squared) * kSlack)
        try_triangle(leaf.node, point, best);
  }
  const auto& [a, b, c] = corners_[best.slot];
  return {best.place, (b - a).cross(c - a), triangle_[best.slot]};
}

}  // namespace trocar
