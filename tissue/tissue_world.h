// The world behind the contact patch: an organ surface, if the exercise has one, and rigid things, if it has any.
//
// step() takes the newest haptic state at the tissue rate (100 Hz) and gives back what the loop needs until the next
// step (ContactPatch) and what everybody else may know of the world (TissueFrame). Frame T, SI units.
// Deterministic: same states in, same frames out. Thread: tissue task.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "haptics/contact/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/stylus_state.h"
#include "tissue/collision/patch_extraction.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/rigid/rigid_scene.h"
#include "tissue/rigid/rigid_world.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct TissueSetup {
  const TriangleSurface* organ_T = nullptr;  ///< with its neighbours; must outlive the world; nullptr: none
  ContactMaterial organ;
  /// Of each triangle: 0 the organ, n the n-th of `neighbours`; empty: all the organ. Must outlive the world.
  std::span<const std::int32_t> triangle_material = {};
  std::vector<ContactMaterial> neighbours = {};  ///< at most kMaxPatchMaterials - 1, and only without rigid things
  RigidScene rigid;
  ToolShape tool;
};

class TissueWorld {
 public:
  explicit TissueWorld(const TissueSetup& setup);

  /// @param present the instrument is in the scene: before that nothing is felt or moved by it. @param patch filled.
  void step(const StylusState& state, bool present, ContactPatch& patch);
  const TissueFrame& frame() const { return frame_; }
  /// Triangles in reach that did not fit into a patch, over the run.
  std::uint64_t dropped() const { return dropped_; }

 private:
  ContactMaterial organ_;
  std::vector<ContactMaterial> neighbours_;
  ToolShape tool_;
  std::optional<PatchExtraction> extraction_;
  std::optional<RigidWorld> rigid_;
  TissueFrame frame_;
  std::uint64_t dropped_ = 0;
};

}  // namespace trocar
