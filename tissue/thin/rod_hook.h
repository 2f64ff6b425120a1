// The crook of a hook under a strand: what has come between foot and shaft from the side is lifted, and comes off the
// foot's end.
//
// The foot lies in frame I of the instrument (z along the shaft to the tip) across the shaft, towards -y. A rod is in
// the crook once it passes over the foot, on the side of the shaft; one that the foot has come through from above is
// not, until the foot has left it. Where the foot touches it, the foot holds that place of it: pushed off the wire,
// rubbing along itself, free along the foot up to the shaft. Foot and shaft are as thick as the wire: the shaft that
// the loop knows is thicker, and does not feel a rod in the crook. SI. Thread: tissue task.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/thin/elastic_rod.h"

namespace trocar {

struct RodHookOptions {
  double foot_m = 0.006;           ///< length of the foot from the shaft's axis (training.md 5.2, E13: a tip of 6 mm)
  double foot_z_m = 0.00165;       ///< of its axis in I, as it is drawn (app/picture/models)
  double wire_radius_m = 0.00055;  ///< as it is drawn
  double crook_m = 0.006;          ///< over the foot, up to which a rod is in the crook (a choice)
  double friction = 0.5;           ///< of a rod that is bent over the wire (a choice)
  double push_n_per_m = 600;       ///< of the wire on a rod (a choice: as jaws hold)
  double most_loop_n_per_m = 250;  ///< of the hold in the loop, as RodGripOptions
};

class RodHook {
 public:
  explicit RodHook(const RodHookOptions& options = {}) : options_(options) {}

  /// Before the rod's step: whether it is in the crook now, and the springs by which the wire holds it where it
  /// touches.
  void reach(const Pose& X_TI, const ElasticRod& rod, std::vector<RodSpring>& springs);
  /// After the step. @param springs those that reach() added, their forces filled in
  void feel(const Pose& X_TI, std::span<const RodSpring> springs, const ElasticRod& rod);
  void let_go();

  bool holds() const { return held_ || inside_; }  ///< it is in the crook
  double arc_m() const { return arc_m_; }          ///< where it lies over the foot. @pre holds()
  double load_n() const { return load_n_; }        ///< of the rod on the foot, in the last step
  GripHold hold() const { return hold_; }

 private:
  struct Crossing {
    double arc_m = 0;
    Vec3 away_I = -Vec3::UnitZ();  ///< unit: across foot and rod, to the shaft's side
    double over_m = 0;             ///< of the rod's axis over the foot's
  };
  struct Held {
    Vec3 away_I = -Vec3::UnitZ();  ///< as it was when the foot touched it
    double aside_m = 0;            ///< that it has slid across the foot since
  };
  std::optional<Crossing> crossing(const Pose& X_TI, const ElasticRod& rod) const;
  bool on_foot(double y_I) const { return y_I < options_.wire_radius_m && -y_I < options_.foot_m; }

  RodHookOptions options_;
  std::optional<Held> held_;
  bool inside_ = false, passed_through_ = false;
  double arc_m_ = 0, load_n_ = 0;
  GripHold hold_;
};

}  // namespace trocar
