// The planes in which the image ends inside an organ, and the flat caps that lie in them.
//
// A plane lies half a voxel beyond the outermost voxel centres. RAS, metres. Thread: any.
#pragma once

#include <vector>

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// The organ lies where normal . x <= offset.
struct CapPlane {
  Vec3 normal;
  double offset_m;
};

/// @param mask with a margin of kSmoothingMargin
/// @param to_ras from voxels of its box to metres
std::vector<CapPlane> cap_planes(const LabelMask& mask, const Eigen::Affine3d& to_ras);

/// Keeps a surface within the image: no vertex beyond a cap, and those that lay in it at the start stay in it.
class CapKeeper {
 public:
  /// @param planes must outlive this object
  CapKeeper(const std::vector<CapPlane>& planes, const std::vector<Vec3>& vertices);
  void apply(std::vector<Vec3>& vertices) const;
  /// Where the vertex may go that would go to `place`.
  Vec3 kept(std::size_t vertex, Vec3 place) const;

 private:
  const std::vector<CapPlane>& planes_;
  std::vector<std::vector<bool>> on_plane_;
};

}  // namespace trocar
