// Cuts the contact patch out of the surface: the triangles within kPatchRadius of the axes of shaft, jaws and held
// object, nearest first.
//
// Runs at the tissue rate. What does not fit into the patch is the furthest and is counted in `dropped`.
// Frame T. Thread: tissue task; allocates nothing once its buffer has grown.
#pragma once

#include <vector>

#include "haptics/control/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "tissue/collision/surface_tree.h"

namespace trocar {

class PatchExtraction {
 public:
  /// @param surface in T; must outlive this object.
  explicit PatchExtraction(const TriangleSurface& surface);

  /// Fills triangles, count, dropped and reach; leaves stamp, material, grip and held object to the caller.
  /// @param patch its held object is part of the tool
  void extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch, double jaw_opening_m = 0);

 private:
  SurfaceTree tree_;
  std::vector<Vec3> normals_;  ///< unit, per triangle
  std::vector<SurfaceTree::Hit> hits_;
};

}  // namespace trocar
