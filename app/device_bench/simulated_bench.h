// The simulated device on the self-test's bench: every act is possible, and faults can be put in so that a check fails.
//
// Thread: the caller's.
#pragma once

#include "app/device_bench/board_bench.h"
#include "haptics/device/simulated_daq.h"

namespace trocar {

class SimulatedBench final : public BoardBench {
 public:
  /// @param config of every board opened, its faults included.
  explicit SimulatedBench(SimulatedDaqConfig config) : config_(std::move(config)) {}
  std::unique_ptr<DataAcquisition> open(const BoardActs& acts) override;
  bool repeatable() const override { return true; }

 private:
  SimulatedDaqConfig config_;
};

}  // namespace trocar
