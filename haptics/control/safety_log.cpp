#include "haptics/control/safety_log.h"

#include <algorithm>
#include <cmath>

namespace trocar {

SafetyLog::SafetyLog(double rate_hz) : after_ticks_(static_cast<std::uint64_t>(std::lround(kAfter_s * rate_hz))) {
  // A bank also holds the moment after the change, else a full one would have less than kBefore_s before it.
  for (Bank& bank : banks_) bank.ring.resize(static_cast<std::size_t>(std::lround((kBefore_s + kAfter_s) * rate_hz)));
}

void SafetyLog::add(const TickRecord& record) {
  const StylusState& s = record.stylus;
  if (s.loop != last_ || (s.loop == LoopState::kFault && s.fault.tick != fault_tick_)) note(record);
  if (closed_) return;
  keep(record);
  if (until_close_ == 0 || --until_close_ > 0) return;
  if (record.stylus.loop == LoopState::kFault) {
    closed_ = true;
    return;
  }
  bank_ = (bank_ + 1) % kBanks;
  banks_[bank_].next = banks_[bank_].filled = 0;
}

void SafetyLog::note(const TickRecord& record) {
  const StylusState& s = record.stylus;
  if (closed_) {  // the operator's reset
    closed_ = false;
    bank_ = (bank_ + 1) % kBanks;
    banks_[bank_].next = banks_[bank_].filled = 0;
  }
  if (count_ < static_cast<std::ptrdiff_t>(kTransitions)) {
    transitions_[static_cast<std::size_t>(count_++)] = {s.tick, s.period, last_, s.loop, s.fault};
  } else {
    ++lost_;
  }
  last_ = s.loop;
  fault_tick_ = s.fault.tick;
  until_close_ = after_ticks_;
}

void SafetyLog::keep(const TickRecord& record) {
  Bank& bank = banks_[bank_];
  SafetyRow& row = bank.ring[bank.next];
  row.tick = record.stylus.tick;
  row.period = record.stylus.period;
  row.counts = record.in.counts;
  row.codes = record.out.codes;
  row.elapsed_periods = record.in.elapsed_periods;
  row.digital_in = record.in.digital_in;
  row.warnings = record.warnings;
  row.valid = record.in.valid;
  row.state = record.stylus.loop;
  bank.next = (bank.next + 1) % bank.ring.size();
  bank.filled = std::min(bank.filled + 1, bank.ring.size());
}

std::vector<SafetyRow> SafetyLog::rows() const {
  std::vector<SafetyRow> out;
  for (int n = 1; n <= kBanks; ++n) {
    const Bank& bank = banks_[(bank_ + n) % kBanks];
    const std::size_t size = bank.ring.size(), begin = bank.filled < size ? 0 : bank.next;
    for (std::size_t i = 0; i < bank.filled; ++i) out.push_back(bank.ring[(begin + i) % size]);
  }
  return out;
}

}  // namespace trocar
