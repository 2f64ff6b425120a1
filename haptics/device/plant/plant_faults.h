// Failures that happen inside the simulated back-end, where the controller cannot know of them.
//
// Times are those of the SYNC from which a failure shows. Thread: haptic task; nothing allocates after construction.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/device/data_acquisition.h"

namespace trocar {

inline constexpr double kTimeSlack = 1e-9;  ///< s, against rounding of k * period

enum class InjectedFaultKind : std::uint8_t {
  kEncoderJump,      ///< the channel's counter gains `value` counts, once
  kEncoderStuck,     ///< the channel's counter keeps its number
  kChannelInvalid,   ///< the channel's valid bit is down
  kDacStuck,         ///< the channel's DAC keeps its code
  kMissedSync,       ///< `value` SYNCs pass unread: elapsed_periods is 1 + value, once
  kHandNaN,          ///< the hand's intent is NaN
  kHandLetsGo,       ///< the hand leaves the stylus
  kDelay,            ///< codes reach the DAC `value` periods later than they should
  kEmergencyStop,    ///< pressed
  kDeadmanOpen,      ///< the operator's thumb leaves the switch
  kDriveFault,       ///< fault output of the channel's amplifier
  kWatchdog,         ///< writes do not reach the board: its watchdog fires
  kOverTemperature,  ///< over-temperature output of the channel's amplifier
  kBeamDark,         ///< emitter or receiver of the jig's light is dead
  kBeamLit,          ///< the receiver says light whatever comes
  kSensorSilence,    ///< the board latches nothing: the last sample again, no period elapsed
};

/// Lasts for duration_s, but for what happens once.
struct InjectedFault {
  InjectedFaultKind kind = InjectedFaultKind::kEncoderJump;
  double at_s = 0;        ///< time of the SYNC from which it shows
  double duration_s = 0;  ///< s; 0 means for good
  int channel = 0;
  double value = 0;
};

/// Why a fault cannot be injected; empty when it can.
std::string injection_refusal(const InjectedFault& fault);

class PlantFaults {
 public:
  explicit PlantFaults(const std::vector<InjectedFault>& faults);

  /// Whether one of this kind is present at a SYNC.
  bool lasts(InjectedFaultKind kind, double now_s) const noexcept;
  bool lasts(InjectedFaultKind kind, double now_s, int channel) const noexcept;
  /// SYNCs that pass unread before the one at this time; asks once.
  std::uint32_t missed_syncs(double next_s) noexcept;
  /// Further periods between write and DAC.
  int extra_delay(double now_s) const noexcept;
  /// Counters and valid bits as a failing board shows them. @param last sample before.
  void spoil(DaqSample& sample, const DaqSample& last, double now_s) noexcept;

 private:
  struct Entry {
    InjectedFault fault;
    bool fired = false;
  };

  std::vector<Entry> entries_;
  std::array<std::int32_t, kChannels> jump_{};
};

}  // namespace trocar
