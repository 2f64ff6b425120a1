// The device held in a pose and let go: no loop, only a law for the weight behind the seam.
//
// A servo brings the arm to the pose, a firm hand takes hold there for half a second while the law acts, then it lets
// go. Counts in, angles, law, DAC codes out each SYNC, so calibration, quantisation and delay are those of the loop;
// the enabling switch is bridged. SI. Thread: any.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "haptics/device/plant/plant_parameters.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

struct GravityLaw {
  std::string name;
  std::function<JointVector(const ArmState&)> torque;  ///< N m
};

struct Release {
  double drift_m = 0;  ///< farthest that the stylus origin came from where it was let go
  double left_over = 0,
         weight = 0;             ///< norms: torque that the motors deliver minus what holds the arm; the latter, N m
  std::vector<double> t, drift;  ///< every 10 ms
};

/// @param seconds after the hand has let go; it ends earlier when the stylus has gone 50 mm.
Release release(const PlantParameters& truth, const JointVector& q, const GravityLaw& law, double seconds);

/// The thesis' law: centre of the platform's weights as the sum of three partial rotations, (4.3) to (4.7) as printed
/// with the angle about x counted so that a rotation about x alone turns the right way; mapped to the joints without
/// its slips (moment of the stylus about Z4, not X).
JointVector thesis_gravity_torque(const ArmState& arm);

}  // namespace trocar
