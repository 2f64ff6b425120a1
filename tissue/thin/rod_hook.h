// The crook of a hook under a strand: what has come between foot and shaft from the side is lifted, slides along the
// foot, and comes off its end.
//
// The foot lies in frame I of the instrument (z along the shaft to the tip) across the shaft, towards -y. A rod is in
// the crook once it passes over the foot, on the side of the shaft; one that the foot has come through from above is
// not, until the foot has left it. In the crook it is pushed off foot and shaft, both as thick as the wire, without
// friction: the shaft that the loop knows is thicker, and feels a rod in the crook no longer. SI. Thread: tissue task.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/thin/elastic_rod.h"

namespace trocar {

struct RodHookOptions {
  double foot_m = 0.006;            ///< length of the foot from the shaft's axis (training.md 5.2, E13: a tip of 6 mm)
  double foot_z_m = 0.00165;        ///< of its axis in I, as it is drawn (app/picture/models)
  double wire_radius_m = 0.00055;   ///< as it is drawn
  double crook_m = 0.006;          ///< over the foot, up to which a rod is in the crook (a choice)
  double push_n_per_m = 600;       ///< of the wire on a rod (a choice: as jaws hold)
  double most_loop_n_per_m = 250;   ///< of the hold in the loop, as RodGripOptions
};

class RodHook {
 public:
  explicit RodHook(const RodHookOptions& options = {}) : options_(options) {}

  /// Before the rod's step: whether it is in the crook now, and the springs by which foot and shaft push it then.
  void reach(const Pose& X_TI, const ElasticRod& rod, std::vector<RodSpring>& springs);
  static constexpr std::size_t kSprings = 2;
  /// After the step. @param springs that reach() added, their forces filled in
  void feel(const Pose& X_TI, std::span<const RodSpring, kSprings> springs, const ElasticRod& rod);
  void let_go();

  bool holds() const { return crossing_ && inside_; }
  /// Where the rod lies on the foot. @pre holds()
  double arc_m() const { return crossing_->arc_m; }
  double load_n() const { return load_n_; }  ///< of the rod on the foot, in the last step
  GripHold hold() const { return hold_; }

 private:
  struct Crossing {
    double arc_m = 0;
    Vec3 foot_I = Vec3::Zero();    ///< of the foot's axis under the rod
    Vec3 away_I = -Vec3::UnitZ();  ///< unit: across foot and rod, to the shaft's side
    double over_m = 0;             ///< of the rod's axis over the foot's
  };
  std::optional<Crossing> crossing(const Pose& X_TI, const ElasticRod& rod) const;

  RodHookOptions options_;
  std::optional<Crossing> crossing_;
  bool inside_ = false, passed_through_ = false;
  double load_n_ = 0;
  GripHold hold_;
};

}  // namespace trocar
