#include "tissue/collision/patch_extraction.h"

#include <algorithm>
#include <array>
#include <utility>

namespace trocar {

PatchExtraction::PatchExtraction(const TriangleSurface& surface, std::span<const std::int32_t> material)
    : tree_(surface), material_(material), place_(surface.vertices.size()) {
  hits_.reserve(kMaxPatchTriangles + 1);
}

void PatchExtraction::extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch, double jaw_opening_m) {
  const ToolCapsules capsules = tool_capsules(tool, jaw_opening_m, patch.held);
  std::array<QuerySegment, kMaxCapsules> axes;
  for (int c = 0; c < capsules.count; ++c) {
    const Pose X_TC = X_TI * capsules.at[c].X_IC;
    axes[c] = {X_TC.p, X_TC.p - X_TC.R.col(2) * capsules.at[c].length_m};
  }
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
                         material_.empty() ? 0 : material_[static_cast<std::size_t>(id)],
                         {place_vertex(a, patch), place_vertex(b, patch), place_vertex(c, patch)}};
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
