// The laid-out head-up display of an attempt in the window: drawn by ImGui behind all panels, as hud_painter.h draws it
// on a picture.
//
// The layout is hud_layout.h's, so its tests hold for the window too. Text is drawn no wider than it was laid out.
// Colours: Okabe and Ito's. px of the window. Thread: the window's, between begin and end of a frame of the UiLayer.
#pragma once

#include "app/picture/display/hud_layout.h"
#include "app/window/ui/theme.h"

namespace trocar {

class Ui;

void draw_hud(Ui& ui, const HudLayout& layout);

/// The same display for a left hand: the column on the left, the picture and what lies over it on the right.
HudLayout column_left(HudLayout layout);
/// Part of the window left to the scope's picture then.
PixelRect picture_right(const PixelRect& picture, int width);

/// Arrow at the rim of the round field, pointing outwards. @param x,y centre of the field, px.
/// @param angle_rad 0 to the right, up positive. @param colour of the shape.
void draw_rim_arrow(double x, double y, double radius, double angle_rad, double size, Ink colour);

}  // namespace trocar
