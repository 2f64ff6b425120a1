#include "tissue/solid/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/label_surface.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/solid/tetrahedra_mesher.h"

namespace trocar {
namespace {

/// One label's field with its level taken off: above 0 inside, linear between the samples. Places in mm.
class LabelField {
 public:
  LabelField(const LabelVolume& volume, int label, const Progress& progress)
      : mask_(cut_out_label(volume, label, kSmoothingMargin, {})) {
    constexpr int kTriangles = 100000;  // as finely as the voxels allow
    LabelSurface surface = label_surface(volume, label, mask_, kTriangles, progress);
    dense_ = std::move(surface.dense);
    field_ = signed_field(smooth_field(mask_, {}, surface.sampling), mask_, surface.sampling, surface.level);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const int step = surface.sampling[static_cast<std::size_t>(axis)];
      first_[axis] = sample_place(0, step) + mask_.first[static_cast<std::size_t>(axis)];
      spacing_[axis] = sample_place(1, step) - sample_place(0, step);
    }
  }

  /// @param voxel place in voxels of the label map
  double at(const Vec3& voxel) const {
    const Vec3 place = (voxel - first_).cwiseQuotient(spacing_);
    std::array<int, 3> low{};
    Vec3 share;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(axis);
      const double floor = std::floor(place[axis]);
      if (!(floor >= 0) || floor + 1 >= field_.size[n]) return -1;
      low[n] = static_cast<int>(floor);
      share[axis] = place[axis] - floor;
    }
    double value = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      for (int axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? share[axis] : 1 - share[axis];
      value += weight *
               field_.values[field_.offset(low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2))];
    }
    return value;
  }

  const TriangleSurface& dense() const { return dense_; }
  std::size_t voxels() const { return mask_.kept_voxels; }

 private:
  LabelMask mask_;
  ScalarField field_;
  TriangleSurface dense_;
  Vec3 first_, spacing_;
};

double six_cell_volumes(const TetrahedraMesh& mesh, const std::array<std::int32_t, 4>& t) {
  const auto at = [&](std::size_t n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[n])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
}

/// Faces of one tetrahedron only, outward.
TriangleSurface boundary_of(const TetrahedraMesh& mesh) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::map<std::array<std::int32_t, 3>, std::pair<int, std::array<std::int32_t, 3>>> faces;
  for (const auto& t : mesh.tetrahedra)
    for (const auto& f : kFaces) {
      const std::array<std::int32_t, 3> face{t[f[0]], t[f[1]], t[f[2]]};
      auto key = face;
      std::sort(key.begin(), key.end());
      auto& entry = faces[key];
      ++entry.first;
      entry.second = face;
    }
  TriangleSurface surface;
  surface.vertices = mesh.nodes;
  for (const auto& [key, entry] : faces)
    if (entry.first == 1) surface.triangles.push_back(entry.second);
  return surface;
}

TetrahedraFacts facts_of(const TetrahedraMesh& mesh, const std::vector<LabelField>& fields, double voxel_m3) {
  constexpr double kSliverDeg = 15;
  TetrahedraFacts facts;
  facts.nodes = mesh.nodes.size(), facts.tetrahedra = mesh.tetrahedra.size();
  facts.min_dihedral_deg = 180;
  double slivers = 0, voxels = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const double angle = smallest_dihedral_deg(mesh, t);
    facts.min_dihedral_deg = std::min(facts.min_dihedral_deg, angle);
    slivers += angle < kSliverDeg ? 1 : 0;
    facts.volume_ml += six_cell_volumes(mesh, mesh.tetrahedra[t]) / 6 * 1e6;
  }
  facts.share_below_15 = slivers / static_cast<double>(mesh.tetrahedra.size());
  TriangleSurface dense;
  for (const LabelField& field : fields) {
    voxels += static_cast<double>(field.voxels());
    const auto shift = static_cast<std::int32_t>(dense.vertices.size());
    dense.vertices.insert(dense.vertices.end(), field.dense().vertices.begin(), field.dense().vertices.end());
    for (const auto& [a, b, c] : field.dense().triangles) dense.triangles.push_back({a + shift, b + shift, c + shift});
  }
  facts.volume_error_pct = (facts.volume_ml / (voxels * voxel_m3 * 1e6) - 1) * 100;
  const SurfaceDistance distance = distance_from_to(boundary_of(mesh), dense);
  facts.surface_rms_voxel = distance.rms_m / std::cbrt(voxel_m3);
  facts.surface_max_voxel = distance.max_m / std::cbrt(voxel_m3);
  return facts;
}

double volume_m3(const TetrahedraMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra) sum += six_cell_volumes(mesh, t) / 6;
  return sum;
}

/// Facets are chords: the mesh is a little small. Moves the outer nodes along the normals until it holds the voxels'
/// volume.
/// @return the shift, m; 0 when it would have squeezed a tetrahedron
double correct_tetrahedra_volume(TetrahedraMesh& mesh, double volume) {
  const TetrahedraMesh before = mesh;
  TriangleSurface surface = boundary_of(mesh);
  double shift = 0;
  for (int round = 0; round < 4; ++round) {
    const double step = (volume - volume_m3(mesh)) / surface_area_m2(surface);
    const std::vector<Vec3> normals = surface.vertex_normals();
    for (std::size_t n = 0; n < normals.size(); ++n) mesh.nodes[n] += step * normals[n];
    surface.vertices = mesh.nodes;
    shift += step;
  }
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    if (six_cell_volumes(mesh, mesh.tetrahedra[t]) < 0.3 * six_cell_volumes(before, before.tetrahedra[t])) {
      mesh = before;
      return 0;
    }
  return shift;
}

void check_tetrahedra(const std::vector<int>& labels, const TetrahedraOptions& options) {
  if (labels.empty()) throw InputError("no label was asked for");
  if (!(options.cell_m > 1e-4 && options.cell_m < 1))
    throw InputError("tetrahedra of that size cannot be made: 0.1 mm to 1 m are possible");
  if (!(options.facet_distance_voxel >= 0.05 && options.facet_distance_voxel <= 10))
    throw InputError("the facet distance must be 0.05 to 10 voxels");
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

BuiltTetrahedra make_tetrahedra(const LabelVolume& volume, const std::vector<int>& labels,
                                const TetrahedraOptions& options) {
  check_tetrahedra(labels, options);
  std::vector<LabelField> fields;
  for (const int label : labels) fields.emplace_back(volume, label, options.progress);
  const Eigen::Affine3d to_voxel = volume.index_to_ras_mm.inverse();
  const double voxel_mm = std::cbrt(volume.voxel_volume_ml() * 1e3);
  MesherSettings settings;
  for (const LabelField& field : fields)
    for (const Vec3& vertex : field.dense().vertices) settings.box.extend(vertex * 1e3);
  settings.box.min().array() -= 2 * voxel_mm, settings.box.max().array() += 2 * voxel_mm;
  settings.cell = options.cell_m * 1e3, settings.facet = options.cell_m * 1e3;
  settings.facet_distance = options.facet_distance_voxel * voxel_mm;
  settings.optimise = options.optimise;
  report(options.progress, "filling with tetrahedra", -1);
  const auto region = [&](const Vec3& place_mm) {
    const Vec3 voxel = to_voxel * place_mm;
    int best = 0;
    double most = 0;
    for (std::size_t n = 0; n < fields.size(); ++n)
      if (const double value = fields[n].at(voxel); value > most) most = value, best = static_cast<int>(n + 1);
    return best;
  };
  BuiltTetrahedra built;
  built.mesh = meshed(region, settings);
  if (built.mesh.tetrahedra.empty()) throw InputError("the cells are too large for this organ: choose smaller ones");
  for (Vec3& node : built.mesh.nodes) node *= 1e-3;
  for (auto& label : built.mesh.labels) label = labels[static_cast<std::size_t>(label - 1)];
  for (auto& t : built.mesh.tetrahedra)
    if (six_cell_volumes(built.mesh, t) < 0) std::swap(t[2], t[3]);
  double voxels = 0;
  for (const LabelField& field : fields) voxels += static_cast<double>(field.voxels());
  const double shift = correct_tetrahedra_volume(built.mesh, voxels * volume.voxel_volume_ml() * 1e-6);
  built.notes.push_back(shift == 0 ? "the outer nodes were not moved: the volume error stays"
                                   : "moved the outer nodes by " + std::to_string(shift * 1e3) +
                                         " mm along the normals to keep the volume");
  built.facts = facts_of(built.mesh, fields, volume.voxel_volume_ml() * 1e-6);
  if (built.facts.min_dihedral_deg < 10)
    built.notes.push_back("some tetrahedra have a dihedral angle under 10 degrees: smaller cells help");
  return built;
}

}  // namespace trocar
