// What a person's hands do to mouse, keys, pad or six-axis SpaceMouse, as plain values: made by the window, or by a
// test.
//
// Pixels of the window, y down; axes -1..1. Plain values, any thread.
#pragma once

#include <array>
#include <cstdint>

namespace trocar {

/// Keys by what is printed on a US keyboard; letters and digits by their ASCII code, others from 256.
enum Key : std::int32_t {
  kKeyUnknown = 0,
  kKeySpace = ' ',
  kKeyEscape = 256,
  kKeyEnter,
  kKeyTab,
  kKeyBackspace,
  kKeyInsert,
  kKeyDelete,
  kKeyRight,
  kKeyLeft,
  kKeyDown,
  kKeyUp,
  kKeyPageUp,
  kKeyPageDown,
  kKeyHome,
  kKeyEnd,
  kKeyF1,
  kKeyF2,
  kKeyF3,
  kKeyF4,
  kKeyF5,
  kKeyF6,
  kKeyF7,
  kKeyF8,
  kKeyF9,
  kKeyF10,
  kKeyF11,
  kKeyF12,
  kKeyShift,
  kKeyControl,
  kKeyAlt,
};

enum class MouseButton : std::uint8_t { kLeft, kRight, kMiddle };

struct InputEvent {
  enum class Kind : std::uint8_t {
    kKeyDown,
    kKeyUp,
    kMouseMove,
    kButtonDown,
    kButtonUp,
    kWheel,
    kPad,
    kSpaceMouse,
    kFocusLost,
    kText
  } kind = Kind::kMouseMove;
  std::int32_t key = kKeyUnknown;
  bool repeat = false;  ///< a key that is held
  bool shift = false, control = false, alt = false;
  MouseButton button = MouseButton::kLeft;
  double x = 0, y = 0;  ///< px: pointer
  double wheel = 0;     ///< notches, away from the person is positive
  std::array<double, 6>
      axis{};                   ///< pad: left x y, right x y (y towards the person), left and right trigger (0..1);
                                ///< SpaceMouse: translation x y z, rotation x y z (x right, y up, z towards the person)
  std::uint32_t buttons = 0;    ///< pad (PadButton) or SpaceMouse: bit n for button n, as held now
  std::uint32_t character = 0;  ///< kText: Unicode code point as the keyboard's layout gives it
};

/// Bits of InputEvent::buttons for pads, as GLFW numbers a gamepad's buttons.
enum PadButton : std::uint32_t {
  kPadA = 1u << 0,
  kPadB = 1u << 1,
  kPadX = 1u << 2,
  kPadY = 1u << 3,
  kPadLeftBumper = 1u << 4,
  kPadRightBumper = 1u << 5,
  kPadLeftThumb = 1u << 9,  ///< the sticks pressed
  kPadRightThumb = 1u << 10,
  kPadUp = 1u << 11,
  kPadRight = 1u << 12,
  kPadDown = 1u << 13,
  kPadLeft = 1u << 14,
};

/// What moves the hand; stored with the attempt.
enum class InputKind : std::uint8_t { kMouse, kKeyboard, kPad, kSpaceMouse, kDevice };
const char* input_name(InputKind kind);  ///< "mouse", "keyboard", "gamepad", "spacemouse", "device"

}  // namespace trocar
