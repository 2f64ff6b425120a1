#include "tissue/organ/lost_form.h"

#include <algorithm>
#include <cmath>

#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

/// Coarse meshes of good form are far from these: at 800 triangles organs of a CT of 3 mm are 0.0 % and less than a
/// third of a voxel off on average.
struct FormLimits {
  double volume_pct = 5;
  double extent_share = 0.1, extent_voxels = 2;
  double mean_voxels = 1, mean_thickness = 0.25;
  double p99_voxels = 5, p99_thickness = 1;
};

/// Sets the axis on which the boxes differ most, beyond what is allowed.
void compare_extents(const TriangleSurface& mesh, const TriangleSurface& source, double voxel_m, LostForm& form) {
  constexpr FormLimits kLimits{};
  const Vec3 got = mesh.bounds().sizes(), wanted = source.bounds().sizes();
  double most = -1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double allowed = std::max(kLimits.extent_voxels * voxel_m, kLimits.extent_share * wanted[axis]);
    const double off = std::abs(got[axis] - wanted[axis]) / allowed;
    if (off <= most) continue;
    most = off;
    form.extent_m = got[axis], form.wanted_m = wanted[axis];
  }
  form.extent_lost = most > 1;
}

/// As many triangles as edges of one and a half thicknesses make, and for voxels at least twice those that were too
/// few. A surface of other programs may have ends so sharp that no number keeps them: a tetrahedron's.
int enough_triangles(double area_m2, double thickness_m, int too_few, bool of_voxels) {
  constexpr double kEdge = 1.5, kAreaOfEdgeOne = 0.433;  // of an equilateral triangle
  constexpr double kMost = 200000;
  const double count = area_m2 / (kAreaOfEdgeOne * std::pow(kEdge * thickness_m, 2));
  if (!of_voxels && count <= too_few) return 0;
  const double wanted = std::max(count, 2.0 * too_few);
  return static_cast<int>(std::min(100 * std::ceil(wanted / 100), kMost));
}

}  // namespace

std::optional<LostForm> lost_form(const TriangleSurface& mesh, const TriangleSurface& source, const MeshFacts& facts,
                                  int triangles) {
  constexpr FormLimits kLimits{};
  constexpr double kNoVoxelM = 1e-3;
  const double voxel_m = facts.voxel_m > 0 ? facts.voxel_m : kNoVoxelM;
  const double area_m2 = surface_area_m2(source);
  LostForm form{.thickness_m = 2 * source.volume_m3() / area_m2, .triangles = triangles};
  form.volume_error_pct = facts.kept_error_pct;
  form.volume_lost = std::abs(facts.kept_error_pct) > kLimits.volume_pct;
  compare_extents(mesh, source, voxel_m, form);
  const auto far = [&](const SurfaceDistance& distance) {
    return distance.mean_m > std::max(kLimits.mean_voxels * voxel_m, kLimits.mean_thickness * form.thickness_m) ||
           distance.p99_m > std::max(kLimits.p99_voxels * voxel_m, kLimits.p99_thickness * form.thickness_m);
  };
  // The distances of the facts may be to the unsmoothed voxels: what smoothing took is no matter of triangles.
  SurfaceDistance back = facts.distance_back;
  bool lies_off = far(back);
  if (lies_off) {
    back = distance_from_to(source, mesh);
    lies_off = far(back);
  }
  form.mean_m = back.mean_m, form.p99_m = back.p99_m;
  if (!form.volume_lost && !form.extent_lost && !lies_off) return {};
  form.enough = enough_triangles(area_m2, form.thickness_m, triangles, facts.voxel_m > 0);
  return form;
}

}  // namespace trocar
