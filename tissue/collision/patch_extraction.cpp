#include "tissue/collision/patch_extraction.h"

#include <algorithm>
#include <array>

namespace trocar {

PatchExtraction::PatchExtraction(const TriangleSurface& surface, std::span<const std::int32_t> material)
    : tree_(surface), material_(material) {
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
  patch.count = static_cast<std::int32_t>(hits_.size());
  patch.dropped = static_cast<std::int32_t>(std::min<std::int64_t>(left_over, 1 << 30));
  patch.reach_m = patch.dropped > 0 ? hits_.back().distance : kPatchRadius;
  const TriangleSurface& surface = tree_.surface();
  for (std::int32_t i = 0; i < patch.count; ++i) {
    const std::int32_t id = hits_[i].triangle;
    const auto& [a, b, c] = surface.triangles[id];
    const auto& v = surface.vertices;
    patch.triangle[i] = {{v[a], v[b], v[c]},
                         (v[b] - v[a]).cross(v[c] - v[a]).normalized(),
                         id,
                         material_.empty() ? 0 : material_[static_cast<std::size_t>(id)]};
  }
}

}  // namespace trocar
