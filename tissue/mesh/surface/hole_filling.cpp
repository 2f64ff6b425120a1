// Holes found by their rims, filled with triangles of the size around them, smooth across the rim.
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <iterator>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/cgal_mesh.h"
#include "tissue/mesh/surface/rescue.h"

namespace trocar {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Mesh = SurfaceMesh;
using Rim = Mesh::Halfedge_index;

Mesh oriented_mesh(const TriangleSurface& surface, const std::string& file) {
  SurfaceSoup soup(surface);
  pmp::orient_polygon_soup(soup.points, soup.faces);  // vertices where rims touch become several
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.faces))
    throw InputError(file + ": its holes cannot be followed: wrap it instead");
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.faces, mesh);
  return mesh;
}

Vec3 point_of(const Mesh& mesh, Mesh::Vertex_index vertex) { return to_vec(mesh.point(vertex)); }

FilledHole measured(const Mesh& mesh, Rim rim) {
  FilledHole hole;
  Eigen::AlignedBox3d box;
  for (const auto edge : CGAL::halfedges_around_face(rim, mesh)) {
    ++hole.edges;
    box.extend(point_of(mesh, mesh.target(edge)));
  }
  hole.span_m = box.diagonal().norm();
  return hole;
}

std::string too_wide(const std::vector<FilledHole>& holes, double widest_m) {
  std::size_t count = 0;
  FilledHole worst;
  for (const FilledHole& hole : holes) {
    if (hole.span_m <= widest_m) continue;
    ++count;
    if (hole.span_m > worst.span_m) worst = hole;
  }
  if (count == 0) return {};
  return std::to_string(count) + " of " + std::to_string(holes.size()) + " holes are wider than the " +
         std::to_string(widest_m * 1e3) + " mm that may be filled: the widest spans " +
         std::to_string(worst.span_m * 1e3) + " mm (" + std::to_string(worst.edges) + " edges)";
}

double patch_area(const Mesh& mesh, const std::vector<Mesh::Face_index>& faces) {
  double doubled = 0;
  for (const auto face : faces) {
    const Rim side = mesh.halfedge(face);
    const Vec3 a = point_of(mesh, mesh.source(side)), b = point_of(mesh, mesh.target(side));
    doubled += (b - a).cross(point_of(mesh, mesh.target(mesh.next(side))) - a).norm();
  }
  return doubled / 2;
}

}  // namespace

TriangleSurface holes_filled(const TriangleSurface& surface, double widest_m, std::vector<FilledHole>& holes,
                             const std::string& file) {
  Mesh mesh = oriented_mesh(surface, file);
  std::vector<Rim> rims;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(rims));
  for (const Rim rim : rims) holes.push_back(measured(mesh, rim));
  const std::string refusal = too_wide(holes, widest_m);
  if (!refusal.empty()) throw InputError(file + ": " + refusal);
  for (std::size_t n = 0; n < rims.size(); ++n) {
    std::vector<Mesh::Face_index> faces;
    std::vector<Mesh::Vertex_index> vertices;
    pmp::triangulate_refine_and_fair_hole(mesh, rims[n], std::back_inserter(faces), std::back_inserter(vertices));
    if (faces.empty())
      throw InputError(file + ": the hole of " + std::to_string(holes[n].edges) +
                       " edges cannot be filled: wrap the surface instead");
    holes[n].area_m2 = patch_area(mesh, faces);
    for (const auto vertex : vertices)  // the fairing has no solution on flat or folded rims
      if (!point_of(mesh, vertex).allFinite())
        throw InputError(file + ": the hole of " + std::to_string(holes[n].edges) +
                         " edges cannot be filled smoothly: wrap the surface instead");
  }
  return plain_surface(mesh);
}

}  // namespace trocar
