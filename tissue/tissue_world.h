// The world: an organ that stands still or gives way, if the exercise has one, ducts and vessels on one that gives way,
// and rigid things, if it has any.
//
// Frame T, SI units. Thread: tissue task.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "haptics/contact/instrument.h"
#include "tissue/collision/patch_extraction.h"
#include "tissue/interaction/bleeder_setup.h"
#include "tissue/interaction/breathing.h"
#include "tissue/interaction/instrument_actions.h"
#include "tissue/interaction/suturing.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/rigid/rigid_scene.h"
#include "tissue/rigid/rigid_world.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/thin/duct_system.h"
#include "tissue/thin/sheet_system.h"
#include "tissue/world.h"

namespace trocar {

/// An organ that gives way, as it is laid out before a run.
struct SoftSetup {
  TissueSolid material;
  SoftOrganOptions options;
  Lattice lattice;  ///< over the organ as it lies in T, a bound neighbour beside it
  std::optional<TissueSolid> neighbour = {};
  std::optional<BedOptions> bed = {};  ///< that binds it
  Breathing breathing = {};
};

struct TissueSetup {
  /// With the adjacent organs, which stop one that gives way; must outlive the world; nullptr: none
  const TriangleSurface* organ_T = nullptr;
  SurfacePtr seen_T = nullptr;  ///< what pictures show of it: the organ alone
  ContactMaterial organ;
  /// Of each triangle: 0 the organ, n the n-th of `adjacent`; empty: all the organ. Must outlive the world.
  std::span<const std::int32_t> triangle_material = {};
  std::vector<ContactMaterial> adjacent = {};  ///< at most kMaxPatchMaterials - 1, and only without rigid things
  RigidScene rigid;
  std::vector<Tool> tools = {Tool{}};  ///< by StylusState::instrument, at least one
  /// How the organ gives way; its vertices are then the first of organ_T. nullptr: it stands still.
  std::shared_ptr<const SoftSetup> soft = nullptr;
  std::vector<DuctSetup> ducts = {};    ///< only with `soft`
  std::vector<SheetSetup> sheets = {};  ///< only with `soft`
  /// A needle that the driver brings in, its X_TN and the thread's way found then; only with `soft`. nullptr: none.
  std::shared_ptr<const SutureSetup> suture = nullptr;
  std::vector<BleederSetup> bleeders = {};  ///< at most kMaxWoundsSeen; only with `ducts`
  /// Places on the organ at rest, or on a sheet in a frame, whose way the frame tells, at most kMaxFollowedPlaces; only
  /// with `soft`.
  std::vector<SurfacePlace> followed = {};
};

class TissueWorld final : public World {
 public:
  explicit TissueWorld(const TissueSetup& setup);

  void step(const HapticState& state, bool present, ContactPatch& patch) override;
  const TissueFrame& frame() const override { return frame_; }
  SurfacePtr surface() const override { return soft_ ? soft_->surface() : seen_; }
  std::span<const SurfacePtr> thin() const override { return thin_; }
  TissueShape shape() const override;
  std::uint64_t dropped() const override { return dropped_; }

 private:
  /// Steps the organ that gives way, and tells the extraction where its surface is for the loop.
  void step_soft(const HapticState& newest, const Tool& tool, bool present);
  /// What the loop is given after a cut: the organ's vertices, those of the adjacent organs, those of the ducts.
  void gather_felt();
  /// Of the n-th of ducts, then sheets, in a patch.
  std::int32_t thin_material(std::size_t n) const;
  /// Where the triangles of sheets, then ducts, begin in the patch that the contacts are from; -1: not known.
  std::int32_t first_thin(const SolvedContacts& contacts) const;
  std::int32_t sheet_triangles() const {
    return sheets_ ? static_cast<std::int32_t>(sheets_->contact().triangles.size()) : 0;
  }
  void hang_vessels();
  /// Cuts and clips of vessels, for the blood.
  void tell_vessels();
  /// Bleeders spurt when the last duct has been divided.
  void open_bleeders();
  void tell_wounds();
  void tell_gap(const Vec3& tip_T, const Tool& tool, const ContactPatch& patch);
  /// The ducts' part in patch and frame.
  void add_ducts(ContactPatch& patch);
  void add_sheets(ContactPatch& patch);
  /// A driver that is taken in hand, or comes into the scene, has a needle in its jaws, unless the last one is in
  /// tissue.
  void bring_needle(const StylusState& stylus, const Tool& tool, bool present);
  /// The same where needles stand ready instead.
  void set_needle_up(double dt_s);
  void add_suture(ContactPatch& patch);
  void tell_needle();
  /// Whether a triangle of a patch is a contact: what the jaws hold or have been round is none.
  bool felt(std::int32_t triangle) const;
  void clear_taken(ContactPatch& patch) const;
  void keep_changes();
  void follow(std::span<const SurfacePlace> places_T);
  void tell_followed();
  void tell_touched(const SolvedContacts& contacts);
  const Tool& in_hand(const StylusState& stylus) const;

  ContactMaterial organ_;
  std::vector<ContactMaterial> adjacent_;
  std::vector<Tool> tools_;
  SurfacePtr seen_;
  Breathing breathing_;
  std::optional<PatchExtraction> extraction_;
  std::optional<RigidWorld> rigid_;
  std::optional<SoftOrgan> soft_;
  std::optional<InstrumentActions> actions_;     ///< with soft_
  std::optional<DuctSystem> ducts_;              ///< with soft_
  std::optional<SheetSystem> sheets_;            ///< with soft_
  std::shared_ptr<const SutureSetup> suture_;    ///< with soft_
  std::optional<Suturing> suturing_;             ///< with suture_, since a needle was brought in
  bool drives_ = false;                          ///< the driver is in hand, in the scene
  double laid_off_s_ = 0;                        ///< since the needle was let go
  std::size_t organ_vertices_ = 0;               ///< of felt_, before those of the adjacent organs
  std::vector<std::int32_t> triangle_material_;  ///< with soft_: of felt_
  TriangleSurface adjacent_T_;  ///< with soft_: the adjacent organs alone, their corners counted from 0
  std::vector<std::int32_t> adjacent_material_;  ///< of its triangles
  /// With soft_: what the loop is given: organ, adjacent organs, sheets, ducts.
  TriangleSurface felt_;
  std::size_t first_duct_vertex_ = 0;  ///< of felt_
  std::vector<Vec3> velocity_;         ///< with soft_: of its vertices, m/s
  /// A place by the corners of its triangle, which keep their numbers when the organ is cut.
  struct Followed {
    std::array<std::int32_t, 3> corner;
    Barycentric weight;
    SurfacePlace rest;
    std::optional<SheetPlace> on_sheet = {};  ///< in a frame, that bears it
  };
  std::vector<Followed> followed_;
  TissueFrame frame_;
  std::uint64_t dropped_ = 0;
  // With ducts_, sheets_ or suture_:
  std::vector<SurfacePtr> thin_;      ///< of the ducts, the sheets, then of needle and thread
  std::vector<NodePlace> nodes_;      ///< of the organ, then theirs
  std::vector<std::string> changes_;  ///< of organ, ducts and suture, in order
  // With ducts_:
  std::vector<BleederSetup> bleeders_;
  std::vector<WoundId> bleeds_;       ///< their wounds, since they have opened
  std::vector<std::int32_t> vessel_;  ///< of each in Bleeding's network; -1: carries no blood
  std::size_t organ_cuts_kept_ = 0;
  std::uint64_t last_topology_ = 0;  ///< of the organ before its last cut, when sheets and ducts began at
  std::int32_t first_thin_triangle_ = 0, last_first_thin_triangle_ = -1;
  std::int32_t organ_closings_ = 0, refusal_ = 0, organ_cuts_ = 0, duct_cuts_ = 0;
  bool duct_cut_last_ = false;
  double refused_s_ = 0;  ///< loop time at which a closing on a duct was refused last
};

}  // namespace trocar
