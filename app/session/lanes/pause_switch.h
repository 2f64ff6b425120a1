// Lets the lanes of a live run stand still, and the clock of the run with them: a pause is time that has not passed.
//
// Only for a device that can stand still, which is the simulated one. A lane that wakes during a pause waits;
// afterwards all its wished times lie later by what the pause took, so that nothing counts as missed and no lane moves
// against another. The window asks for one (of a person), and the lane of a board that does not answer. Threads: any.
#pragma once

#include <time.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace trocar {

class PauseSwitch {
 public:
  struct Pause {
    std::int64_t begin_ns = 0, end_ns = 0;  ///< CLOCK_MONOTONIC
  };

  /// Who asks for it; the run stands still while anybody does.
  enum class Cause : std::uint8_t { kPerson = 1, kBoard = 2 };

  void set(bool paused, Cause cause = Cause::kPerson) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto bit = static_cast<std::uint8_t>(cause);
    const std::uint8_t before = causes_.load(), after = paused ? before | bit : before & ~bit;
    causes_.store(after);
    if ((before != 0) == (after != 0)) return;
    const std::int64_t now = now_ns();
    if (after != 0) {
      pauses_.push_back({now, now});
    } else {
      pauses_.back().end_ns = now;
      stood_ns_ += now - pauses_.back().begin_ns;  // before the lanes may go on
    }
    paused_.store(after != 0);
  }
  bool paused() const noexcept { return paused_.load(); }
  bool asked_by(Cause cause) const noexcept { return (causes_.load() & static_cast<std::uint8_t>(cause)) != 0; }
  /// All pauses that have ended, together. A lane asks after paused() said no.
  std::int64_t stood_ns() const noexcept { return stood_ns_.load(); }
  /// One that has not ended lasts until now.
  std::vector<Pause> pauses() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Pause> out = pauses_;
    if (paused_.load()) out.back().end_ns = now_ns();
    return out;
  }

 private:
  static std::int64_t now_ns() {
    timespec now;
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
  }

  std::atomic<std::uint8_t> causes_{0};
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> stood_ns_{0};
  mutable std::mutex mutex_;
  std::vector<Pause> pauses_;
};

}  // namespace trocar
