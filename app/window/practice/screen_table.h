// Which screen each name stands for: one line a screen. Thread: the window's.
#pragma once

#include <memory>

#include "app/window/practice/screen.h"

namespace trocar {

/// Fresh; nullptr for a name that has no screen (kQuit).
std::unique_ptr<Screen> make_screen(ScreenName name);
/// "start", "curriculum", ...: of pictures' files and tests.
const char* screen_name(ScreenName name);

}  // namespace trocar
