// Faults of the device loop: values, never exceptions, because they arise inside the 1 kHz tick.
// A fault latches with the tick at which it first appeared; only an explicit operator reset clears it.
#pragma once

#include <cstdint>

namespace trocar {

enum class FaultCode : std::uint8_t {
  kNone,
  kEncoderJump,     ///< more counts in one period than a motor can turn
  kChannelInvalid,  ///< the board marks an encoder channel as not valid
  kNonFinite,       ///< NaN or infinity in a computed quantity
  kOverspeed,       ///< joint or tip faster than allowed, in spite of damping
  kSingular,        ///< det A of the shoulder below the fault threshold
  kEnergyDebt,      ///< the passivity observer's debt exceeds what may be owed
  kOverheat,        ///< winding model above the cut-off temperature
  kLateLoop,        ///< too many missed periods in a row
  kHandNonFinite,   ///< the (simulated) hand produced NaN or infinity
  kSelfTest,        ///< the self-test did not pass in time; value: SelfTestCheck bits that failed
  kEncoderStuck,    ///< the arm moved far and this channel counted nothing
  kSensorSilent,    ///< the board latched nothing new
  kDacMismatch,     ///< a DAC does not hold the code that was written
  kWatchdog,        ///< the board's watchdog fired: it had not been written to
  kEmergencyStop,   ///< emergency stop pressed
  kDriveFault,      ///< an amplifier reports a fault
  kDriveHot,        ///< an amplifier or motor reports over-temperature
  kStalePatch,      ///< the tissue has given no new patch for too long; value: its age, s
};

/// True where sensing and drives can still be trusted: the torque then fades within SafetyLimits::fade_s (stop
/// category 1). All others cut it in the same tick (category 0).
constexpr bool is_soft(FaultCode code) {
  return code == FaultCode::kOverspeed || code == FaultCode::kSingular || code == FaultCode::kEnergyDebt ||
         code == FaultCode::kOverheat || code == FaultCode::kDriveHot || code == FaultCode::kStalePatch;
}

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
    case FaultCode::kNone:
      return "none";
    case FaultCode::kEncoderJump:
      return "encoder-jump";
    case FaultCode::kChannelInvalid:
      return "channel-invalid";
    case FaultCode::kNonFinite:
      return "non-finite";
    case FaultCode::kOverspeed:
      return "overspeed";
    case FaultCode::kSingular:
      return "singular";
    case FaultCode::kEnergyDebt:
      return "energy-debt";
    case FaultCode::kOverheat:
      return "overheat";
    case FaultCode::kLateLoop:
      return "late-loop";
    case FaultCode::kHandNonFinite:
      return "hand-non-finite";
    case FaultCode::kSelfTest:
      return "self-test";
    case FaultCode::kEncoderStuck:
      return "encoder-stuck";
    case FaultCode::kSensorSilent:
      return "sensor-silent";
    case FaultCode::kDacMismatch:
      return "dac-mismatch";
    case FaultCode::kWatchdog:
      return "watchdog";
    case FaultCode::kEmergencyStop:
      return "emergency-stop";
    case FaultCode::kDriveFault:
      return "drive-fault";
    case FaultCode::kDriveHot:
      return "drive-hot";
    case FaultCode::kStalePatch:
      return "stale-patch";
  }
  return "unknown";
}

}  // namespace trocar
