#include "app/studies/contact/release_bench.h"

#include <algorithm>
#include <cmath>

#include "app/studies/contact/bare_control_loop.h"
#include "haptics/control/gravity.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/identification/joint_servo.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

constexpr double kHold_s = 0.5, kFarEnough_m = 0.05;
constexpr int kKeep = 10;  // SYNCs between kept samples

/// Angles as the counts say, where the servo has brought the arm.
JointVector bring(SimulatedDaq& daq, const JointVector& q) {
  JointServo servo(daq, {});
  servo.move_to(q, 2.0);
  const MotionTrace rest = servo.follow([&](double) { return PathPoint{q, JointVector::Zero()}; }, 0.2);
  return rest.q.back();
}

}  // namespace

Release release(const PlantParameters& truth, const JointVector& q, const GravityLaw& law, double seconds) {
  SimulatedDaqConfig config;
  config.plant = truth;
  config.hand = hand_parameters(GripPreset::kFirm);
  config.hand.tremor_m = 0;
  SimulatedDaq daq(config);
  const JointVector arrived = bring(daq, q);
  const HandSense held = daq.sense();
  daq.set_hand_intent(held.X_BS, held.jaw_opening_m);
  BareControlLoop loop(daq, law.torque, arrived);
  for (long n = std::lround(kHold_s * config.rate_hz); n > 0; --n) {
    daq.set_hand_intent(held.X_BS, held.jaw_opening_m);
    loop.tick();
  }
  Release r;
  const Vec3 from = daq.sense().X_BS.p;
  const JointVector holding = daq.plant().holding_torque();
  r.weight = holding.norm();
  r.left_over = (daq.plant().motor_loads().head<kArmJoints>() - holding).norm();
  daq.release_hand();
  const long n = std::lround(seconds * config.rate_hz);
  for (long k = 0; k < n && r.drift_m < kFarEnough_m; ++k) {
    loop.tick();
    const double drift = (daq.sense().X_BS.p - from).norm();
    r.drift_m = std::max(r.drift_m, drift);
    if (k % kKeep != 0) continue;
    r.t.push_back(static_cast<double>(k + 1) / config.rate_hz);
    r.drift.push_back(drift);
  }
  return r;
}

JointVector thesis_gravity_torque(const ArmState& arm) {
  static const DeviceModel model;
  static const Mat3 home_inverse = arm_state(home_angles()).R_WPprime.transpose();
  Vec3 home = Vec3::Zero();
  double weight = 0;
  for (const PlatformWeight& w : model.platform_weights) home += w.weight_n * w.home_W, weight += w.weight_n;
  home /= weight;
  const Mat3 R = arm.R_WPprime * home_inverse;  // Rz Ry Rx of W'
  const Vec3 zyx(std::atan2(R(1, 0), R(0, 0)), -std::asin(std::clamp(R(2, 0), -1.0, 1.0)),
                 -std::atan2(R(2, 1), R(2, 2)));
  const double Y = std::abs(home.y()), Z = std::abs(home.z()), r = std::hypot(Y, Z), beta = std::atan2(Z, Y);
  const Vec3 centre(Y * std::sin(zyx[0]) - Z * std::sin(zyx[1]), -Y * std::cos(zyx[0]) - r * std::cos(beta - zyx[2]),
                    -Z * std::cos(zyx[1]) - r * std::sin(beta - zyx[2]));
  JointVector torque = model.stylus_weight_n * arm.J_WS.row(2).transpose();
  for (int i = 0; i < 3; ++i) torque[i] += weight * arm.J_WS.block<3, 1>(3, i).cross(centre).z();
  return torque;
}

}  // namespace trocar
