// What the controller believes about the device: nominal values, each with its source. The simulated plant has its
// own copy of the world (haptics/device/plant/plant_parameters.h) and differs from these on purpose.
//
// Marks: [T] thesis, [F] public data sheet, [C] computed from those, [assumed] to be identified on the real device.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "haptics/quantities.h"

namespace trocar {

/// One transmission from motor to joint (or to the pinch slide, whose "joint" unit is the metre).
struct Transmission {
  double ratio = 0.23;              ///< joint rad per motor rad [T 3.2]; m per rad for the pinch
  double counts_per_turn = 2000;    ///< quadrature counts per motor turn [T 3.2.2]
  double torque_constant = 0.0232;  ///< N m/A [T table 3.1]
  double amps_per_volt = 0.431;     ///< amplifier in current mode; +-10 V = 4.31 A [C]
  double offset_v = 0;              ///< that the chain adds to every command, found by `trocar device calibrate`
  double full_scale_v = 10;         ///< DAC range [T 3.2]
  double max_motor_torque = 0.100;  ///< N m at +-10 V [C]
};

/// A weight that turns rigidly with the platform, given where it is at home.
struct PlatformWeight {
  double weight_n;
  Vec3 home_W;  ///< centre of mass in W' at the home pose, m
};

/// Six equal arm joints and the pinch slide: 8 mm pulley, low-friction small motor of the same electrical scale
/// [assumed].
inline std::array<Transmission, kChannels> nominal_transmissions() {
  std::array<Transmission, kChannels> transmission;
  transmission.fill(Transmission{});
  transmission[kPinchChannel].ratio = 0.008;
  transmission[kPinchChannel].max_motor_torque = 0.080;
  return transmission;
}

/// Weights of the arm as base parameters, N m: what the joints can tell apart, however the masses are spread
/// (haptics/identification). In the frames of arm_regressor.h; components along joint axes are part of the body before.
struct IdentifiedGravity {
  Vec3 platform = Vec3::Zero();                      ///< x y z in P'
  Eigen::Vector2d link2 = Eigen::Vector2d::Zero();   ///< x y in 4
  Eigen::Vector2d wrist = Eigen::Vector2d::Zero();   ///< x y in 5 (x along the roll axis)
  Eigen::Vector2d stylus = Eigen::Vector2d::Zero();  ///< x y in S
};

/// How the zero of the joints is found (haptics/control/homing.h).
enum class HomingMethod : std::uint8_t {
  kLight,  ///< the thesis': where the jig holds the arm while the beam is received
  kEdges,  ///< the same, and the roll from the middle between the two edges of the light
  kIndex,  ///< from the marks of the encoders, whose places are known
};

struct HomingModel {
  HomingMethod method = HomingMethod::kLight;
  bool see_dark = false;  ///< the receiver must have been seen dark before its light counts
  std::array<std::int32_t, kArmJoints> index_counts{};  ///< from home to an index mark, counts; kIndex only
};

/// The pinch's hardware. The transmission of its channel says counts and forces, these what goes along with them.
enum class PinchDesign : std::uint8_t {
  kDirect,         ///< pulley on the motor, encoder on its shaft [assumed]
  kGeared,         ///< slide, two gears at right angles, motor with encoder [T 5.2, the first]
  kPotentiometer,  ///< slide on a potentiometer, motor behind a servo driver [T 5.2, the alternative]
};

struct PinchHardware {
  PinchDesign design = PinchDesign::kDirect;
  std::int32_t noise_counts = 0;  ///< that its reading trembles by at rest: no motion
  double jaw_length_m = 0.020;    ///< from hinge to pads [assumed]: opening = 2 length sin(angle / 2)
};

/// How a force/torque sensor sits on the output link (the stylus, S), and what hangs on it. F: the sensor's own axes.
struct SensorMount {
  std::optional<Vec3> rpy_rad;        ///< from S to F by roll, pitch, yaw about fixed axes; none: not known
  bool body_on_device = false;        ///< else the hand holds the body and the device acts on the tool side
  double fixture_kg = 0;              ///< that hangs on the tool side
  Vec3 fixture_com_F = Vec3::Zero();  ///< its centre of mass, m
  std::optional<double> lag_s;        ///< of its readings, with its filter; none: the thesis' sensor's
  std::optional<double> counts_per_n, counts_per_nm;  ///< none: a Net F/T box's own, a serial Nano25's usual

  /// From F to S. @pre rpy_rad
  Mat3 R_SF() const {
    using Turn = Eigen::AngleAxisd;
    return (Turn(rpy_rad->z(), Vec3::UnitZ()) * Turn(rpy_rad->y(), Vec3::UnitY()) * Turn(rpy_rad->x(), Vec3::UnitX()))
        .toRotationMatrix();
  }
};

struct DeviceModel {
  std::array<Transmission, kChannels> transmission = nominal_transmissions();
  std::array<PlatformWeight, 3> platform_weights{{{3.21, {0, -0.0125, 0.0095}},   // wrist motors [T table 4.1]
                                                  {0.20, {0, 0, -0.073}},         // link l1 [T table 4.1]
                                                  {1.61, {0, 0.0125, -0.146}}}};  // elbow motor [T table 4.1]
  double stylus_weight_n = 0.76;                        ///< at the stylus origin [T table 4.1]
  std::optional<IdentifiedGravity> identified_gravity;  ///< takes the place of the weights above
  JointVector coulomb =
      JointVector::Constant(0.0037 / 0.23 * 0.46);     ///< N m at the joint [C 37 mA no-load] x 2 [assumed]
  JointVector viscous = JointVector::Constant(0.005);  ///< N m s/rad [assumed]
  double pinch_travel_m = 0.030;                       ///< slide from closed (0) to fully open [assumed]
  double pinch_home_m = 0.020;                         ///< slide position in the home jig [assumed]
  PinchHardware pinch;
  HomingModel homing;
  std::optional<SensorMount> sensor;  ///< none: nothing is known of how it sits

  /// Share of coulomb and viscous that surely is there: what identification may miss, else what 1 of 200 joints of this
  /// kind does not reach (log-normal, 20 %).
  double friction_sure() const { return identified_gravity ? 0.9 : 0.6; }
};

}  // namespace trocar
