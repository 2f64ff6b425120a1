// Damping of a wanted power placed on the joints under the motors' limits.
//
//   min sum (tau_i / w_i)^2   subject to   tau . qd = -p,   |tau_i| <= h_i
// (after Preusche and others 2003; haptics notes 1.4, Q = diag(1/w_i^2), w_i the joint's largest torque, so strong
// joints work most). Without limits tau = -p Q^-1 qd / (qd^T Q^-1 qd). A joint that this saturates is held at its limit
// and the remainder is placed on the others; each pass holds at least one joint more, so six passes end it, and because
// the multiplier only grows a joint once held stays held: the result meets the conditions of Karush, Kuhn and Tucker
// exactly. Every tau_i opposes its own qd_i: no joint is driven. What finds no room is returned and stays debt. Joints
// 0..5, rad/s and N m; power in W. Thread: haptic task; pure, no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct PlacedDamping {
  JointVector torque = JointVector::Zero();  ///< N m, tau_i qd_i <= 0
  double unplaced_w = 0;                     ///< of the wanted power
  int passes = 0;
};

/// @param power_w to be taken out of the motion, <= 0 or NaN places nothing; @param qd rad/s;
/// @param headroom N m that each motor has left against its joint's motion, negative counts as none;
/// @param weight N m, w above, > 0.
PlacedDamping place_damping(double power_w, const JointVector& qd, const JointVector& headroom,
                            const JointVector& weight);

/// Below this a joint's estimated velocity may be one count's noise: it is left out. On the grid of presses, where
/// noise of resting joints had made the law shake, that took the stable cases of seeds 2 and 3 from 98 to 100.
inline constexpr double kDampedFrom = 0.1;  ///< rad/s

JointVector moving_joints(const JointVector& qd);

/// Torque that each motor can still give against its joint's motion. @param carried what it gives already, N m.
JointVector headroom_against(const JointVector& qd, const JointVector& carried, const JointVector& limit);

}  // namespace trocar
