// What `trocar doctor` tries rather than believes: whether a display answers, and what stands between the driver and a
// board of the thesis.
//
// Reads and connects only; nothing is written to a board. Thread: any.
#pragma once

#include <string>

namespace trocar {

/// Whether a server answers. @param display as DISPLAY has it: ":0", "localhost:10.0".
bool x_answers(const std::string& display);
/// @param display as WAYLAND_DISPLAY has it.
bool wayland_answers(const std::string& display);

/// --card names boards of the thesis and no address of a Mesa card.
bool names_boards(const std::string& card);

struct BoardLook {
  std::string trouble = {};  ///< why the driver could not use it, and what to do; empty: nothing
  std::string driver = {};   ///< of the kernel, that it is bound to; empty: none
};
/// @param device a folder of PCI's sysfs, or /dev/uioN.
BoardLook look_at_board(const std::string& device);

}  // namespace trocar
