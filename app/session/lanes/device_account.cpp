#include "app/session/lanes/device_account.h"

#include <algorithm>

namespace trocar {

void DeviceAccount::add(const TickRecord& record) {
  const StylusState& s = record.stylus;
  ++ticks_;
  missed_ += std::max<std::uint32_t>(1, record.in.elapsed_periods) - 1;  // 0: a silent board
  min_energy_j_ = record.min_energy_j;
  for (std::size_t i = 0; i < kLoopWarnings.size(); ++i) {
    if (!(record.warnings & bit(kLoopWarnings[i]))) continue;
    if (warnings_[i].ticks++ == 0) warnings_[i].first_s = s.t_s;
  }
  if (fault_ || !s.fault) return;
  fault_ = s.fault;
  fault_s_ = s.t_s;
}

void DeviceAccount::fill(DeviceReceipt& receipt) const {
  receipt.ticks = ticks_;
  receipt.overruns = missed_;
  receipt.min_energy_j = min_energy_j_;
  for (std::size_t i = 0; i < kLoopWarnings.size(); ++i) {
    const Count& count = warnings_[i];
    if (count.ticks > 0) receipt.warnings.push_back({warning_name(kLoopWarnings[i]), count.first_s, count.ticks});
  }
  if (!fault_) return;
  receipt.fault = fault_name(fault_.code);
  receipt.fault_channel = fault_.channel;
  receipt.fault_value = fault_.value;
  receipt.fault_s = fault_s_;
}

}  // namespace trocar
