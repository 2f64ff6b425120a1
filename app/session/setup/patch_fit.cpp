#include "app/session/setup/patch_fit.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "haptics/kinematics/device_geometry.h"
#include "tissue/collision/surface_tree.h"

namespace trocar {
namespace {

/// 3 mm round the shaft and what 0.1 m/s makes of the 15 ms between the state that a patch is cut for and the last tick
/// that feels it.
constexpr double kPatchMargin = 3e-3 + 0.1 * 0.015;
constexpr double kSafety = 0.9;  // larger triangles reach further into the 25 mm
constexpr int kRounding = 50;    // of the advice, downwards

}  // namespace

bool PatchFit::whole() const { return most <= kMaxPatchTriangles; }

std::string PatchFit::words() const {
  char text[400];
  const int length = std::snprintf(
      text, sizeof text,
      "a contact patch holds %d triangles within %.0f mm of the tool, here are up to %d; it ends %.1f mm from"
      " the tool's axis, %.1f mm are needed: ",
      kMaxPatchTriangles, kPatchRadius * 1e3, most, reach_m * 1e3, needed_m * 1e3);
  return std::string(text, static_cast<std::size_t>(length)) +
         (felt() ? "enough to feel it; " : "import it again with ") + "--triangles " + std::to_string(advised) +
         (felt() ? " would fit in whole" : "");
}

PatchFit patch_fit(const Scene& scene) {
  const TriangleSurface& surface = felt_surface(scene);
  const SurfaceTree tree(surface);
  const Mat3 R_TI = scene.loop.map.instrument_pose(home_pose()).R;
  PatchFit fit;
  fit.reach_m = kPatchRadius;
  fit.needed_m = scene.loop.tool.radius_m + kPatchMargin;
  std::vector<SurfaceTree::Hit> hits;
  for (const Target& target : scene.board.targets) {
    const QuerySegment axis{target.centre_T, target.centre_T - scene.loop.tool.shaft_length_m * R_TI.col(2)};
    tree.within({&axis, 1}, kPatchRadius, hits);
    fit.most = std::max(fit.most, static_cast<int>(hits.size()));
    if (hits.size() > static_cast<std::size_t>(kMaxPatchTriangles)) {
      fit.reach_m = std::min(fit.reach_m, hits[static_cast<std::size_t>(kMaxPatchTriangles) - 1].distance);
    }
  }
  const double share = fit.most > 0 ? std::min(1.0, static_cast<double>(kMaxPatchTriangles) / fit.most) : 1;
  const double organ = static_cast<double>(scene.organ_T->triangles.size());
  fit.advised = std::max(kRounding, static_cast<int>(kSafety * share * organ) / kRounding * kRounding);
  return fit;
}

}  // namespace trocar
