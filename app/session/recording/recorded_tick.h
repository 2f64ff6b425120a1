// One haptic tick as the recording keeps it: the exact input of the device and the trace in whole quanta.
//
// Scoring reads the DECODED row, live as well as when regrading, so both see the same numbers to the bit. Quanta:
// positions and opening 1 um, shaft direction 1e-4, forces 1 mN, stiffness 0.1 N/m. Frame T. Thread: any, plain values.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "haptics/device/data_acquisition.h"
#include "haptics/exchange/stylus_state.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

inline constexpr double kLengthQuantum = 1e-6;     ///< m
inline constexpr double kDirectionQuantum = 1e-4;  ///< of a unit vector
inline constexpr double kForceQuantum = 1e-3;      ///< N
inline constexpr double kStiffnessQuantum = 0.1;   ///< N/m

/// Stands for "not finite, or beyond what 31 bits of quanta hold"; decodes to NaN, never to a number.
inline constexpr std::int32_t kNotRepresentable = INT32_MIN;

enum RecordedFlag : std::uint8_t {
  kFlagContact = 1u << 0,
  kFlagSaturated = 1u << 1,
  kFlagPassivityActive = 1u << 2,
  kFlagPedal = 1u << 3,
};
/// The four bits above are the instrument in hand; recordings from before there was a choice have none of them.
inline constexpr int kFirstInstrumentBit = 4;

struct RecordedTick {
  std::uint64_t tick = 0;  ///< SYNC period of the tick; increases, skips missed ones; time = tick / rate
  std::array<std::int32_t, kChannels> counts{};  ///< exact, wrapping at 32 bit
  std::uint32_t elapsed_periods = 1;
  std::uint32_t digital_in = 0;                ///< DigitalInput bits
  std::array<std::int32_t, 3> tip{};           ///< um
  std::array<std::int32_t, 3> shaft{};         ///< 1e-4
  std::array<std::int32_t, 3> force{};         ///< mN, virtual
  std::int32_t rendered = 0, grip = 0;         ///< mN
  std::int32_t jaw_opening = 0;                ///< um
  std::int32_t commanded = kNotRepresentable;  ///< mN; older recordings do not have it
  /// 0.1 N/m: asked of the device and K_max there, 0 while nothing is touched; formats 1 and 2 do not have them
  std::int32_t stiffness = kNotRepresentable, k_max = kNotRepresentable;
  std::uint8_t valid = 0x7F;    ///< bit i: channel i latched correctly
  std::uint8_t flags = 0;       ///< RecordedFlag bits and the instrument in hand
  std::uint8_t loop_state = 0;  ///< LoopState
  std::uint8_t phase = 0;       ///< Phase of the director (scenarios/director/director.h), opaque here

  bool operator==(const RecordedTick&) const = default;
};

/// Rounds a tick to quanta (half away from zero). sample.t_s is not used: time is tick / rate.
RecordedTick quantise(std::uint64_t tick, const DaqSample& input, const TraceSample& sample, LoopState loop,
                      std::uint8_t phase);

/// The sample that scoring reads. The shaft is brought back to unit length; kNotRepresentable becomes NaN.
TraceSample dequantise(const RecordedTick& row, double rate_hz);

/// The device input of the row, exactly as it was read.
DaqSample device_input(const RecordedTick& row);

/// Trace of consecutive rows.
Trace rebuild_trace(std::span<const RecordedTick> rows, double rate_hz);

}  // namespace trocar
