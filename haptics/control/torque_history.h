// Torques asked of the boards, tick by tick: which of them acted in the periods just past.
//
// What a tick writes acts from the SYNC after the next one on: one period of delay, plus what the boards are known to
// add. A period without a tick keeps what was written before. Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <array>

#include "haptics/quantities.h"

namespace trocar {

class TorqueHistory {
 public:
  static constexpr int kLength = 128;

  /// What this tick has asked for.
  void add(const ChannelVector& torque) {
    newest_ = (newest_ + 1) % kLength;
    asked_[static_cast<std::size_t>(newest_)] = torque;
  }
  /// Disarmed: nothing acts and nothing is on its way.
  void clear() { asked_.fill(ChannelVector::Zero()); }

  /// Mean torque that acted during the `periods` since the last tick; call once a tick, before add(). Periods beyond
  /// half the history and delays beyond its other half are taken at those bounds.
  ChannelVector acted(int periods, int delay_periods) {
    periods = std::clamp(periods, 1, kLength / 2);
    const int delay = std::clamp(delay_periods, 0, kLength / 2 - 2);
    const ChannelVector kept = asked_[static_cast<std::size_t>(newest_)];
    for (int missed = 1; missed < periods; ++missed) add(kept);
    ChannelVector sum = ChannelVector::Zero();
    for (int age = 1; age <= periods; ++age) sum += at(age + delay);
    return sum / periods;
  }

 private:
  /// @param age ticks or missed periods before the newest.
  const ChannelVector& at(int age) const {
    return asked_[static_cast<std::size_t>((newest_ + kLength - age) % kLength)];
  }

  std::array<ChannelVector, kLength> asked_ = [] {
    std::array<ChannelVector, kLength> zero;
    zero.fill(ChannelVector::Zero());
    return zero;
  }();
  int newest_ = 0;
};

}  // namespace trocar
