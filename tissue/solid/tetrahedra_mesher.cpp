#include "tissue/solid/tetrahedra_mesher.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <map>

namespace trocar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

constexpr unsigned kSeed = 7;
constexpr double kSliverBound = 12, kFacetAngle = 25, kRadiusEdgeRatio = 2.5;

TetrahedraMesh from_cgal(const Complex& complex) {
  TetrahedraMesh mesh;
  std::map<Triangulation::Vertex_handle, std::int32_t> numbers;  // looked up only: its order by address decides nothing
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<std::int32_t, 4> corners{};
    for (int n = 0; n < 4; ++n) {
      const auto vertex = cell->vertex(n);
      const auto [entry, fresh] = numbers.try_emplace(vertex, static_cast<std::int32_t>(mesh.nodes.size()));
      if (fresh) mesh.nodes.emplace_back(vertex->point().x(), vertex->point().y(), vertex->point().z());
      corners[static_cast<std::size_t>(n)] = entry->second;
    }
    mesh.tetrahedra.push_back(corners);
    mesh.labels.push_back(static_cast<std::int32_t>(complex.subdomain_index(cell)));
  }
  return mesh;
}

}  // namespace

TetrahedraMesh meshed(const std::function<int(const Vec3&)>& region, const MesherSettings& settings) {
  CGAL::get_default_random() = CGAL::Random(kSeed);
  const auto function = [&](const Kernel::Point_3& p) { return region(Vec3(p.x(), p.y(), p.z())); };
  const Vec3 low = settings.box.min(), high = settings.box.max();
  const CGAL::Bbox_3 box(low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
  CGAL::Random random(kSeed);
  const Domain domain(parameters::function = function, parameters::bounding_object = box,
                      parameters::relative_error_bound = 1e-5, parameters::p_rng = &random);
  const Criteria criteria(parameters::facet_angle = kFacetAngle, parameters::facet_size = settings.facet,
                          parameters::facet_distance = settings.facet_distance,
                          parameters::cell_radius_edge_ratio = kRadiusEdgeRatio, parameters::cell_size = settings.cell);
  Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb(), parameters::no_exude());
  if (settings.optimise) {
    CGAL::perturb_mesh_3(complex, domain, parameters::sliver_bound = kSliverBound);
    CGAL::exude_mesh_3(complex, parameters::sliver_bound = kSliverBound);
  }
  return from_cgal(complex);
}

}  // namespace trocar
