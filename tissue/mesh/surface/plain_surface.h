// Points and triangles out of a library's half-edge mesh, without naming its type: any mesh with the members of
// CGAL::Surface_mesh.
//
// Faces must be triangles and the indices without gaps (collect_garbage). Unit and frame stay. Thread: any.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

template <typename Mesh>
TriangleSurface plain_surface(const Mesh& mesh) {
  TriangleSurface surface;
  for (const auto vertex : mesh.vertices()) {
    const auto& point = mesh.point(vertex);
    surface.vertices.emplace_back(point.x(), point.y(), point.z());
  }
  for (const auto face : mesh.faces()) {
    std::array<std::int32_t, 3> triangle{};
    std::size_t n = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      triangle.at(n++) = static_cast<std::int32_t>(vertex.idx());
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace trocar
