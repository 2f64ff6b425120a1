#include "app/studies/tissue/solver_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "app/studies/tissue/quadratic_reference.h"
#include "app/studies/tissue/soft_bench.h"
#include "tissue/solid/lattice.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/solid/tetrahedra_mesher.h"

namespace trocar {
namespace {

const Vec3 kEllipsoidHalf(0.100, 0.075, 0.040);  // m
constexpr double kTent = 0.020;                  // m, radius of the load
constexpr int kMixes = 20;                       // steps from soft to stiff of a cell that has both
constexpr int kMixSamples = 6;                   // along its edge

TissueSolid stiffer_by(double share) {
  TissueSolid material;
  material.young_pa *= share;
  return material;
}

double most_stiff(StiffPart stiff) { return stiff == StiffPart::kNone ? 1 : stiff == StiffPart::kNodule ? 50 : 100; }

double stiffness_share(StiffPart stiff, const Vec3& place) {
  const bool hard = stiff == StiffPart::kNodule  ? (place - Vec3(0, 0, kEllipsoidHalf.z() - 0.025)).norm() < 0.015
                    : stiff == StiffPart::kLayer ? std::abs(place.z() - (kEllipsoidHalf.z() - 0.020)) < 0.005
                                                 : false;
  return hard ? most_stiff(stiff) : 1;
}

bool in_organ(const Vec3& place) { return place.cwiseQuotient(kEllipsoidHalf).squaredNorm() < 1; }

double tent_at(const Vec3& place) {
  return place.z() > 0 ? std::max(0.0, 1 - std::hypot(place.x(), place.y()) / kTent) : 0;
}

TetrahedraMesh fitted_tetrahedra(StiffPart stiff, double cell_m) {
  MesherSettings settings;
  settings.box = Eigen::AlignedBox3d(-1.1 * kEllipsoidHalf, 1.1 * kEllipsoidHalf);
  settings.cell = cell_m;
  settings.facet = cell_m;
  settings.facet_distances = {cell_m / 10, cell_m / 10};
  const auto region = [&](const Vec3& place) {
    if (!in_organ(place)) return 0;
    return stiffness_share(stiff, place) > 1 ? 2 : 1;
  };
  TetrahedraMesh mesh = meshed(region, settings);
  for (std::int32_t& label : mesh.labels) --label;
  return mesh;
}

/// Barycentric coordinates of the place in the tetrahedron that it lies in, or least far outside of.
struct InTetrahedron {
  std::size_t number = 0;
  Eigen::Vector4d weight = Eigen::Vector4d::Zero();
};
std::vector<InTetrahedron> place_in(const TetrahedraMesh& mesh, const std::vector<Vec3>& places) {
  std::vector<Mat3> inverse;
  std::vector<Vec3> first, middle;
  double reach = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const Mat3 edges = edges_of(mesh, t);
    inverse.push_back(edges.inverse());
    first.push_back(mesh.nodes[static_cast<std::size_t>(mesh.tetrahedra[t][0])]);
    middle.push_back(first.back() + edges.rowwise().sum() / 4);
    reach = std::max(reach, edges.colwise().norm().maxCoeff());
  }
  std::vector<InTetrahedron> out(places.size());
  for (std::size_t p = 0; p < places.size(); ++p) {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < inverse.size(); ++t) {
      if ((places[p] - middle[t]).squaredNorm() > reach * reach) continue;
      const Vec3 rest = inverse[t] * (places[p] - first[t]);
      const Eigen::Vector4d weight(1 - rest.sum(), rest[0], rest[1], rest[2]);
      if (weight.minCoeff() > best) best = weight.minCoeff(), out[p] = {t, weight};
    }
  }
  return out;
}

std::vector<NodeShares> surface_in(const TetrahedraMesh& mesh, const TriangleSurface& surface) {
  std::vector<NodeShares> out;
  for (const InTetrahedron& in : place_in(mesh, surface.vertices)) {
    // The surface's curve stands out of the facets: such a vertex goes with what of the facet is nearest.
    const Eigen::Vector4d inside = in.weight.cwiseMax(0);
    NodeShares& shares = out.emplace_back();
    for (std::size_t a = 0; a < 4; ++a) {
      shares.node.push_back(mesh.tetrahedra[in.number][a]);
      shares.share.push_back(static_cast<float>(inside[static_cast<Eigen::Index>(a)] / inside.sum()));
    }
  }
  return out;
}

/// The static solution at the surface, by ten-node tetrahedra.
void find_reference(SolverScene& scene) {
  const StiffPart stiff = scene.options.stiff;
  const TetrahedraMesh corners = fitted_tetrahedra(stiff, scene.options.reference_m);
  const QuadraticMesh mesh = quadratic_mesh(corners);
  const TissueSolid material;
  QuadraticProblem problem{
      .mesh = mesh,
      .young_pa = [&](const Vec3& place) { return material.young_pa * stiffness_share(stiff, place); },
      .poisson = material.poisson};
  const SoftOrganOptions organ;
  problem.bed_n_per_m3 = organ.bed_n_per_m3;
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const auto& face = mesh.boundary[f];
    const Vec3 normal = (mesh.nodes.col(face[1]) - mesh.nodes.col(face[0]))
                            .cross(Vec3(mesh.nodes.col(face[2]) - mesh.nodes.col(face[0])))
                            .normalized();
    if (normal.z() < organ.bed_cosine) problem.bedded.push_back(static_cast<int>(f));
  }
  problem.forces_n = traction_forces(mesh, [](const Vec3& place) -> Vec3 { return {0, 0, -tent_at(place)}; });
  problem.forces_n *= -scene.options.force_n / problem.forces_n.sum();
  const QuadraticSolution solution = solve(problem);
  scene.reference_nodes = static_cast<int>(mesh.nodes.cols());
  scene.pressed_m = problem.forces_n.cwiseProduct(solution.displacements_m).sum() / scene.options.force_n;
  constexpr std::array<std::array<int, 2>, 6> kMiddles{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  for (const InTetrahedron& in : place_in(corners, scene.surface.vertices)) {
    const auto& node = mesh.elements[in.number];
    const Eigen::Vector4d& l = in.weight;
    Vec3 u = Vec3::Zero();
    for (std::size_t a = 0; a < 4; ++a) {
      const double weight = l[static_cast<Eigen::Index>(a)];
      u += weight * (2 * weight - 1) * solution.displacements_m.col(node[a]);
    }
    for (std::size_t e = 0; e < 6; ++e)
      u += 4 * l[kMiddles[e][0]] * l[kMiddles[e][1]] * solution.displacements_m.col(node[4 + e]);
    scene.displacement_m.push_back(u);
  }
}

/// Materials from soft to stiff and which of them a cube has.
std::vector<TissueSolid> mixed_materials(StiffPart stiff) {
  std::vector<TissueSolid> out;
  for (int mix = 0; mix <= kMixes; ++mix)
    out.push_back(stiffer_by(std::pow(most_stiff(stiff), mix / static_cast<double>(kMixes))));
  return out;
}
std::int32_t mix_of(StiffPart stiff, const Vec3& low, double edge_m) {
  if (stiff == StiffPart::kNone) return 0;
  int hard = 0, all = 0;
  for (int i = 0; i < kMixSamples; ++i)
    for (int j = 0; j < kMixSamples; ++j)
      for (int k = 0; k < kMixSamples; ++k) {
        const Vec3 place = low + edge_m / kMixSamples * Vec3(i + 0.5, j + 0.5, k + 0.5);
        if (!in_organ(place)) continue;
        ++all;
        hard += stiffness_share(stiff, place) > 1 ? 1 : 0;
      }
  return all == 0 ? 0 : static_cast<std::int32_t>(std::lround(static_cast<double>(kMixes) * hard / all));
}

struct MixedLattice {
  Lattice lattice;
  std::vector<std::int32_t> material;  ///< of each cell
  std::vector<NodeShares> surface;
};
MixedLattice mixed_lattice(const SolverScene& scene, double edge_m) {
  LatticeOptions options;
  options.cell_m = edge_m;
  MixedLattice out{build_lattice(scene.surface, options).lattice, {}, {}};
  for (const LatticeCell& cell : out.lattice.cells)
    out.material.push_back(
        mix_of(scene.options.stiff, out.lattice.node_m(static_cast<std::size_t>(cell.corners[0])), edge_m));
  for (const Embedding& embedding : out.lattice.embedding) {
    const LatticeCell& cell = out.lattice.cells[static_cast<std::size_t>(embedding.cell)];
    out.surface.push_back(
        {{cell.corners.begin(), cell.corners.end()}, {embedding.weights.begin(), embedding.weights.end()}});
  }
  return out;
}

}  // namespace

SolverScene make_scene(const SolverSceneOptions& options) {
  SolverScene scene{options, ellipsoid_surface(kEllipsoidHalf, options.rows), {}, {}, {}, 0, 0};
  scene.force_n.assign(scene.surface.vertices.size(), 0);
  scene.bed_n_per_m = scene.force_n;
  const SoftOrganOptions organ;
  double sum = 0;
  for (const auto& triangle : scene.surface.triangles) {
    std::array<Vec3, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = scene.surface.vertices[static_cast<std::size_t>(triangle[k])];
    const Vec3 twice = (at[1] - at[0]).cross(at[2] - at[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangle[k]);
      scene.force_n[v] += tent_at(at[k]) * twice.norm();
      sum += tent_at(at[k]) * twice.norm();
      if (twice.z() < organ.bed_cosine * twice.norm()) scene.bed_n_per_m[v] += organ.bed_n_per_m3 * twice.norm() / 6;
    }
  }
  for (double& force : scene.force_n) force *= options.force_n / sum;
  find_reference(scene);
  return scene;
}

PeerMesh fitted_mesh(const SolverScene& scene, double cell_m) {
  PeerMesh out;
  out.body.mesh = fitted_tetrahedra(scene.options.stiff, cell_m);
  out.body.share.assign(out.body.mesh.tetrahedra.size(), 1);
  out.body.materials = {stiffer_by(1), stiffer_by(most_stiff(scene.options.stiff))};
  out.surface = surface_in(out.body.mesh, scene.surface);
  return out;
}

PeerMesh lattice_mesh(const SolverScene& scene, double edge_m) {
  const MixedLattice mixed = mixed_lattice(scene, edge_m);
  PeerMesh out;
  out.body.materials = mixed_materials(scene.options.stiff);
  TetrahedraMesh& mesh = out.body.mesh;
  for (std::size_t n = 0; n < mixed.lattice.nodes.size(); ++n) mesh.nodes.push_back(mixed.lattice.node_m(n));
  for (std::size_t c = 0; c < mixed.lattice.cells.size(); ++c) {
    const LatticeCell& cell = mixed.lattice.cells[c];
    const int sum = cell.place[0] + cell.place[1] + cell.place[2];
    split_cube(cell.corners, sum % 2 != 0, mixed.material[c], mesh);
    out.body.share.resize(mesh.tetrahedra.size(), cell.fill);
  }
  out.surface = mixed.surface;
  return out;
}

SoftMesh soft_mesh(const SolverScene& scene, const SoftSolidOptions& options) {
  const MixedLattice mixed = mixed_lattice(scene, options.edge_m);
  std::vector<Vec3> nodes;
  for (std::size_t n = 0; n < mixed.lattice.nodes.size(); ++n) nodes.push_back(mixed.lattice.node_m(n));
  std::vector<SoftCell> cells;
  for (std::size_t c = 0; c < mixed.lattice.cells.size(); ++c)
    cells.push_back({mixed.lattice.cells[c].corners, mixed.lattice.cells[c].fill, mixed.material[c]});
  const std::vector<TissueSolid> materials = mixed_materials(scene.options.stiff);
  return {SoftSolid(nodes, cells, materials, options), mixed.surface};
}

}  // namespace trocar
