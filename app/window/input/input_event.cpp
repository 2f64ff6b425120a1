#include "app/window/input/input_event.h"

namespace trocar {

const char* input_name(InputKind kind) {
  switch (kind) {
    case InputKind::kMouse:
      return "mouse";
    case InputKind::kKeyboard:
      return "keyboard";
    case InputKind::kPad:
      return "gamepad";
    case InputKind::kSpaceMouse:
      return "spacemouse";
    case InputKind::kDevice:
      return "device";
  }
  return "unknown";
}

}  // namespace trocar
