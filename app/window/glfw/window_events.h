// From GLFW's callbacks and pads to InputEvents. Included by sources of app/window only. Thread: the main one.
#pragma once

#include <array>
#include <vector>

#include "app/window/input/input_event.h"

struct GLFWwindow;

namespace trocar {

/// Our key for one of GLFW's; kKeyUnknown for those that nothing uses.
std::int32_t key_of_glfw(int key);

/// Collects what callbacks say; lives as long as the window.
struct WindowEvents {
  std::vector<InputEvent> queue = {};
  double x = 0, y = 0;                   ///< px of the framebuffer
  std::array<InputEvent, 16> pads = {};  ///< as last told, one a joystick
  std::array<bool, 16> pad_seen = {};

  /// Sets the callbacks; the window's user pointer is this.
  void listen(GLFWwindow* window);
  /// Adds a pad's state when it changed or its sticks are not at rest.
  void sample_pads();
};

}  // namespace trocar
