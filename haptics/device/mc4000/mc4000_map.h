// Registers of the PMDi MC4000 (PRO and LITE): table 3.1 of the thesis, and what it leaves open.
//
// No data sheet, header or driver of this board is public. [T]: thesis. [assumed]: chosen so that driver and emulated
// board agree; to be set right with the manufacturer's manual before a real board is touched (docs/real_hardware.md).
// Thread: plain values.
#pragma once

#include <cstdint>
#include <vector>

#include "haptics/device/data_acquisition.h"

namespace trocar {

struct Mc4000Map {
  // Words. The table's PCI column counts two a DSP word but for the converters, which it gives one each.
  std::uint32_t pit = 0x00, watchdog = 0x02, gate = 0x04, sync_control = 0x06;  // [T]
  std::uint32_t dac = 0x08, dac_stride = 1;                                     // [T]
  std::uint32_t digital_in_b = 0x22;                                            // [T]
  std::uint32_t interrupt_flags = 0x34, interrupt_enable = 0x35;                // [T]
  std::uint32_t decoder_count = 0x40, decoder_mode = 0x50, decoder_stride = 2;  // [T]
  std::uint32_t digital_out_a = 0x20;                                           // [assumed]: the table names no output

  double pit_clock_hz = 10e6;  ///< PIT counts down from its load at this rate [assumed]
  int watchdog_divider = 8;    ///< watchdog counts once in so many PIT periods [T]
  int dac_bits = 16;           ///< two's complement, right-justified [assumed]
  int count_bits = 32;         ///< of a decoder; fewer are sign-extended [assumed]

  std::uint32_t gate_pit = 1u << 0, gate_watchdog = 1u << 1;                          // [assumed]
  std::uint32_t sync_internal_pit = 1u << 0, sync_internal_external = 1u << 1;        // [assumed]
  std::uint32_t sync_output1_pit = 1u << 2;                                           // [assumed]
  std::uint32_t mode_invert = 1u << 0, mode_preload = 1u << 1, mode_error = 1u << 2;  // [assumed]
  std::uint32_t flag_sync = 1u << 0, flag_watchdog = 1u << 1;  // [assumed]; written back: cleared
  std::uint32_t out_amplifiers = 1u << 0;                      ///< relay of all inhibits and of the bus power [assumed]
};

/// An input of a board's port B.
struct Mc4000Input {
  std::uint32_t bits = 0;  ///< of DigitalInput
  int board = 0, pin = 0;
  bool active_low = true;
};

/// Which axis of which board a channel is: joints 1 to 4 on board 0, 5 and 6 on board 1 [T 3.2.2], the pinch beside
/// them.
struct Mc4000Axis {
  int board = 0, axis = 0;
};
inline constexpr Mc4000Axis kMc4000Axes[kChannels] = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 1}, {1, 2}};

/// As of the card on the network (hostmot2_map.h), in its order: the first six on board 0 from pin 0, drive faults and
/// over-temperatures from pin 8 on, on the board of their channel.
std::vector<Mc4000Input> mc4000_inputs();

}  // namespace trocar
