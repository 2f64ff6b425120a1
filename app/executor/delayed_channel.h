// A value published now and seen a declared number of ticks later: the lockstep form of a channel between tasks.
//
// Newest wins; a reader sees the newest value whose delay has passed. Thread: lockstep, one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

namespace trocar {

template <typename T>
class DelayedChannel {
 public:
  /// @param delay ticks from publish to visibility. @param initial what is seen before the first.
  explicit DelayedChannel(std::uint64_t delay, const T& initial = T{}) : delay_(delay) {
    for (auto& slot : slots_) slot = std::make_unique<Slot>(Slot{initial, 0});
  }

  /// The value to fill; it becomes visible at tick + delay. At most one publication may be under way.
  T& begin_publish(std::uint64_t tick) {
    settle(tick);
    slots_[1]->visible_from = tick + delay_;
    pending_ = true;
    return slots_[1]->value;
  }

  const T& read(std::uint64_t tick) {
    settle(tick);
    return slots_[0]->value;
  }

 private:
  struct Slot {
    T value;
    std::uint64_t visible_from;
  };
  void settle(std::uint64_t tick) {
    if (!pending_ || tick < slots_[1]->visible_from) return;
    std::swap(slots_[0], slots_[1]);
    pending_ = false;
  }

  std::uint64_t delay_;
  std::array<std::unique_ptr<Slot>, 2> slots_;
  bool pending_ = false;
};

}  // namespace trocar
