// A simulated force sensor at the stylus: what it is given comes out late, noisy, drifting and at its own rate.
//
// Plant model of the reference (measured force lags by 0.15 s at 40 Hz): pure delay of a whole number of samples, white
// noise on each axis, slow zero drift along one direction drawn by the seed. Force only; axes are those of what it is
// given, N. Thread: the sensor task's; no allocation after construction.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

struct ForceSensorConfig {
  double rate_hz = 40;         ///< serial link of the thesis
  double lag_s = 0.15;         ///< measured in the thesis
  double noise_n = 0.020;      ///< SD on each axis [assumed]
  double drift_n_per_h = 0.1;  ///< of the zero [assumed]
};

struct ForceSample {
  std::uint64_t number = 0;   ///< counts from 1
  Vec3 force = Vec3::Zero();  ///< N, as it was lag_s ago
  bool valid = false;         ///< the delay line is full
};

class SimulatedForceSensor {
 public:
  /// @throws std::invalid_argument when rate, lag or noise are negative, not finite, or the lag exceeds 10 s.
  SimulatedForceSensor(const ForceSensorConfig& config, std::uint64_t seed);

  /// One sample. @param force true force now, N.
  ForceSample sample(const Vec3& force);

  const ForceSensorConfig& config() const { return config_; }
  /// Samples between a force and its appearance.
  std::size_t delay() const { return line_.size() - 1; }

 private:
  double normal();

  ForceSensorConfig config_;
  std::mt19937_64 random_;
  std::vector<Vec3> line_;  ///< ring: the newest forces
  Vec3 drift_per_sample_;
  std::uint64_t number_ = 0;
};

}  // namespace trocar
