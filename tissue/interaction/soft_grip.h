// The jaws on tissue that gives way: a fold between the pads is squeezed, held, slips and is let go.
//
//   squeeze   N = k (t - o), t the fold's thickness, o the pads' opening (rendered at 1 kHz by the pinch channel)
//   hold      from 0.1 N on until below 0.05 N the pads hold on to up to 12 places of the surface between them, each by
//             a spring to its point of the jaws: springs of the solid's own step, so pulling is felt as it is solved
//   slip      no more than 2 mu N (two pads); beyond it the points slide along and keep that force; what has slid
//             off the pads is lost
// The loop gets the sum as one spring at their middle (ContactPatch::hold) whose force is the solved one where the
// jaws were, as stiff as springs and clamped neighbourhood are within a step. While it is held, and until the jaws are
// clear of it afterwards, the tissue round the fold is no contact. Frames T and I (x hinge axis, z to the tip, pads
// meet in y = 0). SI. Thread: tissue task. After the end of a hold nothing of it is left.
#pragma once

#include <cstdint>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct SoftGripOptions {
  double pad_length_m = 0.020, pad_width_m = 0.005;  ///< fenestrated grasper of 5 mm
  double fold_m = 0.008;                             ///< thickness at which a fold fills the pads
  double fold_stiffening = 4;                        ///< of a fold squeezed between hard pads, over E* A / t
  double friction = 0.6;                             ///< pads on wet tissue, 0.11 smooth to 0.83 profiled [M]
  double hold_n_per_m = 600;                         ///< of all springs together
};

class SoftGrip {
 public:
  explicit SoftGrip(const SoftGripOptions& options = {}) : options_(options) {}

  /// Before the step: what the jaws have now, and the springs by which they hold on.
  void reach(const Pose& X_TI, double opening_m, const SoftOrgan& organ, std::vector<SoftSpring>& springs);
  /// After it. @param springs those that reach() added, their forces filled in
  void feel(const Pose& X_TI, std::span<const SoftSpring> springs, const SoftOrgan& organ);
  void let_go();
  /// The organ has been cut: what is held is held by the pieces there are now.
  void follow_cut(const SoftOrgan& organ);

  GripState state() const { return state_; }
  double slipped_m() const { return slipped_m_; }
  /// Middle of what is held, in T; where nothing is, the origin.
  Vec3 middle_T(const SoftOrgan& organ) const;
  /// The same at rest; it may lie just inside the organ.
  Vec3 middle_rest_T(const SoftOrgan& organ) const;
  bool holds() const { return !places_.empty(); }
  /// Of the part that is held, tension per width; of nothing, infinity.
  double rupture_n_per_m(const SoftOrgan& organ) const;
  double squeeze_n() const { return squeeze_n_; }  ///< of the pads on the fold
  Vec3 pull_T() const { return pull_T_; }          ///< of the tissue on the jaws, N
  GripBlock block() const { return block_; }
  GripHold hold() const { return hold_; }
  /// Whether a triangle of the organ is a contact.
  bool felt(std::int32_t triangle) const {
    return no_contact_.empty() || !no_contact_[static_cast<std::size_t>(triangle)];
  }

 private:
  struct Place {
    std::int32_t triangle = 0;
    NodeShares shares;
    Vec3 point_I = Vec3::Zero();
  };
  /// Triangles whose middle lies between the pads.
  std::vector<std::int32_t> between(const Pose& X_TI, double opening_m, const SoftOrgan& organ) const;
  Vec3 middle_of_places(const TriangleSurface& surface) const;
  void take(const Pose& X_TI, const std::vector<std::int32_t>& triangles, const SoftOrgan& organ);
  bool jaws_clear(const Pose& X_TI, const SoftOrgan& organ) const;

  SoftGripOptions options_;
  GripState state_ = GripState::kEmpty;
  std::vector<Place> places_;
  std::vector<bool> no_contact_;  ///< of the organ's triangles; empty: all are felt
  GripBlock block_;
  GripHold hold_;
  Vec3 pull_T_ = Vec3::Zero();
  double squeeze_n_ = 0, slipped_m_ = 0;
};

}  // namespace trocar
