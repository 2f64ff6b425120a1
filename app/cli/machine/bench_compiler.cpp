#include "app/cli/machine/bench_compiler.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "app/cli/machine/bench_contact.h"
#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/isosurface.h"
#include "tissue/organ/organ_compiler.h"

namespace trocar {
namespace {

/// Below 0 inside; the axes run from -1 to 1 over the map.
double liver_like(const Vec3& p) {
  const Vec3 right = (p - Vec3(0.10, 0.05, 0.25)).cwiseQuotient(Vec3(0.38, 0.33, 0.95));
  const Vec3 left = (p - Vec3(-0.28, 0.18, 0.40)).cwiseQuotient(Vec3(0.36, 0.16, 0.55));
  const double lobes = std::min(right.norm(), left.norm());
  const double notch = (p - Vec3(-0.10, -0.12, -0.15)).cwiseQuotient(Vec3(0.16, 0.16, 0.5)).norm();
  const double bends = 0.03 * std::sin(19 * p.x() + 5 * p.z()) * std::sin(17 * p.y()) * std::sin(7 * p.z());
  return std::max(lobes - 1 + bends, 1 - notch);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace

LabelVolume liver_like_labels(const std::array<int, 3>& size) {
  LabelVolume volume;
  volume.size = size;
  volume.index_to_ras_mm.linear() = Eigen::Vector3d(358.4 / size[0], 358.4 / size[1], 120.0 / size[2]).asDiagonal();
  volume.labels.assign(volume.offset(0, 0, size[2]), 0);
  std::size_t voxel = 0;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i, ++voxel) {
        const Vec3 place(2 * (i + 0.5) / size[0] - 1, 2 * (j + 0.5) / size[1] - 1, 2 * (k + 0.5) / size[2] - 1);
        volume.labels[voxel] = liver_like(place) < 0 ? 1 : 0;
      }
  return volume;
}

CompilerCost compiler_cost(const std::array<int, 3>& size, int triangles) {
  CompilerCost cost;
  cost.size = size;
  const LabelVolume volume = liver_like_labels(size);
  const double memory = peak_mb(), start = cpu_now_us();
  CompileOptions options;
  options.triangles = triangles;
  const CompiledOrgan organ = compile_label(volume, 1, options);
  cost.cpu_s = (cpu_now_us() - start) * 1e-6;
  cost.peak_growth_mb = peak_mb() - memory;
  cost.triangles = organ.surface.triangles.size();
  cost.mean_mm = organ.facts.distance.mean_m * 1e3, cost.p99_mm = organ.facts.distance.p99_m * 1e3;
  const LabelMask mask = cut_out_label(volume, 1, 1);
  cost.raw_triangles = isosurface(sharp_field(mask), Vec3::Ones(), 0.5).triangles.size();
  return cost;
}

}  // namespace trocar
