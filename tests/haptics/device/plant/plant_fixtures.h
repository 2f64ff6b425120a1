// Devices and poses that several tests of the plant use.
#pragma once

#include <limits>
#include <numbers>

#include "haptics/device/plant/device_plant.h"
#include "haptics/device/plant/plant_random.h"

namespace trocar::test {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// Nominal device without friction or end stops: only inertia, weight and motors are left.
inline PlantParameters conservative_parameters() {
  PlantParameters p = nominal_parameters();
  for (ChannelParameters& c : p.channel) {
    c.friction.coulomb = 0;
    c.friction.viscous = 0;
    c.stop.lower = -std::numeric_limits<double>::infinity();
    c.stop.upper = std::numeric_limits<double>::infinity();
  }
  return p;
}

/// Drive without lag or limits: the load asked for is the load at the output.
inline void idealise_drive(PlantParameters& p) {
  p.amplifier_time_constant = 1e-12;
  p.bus_voltage = 1e6;
  p.current_limit = 1e6;
}

/// Command volts that make the motors deliver these loads at the outputs.
inline ChannelVector volts_for(const PlantParameters& p, const JointVector& tau, double jaw_force = 0) {
  ChannelVector volts;
  for (int i = 0; i < kChannels; ++i) {
    const ChannelParameters& c = p.channel[i];
    volts[i] = (i < kArmJoints ? tau[i] : jaw_force) * c.ratio / (c.torque_constant * c.amplifier_gain);
  }
  return volts;
}

/// Joint angles inside the limits of Table 2.4, margin_deg away from them and from the shoulder's corners.
inline JointVector random_joints(PlantRandom& random, double margin_deg = 10) {
  for (;;) {
    JointVector q;
    for (int i = 0; i < 3; ++i) q[i] = (margin_deg + (90 - 2 * margin_deg) * random.unit()) * kDegree;
    q[3] = -(margin_deg + (120 - 2 * margin_deg) * random.unit()) * kDegree;
    q[4] = -(margin_deg + (160 - 2 * margin_deg) * random.unit()) * kDegree;
    q[5] = random.symmetric(std::numbers::pi);
    const double det =
        std::sin(q[0]) * std::sin(q[1]) * std::sin(q[2]) + std::cos(q[0]) * std::cos(q[1]) * std::cos(q[2]);
    if (det > 0.3) return q;
  }
}

inline Vec3 random_vector(PlantRandom& random, double half_width) {
  return {random.symmetric(half_width), random.symmetric(half_width), random.symmetric(half_width)};
}

/// d(f)/dq_i by the five-point rule: error of order h^4, 1e-12 here.
template <class F>
auto derivative(const F& f, const JointVector& q, int i, double h = 1e-3) {
  const auto at = [&](double offset) {
    JointVector moved = q;
    moved[i] += offset;
    return f(moved);
  };
  using Value = decltype(f(q));
  return Value((at(-2 * h) - at(2 * h) + 8.0 * (at(h) - at(-h))) / (12.0 * h));
}

}  // namespace trocar::test
