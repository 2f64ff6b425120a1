#include "tissue/collision/patch_extraction.h"

#include <algorithm>
#include <array>
#include <utility>

#include "haptics/contact/segment_triangle.h"

namespace trocar {
namespace {

QuerySegment axis_of(const Pose& X_TI, const Capsule& capsule) {
  const Pose X_TC = X_TI * capsule.X_IC;
  return {X_TC.p, X_TC.p - X_TC.R.col(2) * capsule.length_m};
}

}  // namespace

PatchExtraction::PatchExtraction(const TriangleSurface& surface, std::span<const std::int32_t> material)
    : tree_(surface), material_(material), place_(surface.vertices.size()) {
  hits_.reserve(kMaxPatchTriangles + 1);
}

void PatchExtraction::extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch, double jaw_opening_m) {
  const ToolCapsules capsules = tool_capsules(tool, jaw_opening_m, patch.held);
  std::array<QuerySegment, kMaxCapsules> axes;
  for (int c = 0; c < capsules.count; ++c) axes[c] = axis_of(X_TI, capsules.at[c]);
  const std::int64_t left_over =
      tree_.nearest({axes.data(), static_cast<std::size_t>(capsules.count)}, kPatchRadius, kMaxPatchTriangles, hits_);
  patch.clear();
  std::swap(last_source_, source_);
  last_count_ = std::exchange(count_, 0);
  patch.moving = !velocity_.empty();
  patch.count = static_cast<std::int32_t>(hits_.size());
  patch.dropped = static_cast<std::int32_t>(std::min<std::int64_t>(left_over, 1 << 30));
  patch.reach_m = patch.dropped > 0 ? hits_.back().distance : kPatchRadius;
  const TriangleSurface& surface = tree_.surface();
  for (std::int32_t i = 0; i < patch.count; ++i) {
    const std::int32_t id = hits_[i].triangle;
    const auto& [a, b, c] = surface.triangles[id];
    const auto& v = surface.vertices;
    patch.triangle[i] = {(v[b] - v[a]).cross(v[c] - v[a]).normalized(),
                         id,
                         material_of(id),
                         {place_vertex(a, patch), place_vertex(b, patch), place_vertex(c, patch)}};
  }
}

void PatchExtraction::look_ahead(const Pose& X_TI, const ToolCapsules& tool, double reach_m,
                                 const std::function<bool(std::int32_t)>& felt, SolvedContacts& contacts) {
  const TriangleSurface& surface = tree_.surface();
  const auto known = static_cast<std::int32_t>(surface.triangles.size());
  std::array<bool, kMaxPatchMaterials> touched{};
  for (std::int32_t i = 0; i < contacts.count; ++i) {
    const std::int32_t triangle = contacts.at[static_cast<std::size_t>(i)].place.triangle;
    if (triangle >= 0 && triangle < known) touched[static_cast<std::size_t>(material_of(triangle))] = true;
  }
  for (int c = 0; c < tool.count; ++c) {
    const Capsule& capsule = tool.at[c];
    const QuerySegment axis = axis_of(X_TI, capsule);
    if (!axis.a.allFinite() || !axis.b.allFinite()) return;
    tree_.within({&axis, 1}, capsule.radius_m + reach_m, hits_);
    std::array<const SurfaceTree::Hit*, kMaxPatchMaterials> nearest{};
    for (const SurfaceTree::Hit& hit : hits_) {
      const auto material = static_cast<std::size_t>(material_of(hit.triangle));
      if (!touched[material] && (nearest[material] == nullptr || hit < *nearest[material]) && felt(hit.triangle))
        nearest[material] = &hit;
    }
    for (const SurfaceTree::Hit* hit : nearest) {
      // Half-way to the axis, or beyond it, its side is not told.
      if (hit == nullptr || hit->distance < capsule.radius_m / 2 || contacts.count == kMaxContacts) continue;
      const auto corners = surface.corners(surface.triangles[static_cast<std::size_t>(hit->triangle)]);
      const ClosestPair closest = closest_segment_triangle(axis.a, axis.b, corners);
      SolvedContact& ahead = contacts.at[static_cast<std::size_t>(contacts.count++)];
      ahead.place = {hit->triangle, barycentric_of(closest.on_triangle, corners)};
      ahead.normal_T = (closest.on_segment - closest.on_triangle) / closest.distance;
      ahead.force_T.setZero();
      ahead.anchor = {};
      ahead.tool_T = closest.on_segment - capsule.radius_m * ahead.normal_T;
      ahead.share = 1;
    }
  }
}

std::int16_t PatchExtraction::place_vertex(std::int32_t vertex, ContactPatch& patch) {
  std::int16_t& place = place_[static_cast<std::size_t>(vertex)];
  if (place >= patch.vertex_count || source_[static_cast<std::size_t>(place)] != vertex) {
    const bool was = place < last_count_ && last_source_[static_cast<std::size_t>(place)] == vertex;
    patch.previous[static_cast<std::size_t>(patch.vertex_count)] = was ? place : std::int16_t{-1};
    place = static_cast<std::int16_t>(patch.vertex_count++);
    const auto at = static_cast<std::size_t>(place);
    source_[at] = vertex;
    patch.vertex[at] = tree_.surface().vertices[vertex];
    if (patch.moving) patch.velocity[at] = velocity_[static_cast<std::size_t>(vertex)];
  }
  count_ = patch.vertex_count;
  return place;
}

}  // namespace trocar
