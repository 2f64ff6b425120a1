// The jaws on a duct or a thread: it is squeezed flat, held, slips along and through, and is let go.
//
//   squeeze   first the ring gives (a thin ring pressed along two lines), then both walls between the pads
//   hold      from 0.1 N on until below 0.05 N at up to four places of the axis, springs of the rod's own step
//   slip      no more than 2 mu N; beyond it the places slide in the jaws and keep that force; a place that has slid
//             off the pads is followed by the piece of rod that is between them now, else it is lost
//   clip      one that came between them while they were open enough keeps them apart: what they squeeze and hold is
//             it and not the rod beside it, so that their whole pull is on it (ClipSet::pull_held)
// The same shape as SoftGrip (tissue/interaction/soft_grip.h); frames T and I (x hinge axis, z to the tip, pads meet in
// y = 0). SI. Thread: tissue task. Let go, nothing is left.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/thin/elastic_rod.h"
#include "tissue/thin/lumen.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct RodGripOptions {
  double pad_length_m = 0.020, pad_width_m = 0.005;  ///< as SoftGripOptions
  double friction = 0.6;                             ///< pads on wet tissue, 0.11 smooth to 0.83 profiled [M]
  double hold_n_per_m = 600;                         ///< of all springs together
  double most_loop_n_per_m = 250;                    ///< of the hold in the loop, as SoftOrganOptions
  double most_stiffness_n_per_m = 2000;              ///< of the squeezed walls (a choice: fingers feel them hard)
  double clip_legs_m = 0;  ///< of a clip's two legs between the pads; 0: they lie in grooves of the jaws
};

class RodGrip {
 public:
  explicit RodGrip(const RodGripOptions& options = {}) : options_(options) {}

  /// Before the step: what the jaws have now, and the springs by which they hold on. @param clips arcs of those on it
  void reach(const Pose& X_TI, double opening_m, const ElasticRod& rod, std::vector<RodSpring>& springs,
             std::span<const double> clips = {});
  /// What the pads do to the lumen, after reach() and Lumen::begin().
  void press(Lumen& lumen) const;
  /// Of the middle of what is between the pads; nullopt: nothing.
  std::optional<double> pressed_arc_m() const {
    if (state_ == GripState::kEmpty || between_.empty()) return std::nullopt;
    return (between_.front() + between_.back()) / 2;
  }
  /// After the step. @param springs those that reach() added, their forces filled in
  void feel(const Pose& X_TI, std::span<const RodSpring> springs, const ElasticRod& rod);
  void let_go();

  GripState state() const { return state_; }
  double slipped_m() const { return slipped_m_; }
  double squeeze_n() const { return squeeze_n_; }
  Vec3 pull_T() const { return pull_T_; }  ///< of the rod on the jaws, N
  GripBlock block() const { return block_; }
  GripHold hold() const { return hold_; }
  std::vector<double> arcs() const;  ///< where it holds
  /// Arcs of the clips between the pads: they take all of its pull.
  std::span<const double> clips() const { return clips_; }

 private:
  struct Place {
    double arc_m = 0;
    Vec3 point_I = Vec3::Zero();
  };
  void squeeze(double opening_m, const ElasticRod& rod, double length_m);
  void meet_clips(const Pose& X_TI, double opening_m, const ElasticRod& rod, std::span<const double> clips);
  void take(const Pose& X_TI, const ElasticRod& rod);
  bool on_pads(const Vec3& point_I) const;
  void follow_through(const Pose& X_TI, const ElasticRod& rod);

  RodGripOptions options_;
  GripState state_ = GripState::kEmpty;
  std::vector<Place> places_;
  std::vector<double> between_, clips_;  ///< arcs between the pads now, of the rod and of clips
  GripBlock block_;
  GripHold hold_;
  Vec3 pull_T_ = Vec3::Zero();
  double squeeze_n_ = 0, slipped_m_ = 0, flatness_ = 0, angle_ = 0;
};

}  // namespace trocar
