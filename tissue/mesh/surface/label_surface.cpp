#include "tissue/mesh/surface/label_surface.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/mesh/surface/isosurface.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

constexpr double kLabelVolumeTolerance = 2e-4;  ///< of the level search; the remeshed surface is corrected to 1e-4
constexpr double kThinShare = 0.25;             ///< from here on the field is sampled twice as finely
constexpr std::size_t kMostFineSamples = 24'000'000;
constexpr double kSamplesPerEdge = 2.5;     ///< of the wanted edge, where voxels are merged
constexpr double kLeastPieceVoxels = 8;     ///< smaller pieces of the surface fall off
constexpr double kLeastPieceShare = 0.002;  ///< ... and those with less of the volume

/// Coarser along axes whose voxels are much smaller than the wanted edge, finer for thin organs.
Sampling choose_sampling(const LabelMask& mask, double sharp_area_m2, const Vec3& spacing_m, int triangles) {
  const double thin =
      static_cast<double>(count_thin_voxels(mask)) / static_cast<double>(std::max<std::size_t>(mask.kept_voxels, 1));
  if (thin > kThinShare && mask.inside.size() * 8 <= kMostFineSamples) return {2, 2, 2};
  const double area_m2 = sharp_area_m2 / 1.35;  // the stairs' share
  const double edge_m = std::sqrt(area_m2 / triangles / 0.433);
  Sampling sampling{1, 1, 1};
  for (std::size_t axis = 0; axis < 3 && thin < 0.02; ++axis)
    if (2 * kSamplesPerEdge * spacing_m[static_cast<Eigen::Index>(axis)] < edge_m &&
        2 * spacing_m[static_cast<Eigen::Index>(axis)] < 1.01 * std::max(0.0025, spacing_m.maxCoeff()))
      sampling[axis] = -2;
  return sampling;
}

Vec3 sample_spacing(const Vec3& spacing_m, const Sampling& sampling) {
  Vec3 result = spacing_m;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const int step = sampling[static_cast<std::size_t>(axis)];
    result[axis] *= step > 0 ? 1.0 / step : -step;
  }
  return result;
}

/// Level at which the cut field encloses the volume.
double level_of_volume(const ScalarField& field, const LabelMask& mask, const Sampling& sampling, const Vec3& spacing_m,
                       double volume_m3, const Progress& progress) {
  const auto excess = [&](double level) {
    return enclosed_volume_m3(signed_field(field, mask, sampling, level), spacing_m, 0) / volume_m3 - 1;
  };
  double low = 0.02, high = 0.9, at_low = 1, at_high = -1, level = 0.48;
  constexpr int kRounds = 16;
  for (int round = 0, side = 0; round < kRounds; ++round) {
    report(progress, "solving the volume", static_cast<double>(round) / kRounds);
    const double error = excess(level);
    if (std::abs(error) < kLabelVolumeTolerance) break;
    if (error > 0) {
      if (side == 1) at_high /= 2;
      low = level, at_low = error, side = 1;
    } else {
      if (side == -1) at_low /= 2;
      high = level, at_high = error, side = -1;
    }
    level = round < 1 ? level + std::clamp(error, -0.2, 0.2)
                      : std::clamp((low * at_high - high * at_low) / (at_high - at_low), low + 0.02 * (high - low),
                                   high - 0.02 * (high - low));
    level = std::clamp(level, 0.02, 0.9);
  }
  return level;
}

Vec3 voxel_centroid(const LabelMask& mask) {
  Vec3 sum = Vec3::Zero();
  std::size_t voxel = 0;
  for (int k = 0; k < mask.size[2]; ++k)
    for (int j = 0; j < mask.size[1]; ++j)
      for (int i = 0; i < mask.size[0]; ++i, ++voxel)
        if (mask.inside[voxel] != 0) sum += Vec3(i, j, k);
  return sum / static_cast<double>(mask.kept_voxels);
}

/// From samples, metres along the axes of the box, to voxels of the box.
Eigen::Affine3d samples_to_voxels(const Vec3& sample_m, const Sampling& sampling) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const int step = sampling[static_cast<std::size_t>(axis)];
    const double first = sample_place(0, step);
    transform.linear()(axis, axis) = (sample_place(1, step) - first) / sample_m[axis];
    transform.translation()[axis] = first;
  }
  return transform;
}

}  // namespace

Eigen::Affine3d box_to_ras_m(const LabelVolume& volume, const LabelMask& mask) {
  const Vec3 first(mask.first[0], mask.first[1], mask.first[2]);
  Eigen::Affine3d transform;
  transform.linear() = volume.index_to_ras_mm.linear() * 1e-3;
  transform.translation() = (volume.index_to_ras_mm * first) * 1e-3;
  return transform;
}

void map_vertices(TriangleSurface& surface, const Eigen::Affine3d& transform) {
  for (Vec3& vertex : surface.vertices) vertex = transform * vertex;
  if (transform.linear().determinant() >= 0) return;
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

LabelSurface label_surface(const LabelVolume& volume, int label, const LabelMask& mask, int triangles,
                           const Progress& progress) {
  LabelSurface result;
  result.spacing_m = volume.index_to_ras_mm.linear().colwise().norm().transpose() * 1e-3;
  const double voxel_m3 = volume.voxel_volume_ml() * 1e-6;
  result.kept_m3 = static_cast<double>(mask.kept_voxels) * voxel_m3;
  const Eigen::Affine3d to_ras = box_to_ras_m(volume, mask);
  result.sharp = isosurface(sharp_field(mask), Vec3::Ones(), 0.5);
  map_vertices(result.sharp, to_ras);
  result.sampling = choose_sampling(mask, surface_area_m2(result.sharp), result.spacing_m, triangles);
  const Vec3 sample_m = sample_spacing(result.spacing_m, result.sampling);
  report(progress, "smoothing", 0);
  const ScalarField field = smooth_field(mask, {}, result.sampling);
  // Axes that are not perpendicular (a sheared gantry) make a voxel smaller than its edges' product.
  const double box_m3 = result.kept_m3 * result.spacing_m.prod() / voxel_m3;
  result.level = level_of_volume(field, mask, result.sampling, sample_m, box_m3, progress);
  const double least = std::max(kLeastPieceVoxels * result.spacing_m.prod(), kLeastPieceShare * box_m3);
  result.dense = without_specks(isosurface(signed_field(field, mask, result.sampling, result.level), sample_m, 0),
                                least, &result.fallen_off_m3);
  if (result.dense.triangles.empty())
    throw InputError("label " + std::to_string(label) + " is too thin to give a surface");
  for (double& lost : result.fallen_off_m3) lost *= voxel_m3 / result.spacing_m.prod(), result.kept_m3 -= lost;
  result.centroid_m = to_ras * voxel_centroid(mask);
  map_vertices(result.dense, to_ras * samples_to_voxels(sample_m, result.sampling));
  result.caps = cap_planes(mask, to_ras);
  return result;
}

}  // namespace trocar
