// All sheets of a scene: hung on the organ along an edge, lying on it, touched, held, lifted, cut, torn.
//
// One step, before the organ's own: jaws (grip, scissors) and hook, anchors where the organ is and is going, contacts
// of the loop and of the organ, sheet.step; then the springs of hinge and contacts for the organ's step. A sheet is
// touched on its middle surface from either side: the proxy remembers on which (contact_renderer.h). What lies between
// the jaws is no contact. Contacts of the loop push the sheet by the stiffness of its material in the patch: at the
// place of the solve the loop's force is the solved one. Triangles keep their numbers through cuts, sheets stand one
// behind the other. T, SI. Thread: tissue task. Same input, same bytes.
//
// A sheet in a frame is stretched by clips along its rim and has no organ beneath. Blades cut it with their tips alone:
// where they press on it and close, along the plane in which they move, as far as they stood open and no further than a
// snip. What was cut is told to the place (seen_cuts()); the mesh comes apart along the edges that are nearest,
// which may lie an edge beside the cut.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/exchange/solved_contacts.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/thin/rod_scissors.h"
#include "tissue/thin/sheet_body.h"
#include "tissue/thin/sheet_grip.h"

namespace trocar {

struct SheetSystemOptions {
  double touch_n_per_m = 150;  ///< of a tool on a sheet (a choice)
  double damping_s_per_m = 0.5;
  double drag_share = 0.8;       ///< of friction's spring over that of the touch (tissue.md 1.4)
  double hinge_n_per_m = 500;    ///< of each node that hangs on the organ (a choice)
  double lying_n_per_m = 40;     ///< of each node on the organ beneath (a choice)
  double lying_reach_m = 0.006;  ///< so deep in the organ it is still brought out
  double least_force_n = 1e-3;   ///< of a contact that passes current
  double near_jaws_m = 0.005;    ///< of what is held, that is no contact
  double clip_n_per_m = 3000;    ///< of each node that hangs in a frame (a choice)
  double frame_strain = 0.015;   ///< of a sheet as it is spread there (a choice)
  double snip_m = 0.005;         ///< that a closing cuts at most there (training.md 5.2, E07)
  double bite_n = 0.1;           ///< with which tips must press there, or it slips off them (a choice)
  SheetGripOptions grip = {};
  ScissorsOptions scissors = {};
};

/// Of contacts: where the triangles of the sheets begin in the patch that they are from.
struct SheetContacts {
  const SolvedContacts& contacts;
  std::int32_t first_triangle = -1;  ///< -1: not known, none is a sheet's
};

/// A place that goes along with a sheet.
struct SheetPlace {
  std::size_t sheet = 0;
  MaterialPoint on;
};

class SheetSystem {
 public:
  /// @throws InputError naming the sheet: none, or a hinge that is not on it
  SheetSystem(std::span<const SheetSetup> sheets, const SoftOrgan& organ, const SheetSystemOptions& options = {});

  /// Whether a sheet lies between the jaws as things are now: what they do is done to it and not to the organ.
  bool jaws_taken(const StylusState& stylus, const Tool& tool, bool present) const;
  /// @param springs of the organ's next step, to which those of hinges and contacts are added
  void step(const HapticState& newest, const SheetContacts& contacts, const Tool& tool, bool present,
            const SoftOrgan& organ, std::vector<SoftSpring>& springs);

  std::size_t size() const { return sheets_.size(); }

  /// What the loop touches, with the sheet of each triangle.
  const TriangleSurface& contact() const { return contact_; }
  std::span<const Vec3> before() const { return before_; }  ///< of its vertices: before the last step
  std::span<const std::int32_t> sheet_of_triangle() const { return sheet_of_triangle_; }
  bool grown() const { return grown_; }  ///< in the last step: contact() has more vertices, which are others
  ContactMaterial material(std::size_t sheet) const;
  /// What lies between the jaws is no contact. @param triangle of contact()
  bool felt(std::int32_t triangle) const { return !between_[static_cast<std::size_t>(triangle)]; }

  GripState grip() const;
  double slipped_m() const;
  GripBlock block() const { return block_; }
  GripHold hold() const { return hold_; }

  std::span<const SurfacePtr> seen() const { return seen_; }              ///< for pictures, one a sheet
  void add_nodes(std::vector<NodePlace>& nodes_T) const;                  ///< of all, for TissueShape
  std::span<const SheetChange> changed() const { return changed_; }       ///< in the last step
  std::span<const SheetCutSeen> seen_cuts() const { return seen_cuts_; }  ///< of sheets in frames, all so far
  /// Of the instrument's contacts on sheets, now, N.
  double pull_n() const { return pull_n_; }
  /// A place of a sheet in a frame, as it was drawn, by its triangle; nothing: none lies there.
  std::optional<SheetPlace> place_on(const Vec3& drawn_T) const;
  SurfacePlace now(const SheetPlace& place) const;
  std::int32_t cuts() const { return cuts_; }
  std::int32_t tears() const { return tears_; }

 private:
  struct Hinge {
    std::int32_t node = 0, vertex = 0;  ///< of the sheet, of the organ
    Vec3 offset_T = Vec3::Zero();       ///< from that vertex
  };
  struct Sheet {
    struct Closing {                            ///< of blades on it, from where they last opened or stood
      double from_m = 0, narrowest_m = 0;       ///< openings
      int stood_steps = 0;                      ///< since they were narrowed
      std::optional<SheetCutSeen> caught = {};  ///< what lay between them as they began to close
    };
    SheetSetup setup;
    ElasticSheet sheet;
    SheetSurface seen;
    SheetGrip grip;
    double edge_m = 0;  ///< mean, at rest
    std::vector<Hinge> hinge = {};
    std::vector<std::int32_t> beneath = {};   ///< of each node: the organ's vertex that is nearest
    std::size_t lying = 0;                    ///< first spring of the last step that is of the organ beneath
    std::vector<std::int32_t> on_organ = {};  ///< nodes of the springs from there on
    // In a frame:
    std::vector<Vec3> drawn_T = {};         ///< of each node, where it was as the sheet was spread
    std::vector<SheetEdge> cut_edges = {};  ///< so far: one alone parts nothing until the next one meets it
    double pressed_n = 0;                   ///< of the tips, now
    Vec3 sunk_T = Vec3::Zero();             ///< from the tips, that a contact lets sink in, up to what they press on
    int bite_steps = 1000;                  ///< since they pressed enough
    Closing closing = {};
    bool snipped = false;  ///< blades have pressed on it and not been opened since
    bool still = false;    ///< nothing moves it: no step is made
  };
  void know(const SoftOrgan& organ);
  NodeShares shares_at(const SoftOrgan& organ, std::int32_t vertex) const;
  Vec3 normal_at(const SoftOrgan& organ, std::int32_t vertex) const;
  void touch(std::size_t sheet, const SheetContacts& contacts, std::vector<SheetSpring>& springs);
  void lie(Sheet& of, const SoftOrgan& organ, std::vector<SheetSpring>& springs);
  void use_scissors(const StylusState& stylus);
  void spread(Sheet& of) const;
  void feel_tips(std::size_t sheet, const SheetContacts& contacts);
  void use_tips(std::size_t sheet, const StylusState& stylus, bool scissors);
  std::optional<SheetCutSeen> cut_between(std::size_t sheet, const Pose& X_TI, double half_m) const;
  static bool leaves_crumb(const Sheet& of);
  Vec3 through_rim(const Vec3& drawn_T, const Vec3& way) const;
  void part_along(std::size_t sheet, const SheetCutSeen& cut);
  void burn(const StylusState& stylus, const SheetContacts& contacts);
  void part(std::size_t sheet, std::vector<SheetEdge> edges);
  void follow();

  SheetSystemOptions options_;
  std::vector<Sheet> sheets_;
  std::uint64_t organ_topology_ = 0;
  std::vector<std::vector<std::int32_t>> fan_;  ///< triangles of the organ round each of its vertices
  TriangleSurface contact_;
  std::vector<Vec3> before_;
  std::vector<std::int32_t> sheet_of_triangle_;
  std::vector<bool> between_;
  bool grown_ = false, open_ = false, burns_ = false;
  Vec3 burnt_T_ = Vec3::Zero();  ///< how far the hook has cut
  GripBlock block_;
  GripHold hold_;
  std::vector<SurfacePtr> seen_;
  std::vector<SheetChange> changed_;
  std::vector<SheetCutSeen> seen_cuts_;
  double pull_n_ = 0;
  std::int32_t cuts_ = 0, tears_ = 0;
};

}  // namespace trocar
