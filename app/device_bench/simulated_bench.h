// A back-end with the simulated device behind it on the self-test's bench: every act is possible, and faults can be put
// in so that a check fails.
//
// Thread: the caller's.
#pragma once

#include "app/device_bench/board_bench.h"
#include "haptics/device/backends/make_backend.h"

namespace trocar {

class SimulatedBench final : public BoardBench {
 public:
  /// @param config of every board opened, its faults included.
  /// @param backend a name that make_backend() knows, of one with the simulated device behind it.
  explicit SimulatedBench(SimulatedDaqConfig config, std::string backend = kSimulatedBackend)
      : config_(std::move(config)), backend_(std::move(backend)) {}
  std::unique_ptr<DataAcquisition> open(const BoardActs& acts) override;
  bool repeatable() const override { return true; }

 private:
  SimulatedDaqConfig config_;
  std::string backend_;
};

}  // namespace trocar
