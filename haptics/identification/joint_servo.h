// A position servo of the six joints straight on the device seam: counts in, codes out, no hand.
//
// tau = g(q_ref) + c tanh(qd_ref / 0.05 rad/s) + b qd_ref + M(q_ref) (w^2 (q_ref - q) + 2 w e'); e' is qd_ref - qd
// behind two low-passes, for on elastic cables the encoders see light rotors, which a fast rate loop shakes. g, c, b
// are those of the model that the servo is given, M the inertia of its weights, rotors and wrist, renewed every 20 ms.
// What it asks for through the DAC codes is the measured torque. A code written after SYNC k acts from SYNC k+1 to k+2:
// the trace pairs the angle of a SYNC with the mean of the codes before and after it. Refuses a device that does not
// follow, jumps or misses SYNCs, and rests the arm when a motor's winding grows hot. SI, radians. Thread: one owner.
#pragma once

#include <functional>
#include <vector>

#include "haptics/control/motor_heat.h"
#include "haptics/control/velocity_estimator.h"
#include "haptics/device/data_acquisition.h"
#include "haptics/device/transmission.h"
#include "haptics/identification/arm_regressor.h"

namespace trocar {

struct PathPoint {
  JointVector q = JointVector::Zero(), qd = JointVector::Zero();
};
/// Where the arm shall be t seconds after the start.
using JointPath = std::function<PathPoint(double t)>;

/// What was measured, one entry a SYNC.
struct MotionTrace {
  double period_s = 1e-3;
  std::vector<JointVector> q, tau;
};

struct ServoGains {
  double stiffness = 25;            ///< w, rad/s
  double rate_lag_s = 0.006;        ///< of each of two low-passes of the rate error
  double friction_knee = 0.05;      ///< rad/s
  double lost_rad = 0.3;            ///< an error beyond this: the device does not follow
  double hot_c = 100, cool_c = 85;  ///< winding at which the arm is rested, and until
};

class JointServo {
 public:
  /// @throws EnvironmentError when the device does not leave its jig or its encoders are not still.
  JointServo(DataAcquisition& daq, const DeviceModel& model, const ServoGains& gains = {});
  /// Amplifiers off.
  ~JointServo();
  JointServo(const JointServo&) = delete;
  JointServo& operator=(const JointServo&) = delete;

  /// Follows a path that begins where the arm is. @throws EnvironmentError.
  MotionTrace follow(const JointPath& path, double seconds);
  /// Minimum-jerk move in joint space, the fastest joint at `speed` rad/s at most.
  void move_to(const JointVector& q, double speed = 1.2);

  const JointVector& reference() const { return reference_; }
  double hottest_c() const { return hottest_c_; }      ///< winding of the hottest motor so far
  double worst_error() const { return worst_error_; }  ///< rad
  double time_s() const { return period_s_ * static_cast<double>(ticks_); }

 private:
  JointVector latch();
  void step(const PathPoint& wanted);
  JointVector torque_for(const PathPoint& wanted);
  void rest();

  DataAcquisition& daq_;
  DeviceModel model_;
  ServoGains gains_;
  double period_s_;
  int dac_bits_;
  CountAccumulator counts_;
  std::vector<VelocityEstimator> velocity_;
  std::vector<MotorHeat> heat_;
  JointVector q_, qd_, reference_, limit_;
  JointVector asked_ = JointVector::Zero(), asked_before_ = JointVector::Zero();  ///< last two torques written
  double hottest_c_ = 0, worst_error_ = 0;
  std::uint64_t ticks_ = 0;
  Eigen::VectorXd masses_;                                                ///< for the servo's M
  JointVector once_ = JointVector::Zero(), twice_ = JointVector::Zero();  ///< error of the rates, smoothed, rad/s
  Mat6 M_;
};

/// Mass parameters that follow from a model's weights; legs, wrist and rotors as assumed in the servo's source.
Eigen::VectorXd servo_masses(const DeviceModel& model);

}  // namespace trocar
