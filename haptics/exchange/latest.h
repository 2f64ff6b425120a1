// Latest<T>: the newest whole value from one writer to one reader, wait-free on both sides. Newest wins; what the
// reader did not fetch in time is overwritten unseen.
//
// Triple buffer: the writer owns one slot, the reader another, the third waits between them under `middle_` with a bit
// that says whether it is newer than what the reader holds. Both sides hand over by one exchange, so a value is never
// torn and nobody ever waits. For several readers give each its own Latest.
// Orders: each exchange releases what its side did to the slot that it gives away and acquires what the other side did
// to the slot that it receives: the reader sees the whole value, and the writer overwrites a slot only after the
// reader's last look. Threads: back() and publish() one thread, read() one other. No allocation unless T's own
// assignment does.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace trocar {

/// What two cores share at once. A constant and not std::hardware_destructive_interference_size: that one may differ
/// between two objects of one program, as the compiler warns.
inline constexpr std::size_t kCacheLine = 64;

template <typename T>
class Latest {
 public:
  /// @param initial what is read before the first publication.
  explicit Latest(const T& initial = T{}) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}
  Latest(const Latest&) = delete;
  Latest& operator=(const Latest&) = delete;

  /// Writer: the value to fill. It holds an old value, not necessarily the newest: fill all of it.
  T& back() noexcept { return slots_[back_].value; }
  /// Writer: hands over what back() holds.
  void publish() noexcept {
    const std::uint8_t given = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel);
    back_ = given & kIndex;
  }
  void write(const T& value) {
    back() = value;
    publish();
  }

  /// Reader: the newest value. The reference stays valid and unchanged until the next read().
  const T& read() noexcept {
    if (fresh()) front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return slots_[front_].value;
  }
  /// Reader: whether the next read() brings something new.
  bool fresh() const noexcept { return middle_.load(std::memory_order_relaxed) & kFresh; }

 private:
  static constexpr std::uint8_t kIndex = 3, kFresh = 4;
  struct alignas(kCacheLine) Slot {
    T value;
  };

  std::array<Slot, 3> slots_;
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{1};
  alignas(kCacheLine) std::uint8_t back_ = 0;   ///< writer's slot
  alignas(kCacheLine) std::uint8_t front_ = 2;  ///< reader's slot
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);
};

}  // namespace trocar
