// The haptic task: read, tick, write, once a loop period. Publishes what it did to the other tasks.
//
// Thread: its own, real-time; the tick itself neither allocates, locks, reads a clock nor throws.
#pragma once

#include "app/session/lanes/channel.h"
#include "app/session/lanes/device_account.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/lanes/task.h"
#include "haptics/exchange/ring.h"
#include "haptics/haptic_loop.h"

namespace trocar {

/// 8 s at 1 kHz: the recorder drains it ten times a second and may wait long for the disk.
using TickRing = Ring<TickRecord, 8192>;

/// What the haptic task reads from and writes to. An absent reader costs nothing.
struct HapticPorts {
  Inlet<ContactPatch>& patch;
  Outlet<HapticState>& tissue;
  Outlet<TickRecord>* observer = nullptr;
  TickRing* recorder = nullptr;
  Outlet<MotorStates>* motors = nullptr;
};

class HapticTask final : public Task {
 public:
  static constexpr double kAfterFault_s = 0.1;  ///< the loop is watched this long after a fault, then the run ends

  /// @param longest_s loop time after which the run ends whatever happens.
  HapticTask(DataAcquisition& daq, HapticLoop& loop, const HapticPorts& ports, double longest_s)
      : daq_(daq), loop_(loop), ports_(ports), longest_s_(longest_s) {}

  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t tick) override;
  bool finished() const override;
  /// Torque off, whatever the loop last said: not after the slowest of the others has ended.
  void leave() noexcept override { daq_.write({}), daq_.arm(false); }

  /// The newest record. Thread: the haptic task's, or any when the run is over.
  const TickRecord& record() const { return record_; }
  const StateHash& hash() const { return hash_; }
  const DeviceAccount& account() const { return account_; }

 private:
  DataAcquisition& daq_;
  HapticLoop& loop_;
  HapticPorts ports_;
  double longest_s_;
  TickRecord record_;
  StateHash hash_;
  DeviceAccount account_;
  double since_fault_s_ = 0;
};

}  // namespace trocar
