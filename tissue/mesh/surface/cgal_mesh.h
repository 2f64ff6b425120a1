// The half-edge mesh of CGAL that the sources of this folder share, and the way from and to plain triangles.
//
// CGAL's headers cost tens of seconds a source: only the sources of trocar_tissue_cgal include this one. Unit and frame
// stay. Thread: any.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfacePoint = SurfaceKernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<SurfacePoint>;

inline SurfacePoint to_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
inline Vec3 to_vec(const SurfacePoint& p) { return {p.x(), p.y(), p.z()}; }

/// Points and faces without connections, as CGAL's repairs of triangle soups take them.
struct SurfaceSoup {
  explicit SurfaceSoup(const TriangleSurface& surface) {
    for (const Vec3& p : surface.vertices) points.push_back(to_point(p));
    for (const auto& [a, b, c] : surface.triangles)
      faces.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  }

  std::vector<SurfacePoint> points;
  std::vector<std::vector<std::size_t>> faces;
};

/// @throws std::invalid_argument when the triangles do not fit together into an oriented manifold
inline SurfaceMesh half_edge_mesh(const TriangleSurface& surface) {
  SurfaceMesh mesh;
  const auto count = static_cast<SurfaceMesh::size_type>(surface.triangles.size());
  mesh.reserve(static_cast<SurfaceMesh::size_type>(surface.vertices.size()), count * 3 / 2, count);
  for (const Vec3& p : surface.vertices) mesh.add_vertex(to_point(p));
  const auto vertex = [](std::int32_t index) {
    return SurfaceMesh::Vertex_index(static_cast<SurfaceMesh::size_type>(index));
  };
  for (const auto& [a, b, c] : surface.triangles)
    if (mesh.add_face(vertex(a), vertex(b), vertex(c)) == SurfaceMesh::null_face())
      throw std::invalid_argument("the surface is not an oriented manifold");
  return mesh;
}

inline std::array<std::int32_t, 3> corners_of(const SurfaceMesh& mesh, SurfaceMesh::Face_index face) {
  std::array<std::int32_t, 3> triangle{};
  std::size_t n = 0;
  for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
    triangle.at(n++) = static_cast<std::int32_t>(vertex.idx());
  return triangle;
}

/// @param mesh of triangles, its indices without gaps (collect_garbage)
inline TriangleSurface plain_surface(const SurfaceMesh& mesh) {
  TriangleSurface surface;
  for (const auto vertex : mesh.vertices()) surface.vertices.push_back(to_vec(mesh.point(vertex)));
  for (const auto face : mesh.faces()) surface.triangles.push_back(corners_of(mesh, face));
  return surface;
}

}  // namespace trocar
