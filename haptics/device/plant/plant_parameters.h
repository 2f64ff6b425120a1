// Every physical value of the simulated device in one place, with its source.
//
// Sources of the numbers in plant_parameters.cpp:
//   [T] the thesis that describes the device    [F] public data sheet or table    [C] computed from those
//   [M] remembered data-sheet value, check before relying on it                   "assumption" where nothing is known
// draw_parameters() makes the TRUE device round the nominal one; nobody tells the controller what was drawn.
//
// Units: SI, radians. A channel's "output" is its joint (rad, N m) or, for the pinch, the jaw opening (m, N); a
// positive motor turn increases the joint angle or opens the jaw. Thread: plain values, any thread.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/device/plant/plant_options.h"
#include "haptics/quantities.h"

namespace trocar {

/// LuGre friction at a channel's output: see plant_friction.h for the law.
struct FrictionParameters {
  double coulomb = 0;            ///< N m (N for the pinch)
  double stribeck_ratio = 1;     ///< breakaway over Coulomb, >= 1
  double stribeck_speed = 0.05;  ///< rad/s (m/s)
  double bristle_length = 1e-3;  ///< rad (m): deflection at which the bristles carry the Coulomb load
  double damping_inertia = 0;    ///< kg m2 (kg): bristle damping is critical for this inertia
  double viscous = 0;            ///< N m s/rad (N s/m)
};

/// Mechanical end stop: one-sided spring and damper.
struct StopParameters {
  double lower = 0, upper = 0;  ///< rad (m)
  double stiffness = 0;         ///< N m/rad (N/m)
  double damping = 0;           ///< N m s/rad (N s/m)
};

/// One motor with its amplifier, DAC, encoder, capstan and friction.
struct ChannelParameters {
  double torque_constant = 0;        ///< N m/A, also V s/rad
  double resistance = 0;             ///< ohm
  double rotor_inertia = 0;          ///< kg m2
  double ratio = 0;                  ///< output per motor radian: 0.23 rad/rad, 0.008 m/rad for the pinch
  double amplifier_gain = 0;         ///< A/V
  double dac_gain = 1;               ///< true over nominal; stands for the gain error of the whole chain
  double dac_offset = 0;             ///< V
  double encoder_offset_counts = 0;  ///< counter at motor angle zero; its fraction is the phase of the disc
  FrictionParameters friction;
  StopParameters stop;
};

/// Point mass that turns with the platform, placed by its position in W' at the home pose.
struct PlatformMass {
  double mass = 0;                    ///< kg
  Vec3 position_home = Vec3::Zero();  ///< m, in W'
};

struct PlantParameters {
  double gravity = 0;                             ///< m/s2
  double link1 = 0, link2 = 0;                    ///< m
  std::array<PlatformMass, 3> platform_masses{};  ///< wrist motors, link 1, elbow motor
  double platform_inertia = 0;                    ///< kg m2, isotropic about the centre of rotation, legs included
  double leg_stop = 0;                  ///< sine of the angle between a leg and its motor axis at which legs meet
  double stylus_mass = 0;               ///< kg, link 2 and stylus, lumped
  Vec3 stylus_com = Vec3::Zero();       ///< m, centre of that mass in the stylus frame
  Vec3 stylus_inertia = Vec3::Zero();   ///< kg m2: Ixx Iyy Izz about the centre of mass, stylus axes
  Vec3 stylus_products = Vec3::Zero();  ///< kg m2: Ixy Ixz Iyz, elements of the tensor
  double jaw_mass = 0;                  ///< kg, jaw and finger pads

  double bus_voltage = 0;              ///< V
  double dac_full_scale = 0;           ///< V
  double amplifier_time_constant = 0;  ///< s
  double current_limit = 0;            ///< A, the amplifier's peak
  double counts_per_turn = 0;          ///< quadrature counts per motor revolution
  std::array<ChannelParameters, kChannels> channel{};

  JointVector jig_error = JointVector::Zero();  ///< rad, how far the jig holds the joints from the exact home pose
  double jig_jaw_opening = 0;                   ///< m, opening at which the jig holds the jaws

  PlantOptions options;  ///< all off
};

/// The device as its documents describe it.
PlantParameters nominal_parameters();

/// The true device of one seed: masses +-3 %, centres of mass +-0.5 mm, friction log-normal 20 %, gain +-1 %, DAC
/// offset +-5 mV, arbitrary counters and disc phases, jig error up to 0.05 deg a joint and 0.1 mm at the jaw.
PlantParameters draw_parameters(std::uint64_t seed);

/// That device with everything else drawn too, from a stream of its own: leg stop and jaw +-10 %, link lengths +-0.02
/// mm, inertia of the pen +-20 % as a whole and +-3 % an axis, supply, current limit, torque constant and rotor +-5 %,
/// resistance +-8 %, ratio +-0.1 %, Stribeck excess and speed, bristles and amplifier tau log-normal 30 %, stops +-0.5
/// deg (pinch 0.2 mm), their stiffness and damping log-normal 20 %. Spreads are assumptions.
PlantParameters draw_everything(std::uint64_t seed);

/// Tensor of the stylus about its centre of mass, stylus axes.
Mat3 stylus_inertia_tensor(const PlantParameters& parameters);

}  // namespace trocar
