// Which triangles can a capsule of the tool touch now? The few at hand, found again only after the tool has moved.
//
// Three stages, all conservative: a triangle that touches is never left out (tests/haptics/contact/near_pairs_test.cpp,
// against all triangles of the patch). (1) A list of the pairs that can touch while the tip travels and the axes turn
// by no more than the room that it was made with. It is made from the balls round the triangles (patch_balls.h) at once
// for the whole patch, then by a separating plane for those that are left: u from the triangle's centre c to the
// nearest point q of the axis,
//   gap >= |q - c| - max_i u . (v_i - c) - r.
// (2) Every pair keeps the way that the capsule has to go before it can touch. A point at the share s of the axis (0
// front, 1 back) has gone no further than T + F + s B: T travel of the tip, F and B ways of the ends about the tip.
// Hence a long shaft that turns does not stir up the triangles at its tip. (3) Of the list only those are offered that
// the next fraction of a millimetre may bring within the slack. Frame T, m. Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/contact/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/quantities.h"

namespace trocar {

/// Axis of a capsule relative to the tip of the instrument, T.
struct CapsuleAxis {
  Vec3 front = Vec3::Zero(), back = Vec3::Zero();
};
using CapsuleAxes = std::array<CapsuleAxis, kMaxCapsules>;

struct PlacedTool {
  const ToolCapsules& capsules;
  const CapsuleAxes& axes;
  const Vec3& tip;
};

class NearPairs {
 public:
  struct Pair {
    double due;          ///< value of the capsule's way up to which it cannot touch
    double share;        ///< of the axis, no further back can it touch
    std::int32_t index;  ///< triangle in the patch
    std::int8_t capsule;
  };

  /// What it has cost; for benchmarks and tests.
  struct Work {
    int lists = 0, listed = 0;  ///< lists made, pairs on them
    int measured = 0;
  };

  void forget() { listed_ = false; }
  /// The tip has gone on.
  void travel(double way_m);
  /// The axes have turned about the tip by this share of the way from one to the other.
  void turn(const CapsuleAxes& from, const CapsuleAxes& to, double share);
  /// Afterwards all pairs within the slack are among those offered. @return whether these are others than before
  bool keep_up(const PlacedTool& tool, const ContactPatch& patch, double slack_m);

  /// In the order of the patch, then of the capsules.
  int count() const { return chosen_count_; }
  const Pair& at(int i) const { return pair_[chosen_[i]]; }
  /// Place of the first pair behind this one in that order, which need not be listed.
  int first_after(const Pair& done) const;
  /// False: certainly further apart than the slack.
  bool due(const Pair& pair, double slack_m) const { return pair.due - way(pair) <= slack_m; }
  void measured(int i, double gap_m) {
    Pair& pair = pair_[chosen_[i]];
    pair.due = gap_m + way(pair);
    ++work.measured;
  }

  Work work;  ///< counts up; zeroed by whoever reads it

 private:
  double way(const Pair& pair) const { return front_[pair.capsule] + pair.share * back_[pair.capsule]; }
  bool serves(const ToolCapsules& capsules, std::uint64_t stamp, double wanted_m) const;
  void list(const PlacedTool& tool, const ContactPatch& patch, double wanted_m);
  /// Lists the pairs that can touch while the list serves, triangle by triangle.
  void sift(const PlacedTool& tool, const ContactPatch& patch, const PatchBalls& balls);
  struct SiftedCapsule;
  /// Fills in how far it is. @return whether it can touch
  bool bound(const PlacedTool& tool, const SiftedCapsule& sifted, const PatchBalls& balls,
             const std::array<Vec3, 3>& triangle, Pair& pair) const;
  bool choice_serves() const;
  /// Takes from the list what may come within the slack before it is asked again.
  void choose(double slack_m);

  std::array<Pair, kMaxPatchTriangles * kMaxCapsules> pair_;  ///< room for all there are
  int listed_count_ = 0;
  std::array<std::int16_t, kMaxPatchTriangles * kMaxCapsules> chosen_;  ///< places in pair_
  int chosen_count_ = 0;
  double chosen_slack_m_ = 0;
  std::array<double, kMaxCapsules> chosen_until_{}, furthest_share_{};  ///< way that the choice is good for
  bool listed_ = false;
  std::uint64_t stamp_ = 0;
  double radii_m_ = 0;                        ///< sum over the capsules
  std::array<double, kMaxCapsules> front_{};  ///< T + F since the list was made
  std::array<double, kMaxCapsules> back_{};   ///< B
  double room_m_ = 0;                         ///< T + F that the list is good for
  PatchBalls balls_;                          ///< of a patch that came without
};

}  // namespace trocar
