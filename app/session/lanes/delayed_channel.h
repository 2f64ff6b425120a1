// A channel between tasks as the tasks see it (Outlet, Inlet), and its lockstep form: a value published now and seen a
// declared number of ticks later. The live form and the choice between them: channel.h.
//
// Newest wins; a reader sees the newest value whose delay has passed.
// Thread: lockstep, one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

namespace trocar {

/// The writing end. begin() gives the value to fill (it holds an old one: fill all of it), commit() publishes it.
template <typename T>
class Outlet {
 public:
  virtual ~Outlet() = default;
  /// @param tick of the writing task's call.
  virtual T& begin(std::uint64_t tick) noexcept = 0;
  virtual void commit() noexcept = 0;

  void write(std::uint64_t tick, const T& value) {
    begin(tick) = value;
    commit();
  }
};

/// The reading end.
template <typename T>
class Inlet {
 public:
  virtual ~Inlet() = default;
  /// @param tick of the reading task's call. @return valid until the next call.
  virtual const T& newest(std::uint64_t tick) noexcept = 0;
};

template <typename T>
class Channel : public Outlet<T>, public Inlet<T> {};

template <typename T>
class DelayedChannel final : public Channel<T> {
 public:
  /// @param delay ticks from publication to visibility. @param initial what is seen before the first.
  explicit DelayedChannel(std::uint64_t delay, const T& initial = T{}) : delay_(delay) {
    for (auto& slot : slots_) slot = std::make_unique<Slot>(Slot{initial, 0});
  }

  /// At most one publication may be under way: one that is not yet visible is replaced.
  T& begin(std::uint64_t tick) noexcept override {
    settle(tick);
    slots_[1]->visible_from = tick + delay_;
    return slots_[1]->value;
  }
  void commit() noexcept override { pending_ = true; }

  const T& newest(std::uint64_t tick) noexcept override {
    settle(tick);
    return slots_[0]->value;
  }

 private:
  struct Slot {
    T value;
    std::uint64_t visible_from;
  };
  void settle(std::uint64_t tick) noexcept {
    if (!pending_ || tick < slots_[1]->visible_from) return;
    std::swap(slots_[0], slots_[1]);
    pending_ = false;
  }

  std::uint64_t delay_;
  std::array<std::unique_ptr<Slot>, 2> slots_;
  bool pending_ = false;
};

}  // namespace trocar
