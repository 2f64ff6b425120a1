// The loop's own memory of what happened: every change of state, with the last 2 s of ticks before it.
//
// Ticks go into a bank, a ring of 2 s. Shortly after a change of state the bank is closed and the next one begins, so
// that the banks together hold at least 2 s before each of the latest changes without anything being copied in the
// tick. The oldest bank is used again; that of a fault stays closed, and the log stands still, until the operator's
// reset. A reset that ends in another fault within its tick is a change too. All memory is taken in the constructor;
// add() allocates nothing. Thread: haptic task; read it when the loop does not run.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/exchange/tick_record.h"

namespace trocar {

struct SafetyRow {
  std::uint64_t tick = 0, period = 0;
  std::array<std::int32_t, kChannels> counts{}, codes{};
  std::uint32_t elapsed_periods = 0, digital_in = 0;
  WarningBits warnings = 0;
  std::uint8_t valid = 0;
  LoopState state = LoopState::kOff;

  bool operator==(const SafetyRow&) const = default;
};

struct SafetyTransition {
  std::uint64_t tick = 0, period = 0;
  LoopState from = LoopState::kOff, to = LoopState::kOff;
  Fault fault;  ///< cause, when `to` is FAULT
};

class SafetyLog {
 public:
  static constexpr double kBefore_s = 2.0, kAfter_s = 0.1;
  static constexpr int kBanks = 8;
  static constexpr std::size_t kTransitions = 64;

  explicit SafetyLog(double rate_hz);

  void add(const TickRecord& record);
  /// The first kTransitions changes of state.
  std::vector<SafetyTransition> transitions() const { return {transitions_.begin(), transitions_.begin() + count_}; }
  std::uint64_t transitions_lost() const { return lost_; }
  /// Ticks still held, in order of time.
  std::vector<SafetyRow> rows() const;

 private:
  struct Bank {
    std::vector<SafetyRow> ring;
    std::size_t next = 0, filled = 0;
  };

  void note(const TickRecord& record);
  void keep(const TickRecord& record);

  std::array<Bank, kBanks> banks_;
  int bank_ = 0;
  std::uint64_t after_ticks_, until_close_ = 0;  ///< ticks after a change; left of them, 0: none awaited
  bool closed_ = false;                          ///< a fault's bank is closed
  LoopState last_ = LoopState::kOff;
  std::uint64_t fault_tick_ = 0;  ///< of the last change to FAULT
  std::array<SafetyTransition, kTransitions> transitions_{};
  std::ptrdiff_t count_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace trocar
