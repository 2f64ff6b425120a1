// Faults of the device loop: values, never exceptions, because they arise inside the 1 kHz tick.
// A fault latches with the tick at which it first appeared; only an explicit operator reset clears it.
#pragma once

#include <cstdint>

namespace trocar {

enum class FaultCode : std::uint8_t {
  kNone,
  kEncoderJump,      ///< more counts in one period than a motor can turn
  kChannelInvalid,   ///< the board marks an encoder channel as not valid
  kNonFinite,        ///< NaN or infinity in a computed quantity
  kOverspeed,        ///< joint rate above the limit
  kSingular,         ///< det A of the shoulder below the fault threshold
  kEnergyDebt,       ///< the passivity observer's debt exceeds what may be owed
  kOverheat,         ///< winding model above the cut-off temperature
  kLateLoop,         ///< too many missed periods in a row
  kHandNonFinite,    ///< the (simulated) hand produced NaN or infinity
};

struct Fault {
  FaultCode code = FaultCode::kNone;
  std::int8_t channel = -1;  ///< channel concerned, -1 when none
  std::uint64_t tick = 0;    ///< tick at which it first appeared
  double value = 0;          ///< the offending number, in the unit that the code implies

  explicit operator bool() const { return code != FaultCode::kNone; }
};

/// Stable identifier used in JSON, events and messages ("encoder-jump").
constexpr const char* fault_name(FaultCode code) {
  switch (code) {
    case FaultCode::kNone: return "none";
    case FaultCode::kEncoderJump: return "encoder-jump";
    case FaultCode::kChannelInvalid: return "channel-invalid";
    case FaultCode::kNonFinite: return "non-finite";
    case FaultCode::kOverspeed: return "overspeed";
    case FaultCode::kSingular: return "singular";
    case FaultCode::kEnergyDebt: return "energy-debt";
    case FaultCode::kOverheat: return "overheat";
    case FaultCode::kLateLoop: return "late-loop";
    case FaultCode::kHandNonFinite: return "hand-non-finite";
  }
  return "unknown";
}

}  // namespace trocar
