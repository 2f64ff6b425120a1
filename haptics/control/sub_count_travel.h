// How far a quantised channel has truly moved, to a fraction of a count.
//
// A count n says no more than that the position lies in [n, n + 1). Inside it the position is followed with the
// estimated velocity and kept within the bounds: x = clamp(x + v T, n, n + 1). Moving, that interpolates between the
// edges; at rest a count that flickers leaves x at the edge, where the stylus truly is: booked as travel, each flicker
// would be a whole count of work that nobody did. Slower than kCreep, where the velocity is one count over the whole
// window or nothing, the position is not interpolated. Units: counts. Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

class SubCountTravel {
 public:
  using Counts = std::array<std::int64_t, kChannels>;

  static constexpr double kCreep = 100;  ///< counts/s

  /// Takes these counts as where the channels stand.
  void reset(const Counts& counts) {
    for (int i = 0; i < kChannels; ++i) position_[i] = middle(counts, i);
  }
  /// @param counts rounded down; @param velocity estimated, counts/s; @param seconds since the last call.
  /// @param known where the board's edges put a channel, counts; NaN: they do not. @return way since the last call.
  ChannelVector advance(const Counts& counts, const ChannelVector& velocity, double seconds,
                        const ChannelVector& known = ChannelVector::Constant(std::nan(""))) {
    const ChannelVector before = position_;
    for (int i = 0; i < kChannels; ++i) {
      const double low = middle(counts, i) - 0.5;
      const double expected = std::abs(velocity[i]) < kCreep ? 0 : velocity[i] * seconds;
      position_[i] = std::isnan(known[i]) ? std::clamp(position_[i] + expected, low, low + 1) : known[i];
    }
    return position_ - before;
  }

 private:
  static double middle(const Counts& counts, int i) {
    return static_cast<double>(counts[static_cast<std::size_t>(i)]) + 0.5;
  }
  ChannelVector position_ = ChannelVector::Constant(0.5);
};

}  // namespace trocar
