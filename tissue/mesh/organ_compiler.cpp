#include "tissue/mesh/organ_compiler.h"

#include <array>
#include <cmath>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/imaging/label_mask.h"
#include "tissue/imaging/smooth_field.h"
#include "tissue/mesh/isosurface.h"
#include "tissue/mesh/remesh.h"
#include "tissue/mesh/surface_fit.h"

namespace trocar {
namespace {

constexpr double kMlPerM3 = 1e6;
constexpr int kRemeshIterations = 5;
constexpr double kVolumeTolerance = 1e-4;  ///< relative; the budget is 1e-2
// Mean triangle area of a remeshed surface over that of the equilateral triangle of the wanted edge (measured on the
// shipped organs); a second pass with the count of the first corrects what is left.
constexpr double kAreaRatio = 0.85;

std::string fixed(double value, int digits) {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(digits);
  out << value;
  return out.str();
}

/// Iso surface whose largest piece encloses `volume`; the level is found by bisection (the volume falls with the
/// level).
struct LevelSurface {
  TriangleSurface surface;
  double level = 0.5;
  std::vector<double> fallen_off_m3;
};

LevelSurface surface_of_volume(const ScalarField& field, const Vec3& spacing_m, double volume_m3) {
  double low = 0.02, high = 0.98;
  LevelSurface best;
  for (int round = 0; round < 20; ++round) {
    best.surface = largest_component(isosurface(field, spacing_m, best.level), &best.fallen_off_m3);
    const double error = best.surface.volume_m3() / volume_m3 - 1;
    if (std::abs(error) < 1e-3) break;
    (error > 0 ? low : high) = best.level;
    best.level = (low + high) / 2;
  }
  return best;
}

void round_to_float(TriangleSurface& surface) {
  for (Vec3& vertex : surface.vertices) vertex = vertex.cast<float>().cast<double>();
}

/// Moves every vertex along its normal until the enclosed volume is right. @return the shift, m
double correct_volume(TriangleSurface& surface, double volume_m3) {
  double shift = 0;
  for (int round = 0; round < 8; ++round) {
    const double missing = volume_m3 - surface.volume_m3();
    if (std::abs(missing) < kVolumeTolerance * volume_m3) break;
    const double step = missing / surface_area_m2(surface);
    const std::vector<Vec3> normals = surface.vertex_normals();
    for (std::size_t v = 0; v < normals.size(); ++v) surface.vertices[v] += step * normals[v];
    shift += step;
  }
  return shift;
}

struct Remeshed {
  TriangleSurface surface;
  std::size_t self_intersections = 0;
};

/// What one attempt of remeshing does; later attempts are gentler, then finer.
struct Attempt {
  double edge_scale;
  int fit_sweeps;
};
constexpr std::array<Attempt, 5> kAttempts{{{1, 4}, {1, 1}, {1, 0}, {0.85, 0}, {0.72, 0}}};

/// Edge length that gives about `triangles`, found by one trial.
double calibrated_edge(const TriangleSurface& source, int triangles) {
  const double edge = std::sqrt(surface_area_m2(source) / triangles / kAreaRatio * 4 / std::sqrt(3.0));
  const auto count = static_cast<double>(remeshed(source, edge, kRemeshIterations).triangles.size());
  return edge * std::sqrt(count / triangles);
}

/// Remeshes to about `triangles`, fits, corrects the volume, and tries again when the result cuts itself.
Remeshed remesh_to(const TriangleSurface& source, int triangles, double volume_m3, std::vector<std::string>& repairs) {
  const double edge = calibrated_edge(source, triangles);
  Remeshed result;
  for (const Attempt& attempt : kAttempts) {
    result.surface = fitted(remeshed(source, edge * attempt.edge_scale, kRemeshIterations), source, attempt.fit_sweeps);
    const double shift = correct_volume(result.surface, volume_m3);
    round_to_float(result.surface);
    result.self_intersections = count_self_intersections(result.surface);
    const std::string what = "remeshed to an edge of " + fixed(edge * attempt.edge_scale * 1e3, 2) + " mm, fitted in " +
                             std::to_string(attempt.fit_sweeps) + " sweeps, moved " + fixed(shift * 1e3, 3) +
                             " mm along the normals to keep the volume";
    if (result.self_intersections == 0) {
      repairs.push_back(what);
      break;
    }
    repairs.push_back(what + ": " + std::to_string(result.self_intersections) + " self-intersections, not kept");
  }
  return result;
}

CompiledOrgan measured(Remeshed&& mesh, MeshFacts facts, double kept_m3, const TriangleSurface& reference) {
  facts.self_intersections = mesh.self_intersections;
  facts.topology = analyse_topology(mesh.surface);
  facts.volume_ml = mesh.surface.volume_m3() * kMlPerM3;
  facts.kept_volume_ml = kept_m3 * kMlPerM3;
  facts.kept_error_pct = (facts.volume_ml / facts.kept_volume_ml - 1) * 100;
  facts.volume_error_pct = (facts.volume_ml / facts.label_volume_ml.value_or(facts.kept_volume_ml) - 1) * 100;
  facts.distance = distance_from_to(mesh.surface, reference);
  facts.distance_back = distance_from_to(reference, mesh.surface);
  facts.quality = mesh_quality(mesh.surface);
  return {std::move(mesh.surface), std::move(facts)};
}

void report_mask(const LabelMask& mask, double voxel_ml, MeshFacts& facts) {
  facts.label_volume_ml = static_cast<double>(mask.label_voxels) * voxel_ml;
  facts.border_voxels = mask.border_voxels;
  for (const std::size_t voxels : mask.lost_parts)
    facts.lost.push_back({"part", voxels, static_cast<double>(voxels) * voxel_ml});
  if (!mask.lost_parts.empty())
    facts.repairs.push_back("kept the largest of " + std::to_string(mask.lost_parts.size() + 1) + " parts");
  for (const std::size_t voxels : mask.cavities)
    facts.repairs.push_back("filled a cavity of " + std::to_string(voxels) + " voxels");
  if (mask.border_voxels > 0)
    facts.repairs.push_back("closed the cut at the image border with a flat cap (" +
                            std::to_string(mask.border_voxels) + " voxels)");
}

/// From the box of the mask, metres along its axes, to RAS metres.
Eigen::Affine3d box_to_ras(const LabelVolume& volume, const LabelMask& mask, const Vec3& spacing_m) {
  const Vec3 first(mask.first[0], mask.first[1], mask.first[2]);
  Eigen::Affine3d transform;
  transform.linear() = volume.index_to_ras_mm.linear() * 1e-3 * spacing_m.cwiseInverse().asDiagonal();
  transform.translation() = (volume.index_to_ras_mm * first) * 1e-3;
  return transform;
}

void map_vertices(TriangleSurface& surface, const Eigen::Affine3d& transform) {
  for (Vec3& vertex : surface.vertices) vertex = transform * vertex;
  if (transform.linear().determinant() >= 0) return;
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

}  // namespace

CompiledOrgan compile_label(const LabelVolume& volume, int label, const CompileOptions& options) {
  const LabelMask mask = cut_out_label(volume, label, kSmoothingMargin);
  const Vec3 spacing_m = volume.index_to_ras_mm.linear().colwise().norm().transpose() * 1e-3;
  const double voxel_ml = volume.voxel_volume_ml(),
               kept_m3 = static_cast<double>(mask.kept_voxels) * voxel_ml / kMlPerM3;
  MeshFacts facts;
  facts.repairs = volume.notes;
  report_mask(mask, voxel_ml, facts);
  LevelSurface smooth = surface_of_volume(smooth_field(mask, {}), spacing_m, kept_m3);
  if (smooth.surface.triangles.empty())
    throw InputError("label " + std::to_string(label) + " is too thin to give a surface");
  for (const double lost : smooth.fallen_off_m3)
    facts.lost.push_back({"neck", static_cast<std::size_t>(std::llround(lost * kMlPerM3 / voxel_ml)), lost * kMlPerM3});
  facts.repairs.push_back("smoothed, iso level " + fixed(smooth.level, 4));
  TriangleSurface sharp = largest_component(isosurface(sharp_field(mask), spacing_m, 0.5));
  const Eigen::Affine3d to_ras = box_to_ras(volume, mask, spacing_m);
  map_vertices(smooth.surface, to_ras);
  map_vertices(sharp, to_ras);
  Remeshed mesh = remesh_to(smooth.surface, options.triangles, kept_m3, facts.repairs);
  return measured(std::move(mesh), std::move(facts), kept_m3, sharp);
}

CompiledOrgan compile_surface(const TriangleSurface& surface, const CompileOptions& options) {
  MeshFacts facts;
  const double volume = surface.volume_m3();
  Remeshed mesh = remesh_to(surface, options.triangles, volume, facts.repairs);
  return measured(std::move(mesh), std::move(facts), volume, surface);
}

}  // namespace trocar
