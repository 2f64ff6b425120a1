// The instruments that a person can have in hand: what they are called, and their shapes.
//
// An exercise names those that it takes (scenarios/exercise.h); StylusState::instrument says which of them is in hand.
// What each does in tissue is the tissue's matter (tissue/tissue_world.cpp), how it looks the pictures'
// (app/picture/models). Lengths m. Thread: constants and pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "haptics/contact/tool_shape.h"

namespace trocar {

enum class InstrumentKind : std::uint8_t { kProbe, kGrasper, kScissors, kHook, kClipApplier, kSuction, kNeedleDriver };

struct InstrumentDescription {
  InstrumentKind kind;
  const char* name;     ///< in exercises and scripts
  const char* title;    ///< on screens
  double jaw_length_m;  ///< hinge to tip; 0: no jaws
  bool powered;         ///< the pedal does something: current, or suction
};

inline constexpr std::array<InstrumentDescription, 7> kInstruments{{
    {InstrumentKind::kProbe, "probe", "Probe", 0, false},
    {InstrumentKind::kGrasper, "grasper", "Grasper", 0.020, true},
    {InstrumentKind::kScissors, "scissors", "Scissors", 0.016, true},
    {InstrumentKind::kHook, "hook", "Hook", 0, true},
    {InstrumentKind::kClipApplier, "clip-applier", "Clip applier", 0.010, false},
    {InstrumentKind::kSuction, "suction", "Suction", 0, true},
    {InstrumentKind::kNeedleDriver, "needle-driver", "Needle driver", 0.014, false},
}};

/// Most instruments that an exercise takes: what a recording's row has room for.
inline constexpr std::size_t kMostInstruments = 16;

constexpr const InstrumentDescription& describe(InstrumentKind kind) {
  return kInstruments[static_cast<std::size_t>(kind)];
}

/// As files name it.
constexpr std::optional<InstrumentKind> instrument_named(std::string_view name) {
  for (const InstrumentDescription& known : kInstruments) {
    if (known.name == name) return known.kind;
  }
  return std::nullopt;
}

/// An instrument as loop and tissue have it.
struct Tool {
  InstrumentKind kind = InstrumentKind::kProbe;
  ToolShape shape;
};

/// @param shaft of all instruments of the exercise.
constexpr Tool make_tool(InstrumentKind kind, ToolShape shaft = {}) {
  shaft.jaw_length_m = describe(kind).jaw_length_m;
  return {kind, shaft};
}

}  // namespace trocar
