// What the thesis prints about kinematics, and its own method as printed, to stand beside the exact models.
//
// Algorithm 1 (2.4): elbow by the sign of one projection (PROJ < 0), arm plane by one sign of AO x Z6, matrices (2.33)
// and (2.36) to two digits. Where (2.22) is misprinted (theta5) the right form is taken, since table 3.7 cannot come
// from it. Angles rad, lengths m. Thread: pure functions, any thread.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar::thesis {

/// The two fixed rotations of the model.
struct Frames {
  Mat3 R_WWprime, R_PPprime;
};
Frames printed_frames();  ///< (2.36) and (2.33): two digits, no rotations
Frames exact_frames();    ///< roots

/// Stylus in W' with the thesis' chain (2.35) on the given frames.
Pose forward(const JointVector& q, const Frames& frames);
/// Algorithm 1 on the given frames; theta6 in (-pi, pi]. NaN where the pose is out of reach.
JointVector inverse(const Pose& X_WS, const Frames& frames);

/// One sample of section 3.5.
struct Sample {
  const char* name;
  JointVector q;        ///< table 3.6
  JointVector inverse;  ///< table 3.7
  Pose printed;         ///< W'_6T as printed; no exact rotation
  Vec3 exact;           ///< position in W' with exact constants, published to 0.1 um (device reference); NaN for S1
};
const std::array<Sample, 3>& samples();

/// Configuration of the forward example (2.5) and the eight stylus positions that it prints, in W.
JointVector example();
const std::array<Vec3, 8>& example_positions_W();

}  // namespace trocar::thesis
