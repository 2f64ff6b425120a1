#include "tissue/collision/patch_extraction.h"

#include <algorithm>
#include <array>

namespace trocar {

PatchExtraction::PatchExtraction(const TriangleSurface& surface) : tree_(surface) {
  normals_.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    const auto& v = surface.vertices;
    normals_.push_back((v[b] - v[a]).cross(v[c] - v[a]).normalized());
  }
}

void PatchExtraction::extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch, double jaw_opening_m) {
  const ToolCapsules capsules = tool_capsules(tool, jaw_opening_m, patch.held);
  std::array<Segment, kMaxCapsules> axes;
  for (int c = 0; c < capsules.count; ++c) {
    const Pose X_TC = X_TI * capsules.at[c].X_IC;
    axes[c] = {X_TC.p, X_TC.p - X_TC.R.col(2) * capsules.at[c].length_m};
  }
  tree_.within({axes.data(), static_cast<std::size_t>(capsules.count)}, kPatchRadius, hits_);
  std::sort(hits_.begin(), hits_.end(), [](const auto& left, const auto& right) {
    return left.distance != right.distance ? left.distance < right.distance : left.triangle < right.triangle;
  });
  const auto found = static_cast<std::int32_t>(hits_.size());
  patch.count = std::min(found, kMaxPatchTriangles);
  patch.dropped = found - patch.count;
  patch.reach_m = patch.dropped > 0 ? hits_[patch.count].distance : kPatchRadius;
  const TriangleSurface& surface = tree_.surface();
  for (std::int32_t i = 0; i < patch.count; ++i) {
    const std::int32_t id = hits_[i].triangle;
    const auto& [a, b, c] = surface.triangles[id];
    patch.triangle[i] = {{surface.vertices[a], surface.vertices[b], surface.vertices[c]}, normals_[id], id};
  }
}

}  // namespace trocar
