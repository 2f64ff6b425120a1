// Velocity of one quantised channel: first-order adaptive windowing (FOAW).
//
// Janabi-Sharifi, Hayward and Chen, "Discrete-time adaptive windowing for velocity estimation", IEEE T-CST 8 (2000):
// the longest window n whose straight line from x(k-n) to x(k) passes every sample within +-delta gives
// v = (x(k) - x(k-n)) / (n T). At rest it is exactly zero; one count of this device would read 0.21 m/s at the tip by
// backward difference. Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace trocar {

class VelocityEstimator {
 public:
  static constexpr int kWindow = 16;     ///< periods at 1 kHz and below; 16 ms at faster rates,
  static constexpr int kMaxWindow = 64;  ///< up to these

  /// @param quantum size of one count in the channel's unit; @param period_s sample period.
  VelocityEstimator(double quantum, double period_s)
      : quantum_(quantum),
        period_s_(period_s),
        longest_(std::clamp(static_cast<int>(std::lround(kWindow * 1e-3 / period_s)), kWindow, kMaxWindow)) {}

  /// Forgets the past: the next samples start a new window.
  void reset() { filled_ = 0; }

  /// @param count position in counts; @param elapsed_periods since the last sample. @return velocity, unit/s.
  double update(std::int64_t count, std::uint32_t elapsed_periods);

  /// Length of the window used last, in periods: half of it is the lag.
  int window() const { return window_; }

 private:
  bool line_fits(int n) const;
  std::int64_t at(int age) const { return history_[(head_ + kMaxWindow + 1 - age) % (kMaxWindow + 1)]; }

  double quantum_, period_s_;
  int longest_;
  std::array<std::int64_t, kMaxWindow + 1> history_{};
  int head_ = 0, filled_ = 0, window_ = 0;
};

}  // namespace trocar
