// ImGui's style and fonts in the theme's colours and sizes. Only app/window/ui/ui*.cpp includes this. Thread: the
// window's.
#pragma once

#include <array>

#include "app/window/ui/theme.h"

struct ImFont;
struct ImVec4;

namespace trocar {

/// Builds the atlas of the current context for body, heading and title. @throws EnvironmentError when the font is
/// missing.
std::array<ImFont*, 3> load_fonts(double unit);
void apply_style(double unit);

ImVec4 vec(Rgb colour, double opacity = 1);
/// As draw lists want it.
unsigned packed(Rgb colour, double opacity = 1);

}  // namespace trocar
