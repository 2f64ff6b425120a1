// A simulated force sensor at the stylus: what it is given comes out late, noisy, drifting and at its own rate.
//
// Plant model of the reference (measured force lags by 0.15 s at 40 Hz): pure delay of a whole number of samples, white
// noise on each axis, slow zero drift along one direction drawn by the seed. Force only; axes are those of what it is
// given, N. Thread: the sensor task's; no allocation after construction.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "haptics/force_sensor/force_sensor.h"

namespace trocar {

class SimulatedForceSensor final : public ForceSensor {
 public:
  /// @throws std::invalid_argument when rate, lag or noise are negative, not finite, or the lag exceeds 10 s.
  SimulatedForceSensor(const ForceSensorConfig& config, std::uint64_t seed);

  ForceSample sample(const Vec3& acting) override;
  const ForceSensorConfig& config() const override { return config_; }
  std::size_t delay() const override { return line_.size() - 1; }

 private:
  double normal();

  ForceSensorConfig config_;
  std::mt19937_64 random_;
  std::vector<Vec3> line_;  ///< ring: the newest forces
  Vec3 drift_per_sample_;
  std::uint64_t number_ = 0;
};

}  // namespace trocar
