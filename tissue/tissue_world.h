// The world: an organ that stands still or gives way, if the exercise has one, and rigid things, if it has any.
//
// Frame T, SI units. Thread: tissue task.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "haptics/contact/instrument.h"
#include "tissue/collision/patch_extraction.h"
#include "tissue/interaction/instrument_actions.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/rigid/rigid_scene.h"
#include "tissue/rigid/rigid_world.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/world.h"

namespace trocar {

/// An organ that gives way, as it is laid out before a run.
struct SoftSetup {
  TissueSolid material;
  SoftOrganOptions options;
  Lattice lattice;  ///< over the organ as it lies in T
};

struct TissueSetup {
  const TriangleSurface* organ_T = nullptr;  ///< with the adjacent organs; must outlive the world; nullptr: none
  SurfacePtr seen_T = nullptr;               ///< what pictures show of it: the organ alone
  ContactMaterial organ;
  /// Of each triangle: 0 the organ, n the n-th of `adjacent`; empty: all the organ. Must outlive the world.
  std::span<const std::int32_t> triangle_material = {};
  std::vector<ContactMaterial> adjacent = {};  ///< at most kMaxPatchMaterials - 1, and only without rigid things
  RigidScene rigid;
  std::vector<Tool> tools = {Tool{}};  ///< by StylusState::instrument, at least one
  /// How the organ gives way; its vertices are then the first of organ_T. nullptr: it stands still.
  std::shared_ptr<const SoftSetup> soft = nullptr;
};

class TissueWorld final : public World {
 public:
  explicit TissueWorld(const TissueSetup& setup);

  void step(const HapticState& state, bool present, ContactPatch& patch) override;
  const TissueFrame& frame() const override { return frame_; }
  SurfacePtr surface() const override { return soft_ ? soft_->surface() : seen_; }
  TissueShape shape() const override;
  std::uint64_t dropped() const override { return dropped_; }

 private:
  /// Steps the organ that gives way, and tells the extraction where its surface is for the loop.
  void step_soft(const HapticState& newest, const Tool& tool, bool present);
  /// The organ has been cut: felt_ has its new triangles, the adjacent organs' behind them.
  void take_cut_surface();
  const Tool& in_hand(const StylusState& stylus) const;

  ContactMaterial organ_;
  std::vector<ContactMaterial> adjacent_;
  std::vector<Tool> tools_;
  SurfacePtr seen_;
  std::optional<PatchExtraction> extraction_;
  std::optional<RigidWorld> rigid_;
  std::optional<SoftOrgan> soft_;
  std::optional<InstrumentActions> actions_;              ///< with soft_
  std::size_t organ_vertices_ = 0, organ_triangles_ = 0;  ///< of felt_, before those of the adjacent organs
  std::vector<std::int32_t> triangle_material_;           ///< with soft_: of felt_
  TriangleSurface felt_;        ///< with soft_: what the loop is given, the adjacent organs behind the organ
  std::vector<Vec3> velocity_;  ///< with soft_: of its vertices, m/s
  TissueFrame frame_;
  std::uint64_t dropped_ = 0;
};

}  // namespace trocar
