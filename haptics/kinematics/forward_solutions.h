// All eight orientations of the platform that close the shoulder's three loops, each carried on to the stylus.
//
// W_i . V_i = 0 has four non-trivial solutions, the assembly modes, and four trivial ones with V_i along -+U_j, which
// hold for any th1..th3 because the legs can then turn freely (thesis 2.5.1). One of the eight is the device: the
// first, whose link l1 hangs inside the base ring. The serial part is the same rigid body X_PS in all of them. Thread:
// pure functions, any thread; no allocation.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kForwardSolutions = 8;

struct ForwardSolution {
  const char* meaning = "";
  bool trivial = false;          ///< closes the loops for any th1..th3
  Mat3 R_WP = Mat3::Identity();  ///< platform in W
  Pose X_WS;                     ///< stylus in W'
  double residual = 0;           ///< largest |W_i . V_i|
  double ring_room_m = 0;        ///< from l1 to the base ring, negative when l1 would cross it
  double det_a = 0;              ///< of A, rows (W_i x V_i)^T
};

/// @param q th1..th6, rad. Solution 0 is arm_state(q).
std::array<ForwardSolution, kForwardSolutions> forward_solutions(const JointVector& q);

}  // namespace trocar
