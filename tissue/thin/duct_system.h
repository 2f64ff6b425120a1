// All ducts and vessels of a scene: held by the organ and by fixed places, touched, held, clipped, cut.
//
// One step, before the organ's own: lumen.begin, jaws (grip, clip applier, scissors), heat, anchors where the organ is
// and is going, rod.step, what pulls on clips, clips.step, surfaces; then springs of the ends for the organ's step
// (rod_on_solid.h). An end on the organ hangs on the vertex nearest to it. An organ lies as it is drawn under the
// tension of its ducts: what it feels of them is what their pull has changed, all of it once a duct is cut. A rod that
// lies between the jaws is taken by them and is then no contact until the tool is clear of it; the organ is not
// (jaws_taken). Contact surface: a coarse tube a duct, one behind the other; numbers stay through cuts, whose new ones
// follow behind all. Contacts of the loop push the rod by dent_stiffness(), which is the stiffness of its material in
// the patch: at the place of the solve the loop's force is the solved one.
//
// What bleeds is told by changed(): the caller knows the circulation. T, SI. Thread: tissue task. Same input, same
// bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/exchange/solved_contacts.h"
#include "tissue/mesh/surface/cut_tracing.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/thin/clip_applier.h"
#include "tissue/thin/duct_tube.h"
#include "tissue/thin/rod_grip.h"
#include "tissue/thin/rod_hook.h"
#include "tissue/thin/rod_scissors.h"
#include "tissue/tissue_frame.h"

namespace trocar {

/// In SurgeryState::refusal the refusals of clips on ducts follow those of cuts with a distance.
inline constexpr std::int32_t kFirstClipRefusal = 32;
constexpr std::int32_t refusal_code(ClipRefusal refusal) {
  return refusal == ClipRefusal::kNone ? 0 : kFirstClipRefusal + static_cast<std::int32_t>(refusal);
}
/// There it also says that a clip came off a duct.
inline constexpr std::int32_t kClipCameOff = kFirstClipRefusal + 17;
/// What SurgeryState::refusal says, in words; empty for 0 and for a number that is none.
std::string_view closing_words(std::int32_t refusal);

struct DuctSystemOptions {
  int contact_sides = 6;
  double damping_s_per_m = 0.5;
  double weld_s = 2;             ///< of a live instrument on a rod, until it is sealed (a choice)
  double hook_seals_s = 0.6;     ///< of a live hook that has a rod in its crook, until it is sealed, and
  double hook_parts_s = 1.0;     ///< until it is parted there: thin and taut, it goes sooner (choices)
  double bile_ml_per_min = 0.6;  ///< that a liver makes: 0.35 to 0.7 (unchecked)
  double least_force_n = 1e-3;   ///< of a contact that passes current
  RodGripOptions grip = {};
  RodHookOptions hook = {};
  ClipApplierOptions applier = {};
  ScissorsOptions scissors = {};
};

/// Of contacts: where the triangles of the ducts begin in the patch that they are from.
struct DuctContacts {
  const SolvedContacts& contacts;
  std::int32_t first_triangle = -1;  ///< -1: not known, none is a duct's
};

class DuctSystem {
 public:
  /// @throws InputError naming the duct: no rod, or an end that finds no place on the organ
  DuctSystem(std::span<const DuctSetup> ducts, const SoftOrgan& organ, double tool_radius_m,
             const DuctSystemOptions& options = {});

  /// Whether a rod lies between the jaws as things are now: what they do is done to it and not to the organ.
  bool jaws_taken(const StylusState& stylus, const Tool& tool, bool present) const;
  /// @param springs of the organ's next step, to which those of the ends are added
  void step(const HapticState& newest, const DuctContacts& contacts, const Tool& tool, bool present,
            const SoftOrgan& organ, std::vector<SoftSpring>& springs);

  std::size_t size() const { return ducts_.size(); }
  const DuctSetup& setup(std::size_t duct) const { return ducts_[duct].setup; }
  const DuctTube& tube(std::size_t duct) const { return ducts_[duct].tube; }

  /// What the loop touches, with the duct of each triangle. Grown in the last step: there are more of both.
  const TriangleSurface& contact() const { return contact_; }
  std::span<const std::int32_t> duct_of_triangle() const { return duct_of_triangle_; }
  bool grown() const { return grown_; }
  ContactMaterial material(std::size_t duct) const;
  /// Those between the jaws or in the crook and stumps of slack ones are no contact. @param triangle of contact()
  bool felt(std::int32_t triangle) const;

  GripState grip() const;
  double slipped_m() const;
  GripBlock block() const { return block_; }
  GripHold hold() const { return hold_; }

  std::span<const SurfacePtr> seen() const { return seen_; }  ///< for pictures, one a duct
  void add_nodes(std::vector<NodePlace>& nodes_T) const;      ///< of all, for TissueShape
  /// Clips that are on, then cuts, tears and nicks, duct by duct.
  std::vector<DuctMark> marks() const;
  /// Which duct lay in the crook of a hook, else the strongest contact of the last step bore on, else which alone lay
  /// between the jaws; -1: none.
  std::int32_t touched() const { return touched_; }
  std::vector<Pose> clip_poses() const;  ///< of all clips that are on, frame of clip_model()
  /// Share of a duct's lumen that the jaws press shut, and where. nullopt: they do not.
  std::optional<std::pair<double, double>> pressed(std::size_t duct) const;
  std::span<const DuctChange> changed() const { return changed_; }  ///< in the last step
  /// What the closing of jaws in the last step came to: 0, or why nothing came of it (refusal_code); kClipCameOff.
  std::optional<std::int32_t> closing() const { return closing_; }
  /// Is one that carries nothing not yet divided?
  bool any_strand_whole() const;
  std::int32_t cuts() const { return cuts_; }  ///< with partial ones
  std::int32_t tears() const { return tears_; }
  std::int32_t clips() const { return clips_; }
  std::int32_t refusals() const { return refusals_; }  ///< with clips that came off
  std::int32_t bile_leaks() const;                     ///< open ends and nicks from which bile comes now
  double bile_ml() const { return bile_ml_; }

 private:
  struct Duct {
    DuctSetup setup;
    DuctTube tube;
    RodSurface touched;
    RodGrip grip, clasp;                         ///< of a grasper, of a clip applier
    std::array<std::int32_t, 2> vertex{-1, -1};  ///< of the organ, for each end; -1: fixed
    std::array<NodeShares, 2> place{};
    std::array<Vec3, 2> rest_load{Vec3::Zero(), Vec3::Zero()};  ///< on what the ends hang on, before a run
    RodHook hook = RodHook();
    double hot_s = 0;
    bool seared = false;                  ///< sealed by the hook, in this go of it
    std::vector<DuctMark> openings = {};  ///< cuts, tears and nicks
  };
  /// A run of vertices and triangles of one duct's tube in contact_.
  struct Piece {
    std::size_t duct = 0;
    std::int32_t vertex = 0, vertices = 0, triangle = 0, triangles = 0;  ///< in the tube
    std::int32_t first_vertex = 0, first_triangle = 0;                   ///< in contact_
  };
  void find_places(const SoftOrgan& organ);
  void anchor(const SoftOrgan& organ);
  void add_loads(const Duct& duct, std::vector<SoftSpring>& springs) const;
  std::vector<ClipSurroundings::Rod> rods(std::vector<std::vector<double>>& arcs) const;
  std::int32_t surrounded(const StylusState& stylus, const Tool& tool) const;
  void use_jaws(const StylusState& stylus, const Tool& tool, const SoftOrgan& organ);
  void use_applier(const StylusState& stylus, std::span<const ClipSurroundings::Rod> rods, const SoftOrgan& organ);
  void use_scissors(const StylusState& stylus, std::span<const ClipSurroundings::Rod> rods);
  /// @return the duct that is in the crook of a hook; -1: none
  std::int32_t hooked() const;
  void burn_through(bool live, std::size_t duct);
  void weld(const StylusState& stylus, const Tool& tool, std::span<const SolvedContacts> touches);
  void change(const DuctChange& change);
  SolvedContacts contacts_of(std::size_t duct, const DuctContacts& contacts) const;
  void take_events();
  void lose_clips(std::size_t duct);
  void follow();
  std::int32_t contact_vertex(std::size_t duct, std::int32_t vertex) const;
  static bool whole(const Duct& duct);
  bool tight(const Duct& duct, const LumenEnd& end) const;

  DuctSystemOptions options_;
  double tool_radius_m_;
  std::vector<Duct> ducts_;
  std::uint64_t organ_topology_ = 0;
  ClipApplier applier_;
  RodScissors scissors_;
  TriangleSurface contact_;
  std::vector<std::int32_t> duct_of_triangle_;
  std::vector<Piece> pieces_;
  std::vector<bool> between_;  ///< the jaws, in the crook, or a stump of what was slack: of each duct
  std::vector<bool> passed_;   ///< was that, and the tool reaches into it still: no contact until it is clear
  bool grown_ = false;
  std::int32_t touched_ = -1;
  GripBlock block_;
  GripHold hold_;
  std::vector<SurfacePtr> seen_;
  std::vector<DuctChange> changed_;
  std::optional<std::int32_t> closing_;
  std::int32_t cuts_ = 0, tears_ = 0, clips_ = 0, refusals_ = 0;
  double bile_ml_ = 0;
};

}  // namespace trocar
