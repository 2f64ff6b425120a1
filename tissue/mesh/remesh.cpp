#include "tissue/mesh/remesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

namespace trocar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh to_cgal(const TriangleSurface& surface) {
  Mesh mesh;
  for (const Vec3& p : surface.vertices) mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  const auto vertex = [](std::int32_t index) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(index)); };
  for (const auto& [a, b, c] : surface.triangles)
    if (mesh.add_face(vertex(a), vertex(b), vertex(c)) == Mesh::null_face())
      throw std::invalid_argument("remeshed: the surface is not an oriented manifold");
  return mesh;
}

TriangleSurface from_cgal(Mesh& mesh) {
  mesh.collect_garbage();
  TriangleSurface surface;
  for (const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    surface.vertices.emplace_back(p.x(), p.y(), p.z());
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

}  // namespace

TriangleSurface remeshed(const TriangleSurface& surface, double edge_m, int iterations) {
  Mesh mesh = to_cgal(surface);
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      mesh.faces(), edge_m, mesh, CGAL::parameters::number_of_iterations(static_cast<unsigned>(iterations)));
  return from_cgal(mesh);
}

}  // namespace trocar
