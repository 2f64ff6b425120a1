// Forward kinematics and velocities of the spherical 3-RRR shoulder with all right angles.
//
// Loop closure W_i . V_i = 0 (thesis 2.1), platform orientation R = Rz(phi1) Ry(phi2) Rx(phi3) (2.4) on the working
// assembly mode, in frame W. Derivation: Kong and Gosselin's unique solution; the quotient (2.31) is replaced by a
// form that is regular on the whole joint box (docs/thesis_errata.md). Velocity: A omega = B thdot with
// A rows (W_i x V_i)^T and B = diag((U_i x W_i) . V_i).
// Thread: pure functions, any thread; no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct SphericalParallelState {
  Mat3 R_WP = Mat3::Identity();   ///< platform in W; columns are V1 V2 V3
  Mat3 rates = Mat3::Identity();  ///< omega_W = rates * (th1', th2', th3')
  double det_a = 1;               ///< s1 s2 s3 + c1 c2 c3: 0 at a singularity of the shoulder
};

/// @param theta th1..th3, rad. Regular for every joint triple with det A > 0.
SphericalParallelState spherical_parallel(const Vec3& theta);

/// Orientation of the platform in each of the four non-trivial assembly modes (phi2, phi3 shifted by pi).
/// @param mode 0 is the working mode of spherical_parallel(), 1..3 the others.
Mat3 assembly_mode(const Vec3& theta, int mode);

/// The four trivial solutions (thesis R_TO1..4), which close the loop for any joint angles. @param index 0..3.
Mat3 trivial_assembly(int index);

/// Largest |W_i . V_i|: 0 when R closes the three chains.
double loop_residual(const Vec3& theta, const Mat3& R_WP);

/// Active joint angles that carry a platform orientation (thesis 2.21).
Vec3 active_angles(const Mat3& R_WP);

}  // namespace trocar
