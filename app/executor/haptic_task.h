// The haptic task: read, tick, write, once a loop period. Keeps the newest record for the others.
#pragma once

#include "app/executor/delayed_channel.h"
#include "app/executor/state_hash.h"
#include "app/executor/task.h"
#include "haptics/haptic_loop.h"

namespace trocar {

class HapticTask final : public Task {
 public:
  HapticTask(DataAcquisition& daq, HapticLoop& loop, DelayedChannel<ContactPatch>& patch, StateHash& hash)
      : daq_(daq), loop_(loop), patch_(patch), hash_(hash) {}

  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t tick) override {
    const DaqSample sample = daq_.read();
    const DacFrame codes = loop_.tick(sample, patch_.read(tick), record_);
    daq_.arm(record_.amplifiers_armed);
    daq_.write(codes);
    hash_.add(record_);
  }
  const TickRecord& record() const { return record_; }

 private:
  DataAcquisition& daq_;
  HapticLoop& loop_;
  DelayedChannel<ContactPatch>& patch_;
  StateHash& hash_;
  TickRecord record_;
};

}  // namespace trocar
