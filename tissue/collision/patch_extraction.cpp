#include "tissue/collision/patch_extraction.h"

#include <algorithm>

namespace trocar {

PatchExtraction::PatchExtraction(const TriangleSurface& surface) : tree_(surface) {
  normals_.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    const auto& v = surface.vertices;
    normals_.push_back((v[b] - v[a]).cross(v[c] - v[a]).normalized());
  }
}

void PatchExtraction::extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch) {
  const Vec3 handle = X_TI.p - X_TI.R.col(2) * tool.shaft_length_m;
  tree_.within(X_TI.p, handle, kPatchRadius, hits_);
  std::sort(hits_.begin(), hits_.end(), [](const auto& left, const auto& right) {
    return left.distance != right.distance ? left.distance < right.distance : left.triangle < right.triangle;
  });
  const auto found = static_cast<std::int32_t>(hits_.size());
  patch.count = std::min(found, kMaxPatchTriangles);
  patch.dropped = found - patch.count;
  const TriangleSurface& surface = tree_.surface();
  for (std::int32_t i = 0; i < patch.count; ++i) {
    const std::int32_t id = hits_[i].triangle;
    const auto& [a, b, c] = surface.triangles[id];
    patch.triangle[i] = {{surface.vertices[a], surface.vertices[b], surface.vertices[c]}, normals_[id], id};
  }
}

}  // namespace trocar
