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
using Labelled = CGAL::Labeled_mesh_domain_3<Kernel>;
namespace parameters = CGAL::parameters;

/// CGAL's domain with the first points given.
class Domain : public Labelled {
 public:
  template <typename... Arguments>
  explicit Domain(const std::vector<MesherSeed>& seeds, Arguments... arguments)
      : Labelled(arguments...), seeds_(seeds) {}

  struct Construct_initial_points {
    const Domain& domain;
    template <typename Output>
    Output operator()(Output points, int count = 12) const {
      if (domain.seeds_.empty()) return domain.Labelled::construct_initial_points_object()(points, count);
      for (const MesherSeed& seed : domain.seeds_)
        *points++ = {Kernel::Point_3(seed.place.x(), seed.place.y(), seed.place.z()),
                     domain.index_from_surface_patch_index({0, seed.region})};
      return points;
    }
  };
  Construct_initial_points construct_initial_points_object() const { return {*this}; }

 private:
  const std::vector<MesherSeed>& seeds_;
};

using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

/// How far a facet may lie from the border, by the two regions that it parts.
struct FacetDistance {
  using FT = double;
  using Index = Domain::Index;
  const std::vector<double>* distances;

  double of(int region) const {
    return region > 0 ? (*distances)[static_cast<std::size_t>(region - 1)] : std::numeric_limits<double>::max();
  }
  double operator()(const Kernel::Point_3&, int, const Index& index) const {
    const auto& [inner, outer] = boost::get<Domain::Surface_patch_index>(index);
    return std::min(of(inner), of(outer));
  }
};

constexpr unsigned kSeed = 7;
constexpr double kFacetAngle = 25, kRadiusEdgeRatio = 2.5;

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
    mesh.tetrahedra.push_back(corners);  // CGAL's cells are positive
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
  const Domain domain(settings.seeds, parameters::function = function, parameters::bounding_object = box,
                      parameters::relative_error_bound = 1e-5, parameters::p_rng = &random);
  const FacetDistance distance{&settings.facet_distances};
  const Criteria criteria(parameters::facet_angle = kFacetAngle, parameters::facet_size = settings.facet,
                          parameters::facet_distance = distance, parameters::cell_radius_edge_ratio = kRadiusEdgeRatio,
                          parameters::cell_size = settings.cell);
  Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb(), parameters::no_exude());
  if (settings.perturb) CGAL::perturb_mesh_3(complex, domain, parameters::sliver_bound = settings.sliver_deg);
  CGAL::exude_mesh_3(complex, parameters::sliver_bound = settings.sliver_deg);
  return from_cgal(complex);
}

}  // namespace trocar
