#include "haptics/device/plant/plant_parameters.h"

#include <limits>
#include <numbers>

#include "haptics/device/plant/plant_random.h"

namespace trocar {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Motor RE25 118752, 24 V 20 W graphite.
constexpr double kTorqueConstant = 0.0232;  // N m/A [T]; the public table has 0.0234 [F]
constexpr double kResistance = 2.32;        // ohm [F][T]
constexpr double kRotorInertia = 10.3e-7;   // kg m2 (10.3 g cm2) [F]
constexpr double kCapstanRatio = 0.23;      // joint radian per motor radian [T]

// Amplifier 12A8 in current mode.
constexpr double kAmplifierGain = 0.431;   // A/V: +-10 V is +-4.31 A, 100 mN m at the motor [C] from [T]
constexpr double kAmplifierPeak = 12.0;    // A [T]
constexpr double kAmplifierTau = 0.08e-3;  // s, bandwidth 2 kHz [M]
constexpr double kBusVoltage = 24.0;       // V, the motor's nominal voltage [T]; supply itself an assumption

// Joint friction at the output of the capstan.
constexpr double kMotorCoulomb = 0.037 * kTorqueConstant / kCapstanRatio;  // 3.7 mN m from the no-load current [C]
constexpr double kCableFactor = 2.0;                                       // cable and bearings, 1.5 to 3: assumption
constexpr double kJointViscous = 5e-3;                                     // N m s/rad, 2e-3 to 1e-2: assumption
constexpr double kStribeckRatio = 1.3;                                     // assumption
constexpr double kStribeckSpeed = 0.05;                                    // rad/s, assumption
constexpr double kBristleAngle = 1e-3;                                     // rad, assumption (standard LuGre form)
constexpr double kBristleDampingInertia = 1e-3;  // kg m2, of the order of the arm seen by a joint: assumption

// End stops: hard rubber, assumption. 300 N m/rad gives way 2 deg under the strongest hand.
constexpr double kStopStiffness = 300.0;
constexpr double kStopDamping = 0.3;

ChannelParameters arm_channel(double lower_deg, double upper_deg) {
  ChannelParameters c;
  c.torque_constant = kTorqueConstant;
  c.resistance = kResistance;
  c.rotor_inertia = kRotorInertia;
  c.ratio = kCapstanRatio;
  c.amplifier_gain = kAmplifierGain;
  c.friction = {kMotorCoulomb * kCableFactor, kStribeckRatio, kStribeckSpeed, kBristleAngle,
                kBristleDampingInertia,       kJointViscous};
  c.stop = {lower_deg * kDegree, upper_deg * kDegree, kStopStiffness, kStopDamping};
  return c;
}

// The pinch: a small coreless motor whose pulley drives the jaws directly. Every value is an assumption; the thesis
// only proposes such an axis (chapter 5).
ChannelParameters pinch_channel() {
  ChannelParameters c;
  c.torque_constant = kTorqueConstant;  // same drive constants keep one kind of amplifier
  c.resistance = 4.0;                   // ohm
  c.rotor_inertia = 4.0e-7;             // kg m2: 6 g at the jaw
  c.ratio = 0.008;                      // m per radian: pulley radius 8 mm, 25 um a count, 12.5 N at +-10 V
  c.amplifier_gain = kAmplifierGain;
  c.friction = {0.04, 1.2, 0.005, 1e-5, 0.026, 0.4};  // N, -, m/s, m, kg, N s/m
  c.stop = {0.0, 0.030, 20000.0, 20.0};               // m, m, N/m, N s/m: travel 0 to 30 mm
  return c;
}

void set_masses(PlantParameters& p) {
  p.gravity = kGravity;
  p.link1 = 0.146;  // m, Table 2.3 [T]
  p.link2 = 0.128;  // m, Table 2.3 [T]
  // Weights and home positions of Table 4.1 [T]; the 12.5 mm offsets lie along Y (device notes), not X as printed.
  p.platform_masses[0] = {3.21 / kGravity, {0.0, -0.0125, 0.0095}};  // wrist motors
  p.platform_masses[1] = {0.20 / kGravity, {0.0, 0.0, -0.073}};      // link 1
  p.platform_masses[2] = {1.61 / kGravity, {0.0, 0.0125, -0.146}};   // elbow motor
  p.platform_inertia = 1e-4;                                         // kg m2, platform and legs: assumption
  p.leg_stop = 0.04;  // 2.3 deg before a leg locks up, below det A 0.05 where a controller faults: assumption
  p.stylus_mass = 0.76 / kGravity;        // link 2 and stylus at the stylus origin [T]
  p.stylus_inertia = {8e-5, 8e-5, 1e-5};  // kg m2, a 12 cm pen with its pinch: assumption
  p.jaw_mass = 0.020;                     // kg, jaw and finger pads: assumption
}

constexpr std::uint64_t kVariationStream = 0xD1B54A32D192ED03ull;  // apart from what draw_parameters draws

void vary_drive(ChannelParameters& c, PlantRandom& random) {
  c.torque_constant *= 1.0 + random.symmetric(0.05);
  c.resistance *= 1.0 + random.symmetric(0.08);
  c.rotor_inertia *= 1.0 + random.symmetric(0.05);
  c.ratio *= 1.0 + random.symmetric(1e-3);
  c.friction.stribeck_ratio = 1.0 + (c.friction.stribeck_ratio - 1.0) * random.log_normal(0.3);
  c.friction.stribeck_speed *= random.log_normal(0.3);
  c.friction.bristle_length *= random.log_normal(0.3);
  c.friction.damping_inertia *= random.log_normal(0.3);
}

void vary_stop(StopParameters& stop, double half_width, PlantRandom& random) {
  stop.lower += random.symmetric(half_width);
  stop.upper += random.symmetric(half_width);
  stop.stiffness *= random.log_normal(0.2);
  stop.damping *= random.log_normal(0.2);
}

}  // namespace

PlantParameters nominal_parameters() {
  PlantParameters p;
  set_masses(p);
  p.bus_voltage = kBusVoltage;
  p.dac_full_scale = 10.0;  // V [T]
  p.amplifier_time_constant = kAmplifierTau;
  p.current_limit = kAmplifierPeak;
  p.counts_per_turn = 2000;                                       // 500 lines, quadrature [T]
  for (int i = 0; i < 3; ++i) p.channel[i] = arm_channel(0, 90);  // limits: Table 2.4 [T]
  p.channel[3] = arm_channel(-120, 0);
  p.channel[4] = arm_channel(-160, 0);
  p.channel[5] = arm_channel(0, 0);
  p.channel[5].stop.lower = -std::numeric_limits<double>::infinity();  // roll is continuous
  p.channel[5].stop.upper = std::numeric_limits<double>::infinity();
  p.channel[kPinchChannel] = pinch_channel();
  p.jig_jaw_opening = 0.020;  // m, assumption: the jig's block between the jaws
  return p;
}

PlantParameters draw_parameters(std::uint64_t seed) {
  PlantRandom random(seed);
  PlantParameters p = nominal_parameters();
  for (PlatformMass& m : p.platform_masses) {
    m.mass *= 1.0 + random.symmetric(0.03);
    for (int axis = 0; axis < 3; ++axis) m.position_home[axis] += random.symmetric(0.5e-3);
  }
  p.stylus_mass *= 1.0 + random.symmetric(0.03);
  for (int axis = 0; axis < 3; ++axis) p.stylus_com[axis] = random.symmetric(0.5e-3);
  p.platform_inertia *= 1.0 + random.symmetric(0.1);
  p.jaw_mass *= 1.0 + random.symmetric(0.03);
  for (ChannelParameters& c : p.channel) {
    c.friction.coulomb *= random.log_normal(0.2);
    c.friction.viscous *= random.log_normal(0.2);
    c.dac_gain = 1.0 + random.symmetric(0.01);
    c.dac_offset = random.symmetric(5e-3);
    // Whole counters start anywhere in 32 bits; the fraction says where in a count the disc stands.
    c.encoder_offset_counts = static_cast<double>(static_cast<std::int32_t>(random.word())) + random.unit();
  }
  for (int i = 0; i < kArmJoints; ++i) p.jig_error[i] = random.symmetric(0.05 * kDegree);
  p.jig_jaw_opening += random.symmetric(0.1e-3);
  return p;
}

PlantParameters draw_everything(std::uint64_t seed) {
  PlantParameters p = draw_parameters(seed);
  PlantRandom random(seed ^ kVariationStream);
  p.leg_stop *= 1.0 + random.symmetric(0.1);
  p.link1 += random.symmetric(2e-5);  // home is nearly stretched: 0.1 mm would turn the elbow by 0.7 deg
  p.link2 += random.symmetric(2e-5);
  p.stylus_inertia *= 1.0 + random.symmetric(0.2);
  for (int axis = 0; axis < 3; ++axis) p.stylus_inertia[axis] *= 1.0 + random.symmetric(0.03);
  p.jaw_mass *= 1.0 + random.symmetric(0.1);
  p.bus_voltage *= 1.0 + random.symmetric(0.05);
  p.current_limit *= 1.0 + random.symmetric(0.05);
  p.amplifier_time_constant *= random.log_normal(0.3);
  for (int i = 0; i < kChannels; ++i) {
    vary_drive(p.channel[i], random);
    vary_stop(p.channel[i].stop, i == kPinchChannel ? 0.2e-3 : 0.5 * kDegree, random);
  }
  return p;
}

Mat3 stylus_inertia_tensor(const PlantParameters& p) {
  Mat3 I = p.stylus_inertia.asDiagonal();
  I(0, 1) = I(1, 0) = p.stylus_products[0];
  I(0, 2) = I(2, 0) = p.stylus_products[1];
  I(1, 2) = I(2, 1) = p.stylus_products[2];
  return I;
}

}  // namespace trocar
