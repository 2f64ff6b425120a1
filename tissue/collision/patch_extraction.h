// Cuts the contact patch out of the surface: the triangles within kPatchRadius of the axes of shaft, jaws and held
// object, nearest first.
//
// Runs at the tissue rate. Of a surface too fine for the patch the nearest triangles are kept: `dropped` is then above
// 0 and `reach` says how near to the tool nothing is missing. Frame T. Thread: tissue task; allocates nothing once its
// buffer has grown.
#pragma once

#include <span>
#include <vector>

#include "haptics/contact/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "tissue/collision/surface_tree.h"

namespace trocar {

class PatchExtraction {
 public:
  /// @param surface in T; must outlive this object.
  /// @param material of each triangle, as an index into ContactPatch::material; empty: all 0. Must outlive this object.
  explicit PatchExtraction(const TriangleSurface& surface, std::span<const std::int32_t> material = {});

  /// The surface's vertices have moved.
  void refit() { tree_.refit(); }

  /// Fills triangles, count, dropped and reach; leaves stamp, material, grip and held object to the caller.
  /// @param patch its held object is part of the tool
  void extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch, double jaw_opening_m = 0);

 private:
  SurfaceTree tree_;
  std::span<const std::int32_t> material_;
  std::vector<SurfaceTree::Hit> hits_;
};

}  // namespace trocar
