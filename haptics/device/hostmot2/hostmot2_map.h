// Where things stand in a card with HostMot2 firmware: identity, modules, registers, bits.
//
// A module's place, its strides, clocks and the wiring of pins are read from the card (IDROM), never assumed. Source:
// HostMot2 register map (LinuxCNC, src/hal/drivers/mesa-hostmot2/doc/regmap). Thread: constants and plain values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/device/data_acquisition.h"

namespace trocar::hostmot2 {

inline constexpr std::uint16_t kCookieAt = 0x0100, kNameAt = 0x0104, kIdromOffsetAt = 0x010C;
inline constexpr std::uint32_t kCookie = 0x55AACAFE;
inline constexpr const char* kName = "HOSTMOT2";
inline constexpr std::uint32_t kIdromTypes[] = {2, 3};  ///< that are laid out as below

/// Words of the IDROM.
enum IdromWord : std::uint8_t {
  kIdromType,
  kModulesOffset,
  kPinsOffset,
  kBoardName,  ///< two words
  kIoPorts = 7,
  kIoWidth,
  kPortWidth,
  kClockLow,
  kClockHigh,
  kInstanceStride0,
  kInstanceStride1,
  kRegisterStride0,
  kRegisterStride1,
  kIdromWords
};
inline constexpr int kMostModules = 32, kMostPins = 144;

enum class Tag : std::uint8_t { kNone = 0, kWatchdog = 2, kIoPort = 3, kEncoder = 4, kPwm = 6 };

/// Registers of each module, in its order.
enum class WatchdogRegister : std::uint8_t { kTimer, kStatus, kKick };
enum class IoPortRegister : std::uint8_t { kData, kDirection, kAlternate, kOpenDrain, kInvert };
enum class EncoderRegister : std::uint8_t { kCount, kControl, kStampDivider, kStampNow, kFilter };
enum class PwmRegister : std::uint8_t { kValue, kMode, kPwmRate, kPdmRate, kEnable };

inline constexpr std::uint32_t kWatchdogKick = 0x5Au << 24, kWatchdogOff = 1u << 31, kBitten = 1;
inline constexpr std::uint32_t kQuadratureError = 1u << 15, kFifteenClocks = 1u << 11;
inline constexpr std::uint32_t kIndexInput = 1u << 2;  ///< level of the index input at the read [LinuxCNC hostmot2.h]
inline constexpr std::uint32_t kPdmMode = 3u << 3;     ///< 12 bit, not double buffered
inline constexpr int kPdmBits = 12;                    ///< and a sign
inline constexpr std::uint32_t kMostPdm = (1u << kPdmBits) - 1;

/// A signed code as the register of the analogue output has it: size in bits 27..16, sign in bit 31.
constexpr std::uint32_t pdm_of(std::int32_t code) {
  const auto size = static_cast<std::uint32_t>(code < 0 ? -code : code);
  return (size > kMostPdm ? kMostPdm : size) << 16 | (code < 0 ? 1u << 31 : 0u);
}
constexpr std::int32_t code_of(std::uint32_t pdm) {
  const auto size = static_cast<std::int32_t>(pdm >> 16 & kMostPdm);
  return pdm >> 31 ? -size : size;
}

/// Modules of the firmware, one descriptor each.
struct Module {
  Tag tag = Tag::kNone;
  int instances = 0;
  std::uint16_t base = 0, register_stride = 0, instance_stride = 0;
  double clock_hz = 0;

  template <typename Register>
  std::uint16_t at(Register r, int instance = 0) const {
    return static_cast<std::uint16_t>(base + static_cast<int>(r) * register_stride + instance * instance_stride);
  }
};

/// What the device needs of a card.
struct Need {
  Tag tag;
  const char* name;
  int instances;
};
inline constexpr Need kEncoders{Tag::kEncoder, "quadrature counters", kChannels},
    kOutputs{Tag::kPwm, "analogue outputs", kChannels}, kPorts{Tag::kIoPort, "I/O ports", 1},
    kWatchdogs{Tag::kWatchdog, "watchdogs", 1};
inline constexpr Need kNeeds[] = {kEncoders, kOutputs, kPorts, kWatchdogs};

/// What a pin does besides being an input: third part of its descriptor and whose it is.
struct Pin {
  Tag tag = Tag::kNone;
  int unit = 0;
  bool output = false;
};

struct Identity {
  std::string board = {};  ///< as the card says, blanks cut
  int port_width = 24, ports = 0;
  std::vector<Module> modules = {};
  std::vector<Pin> pins = {};
};

/// Which input of the card tells what. Pins are counted over all ports.
struct Wiring {
  struct Input {
    std::uint32_t bits = 0;  ///< of DigitalInput
    int pin = 0;
    bool active_low = true;  ///< a broken wire then reads as what is safe: see standard_wiring()
  };
  std::vector<Input> inputs = {};
};

/// The wiring of docs/real_hardware.md: from pin 48 on, in this order: enabling switch, home beam, emergency stop,
/// clutch, pedal, exchange, drive faults and over-temperatures of the seven channels. A broken wire must read as the
/// safe state: the enabling switch and the beam pull their pin down when closed, received; what reports trouble lets go
/// of it.
inline Wiring standard_wiring() {
  Wiring out;
  int pin = 48;
  for (const DigitalInput low : {kDeadman, kHomeBeam}) out.inputs.push_back({low, pin++, true});
  out.inputs.push_back({kEmergencyStop, pin++, false});
  for (const DigitalInput low : {kClutch, kPedal, kExchange}) out.inputs.push_back({low, pin++, true});
  for (const DigitalInput group : {kDriveFault, kDriveHot})
    for (int i = 0; i < kChannels; ++i) out.inputs.push_back({static_cast<std::uint32_t>(group) << i, pin++, false});
  return out;
}

}  // namespace trocar::hostmot2
