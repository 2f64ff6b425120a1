// Velocity of one quantised channel by a steady-state Kalman filter of constant acceleration.
//
// State (x, v, a), jerk white of spectral density q, measurement noise R = quantum^2 / 12 (a uniform count). Only q / R
// and the period shape the gains: they are iterated to their steady state once, at construction. At 1 kHz with q / R =
// 1e3 / (0.208e-3^2 / 12) they are (0.39995, 101.58 1/s, 12900.9 1/s2) (haptics notes 1.9). No lag on steady motion; at
// rest a flickering count keeps it humming, where velocity_estimator.h is exactly zero. Thread: haptic task; no
// allocation after construction.
#pragma once

#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

/// Jerk density over squared quantum, s^-5: 1e3 m2/s5 for a tip that moves 0.208 mm a count.
inline constexpr double kJerkDensityPerQuantum2 = 1e3 / (0.208e-3 * 0.208e-3);

class KalmanVelocity {
 public:
  KalmanVelocity(double quantum, double period_s);

  void reset() { started_ = false; }
  /// @param count position in counts; @param elapsed_periods since the last sample. @return velocity, unit/s.
  double update(std::int64_t count, std::uint32_t elapsed_periods);
  /// Gains of position (1), velocity (1/s) and acceleration (1/s2) on the innovation.
  const Vec3& gains() const { return gain_; }

 private:
  double quantum_, period_s_;
  Mat3 step_;  ///< of the state over one period, in counts
  Vec3 gain_;
  Vec3 state_ = Vec3::Zero();  ///< counts from origin_, counts/s, counts/s2
  std::int64_t origin_ = 0;    ///< keeps the state small whatever the counter reads
  bool started_ = false;
};

}  // namespace trocar
