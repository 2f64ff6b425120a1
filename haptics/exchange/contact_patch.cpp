#include "haptics/exchange/contact_patch.h"

namespace trocar {

void add_surface(ContactPatch& patch, std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles,
                 std::int32_t first_id, std::int32_t material) {
  const int first = patch.vertex_count, end = first + static_cast<int>(vertices.size());
  if (patch.count == kMaxPatchTriangles || end > kMaxPatchVertices) {
    patch.dropped += static_cast<std::int32_t>(triangles.size());
    return;
  }
  for (const Vec3& v : vertices) {
    if (patch.moving) patch.velocity[static_cast<std::size_t>(patch.vertex_count)] = Vec3::Zero();
    patch.vertex[static_cast<std::size_t>(patch.vertex_count++)] = v;
  }
  const auto place = [&](int corner) { return static_cast<std::int16_t>(first + corner); };
  for (const auto& [a, b, c] : triangles) {
    const std::int32_t id = first_id++;
    if (patch.count == kMaxPatchTriangles) {
      ++patch.dropped;
      continue;
    }
    const Vec3 normal = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).normalized();
    patch.triangle[static_cast<std::size_t>(patch.count++)] = {normal, id, material, {place(a), place(b), place(c)}};
  }
}

void add_triangle(ContactPatch& patch, const std::array<Vec3, 3>& vertex, std::int32_t id, std::int32_t material) {
  add_surface(patch, vertex, {{{0, 1, 2}}}, id, material);
}

}  // namespace trocar
