// A simulated force/torque sensor at the stylus with a fixture that hangs on it: force and moment late, noisy,
// drifting.
//
//   F_S = R_WS^T (F_on_hand + m g),   M_S = R_WS^T M_on_hand + c_S x (R_WS^T m g)
// each through a SimulatedForceSensor of its own (one rate and lag). m, c_S: mass of the fixture and its centre in the
// stylus frame; moments about the stylus origin. Noise 20 mN and 0.5 mN m, drift 0.1 N/h, 40 Hz, 0.15 s (reference).
// SI. Thread: the sensor task's; sample() does not allocate.
#pragma once

#include <cstdint>
#include <vector>

#include "haptics/force_sensor/simulated_force_sensor.h"

namespace trocar {

struct WrenchSensorConfig {
  ForceSensorConfig force;         ///< its rate and lag are the moment's too
  double noise_nm = 0.5e-3;        ///< SD on each axis [assumed]
  double drift_nm_per_h = 2.5e-3;  ///< of the zero [assumed, the force's share]
  double fixture_kg = 0;
  Vec3 fixture_com = Vec3::Zero();  ///< m, in S
  double gravity = 9.81;            ///< m/s2
};

struct WrenchSample {
  std::uint64_t number = 0;  ///< counts from 1
  bool valid = false;        ///< the delay line is full
  Wrench read;               ///< in S, as it was lag_s ago
  Wrench without_fixture;    ///< the same less the fixture's weight as the stylus was turned then
};

class SimulatedWrenchSensor {
 public:
  /// @param seed of the force's noise; the moment's is the next. @throws std::invalid_argument.
  SimulatedWrenchSensor(const WrenchSensorConfig& config, std::uint64_t seed);

  /// One sample. @param on_hand what the device exerts on the hand, in W', moment about the stylus origin.
  WrenchSample sample(const Mat3& R_WS, const Wrench& on_hand_W);

  const WrenchSensorConfig& config() const { return config_; }
  std::size_t delay() const { return force_.delay(); }

 private:
  WrenchSensorConfig config_;
  SimulatedForceSensor force_, moment_;
  std::vector<Vec3> weight_;  ///< ring: of the fixture in S, N
};

}  // namespace trocar
