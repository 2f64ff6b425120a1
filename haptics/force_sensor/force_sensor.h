// A force sensor at the stylus as its task sees it: one sample a call, at the sensor's own rate and lag.
//
// A simulated sensor gives force only, N, in the axes of what it is given; a real one force and moment in its own axes.
// Thread: the sensor task's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

struct ForceSensorConfig {
  double rate_hz = 40;         ///< serial link of the thesis
  double lag_s = 0.15;         ///< measured in the thesis
  double noise_n = 0.020;      ///< SD on each axis [assumed]
  double drift_n_per_h = 0.1;  ///< of the zero [assumed]
};

struct ForceSample {
  std::uint64_t number = 0;       ///< counts from 1
  Vec3 force = Vec3::Zero();      ///< N, as it was lag_s ago
  bool valid = false;             ///< the delay line is full; a real one vouches for it
  Vec3 moment_nm = Vec3::Zero();  ///< of a real one, about its origin
};

class ForceSensor {
 public:
  virtual ~ForceSensor() = default;
  /// One sample. @param acting force of the simulated world at this moment, N; a real sensor measures for itself.
  virtual ForceSample sample(const Vec3& acting) = 0;
  virtual const ForceSensorConfig& config() const = 0;
  /// Samples between a force and its appearance.
  virtual std::size_t delay() const = 0;
};

}  // namespace trocar
