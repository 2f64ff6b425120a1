// Warnings of the device loop: they say what is about to go wrong, change nothing by themselves and do not latch.
// What reduces the torque at the same time is written in docs/device_and_safety.md.
#pragma once

#include <array>
#include <cstdint>

namespace trocar {

enum class LoopWarning : std::uint8_t {
  kEncoderStuck,    ///< suspected: much torque and no count in free space
  kHotMotor,        ///< winding model above its warning temperature
  kNearSingular,    ///< det A of the shoulder below its warning value
  kForceSaturated,  ///< the torque budget cut the contact force
  kEnergyDebt,      ///< the passivity budget owes so much that the stiffness is faded
  kOverspeed,       ///< joint or tip too fast: contact off, damping on
  kStalePatch,      ///< the tissue's patch is old: the contact fades
  kContactWaits,    ///< armed within the tissue: no contact force until it would be small once
};

inline constexpr std::array kLoopWarnings{
    LoopWarning::kEncoderStuck, LoopWarning::kHotMotor,  LoopWarning::kNearSingular, LoopWarning::kForceSaturated,
    LoopWarning::kEnergyDebt,   LoopWarning::kOverspeed, LoopWarning::kStalePatch,   LoopWarning::kContactWaits};

using WarningBits = std::uint16_t;

constexpr WarningBits bit(LoopWarning warning) {
  return static_cast<WarningBits>(1u << static_cast<unsigned>(warning));
}

/// Stable identifier used in JSON and messages.
constexpr const char* warning_name(LoopWarning warning) {
  switch (warning) {
    case LoopWarning::kEncoderStuck:
      return "encoder-stuck-suspected";
    case LoopWarning::kHotMotor:
      return "hot-motor";
    case LoopWarning::kNearSingular:
      return "near-singular";
    case LoopWarning::kForceSaturated:
      return "force-saturated";
    case LoopWarning::kEnergyDebt:
      return "energy-debt";
    case LoopWarning::kOverspeed:
      return "overspeed";
    case LoopWarning::kStalePatch:
      return "stale-patch";
    case LoopWarning::kContactWaits:
      return "contact-waits";
  }
  return "unknown";
}

}  // namespace trocar
