#include "tissue/mesh/files/tetrahedra.h"

#include <algorithm>

namespace trocar {
namespace {

struct Face {
  std::array<std::int32_t, 3> key;      ///< sorted
  std::array<std::int32_t, 3> corners;  ///< outward
  std::int32_t order;
};

// Outward for a positive tetrahedron.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

}  // namespace

std::size_t make_positive(FileTetrahedra& mesh) {
  std::size_t turned = 0;
  for (auto& corners : mesh.tetrahedra) {
    std::array<Vec3, 4> p;
    for (std::size_t n = 0; n < 4; ++n) p[n] = mesh.vertices[static_cast<std::size_t>(corners[n])];
    if ((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) >= 0) continue;
    std::swap(corners[2], corners[3]);
    ++turned;
  }
  return turned;
}

TriangleSurface outer_surface(const FileTetrahedra& mesh, std::optional<std::int32_t> region) {
  std::vector<Face> faces;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (region && !mesh.regions.empty() && mesh.regions[t] != *region) continue;
    for (const auto& face : kFaces) {
      Face entry{};
      for (std::size_t n = 0; n < 3; ++n) entry.corners[n] = mesh.tetrahedra[t][face[n]];
      entry.key = entry.corners;
      std::sort(entry.key.begin(), entry.key.end());
      entry.order = static_cast<std::int32_t>(faces.size());
      faces.push_back(entry);
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.key != b.key ? a.key < b.key : a.order < b.order; });
  std::vector<Face> single;
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    while (end < faces.size() && faces[end].key == faces[begin].key) ++end;
    if (end - begin == 1) single.push_back(faces[begin]);
  }
  std::sort(single.begin(), single.end(), [](const Face& a, const Face& b) { return a.order < b.order; });
  TriangleSurface surface;
  surface.vertices = mesh.vertices;
  for (const Face& face : single) surface.triangles.push_back(face.corners);
  return surface;
}

}  // namespace trocar
