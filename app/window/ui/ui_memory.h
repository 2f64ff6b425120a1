// What the pieces of Ui share from frame to frame with the layer below them: fonts, keys pressed now, the order of Tab.
//
// Kept by UiLayer, reached through ImGui's own context. Only app/window/ui/ui*.cpp includes this. Thread: the window's.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct ImFont;
struct ImGuiWindow;

namespace trocar {

enum class UiFont : std::uint8_t { kBody, kHeading, kTitle };

struct UiMemory {
  std::array<ImFont*, 3> fonts{};
  double unit = 1;
  std::vector<std::int32_t> pressed = {};  ///< keys gone down since the last frame, repeats too
  /// Items in the order in which they were drawn: this frame's, and the last one's.
  struct Item {
    unsigned id = 0;
    bool types = false;
  };
  std::vector<Item> items = {}, items_before = {};
  unsigned focus_wanted = 0;     ///< item that Tab goes to
  bool focus_shown = false;      ///< an item of the last frame has the keyboard, and its ring is seen
  bool list_was_open = false;    ///< a list was down when the frame began: its keys are its own
  bool keys_to_screen = false;   ///< asked in this frame for the next: arrows steer, they do not move the focus
  bool screen_has_keys = false;  ///< it was asked for in the last one
  double pointer_x = -1, pointer_y = -1;  ///< px
};

/// Of the frame that is being drawn.
UiMemory& ui_memory();

}  // namespace trocar
