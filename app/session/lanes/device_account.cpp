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

void DeviceAccount::fill(RunReport& run_report) const {
  run_report.ticks = ticks_;
  run_report.overruns = missed_;
  run_report.min_energy_j = min_energy_j_;
  for (std::size_t i = 0; i < kLoopWarnings.size(); ++i) {
    const Count& count = warnings_[i];
    if (count.ticks > 0) run_report.warnings.push_back({warning_name(kLoopWarnings[i]), count.first_s, count.ticks});
  }
  if (!fault_) return;
  run_report.fault = fault_name(fault_.code);
  run_report.fault_channel = fault_.channel;
  run_report.fault_value = fault_.value;
  run_report.fault_s = fault_s_;
}

}  // namespace trocar
