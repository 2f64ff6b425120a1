// The device seam: encoder counts in, DAC codes out. The only header that controller and plant share besides
// quantities.h.
//
// One call of read() is one SYNC: it latches all encoders at one instant. write() sets the codes that the DACs take
// at the NEXT SYNC (one period of delay). Back-ends: SimulatedDaq, ReplayDaq; real boards implement the same class
// (made by backends/make_backend.h).
// Thread: the haptic task's. No call allocates, locks or throws.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

/// Digital inputs, one bit each; the last three are groups of seven, channel i at bit i of the group. Bits 15, 23 and
/// 31 are the encoders' marks (index_mark.h).
enum DigitalInput : std::uint32_t {
  kDeadman = 1u << 0,        ///< operator's enabling switch closed
  kHomeBeam = 1u << 1,       ///< infrared beam of the home jig received
  kHandFault = 1u << 2,      ///< simulated back-end only: the hand produced a non-finite command
  kEmergencyStop = 1u << 3,  ///< emergency stop pressed: the amplifiers are off by wire
  kWatchdogFired = 1u << 4,  ///< no write for 16 ms: the board has zeroed its DACs; stays until disarmed
  kClutch = 1u << 5,         ///< foot or finger switch: the instrument is frozen while it is closed
  kPedal = 1u << 6,          ///< foot switch: the instrument in hand is energised, or sucks, while it is closed
  kExchange = 1u << 7,       ///< switch: each time it closes, the next instrument is taken
  kDacMismatch = 1u << 8,    ///< a DAC's register reads back another code than the one it should hold now
  kDriveFault = 1u << 16,    ///< fault output of an amplifier
  kDriveHot = 1u << 24,      ///< over-temperature output of an amplifier or motor
};

/// Whether the input of one channel is set. @param group kDacMismatch, kDriveFault or kDriveHot.
constexpr bool channel_input(std::uint32_t digital_in, DigitalInput group, int channel) {
  return (digital_in & (group << channel)) != 0;
}

struct DaqSample {
  std::array<std::int32_t, kChannels> counts{};  ///< quadrature counters, wrapping at 32 bit
  std::uint8_t valid = 0x7F;                     ///< bit i: channel i was latched correctly
  std::uint32_t elapsed_periods = 1;  ///< SYNC periods since the previous read (1 unless one was missed, 0: no news)
  std::uint32_t digital_in = 0;       ///< DigitalInput bits
  /// Microseconds before the latch at which each counter last moved, rounded up; 65535: that or longer; 0: not told.
  std::array<std::uint16_t, kChannels> edge_age_us{};
};

struct DacFrame {
  std::array<std::int32_t, kChannels> codes{};  ///< signed, full scale +-(2^(bits-1) - 1) = +-10 V
};

struct DaqCapabilities {
  const char* name = "";  ///< "simulated", "replay", ...
  double rate_hz = 1000;  ///< SYNC rate
  int dac_bits = 16;
  bool motors = true;  ///< false: nothing can push back (PointerDaq); the loop then renders nothing and guards no motor
};

/// Whether a board can be run at this rate, with a watchdog so patient: what its registers are worked out from.
constexpr bool is_board_pace(double rate_hz, double watchdog_s) {
  return rate_hz >= 100 && rate_hz <= 10000 && watchdog_s > 0 && watchdog_s <= 1;
}

class DataAcquisition {
 public:
  virtual ~DataAcquisition() = default;
  virtual DaqCapabilities capabilities() const noexcept = 0;
  /// Waits for nothing: in lockstep it advances the back-end by one period, then latches.
  virtual DaqSample read() noexcept = 0;
  /// Codes for the next SYNC; all channels change at once. Services the board's watchdog.
  virtual void write(const DacFrame& frame) noexcept = 0;
  /// Enables or inhibits all amplifiers. Inhibited amplifiers deliver no current whatever the codes.
  virtual void arm(bool enabled) noexcept = 0;
};

}  // namespace trocar
