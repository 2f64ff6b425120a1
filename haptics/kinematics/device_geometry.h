// Geometry of the 6-DOF hybrid device: frames, link lengths and joint limits, with exact roots.
//
// Frames (docs/frames_and_units.md): W origin O at the centre of rotation, x = U2, y = U3, z = U1; W' the same origin
// with z up; P the platform (axes V1 V2 V3); P' the platform's serial frame; 4, 5, 6 = S by the modified
// Denavit-Hartenberg parameters of the thesis, table 2.6. The printed two-digit matrices are never used: they alone
// cost 0.5 to 1.5 mm at the tip (docs/thesis_errata.md).
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr double kLink1 = 0.146;  ///< m, platform centre to elbow (thesis, table 2.3)
inline constexpr double kLink2 = 0.128;  ///< m, elbow to wrist centre = stylus origin (thesis, table 2.3)
inline constexpr double kDegree = std::numbers::pi / 180;

/// R_W_W': columns are the axes of W' in W.
inline Mat3 rotation_W_Wprime() {
  const double a = 1 / std::sqrt(2.0), b = 1 / std::sqrt(6.0), c = 1 / std::sqrt(3.0);
  return (Mat3() << a, b, -c, 0, -2 * b, -c, -a, b, -c).finished();
}

/// R_P_P': columns are the axes of P' in P.
inline Mat3 rotation_P_Pprime() {
  const double a = 1 / std::sqrt(2.0), b = 1 / std::sqrt(6.0), c = 1 / std::sqrt(3.0);
  return (Mat3() << -c, -b, -a, -c, -b, a, -c, 2 * b, 0).finished();
}

/// Pose of the stylus in W' while the device rests in its home jig.
inline Pose home_pose() { return {(Mat3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished(), Vec3(0, -0.006, -0.272)}; }

/// Joint limits, thesis table 2.4. theta6 has no stop: it is unwrapped from counts.
struct JointRange {
  double low, high;  ///< rad
  bool limited;
};
inline constexpr std::array<JointRange, kArmJoints> kJointRange{{{0, 90 * kDegree, true},
                                                                 {0, 90 * kDegree, true},
                                                                 {0, 90 * kDegree, true},
                                                                 {-120 * kDegree, 0, true},
                                                                 {-160 * kDegree, 0, true},
                                                                 {0, 360 * kDegree, false}}};

}  // namespace trocar
