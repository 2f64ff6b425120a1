#include "app/picture/scene/mark_block.h"

#include <algorithm>

namespace trocar {

MarkBlock make_mark_block(const std::vector<TissueMark>& marks) {
  MarkBlock block{};
  const std::size_t n = std::min(marks.size(), static_cast<std::size_t>(kMaxTissueMarks));
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) block.place[i][k] = static_cast<float>(marks[i].centre_T[k]);
    block.place[i][3] = static_cast<float>(std::max(marks[i].radius_m, 1e-6));
    block.kind[i][static_cast<std::size_t>(marks[i].kind)] =
        static_cast<float>(std::clamp(marks[i].strength, 0.0, 1.0));
  }
  block.count[0] = static_cast<float>(n);
  return block;
}

std::vector<std::uint32_t> triangles_marked(const PictureMesh& mesh, const std::vector<TissueMark>& marks) {
  std::vector<std::uint32_t> out;
  if (marks.empty()) return out;
  const auto point = [&](std::uint32_t index) {
    const float* p = mesh.vertices[index].position;
    return Vec3(p[0], p[1], p[2]);
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Eigen::AlignedBox3d box(point(mesh.indices[i]));
    box.extend(point(mesh.indices[i + 1])).extend(point(mesh.indices[i + 2]));
    const bool hit = std::any_of(marks.begin(), marks.end(), [&](const TissueMark& mark) {
      return box.squaredExteriorDistance(mark.centre_T) <= kMarkReach * kMarkReach * mark.radius_m * mark.radius_m;
    });
    if (hit) out.insert(out.end(), {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return out;
}

}  // namespace trocar
