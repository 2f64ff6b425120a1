#include "tissue/mesh/complex/complex_volume.h"

#include <algorithm>
#include <cmath>

#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

constexpr double kLeastFree = 0.1;  ///< of an organ's area: with less, shared faces move too
constexpr double kTolerance = 1e-4;
constexpr int kRounds = 6;

/// Whether all triangles round a vertex part the same two regions.
std::vector<bool> within_patches(const LabelComplex& complex) {
  std::vector<std::array<std::int16_t, 2>> pair(complex.vertices.size(), {-1, -1});
  std::vector<bool> within(complex.vertices.size(), true);
  for (std::size_t t = 0; t < complex.triangles.size(); ++t)
    for (const auto corner : complex.triangles[t]) {
      const auto v = static_cast<std::size_t>(corner);
      if (pair[v][0] < 0) pair[v] = complex.regions[t];
      if (pair[v] != complex.regions[t]) within[v] = false;
    }
  return within;
}

/// Sums the outward normals of a region's faces, weighted by area, at their vertices. @return the area
double add_normals(const LabelComplex& complex, std::int16_t region, bool free_only, std::vector<Vec3>& normals) {
  double area = 0;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    const auto& [low, high] = complex.regions[t];
    if ((low != region && high != region) || (free_only && low != 0)) continue;
    const auto& [a, b, c] = complex.triangles[t];
    const auto at = [&](std::int32_t v) -> const Vec3& { return complex.vertices[static_cast<std::size_t>(v)]; };
    const Vec3 doubled = (low == region ? 1.0 : -1.0) * (at(b) - at(a)).cross(at(c) - at(a));
    area += doubled.norm() / 2;
    for (const auto corner : {a, b, c}) normals[static_cast<std::size_t>(corner)] += doubled;
  }
  return area;
}

void correct_region_volume(LabelComplex& complex, std::int16_t region, double target_m3, double most_m,
                           const std::vector<bool>& within, const CapKeeper& caps) {
  const TriangleSurface border = complex.border(region);
  const double missing = target_m3 - border.volume_m3();
  if (std::abs(missing) < kTolerance * target_m3) return;
  std::vector<Vec3> normals(complex.vertices.size(), Vec3::Zero());
  double area = add_normals(complex, region, true, normals);
  if (area < kLeastFree * surface_area_m2(border)) {
    std::fill(normals.begin(), normals.end(), Vec3::Zero());
    area = add_normals(complex, region, false, normals);
  }
  if (!(area > 0)) return;
  const double step = std::clamp(missing / area, -most_m, most_m);
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (within[v] && normals[v].norm() > 0) complex.vertices[v] += step * normals[v].normalized();
  caps.apply(complex.vertices);
}

}  // namespace

void correct_volumes(LabelComplex& complex, const std::vector<double>& targets_m3, double most_m,
                     const CapKeeper& caps) {
  const std::vector<bool> within = within_patches(complex);
  caps.apply(complex.vertices);
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t n = 0; n < targets_m3.size(); ++n)
      correct_region_volume(complex, static_cast<std::int16_t>(n + 1), targets_m3[n], most_m, within, caps);
}

}  // namespace trocar
