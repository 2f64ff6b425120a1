#include "tissue/solid/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/solid/organ_regions.h"
#include "tissue/solid/tetrahedra_angles.h"
#include "tissue/solid/tetrahedra_border.h"
#include "tissue/solid/tetrahedra_mesher.h"

namespace trocar {
namespace {

using Surfaces = std::vector<const TriangleSurface*>;

constexpr double kFacetDistance = 0.1;  ///< of the size, or of the radius where that is smaller
constexpr double kExuded = 20;          ///< degrees: beyond it exudation takes long and gains nothing
constexpr double kWanted = 15;          ///< degrees
constexpr double kReach = 1.5;          ///< of the facet distance: how far a border node may go for an angle
constexpr int kRounds = 3;
constexpr double kBytesEach = 1000;  ///< of memory while a tetrahedron is made; 650 measured

/// Of a tube its radius, of a ball two thirds of it.
double radius_of(const TriangleSurface& surface) { return 2 * surface.volume_m3() / surface_area_m2(surface); }

double facet_distance(const TriangleSurface& surface, double cell) {
  return kFacetDistance * std::min(cell, radius_of(surface));
}

/// Largest radius of a facet that keeps the distance on a tube or a ball as thick as the organ.
double facet_radius(const TriangleSurface& surface, double cell) {
  return std::min(cell, std::sqrt(2 * radius_of(surface) * facet_distance(surface, cell)));
}

/// Memory that can be had, bytes; infinite where the system does not tell.
double free_memory() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  for (double kilobytes = 0; file >> key >> kilobytes; std::getline(file, unit))
    if (key == "MemAvailable:") return kilobytes * 1024;
  return std::numeric_limits<double>::infinity();
}

std::string in_words(double number) {
  constexpr double kMillion = 1e6;
  const auto whole = [](double value) { return std::to_string(std::llround(std::min(value, 1e15))); };
  return number < kMillion ? whole(number) : whole(number / kMillion) + " million";
}

/// Smallest size of which few enough can be made, rounded up, in millimetres.
std::string possible_size(const Surfaces& organs) {
  double tenths = 1;
  while (expected_tetrahedra(organs, tenths * 1e-4) > static_cast<double>(kMaxTriangles)) ++tenths;
  std::ostringstream text;
  text << tenths / 10 << " mm";
  return text.str();
}

/// @throws InputError or EnvironmentError before anything is made
void check_size(const Surfaces& organs, double cell_m) {
  if (!(cell_m > 0 && cell_m <= 1)) throw InputError("tetrahedra: a size above 0 and up to 1000 mm is possible");
  for (const TriangleSurface* organ : organs)
    if (!(organ->volume_m3() > 0)) throw InputError("tetrahedra: a surface bounds no volume");
  const double wanted = expected_tetrahedra(organs, cell_m);
  const double gigabytes = wanted * kBytesEach / 1e9;
  const std::string estimate = "tetrahedra of that size would be about " + in_words(wanted) + " and take about " +
                               in_words(std::ceil(gigabytes)) + " GB of memory";
  if (wanted > static_cast<double>(kMaxTriangles))
    throw InputError(estimate + "; at most " + in_words(kMaxTriangles) + " are made: choose " + possible_size(organs) +
                     " or more");
  if (const double room = free_memory() / 1e9; gigabytes > room)
    throw EnvironmentError(estimate + ", of which this machine has " + in_words(room) + " left: choose a larger size");
}

/// Vertices of the surfaces, on each no two nearer than its radius or a cell.
std::vector<MesherSeed> seeds_on(const Surfaces& organs, double cell) {
  std::vector<MesherSeed> seeds;
  for (std::size_t n = 0; n < organs.size(); ++n) {
    const double apart = std::min(cell, radius_of(*organs[n]));
    std::map<std::array<std::int64_t, 3>, std::vector<Vec3>> kept;  // by cubes of that edge
    for (const Vec3& place : organs[n]->vertices) {
      const Eigen::Array3d cube = (place.array() / apart).floor();
      bool near = false;
      for (int side = 0; side < 27 && !near; ++side) {
        const auto found = kept.find({static_cast<std::int64_t>(cube.x()) + side % 3 - 1,
                                      static_cast<std::int64_t>(cube.y()) + side / 3 % 3 - 1,
                                      static_cast<std::int64_t>(cube.z()) + side / 9 - 1});
        if (found == kept.end()) continue;
        near = std::any_of(found->second.begin(), found->second.end(),
                           [&](const Vec3& other) { return (other - place).norm() < apart; });
      }
      if (near) continue;
      kept[{static_cast<std::int64_t>(cube.x()), static_cast<std::int64_t>(cube.y()),
            static_cast<std::int64_t>(cube.z())}]
          .push_back(place);
      seeds.push_back({place, static_cast<int>(n) + 1});
    }
  }
  return seeds;
}

TetrahedraMesh refined(const Surfaces& organs, const OrganRegions& regions, const TetrahedraOptions& options) {
  constexpr std::size_t kQuestions = 1 << 14;  // between two reports: some milliseconds
  const double cell = options.cell_m;
  MesherSettings settings;
  for (const TriangleSurface* organ : organs) {
    settings.box.extend(organ->bounds());
    settings.facet_distances.push_back(facet_distance(*organ, cell));
  }
  settings.box.min().array() -= cell, settings.box.max().array() += cell;
  settings.cell = settings.facet = cell;
  settings.seeds = seeds_on(organs, cell);
  settings.sliver_deg = kExuded;
  settings.perturb = false;
  std::size_t questions = 0;
  const auto region = [&](const Vec3& place) {
    if (questions++ % kQuestions == 0) report(options.progress, "filling with tetrahedra", -1);
    return regions.at(place);
  };
  return meshed(region, settings);
}

/// Of each node: any of a region's inside, a border node as the finest of the regions there allows.
std::vector<double> reach_of_nodes(const TetrahedraMesh& mesh, const std::vector<BorderFace>& border,
                                   const std::vector<double>& distances) {
  std::vector<double> reach(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (const BorderFace& face : border)
    for (const std::int32_t label : {face.inner, face.outer})
      for (const std::int32_t node : face.nodes)
        if (label > 0)
          reach[static_cast<std::size_t>(node)] =
              std::min(reach[static_cast<std::size_t>(node)], kReach * distances[static_cast<std::size_t>(label - 1)]);
  return reach;
}

TriangleSurface all_of(const Surfaces& organs) {
  TriangleSurface all;
  for (const TriangleSurface* organ : organs) {
    const auto shift = static_cast<std::int32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), organ->vertices.begin(), organ->vertices.end());
    for (const auto& [a, b, c] : organ->triangles) all.triangles.push_back({a + shift, b + shift, c + shift});
  }
  return all;
}

TetrahedraFacts facts_of(const TetrahedraMesh& mesh, const std::vector<BorderFace>& border,
                         const std::vector<double>& targets, const Surfaces& organs) {
  constexpr double kSliverDeg = 15;
  TetrahedraFacts facts;
  facts.nodes = mesh.nodes.size(), facts.tetrahedra = mesh.tetrahedra.size();
  facts.regions.resize(targets.size());
  facts.min_dihedral_deg = 180;
  double slivers = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const double angle = smallest_dihedral_deg(mesh, t);
    facts.min_dihedral_deg = std::min(facts.min_dihedral_deg, angle);
    slivers += angle < kSliverDeg ? 1 : 0;
    ++facts.regions[static_cast<std::size_t>(mesh.labels[t] - 1)].tetrahedra;
  }
  facts.share_below_15 = slivers / static_cast<double>(mesh.tetrahedra.size());
  const std::vector<double> volumes = region_volumes(mesh, targets.size());
  for (std::size_t n = 0; n < targets.size(); ++n) {
    TetrahedraRegion& region = facts.regions[n];
    region.volume_ml = volumes[n] * 1e6;
    region.volume_error_pct = targets[n] > 0 ? (volumes[n] / targets[n] - 1) * 100 : 0;
    facts.volume_ml += region.volume_ml;
    if (std::abs(region.volume_error_pct) > std::abs(facts.volume_error_pct))
      facts.volume_error_pct = region.volume_error_pct;
  }
  TriangleSurface faces{mesh.nodes, {}};
  for (const BorderFace& face : border) faces.triangles.push_back(face.nodes);
  const SurfaceDistance distance = distance_from_to(faces, all_of(organs));
  facts.surface_rms_m = distance.rms_m, facts.surface_max_m = distance.max_m;
  return facts;
}

}  // namespace

double smallest_dihedral_deg(const TetrahedraMesh& mesh, std::size_t tetrahedron) {
  const auto& t = mesh.tetrahedra[tetrahedron];
  double smallest = 180;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) {
      std::array<std::size_t, 2> rest{};
      for (std::size_t n = 0, m = 0; n < 4; ++n)
        if (n != a && n != b) rest[m++] = n;
      const auto at = [&](std::size_t n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[n])]; };
      const Vec3 axis = at(b) - at(a), n1 = axis.cross(at(rest[0]) - at(a)), n2 = axis.cross(at(rest[1]) - at(a));
      smallest = std::min(smallest, std::atan2(n1.cross(n2).norm(), n1.dot(n2)) * 180 / std::numbers::pi);
    }
  return smallest;
}

double expected_tetrahedra(const std::vector<const TriangleSurface*>& organs, double cell_m) {
  constexpr double kVolumeEach = 0.22, kFacetArea = 0.5;  // of the cube and the square of the radius; fitted
  double sum = 0;
  for (const TriangleSurface* organ : organs)
    sum += organ->volume_m3() / (kVolumeEach * std::pow(cell_m, 3)) +
           surface_area_m2(*organ) / (kFacetArea * std::pow(facet_radius(*organ, cell_m), 2));
  return sum;
}

BuiltTetrahedra make_tetrahedra(const std::vector<const TriangleSurface*>& organs, const TetrahedraOptions& options) {
  check_size(organs, options.cell_m);
  const OrganRegions regions(organs);
  const std::vector<double> targets = regions.volumes();
  BuiltTetrahedra built{refined(organs, regions, options), {}};
  std::vector<double> distances;
  for (const TriangleSurface* organ : organs) distances.push_back(facet_distance(*organ, options.cell_m));
  const std::vector<BorderFace> border = border_faces(built.mesh);
  const std::vector<double> reach = reach_of_nodes(built.mesh, border, distances);
  correct_volumes(built.mesh, border, targets, distances);
  for (int round = 0; round < kRounds; ++round) {  // each undoes a little of the other's work
    improve_angles(built.mesh, reach, kWanted);
    correct_volumes(built.mesh, border, targets, distances);
  }
  built.facts = facts_of(built.mesh, border, targets, organs);
  return built;
}

}  // namespace trocar
