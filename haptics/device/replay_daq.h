// Back-end of the seam that plays back recorded samples: the loop sees exactly what it saw, bit for bit.
//
// What the loop writes goes nowhere. After the last sample it repeats it with all channels marked invalid, so that a
// loop driven past the end faults instead of feeling a frozen device. Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <vector>

#include "haptics/device/data_acquisition.h"

namespace trocar {

class ReplayDaq final : public DataAcquisition {
 public:
  /// @param samples at least one; @param capabilities those of the recorded back-end (name becomes "replay").
  ReplayDaq(std::vector<DaqSample> samples, DaqCapabilities capabilities)
      : samples_(std::move(samples)), capabilities_(capabilities) {
    capabilities_.name = "replay";
  }
  DaqCapabilities capabilities() const noexcept override { return capabilities_; }
  DaqSample read() noexcept override {
    if (next_ < samples_.size()) return samples_[next_++];
    DaqSample past = samples_.empty() ? DaqSample{} : samples_.back();
    past.valid = 0;
    return past;
  }
  void write(const DacFrame&) noexcept override {}
  void arm(bool) noexcept override {}
  bool finished() const noexcept { return next_ >= samples_.size(); }

 private:
  std::vector<DaqSample> samples_;
  DaqCapabilities capabilities_;
  std::size_t next_ = 0;
};

}  // namespace trocar
