// What the run report says of the device: missed periods, warnings, when the first fault came. Counted in the haptic
// task.
//
// Thread: add() the haptic task's, no allocation; the rest when the run is over.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "haptics/exchange/tick_record.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

class DeviceAccount {
 public:
  void add(const TickRecord& record);
  /// Ticks, missed periods (as `overruns`), lowest energy, warnings and fault.
  void fill(RunReport& run_report) const;

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t missed() const { return missed_; }  ///< periods without a tick

 private:
  struct Count {
    std::uint64_t ticks = 0;
    double first_s = 0;
  };

  std::uint64_t ticks_ = 0, missed_ = 0;
  double min_energy_j_ = 0;
  std::array<Count, kLoopWarnings.size()> warnings_{};
  Fault fault_;
  double fault_s_ = 0;
};

}  // namespace trocar
