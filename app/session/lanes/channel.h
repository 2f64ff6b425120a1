// Makes the channel that carries the newest value from one task to one other. The tasks see its ends only (Outlet and
// Inlet, delayed_channel.h) and do not know what lies behind: in lockstep a
// DelayedChannel (seen a declared number of ticks after it was published), live a LiveChannel (wait-free, seen at
// once).
//
// Threads: an Outlet belongs to the writing task's, an Inlet to the reading task's.
#pragma once

#include <cstdint>
#include <memory>

#include "app/session/lanes/delayed_channel.h"
#include "haptics/exchange/latest.h"

namespace trocar {

/// A channel between threads: newest wins. The ticks of the two tasks are not compared.
template <typename T>
class LiveChannel final : public Channel<T> {
 public:
  explicit LiveChannel(const T& initial = T{}) : latest_(initial) {}
  T& begin(std::uint64_t) noexcept override { return latest_.back(); }
  void commit() noexcept override { latest_.publish(); }
  const T& newest(std::uint64_t) noexcept override { return latest_.read(); }

 private:
  Latest<T> latest_;
};

/// What drives the tasks of a run.
enum class Timing : std::uint8_t { kLockstep, kLive };

/// @param delay lockstep only: ticks from publication to visibility.
template <typename T>
std::unique_ptr<Channel<T>> make_channel(Timing timing, std::uint64_t delay = 0) {
  if (timing == Timing::kLive) return std::make_unique<LiveChannel<T>>();
  return std::make_unique<DelayedChannel<T>>(delay);
}

}  // namespace trocar
