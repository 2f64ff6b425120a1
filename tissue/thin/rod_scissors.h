// Scissors on a rod: blades that close with the rod between them cut it through, or nick it where only a part of its
// width lies between them.
//
// The force against closing is toughness times the mean width of wall that the blades are in, so that a whole cut takes
// toughness times the wall's area. On a clip they jam. Frame I of rod_in_jaws.h. SI. Thread: tissue task.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tissue/thin/clip_applier.h"
#include "tissue/thin/rod_in_jaws.h"

namespace trocar {

struct ScissorsOptions {
  double blade_m = 0.015, width_m = 0.002;  ///< (unchecked)
  double clip_width_m = 0.0012;             ///< along the rod, as ClipOptions
  double toughness_j_per_m2 = 500;          ///< of the rod's wall; 0: cuts freely
  double shut_opening_m = 0.0005;           ///< blades have passed one another (a choice)
  double through_share = 0.95;              ///< of the width between them from which on nothing is left (a choice)
};

struct RodCut {
  std::int32_t rod = 0;  ///< index among those given
  double arc_m = 0;
  double share = 1;  ///< of the width; below through_share: nicked, not cut through
};

class RodScissors {
 public:
  explicit RodScissors(const ScissorsOptions& options = {}) : options_(options) {}

  /// One step. Cuts nothing itself: the caller severs (ElasticRod::sever) or nicks (Lumen::nick) what it is told.
  /// @param rods those that are near, with their clips
  std::vector<RodCut> step(const Pose& X_TI, double opening_m, std::span<const ClipSurroundings::Rod> rods);

  double resist_n() const { return resist_n_; }  ///< against closing, of what the blades are in now
  bool jammed() const { return jammed_; }        ///< on a clip

 private:
  ScissorsOptions options_;
  std::vector<bool> caught_;  ///< rods that were between open blades
  bool shut_ = true, jammed_ = false;
  double resist_n_ = 0;
};

}  // namespace trocar
