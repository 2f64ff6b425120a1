// Needle driving: pairs of dots across a slit, through each of which a curved needle is driven, as an exercise file
// describes them.
//
// The first half of a board's targets are the dots at which the needle goes in, the second half those at which it comes
// out, in the order of the pairs. Shares of the needle's length count from its point, as surgeons count.
// Lengths m. Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"
#include "tissue/thin/needle_shape.h"

namespace trocar {

struct NeedleRules : KindRules {
  double apart_m = 0;                              ///< the dots of a pair
  double pair_gap_m = 0;                           ///< from a pair to the next, along the slit
  double grip_low_share = 0, grip_high_share = 0;  ///< of the needle, within which it is to be grasped
  double tip_grip_m = 0;                           ///< from its point, where it is to be grasped to be drawn out
  double tip_out_m = 0;                            ///< of its point that must stand out before it is drawn
  Vec3 stand_m = Vec3::Zero();                     ///< the needle's circle, from the region's centre, axes of T
  double most_lean_rad = 0;                        ///< of the shaft over the surface
  double turn_rad = 0, shift_m = 0;                ///< by which boards differ, either way
  double field_m = 0;                              ///< from the region's centre: a needle let go beyond is lost
};

struct NeedleLevel : KindRules {
  double tolerance_m = 0;  ///< from dot to hole
};

/// How a bite through a pair of dots goes in, the needle's circle across the shaft and through both.
struct NeedleBoard : KindRules {
  NeedleShape shape;
  Pose X_TN_stand;  ///< where needles stand
};

/// The exercise's needle. @pre it has one
inline NeedleShape needle_of(const Exercise& exercise) {
  NeedleShape shape;
  shape.length_m = exercise.suture->needle_m;
  shape.circle = exercise.suture->circle;
  return shape;
}

}  // namespace trocar
