// What the instrument in hand does to an organ beyond touching it, and what comes of it: cuts and tears, heat, blood.
//
//   grasper   holds the fold between its pads; pulled beyond what the capsule bears, the fold tears out. Pedal: soft
//             coagulation between the pads
//   scissors  closing cuts what lies between the blades; the fingers feel the energy that the cut takes. Pedal: the
//             blades coagulate what they touch
//   hook      pedal: vaporises what it touches; drawn along, it cuts
//   clip applier  closing sets a clip on the wound between its jaws, which stays and moves with the tissue
//   suction   pedal: takes blood and water away; fingers closed, that have been open since it is in hand: rinses
// A bed between two organs (solid/organ_bed.h) is weakened by heat, goes where a live hook reaches its fibres, and
// oozes where it has been peeled. Every instrument presses on wounds that it stands on. A closing that does nothing
// tells why (CutRefusal). Order of a step: before() what acts on the organ as it lies, then the organ's own step, then
// after(). Frame T, SI. Thread: tissue task. Same input, same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/exchange/solved_contacts.h"
#include "tissue/interaction/bleeding.h"
#include "tissue/interaction/soft_grip.h"
#include "tissue/interaction/tissue_heat.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct InstrumentActionsOptions {
  double blades_m = 0.016, applier_m = 0.010;         ///< from the hinge
  double opened_m = 0.003, closed_m = 0.0015;         ///< openings from which and to which jaws count as closing
  double track_m = 0.003, track_depth_m = 0.0025;     ///< of a hook's edge, per cut; its depth
  double cut_w = 40, forced_w = 25, soft_w = 20;      ///< delivered powers; unchecked
  double hook_edge_m = 0.001, pad_contact_m = 0.003;  ///< radii of contacts of current
  double hook_bed_m = 0.002;                          ///< from the hook's tip to fibres of a bed that it vaporises
  double bed_oozes = 0.02;                            ///< share of the peeled bed that is a wound; unchecked
  double hook_waits_s = 0.3;                          ///< without boiling, after which a track is over
  double coagulates_m = 0.004;                        ///< of wounds round the contact
  double coagulates_c = 65;                           ///< under which heat closes no vessel
  double coagulates_per_s = 2;                        ///< share of what still bleeds there
  double tear_width_m = 0.010;  ///< of the capsule that bears the pull: both faces of a fold as wide as the pads
  double tear_after_s = 0.02;   ///< above its limit
  double tear_length_m = 0.012, tear_depth_m = 0.004;
  double clip_reach_m = 0.006;    ///< from the jaws to the wound
  double press_radius_m = 0.004;  ///< of a tool on a wound
  double smoke_per_j = 0.002;     ///< extinction of the smoke, 1/m a joule of steam; unchecked
  double smoke_s = 12;            ///< in which it clears, and
  double smoke_sucked_s = 2;      ///< under suction
};

class InstrumentActions {
 public:
  explicit InstrumentActions(const SoftOrgan& organ, const InstrumentActionsOptions& options = {});

  /// @param springs of the organ's next step, to which a grip adds its own. @return whether the organ has been cut
  bool before(const HapticState& newest, const Tool& tool, bool present, SoftOrgan& organ,
              std::vector<SoftSpring>& springs);
  void after(const HapticState& newest, const Tool& tool, bool present, std::span<const SoftSpring> springs,
             SoftOrgan& organ);

  /// Before the next step: the tissue between two places of it at rest, that a thread or needle has torn out of, is
  /// open.
  void tear_open(const Vec3& from_rest_T, const Vec3& to_rest_T) { torn_.push_back({from_rest_T, to_rest_T}); }

  const SoftGrip& grip() const { return grip_; }
  GripBlock block() const { return blades_.stiffness_n_per_m > 0 ? blades_ : grip_.block(); }
  const Bleeding& bleeding() const { return bleeding_; }
  Bleeding& bleeding() { return bleeding_; }  ///< for what bleeds beside the organ
  const TissueHeat& heat() const { return heat_; }
  const SurgeryState& state() const { return state_; }
  double smoke_per_m() const { return smoke_per_m_; }
  /// Counts, smoke, clips and drops as they are now.
  void tell(const SoftOrgan& organ, TissueFrame& frame) const;

 private:
  /// Of jaws: how far open since they last closed. @return whether they close in this step
  bool closes(double opening_m);
  void cut_between_blades(const StylusState& stylus, SoftOrgan& organ);
  void feel_blades(const StylusState& stylus, const SoftOrgan& organ);
  void set_clip(const StylusState& stylus, const SoftOrgan& organ);
  void tear(SoftOrgan& organ, const StylusState& stylus);
  void tear_at(const Vec3& from_T, const Vec3& to_T, const Vec3& into_T, SoftOrgan& organ);
  void open_torn(SoftOrgan& organ);
  void draw_hook(const HapticState& newest, SoftOrgan& organ);
  /// @return the wound; -1 where nothing was cut
  WoundId cut(const Blade& blade, SoftOrgan& organ);
  void refuse(CutRefusal why);
  void energise(const HapticState& newest, const Tool& tool, const SoftOrgan& organ);
  void work_bed(const StylusState& stylus, bool hook_live, SoftOrgan& organ);
  void press_wounds(const HapticState& newest, const SoftOrgan& organ);
  void clear_smoke(bool sucked);
  void dress(SoftOrgan& organ) const;

  /// A clip goes with the triangle of the surface that it was set beside, by vertices: a cut may divide the triangle.
  struct SetClip {
    std::array<std::int32_t, 3> vertices{};
    Pose X_VC;  ///< in the frame of these vertices
  };

  InstrumentActionsOptions options_;
  SoftGrip grip_;
  Bleeding bleeding_;
  TissueHeat heat_;
  SurgeryState state_;
  GripBlock blades_;
  double widest_m_ = 0;
  bool may_rinse_ = false;   ///< the fingers have been open since the suction is in hand
  double now_s_ = 0;         ///< of the loop
  double overloaded_s_ = 0;  ///< of a held fold
  bool cut_now_ = false;     ///< in this step
  double cold_s_ = 1;        ///< since the hook last boiled anything
  bool hook_draws_ = false;
  Vec3 hook_from_T_ = Vec3::Zero();
  std::vector<SetClip> clips_;
  std::vector<std::pair<Vec3, Vec3>> torn_;  ///< by thread or needle, since the last step
  double smoke_per_m_ = 0, steam_seen_j_ = 0;
};

}  // namespace trocar
