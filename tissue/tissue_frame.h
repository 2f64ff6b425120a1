// What the tissue task knows after a step beyond the contact patch: where the rigid objects are, what the jaws hold,
// what touches what, and what marks the tissue bears. Read by the director, the picture and the state hash.
//
// Frame T, SI units. Fixed size: copying it allocates nothing. Thread: written by the tissue task.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxObjects = 16;
inline constexpr int kMaxContactPairs = 32;
inline constexpr int kMaxTissueMarks = 32;
inline constexpr int kMaxClipsSeen = 32;
inline constexpr int kMaxDropsSeen = 64;
inline constexpr int kMaxFollowedPlaces = 32;
inline constexpr int kMaxDuctMarks = 24;
inline constexpr int kMaxBitesSeen = 4;
inline constexpr int kMaxSheetCutsSeen = 16;
inline constexpr int kMaxWoundsSeen = 16;

enum class ObjectMotion : std::uint8_t { kResting, kMoving, kHeld };

/// A box of the scene, as it is now: enough to draw it.
struct ObjectState {
  Pose X_TO;                   ///< centre, axes along the edges
  Vec3 size_m = Vec3::Zero();  ///< extents now (a crushed block is thinner)
  Vec3 velocity_T = Vec3::Zero();
  std::int32_t kind = 0, colour = 0;  ///< as in its description
  ObjectMotion motion = ObjectMotion::kResting;
  bool crushed = false;
};

/// What the jaws have: nothing; a block between open pads; a block held; one that slides through them.
enum class GripState : std::uint8_t { kEmpty, kAround, kHolding, kSlipping };

/// Parties of a contact pair that are not objects.
enum : std::int32_t { kPartyShaft = -1, kPartyJaw = -2, kPartyBoard = -3, kPartyPort = -4, kPartyHeld = -5 };

/// Two rigid things that touch. `a`, `b`: index of an object, or a party above.
struct ContactPair {
  std::int32_t a = 0, b = 0;
  Vec3 point_T = Vec3::Zero();
  Vec3 normal_T = Vec3::UnitZ();  ///< unit, from b to a
  double depth_m = 0;             ///< overlap, >= 0; two blocks touch from 0.1 mm before it on
  double force_n = 0;             ///< by the displayed stiffness; 0 between two objects
};

enum class TissueMarkKind : std::uint8_t { kBlood, kChar, kWhitening, kWet };

/// A place on the tissue that looks different from now on. It sticks to the tissue: its place is one at rest.
struct TissueMark {
  TissueMarkKind kind = TissueMarkKind::kBlood;
  Vec3 centre_T = Vec3::Zero();  ///< on the undeformed surface
  double radius_m = 0;
  double strength = 0;  ///< 0 none .. 1 full

  bool operator==(const TissueMark&) const = default;
};

/// What has been done to an organ so far, and how it stands.
struct SurgeryState {
  std::int32_t cuts = 0, tears = 0, clips = 0;
  std::int32_t refusals = 0;  ///< closings of blades or clip applier that did nothing, clips that came off a duct
  std::int32_t refusal = 0;   ///< of the last: closing_words() (thin/duct_system.h); 0: it did what it should
  std::int32_t wounds = 0;
  std::int32_t bile_leaks = 0;  ///< places from which bile comes now
  double blood_ml = 0, blood_ml_per_min = 0, sucked_ml = 0;
  double cut_m2 = 0;     ///< of all cuts and tears, one wall of each
  double cut_m = 0;      ///< length of the last
  double heat_j = 0;     ///< delivered to tissue
  double contact_c = 0;  ///< of the tissue under an energised instrument; 0: none touches
  double refused_s = 0;  ///< loop time of the last refusal
  double bile_ml = 0;    ///< that has come from leaks
  double bed_free = 0;   ///< share of the bed between two organs that is peeled off, 0 .. 1, and
  double bed_hurt = 0;   ///< mean damage of it

  bool operator==(const SurgeryState&) const = default;
};

/// What has been stitched so far, and how it stands.
struct SutureState {
  std::int32_t needles = 0;  ///< that have been brought in, each with its thread
  std::int32_t punctures = 0, stitches = 0, throws = 0;
  std::int32_t tears = 0;  ///< of needle or thread out of the tissue
  std::int32_t knot = 0;   ///< on the last stitch: KnotKind (thin/throws.h)
  bool held = false;       ///< the needle, by jaws
  double pull_n = 0;       ///< of tissue and thread on the needle that is held

  bool operator==(const SutureState&) const = default;
};

/// A way of the needle through tissue, by places of that at rest.
struct NeedleBite {
  std::int32_t number = -1;  ///< that no other has
  Vec3 entry_rest_T = Vec3::Zero(), end_rest_T = Vec3::Zero();
  Vec3 entry_along_T = Vec3::UnitZ();  ///< unit: the needle's way where it went in, as it went
  bool through = false;                ///< its point has come out at the end
  double load_n = 0;                   ///< across the needle, now
};

/// The needle as it lies, and what it is in.
struct NeedleSight {
  bool there = false;
  Pose X_TN;              ///< of thin/needle_shape.h
  double held_share = 0;  ///< of its length, from the swage, where jaws hold it
  std::int32_t bite_count = 0;
  std::array<NeedleBite, kMaxBitesSeen> bite;
};

/// One closing of blades on a sheet: their edge, by places of the sheet as it was drawn.
struct SheetCutSeen {
  std::int32_t sheet = 0;  ///< index in the scene
  Vec3 from_rest_T = Vec3::Zero(), to_rest_T = Vec3::Zero();
  bool from_rim = false, to_rim = false;  ///< the sheet itself ended there, not the blades: its edge, or an older cut
};

struct WoundSeen {
  Vec3 place_T = Vec3::Zero();
  double rate_ml_per_min = 0, lost_ml = 0;
  std::int32_t open_vessels = 0;
};

/// A place on the organ, such as the middle of a disc.
struct SurfacePlace {
  Vec3 point_T = Vec3::Zero(), normal_T = Vec3::UnitZ();
};

/// A clip that is on a duct or vessel, or a place where that is cut or torn through, or nicked.
struct DuctMark {
  enum class Kind : std::uint8_t { kClip, kCut, kTorn, kNick } kind = Kind::kClip;
  std::int32_t duct = 0;    ///< index in the scene
  double arc_m = 0;         ///< along it, from where its content comes; stays the same however it lies
  double share = 1;         ///< of its width that is shut or open
  double angle_rad = 0;     ///< clip: from straight across
  double tip_beyond_m = 0;  ///< clip: of its tips beyond the far wall, squeezed flat

  bool operator==(const DuctMark&) const = default;
};

/// Blood in the air.
struct DropState {
  Vec3 place_T = Vec3::Zero();
  double radius_m = 0;
};

struct TissueFrame {
  std::uint64_t stamp = 0;  ///< frame number, from 1
  double t_s = 0;           ///< loop time of the state that it was made from
  std::int32_t object_count = 0;
  std::array<ObjectState, kMaxObjects> object;
  GripState grip = GripState::kEmpty;
  std::int32_t grip_object = -1;  ///< the block that `grip` speaks of
  double slipped_m = 0;           ///< how far it has slid through the jaws since it was grasped
  std::int32_t pair_count = 0;
  std::array<ContactPair, kMaxContactPairs> pair;
  std::int32_t mark_count = 0;
  std::array<TissueMark, kMaxTissueMarks> mark;
  double smoke_per_m = 0;               ///< extinction of the smoke in the cavity, 1/m: sight falls as exp(-k d)
  double lens_fog = 0, lens_blood = 0;  ///< on the scope's lens, 0 clean .. 1 blind
  SurgeryState surgery;
  SutureState suture;
  std::int32_t clip_count = 0, drop_count = 0;
  std::array<Pose, kMaxClipsSeen> clip;  ///< X_TC of clips on wounds, as they were set; C: thin/clip.h
  std::array<DropState, kMaxDropsSeen> drop;
  std::int32_t place_count = 0;                        ///< 0 where the organ stands still
  std::array<SurfacePlace, kMaxFollowedPlaces> place;  ///< TissueSetup::followed, where they are now
  std::int32_t duct_mark_count = 0;                    ///< those beyond kMaxDuctMarks are not told
  std::array<DuctMark, kMaxDuctMarks> duct_mark;
  /// On which of the ducts the contact that bears most on one lies, else which alone lies between the jaws; -1: none.
  std::int32_t touched_duct = -1;
  /// Where the contact that bears most lies on an organ that gives way, at rest; nothing: none does there.
  std::optional<Vec3> touched_rest_T;

  NeedleSight needle;
  std::int32_t sheet_cut_count = 0;                       ///< so far, of which the newest are told:
  std::array<SheetCutSeen, kMaxSheetCutsSeen> sheet_cut;  ///< the n-th lies at n modulo kMaxSheetCutsSeen
  double sheet_pull_n = 0;                                ///< of jaws or blades on a sheet
  std::int32_t wound_count = 0;
  std::array<WoundSeen, kMaxWoundsSeen> wound;
  double tip_gap_m = INFINITY;  ///< from the instrument's tip to the organ's surface; where none gives way, infinite

  bool held() const { return grip == GripState::kHolding || grip == GripState::kSlipping; }
};

}  // namespace trocar
