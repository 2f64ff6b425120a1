// Finds weights, inertias and friction of a device that is only known through its seam.
//
// 1. Static poses spread over the workspace, each passed slowly forth and back with all joints at once: half the sum of
//    the two torques is weight, half the difference friction.
// 2. Trajectories of five harmonics of 0.1 Hz with the least condition number of those drawn.
// 3. Weighted least squares on both for base parameters, Coulomb and viscous friction and an offset of each drive; what
//    the data cannot tell (relative standard deviation over 30 %) leaves.
// 4. Physical consistency, and the torques of a trajectory that the fit has not seen.
// The torque that counts as measured is what the DAC codes ask for: amplifier and DAC gains are taken as calibrated,
// and an error of theirs goes into the result, which therefore compensates in the device's own units. SI. Thread: one
// owner; takes the device for some minutes of its own time.
#pragma once

#include <cstdint>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/device_model.h"
#include "haptics/identification/excitation.h"
#include "haptics/identification/weighted_fit.h"

namespace trocar {

struct IdentifyRequest {
  std::uint64_t seed = 1;
  int poses = 60;
  int trajectories = 2;  ///< to fit; one more to check
  int candidates = 40;   ///< of which each is the best
  double span = 1;       ///< share of the workspace and of the amplitude that is used
  double drop_above = 0.30;
  double most_condition = 200;  ///< a regressor worse than this is refused
};

/// What the poses alone say.
struct StaticFindings {
  JointVector coulomb = JointVector::Zero();  ///< half the difference, mean over the poses (viscous part included)
  JointVector coulomb_deviation = JointVector::Zero();
  JointVector gravity_residual = JointVector::Zero();  ///< rms of half the sum after the gravity fit
  JointVector nominal_residual = JointVector::Zero();  ///< the same with the model that the servo was given
};

struct Identification {
  IdentifyRequest request;
  BaseSet base;
  TorqueFit fit;
  StaticFindings poses;
  double condition = 0;  ///< of the whole regressor, columns scaled to one
  DeviceModel device;    ///< the model given, with the gravity and friction that were found
  JointVector offset = JointVector::Zero();
  JointVector prediction_error = JointVector::Zero();  ///< unseen trajectory, rms over rms, all of it
  JointVector moving_error = JointVector::Zero();      ///< the same where the joint moves faster than kSlow
  JointVector nominal_error = JointVector::Zero();     ///< all of it, by the weights and friction of the model given
  double least_inertia = 0;         ///< smallest eigenvalue of the joint inertia matrix over the checked poses, kg m2
  std::vector<std::string> doubts;  ///< physical inconsistencies, in words
  double hottest_c = 0, duration_s = 0;
  std::vector<double> unseen_t;  ///< s; times of the rows below
  std::vector<JointVector> unseen_torque, unseen_predicted;
};

/// @throws InputError when the request excites too little (with the condition number), EnvironmentError when the device
/// does not do what it is asked.
Identification identify(DataAcquisition& daq, const DeviceModel& nominal, const IdentifyRequest& request);

}  // namespace trocar
