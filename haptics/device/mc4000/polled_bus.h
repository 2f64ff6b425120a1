// A board whose SYNC is seen in its flag register, in real time: rests until shortly before one is due, then polls. So
// the board paces the loop, whatever the phase and drift of its timer against the computer's clock.
//
// A flag does not count. Periods go by the computer's clock since the SYNC before, whose time is kept: a whole number
// of periods on, but after the last look that did not see the flag, and before the first that did. Thread: as
// RegisterBus.
#pragma once

#include <cstdint>
#include <optional>

#include "haptics/device/mc4000/register_bus.h"

namespace trocar {

class PolledBus : public RegisterBus {
 public:
  /// @param rate_hz of the SYNC.
  explicit PolledBus(double rate_hz) : period_s_(1 / rate_hz) {}

  std::uint32_t await_sync(std::uint32_t flags, std::uint32_t flag) noexcept final;
  bool tells_sync() const noexcept final { return true; }

 private:
  virtual double now_s() noexcept = 0;  ///< of a clock that only goes on
  /// Returns at `look_s`, at once if that has passed; where an interrupt is heard, at it, or at `limit_s`.
  virtual void rest(double look_s, double limit_s) noexcept = 0;
  std::uint32_t seen(std::optional<double> unset_s, double now_s) noexcept;

  double period_s_;
  std::optional<double> sync_s_;  ///< when the last one came, as far as known
};

}  // namespace trocar
