#include "haptics/force_sensor/simulated_wrench_sensor.h"

#include <cmath>
#include <stdexcept>

namespace trocar {
namespace {

ForceSensorConfig moment_line(const WrenchSensorConfig& c) {
  if (!(c.fixture_kg >= 0) || !std::isfinite(c.fixture_kg) || !c.fixture_com.allFinite() || !std::isfinite(c.gravity)) {
    throw std::invalid_argument("force sensor: the fixture's mass or place is out of range");
  }
  return {c.force.rate_hz, c.force.lag_s, c.noise_nm, c.drift_nm_per_h};
}

}  // namespace

SimulatedWrenchSensor::SimulatedWrenchSensor(const WrenchSensorConfig& config, std::uint64_t seed)
    : config_(config),
      force_(config.force, seed),
      moment_(moment_line(config), seed + 1),
      weight_(force_.delay() + 1, Vec3::Zero()) {}

WrenchSample SimulatedWrenchSensor::sample(const Mat3& R_WS, const Wrench& on_hand_W) {
  const Mat3 R_SW = R_WS.transpose();
  const Vec3 weight = R_SW * Vec3(0, 0, -config_.fixture_kg * config_.gravity);
  const ForceSample force = force_.sample(R_SW * on_hand_W.force + weight);
  const ForceSample moment = moment_.sample(R_SW * on_hand_W.moment + config_.fixture_com.cross(weight));
  weight_[force.number % weight_.size()] = weight;
  WrenchSample out;
  out.number = force.number;
  out.valid = force.valid;
  if (!out.valid) return out;
  out.read = {force.force, moment.force};
  const Vec3& then = weight_[(force.number + 1) % weight_.size()];
  out.without_fixture = {force.force - then, moment.force - config_.fixture_com.cross(then)};
  return out;
}

}  // namespace trocar
