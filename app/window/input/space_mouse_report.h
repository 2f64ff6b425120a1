// What a SpaceMouse says in its HID reports, as axes of the person's view.
//
//   report 1: translation x y z (16 bit, little endian), newer devices add rotation x y z to it
//   report 2: rotation x y z        report 3: buttons, a bit each
// The device counts +-350, x right, y towards the person, z down; here x right, y up, z towards the person, -1..1.
// Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace trocar {

struct SpaceMouseState {
  std::array<double, 6> axis{};  ///< translation x y z, rotation x y z
  std::uint32_t buttons = 0;
  bool operator==(const SpaceMouseState&) const = default;
};

/// @param report with its number as first byte. @return false: not understood, nothing is changed.
bool apply_space_mouse_report(std::span<const std::uint8_t> report, SpaceMouseState& state);

/// Is it a SpaceMouse? Logitech's number covers mice and keyboards too, so there the product must be one of
/// 3Dconnexion's.
/// @param usage of page 1; 0 when the library does not tell.
bool is_space_mouse(std::uint16_t vendor, std::uint16_t product, std::uint16_t usage_page, std::uint16_t usage);

}  // namespace trocar
