// Ring<T, N>: every value from one producer to one consumer, in order, wait-free on both sides. When it is full the new
// value is dropped and counted, never an old one overwritten: what arrives is without a gap up to the first drop, which
// is reported.
//
// Lamport's queue: the producer alone moves `written_`, the consumer alone `taken_`; each keeps a copy of the other's
// counter and looks at the real one only when the copy says full or empty, so that their cache lines seldom travel.
// Orders: the release of a counter carries the value written or the slot freed, the other side's acquire receives it.
// Threads: push() and dropped() one thread (dropped() any), pop() one other. No allocation unless T's assignment does.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "haptics/exchange/latest.h"

namespace trocar {

template <typename T, std::size_t N>
class Ring {
  static_assert(std::has_single_bit(N), "the capacity is a power of two");
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  Ring() = default;
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  /// Producer. @return false when the ring is full: the value is dropped and counted.
  bool push(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    const std::uint64_t written = written_.load(std::memory_order_relaxed);
    if (written - taken_seen_ == N) {
      taken_seen_ = taken_.load(std::memory_order_acquire);
      if (written - taken_seen_ == N) {
        dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    slots_[written % N] = value;
    written_.store(written + 1, std::memory_order_release);
    return true;
  }

  /// Consumer. @return false when there is nothing.
  bool pop(T& value) noexcept(std::is_nothrow_move_assignable_v<T>) {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    if (taken == written_seen_) {
      written_seen_ = written_.load(std::memory_order_acquire);
      if (taken == written_seen_) return false;
    }
    value = std::move(slots_[taken % N]);
    taken_.store(taken + 1, std::memory_order_release);
    return true;
  }

  /// Values that found no room, so far.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
  static constexpr std::size_t capacity() { return N; }

 private:
  alignas(kCacheLine) std::array<T, N> slots_{};
  alignas(kCacheLine) std::atomic<std::uint64_t> written_{0};
  std::uint64_t taken_seen_ = 0;           ///< producer's copy
  std::atomic<std::uint64_t> dropped_{0};  ///< written by the producer only
  alignas(kCacheLine) std::atomic<std::uint64_t> taken_{0};
  std::uint64_t written_seen_ = 0;  ///< consumer's copy
};

}  // namespace trocar
