// The device as a mechanical and electrical body: what the controller believes it is driving.
//
// Equations of motion in nu = [omega_p; th4'; th5'; th6']:
//   (M_nu + S^T Jr S) nu' + h(R, nu) + S^T Jr S' nu = S^T (tau_motor - tau_friction - tau_stop) + J^T F_hand
// Rigid bodies: platform group (legs, wrist motors, link 1, elbow motor) and stylus group (link 2, stylus); Jr are the
// rotors seen through the capstans. One step is drift - kick - drift: half a step of position, one velocity step with
// everything evaluated there and friction, stops and viscous loss implicit, half a step of position. Second order.
// Towards the corners of the shoulder's joint box a leg axis V_i turns into its motor axis U_i and the leg would lock
// up (b_i = 0 in plant_kinematics.h). There the legs meet before: a hard stop without rebound at b_i = leg_stop. The
// pinch is a body of its own on the same scheme.
// A joint whose cable is elastic (plant_options.h) has its rotor as a body of its own behind a spring: Jr then leaves
// the equations above and the cable's pull takes the place of tau_motor (plant_cable.h).
//
// Frames: outside W' (base, z up), inside W. External wrench: on the stylus, moment about the stylus origin, in W'.
// Thread: one owner; step() allocates nothing and does not throw.
#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <cstdint>

#include "haptics/device/plant/plant_cable.h"
#include "haptics/device/plant/plant_friction.h"
#include "haptics/device/plant/plant_kinematics.h"
#include "haptics/device/plant/plant_motor.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/device/plant/plant_pinch.h"
#include "haptics/quantities.h"

namespace trocar {

/// Loads from outside during one step.
struct ExternalLoad {
  Wrench stylus_B;         ///< on the stylus at its origin, in W'
  double jaw_force_n = 0;  ///< fingers on the jaw, positive opens
};

enum class PlantStatus : std::uint8_t {
  kOk,
  kNonFiniteLoad,  ///< NaN or infinity from outside: that load was left out
};

/// Motion of stylus and jaw, for the hand and for tests.
struct StylusMotion {
  Pose X_BS;       ///< stylus in W'
  Twist V_BS;      ///< its velocity at the stylus origin, in W'
  double jaw = 0;  ///< opening, m
  double jaw_rate = 0;
};

class DevicePlant {
 public:
  explicit DevicePlant(const PlantParameters& parameters);

  /// Puts the arm at rest at joint angles (rad) and jaw opening (m); friction and currents are forgotten.
  void place(const JointVector& q, double jaw_opening) noexcept;
  /// Gives the arm joint rates (rad/s); for tests.
  void set_joint_rates(const JointVector& qd) noexcept;
  /// Held by the jig: joints and jaw stay where they are whatever acts.
  void clamp(bool held) noexcept;
  bool clamped() const noexcept { return clamped_; }

  void command_volts(const ChannelVector& volts) noexcept { volts_ = volts; }
  /// Inhibited amplifiers lose their current at once.
  void enable_amplifiers(bool enabled) noexcept;
  bool amplifiers_enabled() const noexcept { return enabled_; }

  PlantStatus step(double dt, const ExternalLoad& load) noexcept;

  JointVector angles() const noexcept { return joint_angles(configuration_, kinematics_); }
  JointVector rates() const noexcept;
  StylusMotion motion() const noexcept;
  /// Channel outputs: th1..th6 (rad), jaw opening (m).
  ChannelVector outputs() const noexcept;
  /// What the encoders on the motors see, as outputs: those but for the stretch of elastic cables.
  ChannelVector motor_outputs() const noexcept;
  /// Loads that the motors deliver at the outputs now, N m (N for the pinch).
  ChannelVector motor_loads() const noexcept;

  /// Temperatures of windings and cases, C; those of the start while the heat option is off.
  ChannelVector windings_c() const noexcept;
  ChannelVector cases_c() const noexcept;

  Mat6 mass_matrix() const noexcept;   ///< in nu, rotors included but those behind elastic cables
  double energy() const noexcept;      ///< kinetic and potential of the arm, its cables and their rotors, J
  double cable_loss() const noexcept;  ///< heat that the cables' damping makes now, W
  /// What friction and cables of the six joints have taken out of the motion since construction, J.
  double dissipated_j() const noexcept { return dissipated_j_; }
  JointVector holding_torque() const;  ///< joint torque that carries the weight, N m
  Mat6 joint_jacobian() const;         ///< d(twist in W')/d(joint rates), linear rows first
  const PlantParameters& parameters() const noexcept { return p_; }

 private:
  struct Resistances {
    JointVector constant, slope;                      ///< friction, stops and cables
    std::array<ResistanceLine, kArmJoints> friction;  ///< of that
  };

  void drift(double dt) noexcept;
  Mat6 rigid_mass(const PlantKinematics& k) const noexcept;
  Vec6 bias(const PlantKinematics& k, const Vec6& nu) const noexcept;
  Vec6 to_joint_rates(const PlantKinematics& k, const Vec6& nu) const noexcept;
  Vec6 from_joint_loads(const PlantKinematics& k, const Vec6& tau) const noexcept;
  Resistances resist(const JointVector& q, const JointVector& qd, double dt) noexcept;
  void kick(double dt, const ExternalLoad& load) noexcept;
  double drive(int channel, double rate, double dt) noexcept;
  void hold(double dt) noexcept;
  bool advance_cables(const JointVector& qd_new, double dt) noexcept;
  void stop_legs(const Eigen::LLT<Mat6>& mass) noexcept;
  void step_pinch(double dt, double force) noexcept;
  void refresh() noexcept;

  PlantParameters p_;
  Vec3 gravity_W_;
  Vec3 platform_moment_P_ = Vec3::Zero();   ///< sum of m r
  Mat3 platform_inertia_P_ = Mat3::Zero();  ///< about O
  Mat3 stylus_inertia_;                     ///< about the centre of mass, stylus axes
  Vec6 rotor_ = Vec6::Zero();               ///< Jr at the joints that turns with them, kg m2
  std::array<PlantCable, kArmJoints> cable_;
  std::array<PlantFriction, kChannels> friction_;
  std::array<PlantMotor, kChannels> motor_;
  PlantGear gear_;

  PlantConfiguration configuration_;
  PlantKinematics kinematics_;
  Vec6 nu_ = Vec6::Zero();
  Vec6 nu_dot_ = Vec6::Zero();  ///< of the last step, to centre velocity products
  double jaw_ = 0, jaw_rate_ = 0;
  double dissipated_j_ = 0;
  ChannelVector volts_ = ChannelVector::Zero();
  bool enabled_ = false, clamped_ = false;
};

}  // namespace trocar
