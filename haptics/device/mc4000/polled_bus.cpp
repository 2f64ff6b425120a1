#include "haptics/device/mc4000/polled_bus.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

// Shares of a period.
constexpr double kLongestWait = 1.5;
constexpr double kLookBefore = 0.125;  // a SYNC is due: more than a wake is late by
constexpr double kEarly = 0.05;        // by which one may come before its time, by drift and late wakes

}  // namespace

std::uint32_t PolledBus::await_sync(std::uint32_t flags, std::uint32_t flag) noexcept {
  const double start = now_s(), limit = start + kLongestWait * period_s_;
  const double look = sync_s_ ? *sync_s_ + (1 - kLookBefore) * period_s_ : start;
  std::optional<double> unset;
  for (double now = start;; now = now_s()) {
    const std::uint32_t word = read(flags);
    if (word == ~0U) return 0;  // no board answers
    if (word & flag) return seen(unset, now);
    if (now >= limit) return 0;
    unset = now;
    rest(look, limit);
  }
}

/// @param unset_s of the last look in this wait that did not see the flag.
std::uint32_t PolledBus::seen(std::optional<double> unset_s, double now_s) noexcept {
  if (!sync_s_) {
    sync_s_ = now_s;
    return 1;
  }
  const double passed = std::max(1.0, std::floor((now_s - *sync_s_) / period_s_ + kEarly));
  const double due = *sync_s_ + passed * period_s_;  // late wakes do not move it
  sync_s_ = std::min(std::max(due, unset_s.value_or(due)), now_s);
  return static_cast<std::uint32_t>(passed);
}

}  // namespace trocar
