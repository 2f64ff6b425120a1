#include "haptics/force_sensor/simulated_force_sensor.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trocar {
namespace {

constexpr double kLongestLag_s = 10;

const ForceSensorConfig& checked(const ForceSensorConfig& c) {
  const bool good = std::isfinite(c.rate_hz) && c.rate_hz > 0 && c.lag_s >= 0 && c.lag_s <= kLongestLag_s &&
                    c.noise_n >= 0 && std::isfinite(c.noise_n) && std::isfinite(c.drift_n_per_h);
  if (!good) throw std::invalid_argument("force sensor: rate, lag, noise or drift out of range");
  return c;
}

}  // namespace

SimulatedForceSensor::SimulatedForceSensor(const ForceSensorConfig& config, std::uint64_t seed)
    : config_(checked(config)),
      random_(seed),
      line_(1 + static_cast<std::size_t>(std::llround(config.lag_s * config.rate_hz)), Vec3::Zero()) {
  Vec3 direction(normal(), normal(), normal());
  drift_per_sample_ = direction.normalized() * (config.drift_n_per_h / (3600 * config.rate_hz));
}

/// Box and Muller, so that a seed means the same on every standard library.
double SimulatedForceSensor::normal() {
  const auto uniform = [&] { return static_cast<double>(random_() >> 11) * 0x1p-53; };
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

ForceSample SimulatedForceSensor::sample(const Vec3& acting) {
  line_[number_ % line_.size()] = acting;
  ++number_;
  ForceSample out;
  out.number = number_;
  out.valid = number_ >= line_.size();
  if (!out.valid) return out;
  out.force = line_[number_ % line_.size()] + static_cast<double>(number_) * drift_per_sample_;
  for (int axis = 0; axis < 3; ++axis) out.force[axis] += config_.noise_n * normal();
  return out;
}

}  // namespace trocar
