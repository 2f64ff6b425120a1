// Inverse kinematics of the hybrid arm: every candidate of a stylus pose.
//
// th4 from the triangle O-elbow-A; the arm plane has normal n = +-(AO x Z6)/|AO x Z6|, and BOTH signs are solutions:
// the thesis' single sign is wrong beyond the surface Z6 parallel to AO, which lies inside the joint limits
// (docs/thesis_errata.md). th1..th3 by (2.21), th5 = atan2(T23, T13) and th6 = atan2(-T31, -T32) of 4_T_6.
// Thread: pure functions, any thread; no allocation.
#pragma once

#include <array>
#include <optional>

#include "haptics/quantities.h"

namespace trocar {

struct InverseCandidate {
  JointVector q = JointVector::Zero();  ///< rad; theta6 in [0, 2 pi)
  bool in_limits = false;               ///< thesis table 2.4
};

struct InverseSolutions {
  std::array<InverseCandidate, 2> candidate;
  int count = 0;           ///< 0 when the pose is out of reach or Z6 is parallel to AO
  double missed_by_m = 0;  ///< how far the stylus origin lies outside the reachable shell, 0 when inside
};

/// @param X_WS wanted stylus pose in W', m.
InverseSolutions inverse_kinematics(const Pose& X_WS);

/// The candidate inside the limits; of two, the one nearer to `near` (theta6 taken modulo 2 pi). Empty when none is.
std::optional<JointVector> inverse_within_limits(const Pose& X_WS, const JointVector& near);

/// Joint angles of the home jig, from home_pose() (not typed in: the printed ones are rounded).
JointVector home_angles();

}  // namespace trocar
