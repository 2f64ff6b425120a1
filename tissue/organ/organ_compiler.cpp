#include "tissue/organ/organ_compiler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/complex/complex_remesh.h"
#include "tissue/mesh/complex/complex_volume.h"
#include "tissue/mesh/complex/crossing_guard.h"
#include "tissue/mesh/surface/edge_sizes.h"
#include "tissue/mesh/surface/label_surface.h"
#include "tissue/mesh/surface/measured_facts.h"
#include "tissue/mesh/surface/remesh.h"
#include "tissue/mesh/surface/surface_fit.h"

namespace trocar {
namespace {

constexpr double kMlPerM3 = 1e6;
constexpr double kVolumeTolerance = 1e-4;  ///< relative; the budget is 1e-2
constexpr std::size_t kFitVertices = 4;    ///< that a surface to fit to has at least, for each triangle wanted
std::string fixed_text(double value, int digits) {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(digits);
  out << value;
  return out.str();
}

void round_to_float(TriangleSurface& surface) {
  for (Vec3& vertex : surface.vertices) vertex = as_float(vertex);
}

/// Moves every vertex along its normal until the enclosed volume is right. @return the shift, m
double correct_volume(TriangleSurface& surface, double volume_m3, const CapKeeper& caps) {
  double shift = 0;
  caps.apply(surface.vertices);
  for (int round = 0; round < 10; ++round) {
    const double missing = volume_m3 - surface.volume_m3();
    if (std::abs(missing) < kVolumeTolerance * volume_m3) break;
    const double step = missing / surface_area_m2(surface);
    const std::vector<Vec3> normals = surface.vertex_normals();
    for (std::size_t v = 0; v < normals.size(); ++v) surface.vertices[v] += step * normals[v];
    caps.apply(surface.vertices);
    shift += step;
  }
  return shift;
}

struct Remeshed {
  TriangleSurface surface;
  std::size_t self_intersections = 0;
};

/// What one attempt of remeshing does.
struct Attempt {
  double triangles;
  int fit_sweeps;
  bool even;
};

/// Later attempts are gentler, then finer and more even.
std::vector<Attempt> attempts_of(MeshFit fit) {
  std::vector<Attempt> attempts;
  for (const int sweeps : fit == MeshFit::kOntoBends ? std::vector{6, 3, 1, 0} : std::vector{4, 1, 0})
    attempts.push_back({1, sweeps, false});
  for (const double triangles : {1.0, 1.4, 2.0}) attempts.push_back({triangles, 0, true});
  return attempts;
}

std::vector<double> sizes_for(const TriangleSurface& source, int triangles, double smoothing_m, bool even) {
  EdgeSizeOptions sizes;
  sizes.triangles = triangles;
  sizes.smoothing_m = smoothing_m;
  if (even) sizes.shortest = 0.9, sizes.longest = 1.1;
  return edge_sizes(source, sizes);
}

/// Remeshes a surface that does not cut itself so that no step makes it do so.
Remeshed remesh_guarded(const TriangleSurface& source, const CompileOptions& options, double volume_m3,
                        double smoothing_m, const std::vector<CapPlane>& planes) {
  LabelComplex complex{source.vertices, source.triangles, {}};
  for (Vec3& vertex : complex.vertices) vertex = as_float(vertex);
  for (auto& triangle : complex.triangles) std::swap(triangle[1], triangle[2]);
  complex.regions.assign(complex.triangles.size(), {0, 1});
  ComplexRemeshOptions remesh;
  remesh.triangles = {options.triangles}, remesh.smoothing_m = smoothing_m, remesh.progress = options.progress;
  complex = remeshed(complex, remesh);
  LabelComplex full = complex;
  correct_volumes(full, {volume_m3}, smoothing_m, CapKeeper(planes, full.vertices));
  move_without_crossing(complex, full.vertices);
  Remeshed result{complex.border(1), 0};
  result.self_intersections = count_self_intersections(result.surface);
  return result;
}

/// The same surface, its triangles cut in four until it has as many vertices: a coarse one has too few to fit to.
TriangleSurface cut_in_four(TriangleSurface surface, std::size_t vertices) {
  while (surface.vertices.size() < vertices) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [entry, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(surface.vertices.size()));
      if (fresh)
        surface.vertices.push_back(
            (surface.vertices[static_cast<std::size_t>(a)] + surface.vertices[static_cast<std::size_t>(b)]) / 2);
      return entry->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : surface.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    surface.triangles = std::move(finer);
  }
  return surface;
}

/// Remeshes to about `triangles`, fits, corrects the volume, and tries again when the result cuts itself.
/// @param target what is fitted to: the source with enough vertices
Remeshed remesh_to(const TriangleSurface& source, const TriangleSurface& target, const CompileOptions& options,
                   double volume_m3, double smoothing_m, const std::vector<CapPlane>& planes,
                   std::vector<std::string>& repairs) {
  const std::vector<Attempt> attempts = attempts_of(options.fit);
  Remeshed best;
  TriangleSurface unfitted;
  const Attempt* last = nullptr;
  for (const Attempt& attempt : attempts) {
    Remeshed result;
    const int triangles = static_cast<int>(options.triangles * attempt.triangles);
    RemeshOptions remesh;
    remesh.triangles = triangles, remesh.progress = options.progress;
    if (last == nullptr || last->even != attempt.even || last->triangles != attempt.triangles)
      unfitted = remeshed(source, sizes_for(source, triangles, smoothing_m, attempt.even), remesh);
    last = &attempt;
    const CapKeeper caps(planes, unfitted.vertices);
    report(options.progress, "fitting", 0);
    result.surface = options.fit == MeshFit::kOntoBends ? closely_fitted(unfitted, target, caps, attempt.fit_sweeps)
                                                        : fitted(unfitted, source, attempt.fit_sweeps);
    const double shift = correct_volume(result.surface, volume_m3, caps);
    round_to_float(result.surface);
    result.self_intersections = count_self_intersections(result.surface);
    const std::string what = "remeshed to " + std::to_string(result.surface.triangles.size()) + " triangles" +
                             (attempt.even ? " of even size" : "") + ", fitted in " +
                             std::to_string(attempt.fit_sweeps) + " sweeps, moved " + fixed_text(shift * 1e3, 3) +
                             " mm along the normals to keep the volume";
    if (result.self_intersections == 0) {
      repairs.push_back(what);
      return result;
    }
    repairs.push_back(what + ": " + std::to_string(result.self_intersections) + " self-intersections");
    if (attempt.fit_sweeps > 0) continue;
    if (best.surface.triangles.empty()) {
      best = remesh_guarded(source, options, volume_m3, smoothing_m, planes);
      if (best.self_intersections == 0) {
        repairs.push_back("remeshed to " + std::to_string(best.surface.triangles.size()) +
                          " triangles by steps after none of which it cuts itself");
        return best;
      }
    }
    if (result.self_intersections < best.self_intersections) best = std::move(result);
  }
  repairs.push_back("kept the attempt with the fewest self-intersections, " + std::to_string(best.self_intersections));
  return best;
}

std::string sampling_text(const Sampling& sampling) {
  if (sampling == Sampling{1, 1, 1}) return "";
  if (sampling[0] == 2) return ", sampled at half voxels because much of it is thin";
  return ", sampled at " + std::to_string(std::abs(sampling[0])) + " x " + std::to_string(std::abs(sampling[1])) +
         " x " + std::to_string(std::abs(sampling[2])) + " voxels";
}

}  // namespace

CompiledOrgan compile_label(const LabelVolume& volume, int label, const CompileOptions& options) {
  report(options.progress, "cutting out the label", 0);
  const LabelMask mask = cut_out_label(volume, label, kSmoothingMargin, options.parts);
  const double voxel_ml = volume.voxel_volume_ml();
  MeshFacts facts;
  facts.repairs = volume.notes;
  note_mask(mask, voxel_ml, facts);
  const LabelSurface source = label_surface(volume, label, mask, options.triangles, options.progress);
  for (const double lost : source.fallen_off_m3)
    facts.lost.push_back(
        {"detached", static_cast<std::size_t>(std::llround(lost * kMlPerM3 / voxel_ml)), lost * kMlPerM3});
  facts.repairs.push_back("smoothed, iso level " + fixed_text(source.level, 4) + sampling_text(source.sampling));
  facts.voxel_m = std::cbrt(voxel_ml / kMlPerM3);
  Remeshed mesh = remesh_to(source.dense, source.dense, options, source.kept_m3, 2 * source.spacing_m.maxCoeff(),
                            source.caps, facts.repairs);
  report(options.progress, "measuring", 0);
  facts.self_intersections = mesh.self_intersections;
  measure(mesh.surface, source.kept_m3, source.sharp, source.centroid_m, facts);
  const auto lost = lost_form(mesh.surface, source.dense, facts, options.triangles);
  return {std::move(mesh.surface), std::move(facts), lost};
}

CompiledOrgan compile_surface(const TriangleSurface& surface, const CompileOptions& options) {
  MeshFacts facts;
  const double smoothing_m = std::sqrt(surface_area_m2(surface) / options.triangles);
  const TriangleSurface target = cut_in_four(surface, kFitVertices * static_cast<std::size_t>(options.triangles));
  Remeshed mesh = remesh_to(surface, target, options, surface.volume_m3(), smoothing_m, {}, facts.repairs);
  report(options.progress, "measuring", 0);
  facts.self_intersections = mesh.self_intersections;
  measure(mesh.surface, surface.volume_m3(), surface, volume_centroid_m(surface), facts);
  const auto lost = lost_form(mesh.surface, surface, facts, options.triangles);
  return {std::move(mesh.surface), std::move(facts), lost};
}

}  // namespace trocar
