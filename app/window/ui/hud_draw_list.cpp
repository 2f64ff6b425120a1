#include "app/window/ui/hud_draw_list.h"

#include <imgui.h>

#include <cmath>

#include "app/picture/display/hud_drawing.h"
#include "app/window/ui/ui_parts.h"

namespace trocar {
namespace {

constexpr double kLinePerEm = 1.164;  // ImGui's size of DejaVu Sans is that of its line, ours that of the em square

ImU32 packed(const Colour& c) { return IM_COL32(c.r, c.g, c.b, static_cast<int>(std::lround(255 * c.alpha))); }
float px(double length) { return static_cast<float>(length); }

/// ImGui's list with doubles and boxes.
class Pencil {
 public:
  explicit Pencil(ImDrawList& list) : list_(list) {}
  void box(const HudBox& b, const Colour& colour, double round = 0) {
    if (b.width > 0 && b.height > 0)
      list_.AddRectFilled(at(b.x, b.y), at(b.right(), b.bottom()), packed(colour), px(round));
  }
  void frame(const HudBox& b, const Colour& colour, double round, double width) {
    list_.AddRect(at(b.x, b.y), at(b.right(), b.bottom()), packed(colour), px(round), 0, px(width));
  }
  void disc(double x, double y, double r, const Colour& colour) {
    list_.AddCircleFilled(at(x, y), px(r), packed(colour), 0);
  }
  /// @param r outer radius.
  void ring(double x, double y, double r, double width, const Colour& colour) {
    list_.AddCircle(at(x, y), px(r - 0.5 * width), packed(colour), 0, px(width));
  }
  void line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
    list_.AddLine(at(x0, y0), at(x1, y1), packed(colour), px(width));
  }
  void triangle(double x0, double y0, double x1, double y1, double x2, double y2, const Colour& colour) {
    list_.AddTriangleFilled(at(x0, y0), at(x1, y1), at(x2, y2), packed(colour));
  }
  /// Slanted stripes, clipped to the box.
  void hatch(const HudBox& b, double pitch, double width, const Colour& colour) {
    list_.PushClipRect(at(b.x, b.y), at(b.right(), b.bottom()), true);
    for (double x = b.x - b.height; x < b.right(); x += pitch) line(x, b.bottom(), x + b.height, b.y, width, colour);
    list_.PopClipRect();
  }
  /// No wider than the layout measured it.
  void text(const HudText& text, const Colour& colour) {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    ImFont* font = text.bold && fonts.Size > 1 ? fonts[1] : fonts[0];
    double size = kLinePerEm * text.size;
    const char* begin = text.text.c_str();
    const double width = font->CalcTextSizeA(px(size), 1e9F, 0, begin).x;
    if (width > text.box.width && text.box.width > 0) size *= text.box.width / width;
    const double ascent = size * font->Ascent / font->FontSize;
    list_.AddText(font, px(size), at(std::round(text.box.x), std::round(text.baseline - ascent)), packed(colour),
                  begin);
  }

 private:
  ImDrawList& list_;
};

}  // namespace

void draw_hud(Ui& ui, const HudLayout& layout) {
  Pencil pen(*ImGui::GetBackgroundDrawList());
  draw_hud_with(pen, layout);
  for (const HudText& text : layout.texts) {
    const HudBox& box = text.box;
    UiParts::note(ui, text.text, box.x, box.y, box.width, box.height, box.width, text.text.ends_with("\u2026"));
  }
}

HudLayout column_left(HudLayout layout) {
  const HudBox column = layout.column;
  if (column.width <= 0) return layout;
  const auto shift = [&](HudBox& box) {
    if (box.y + 0.5 * box.height < column.y) return;  // the top bar stays
    box.x += box.x >= column.x ? -column.x : column.width;
  };
  for (HudShape& shape : layout.shapes) shift(shape.box);
  for (HudText& text : layout.texts) shift(text.box);
  for (HudBar& bar : layout.bars) shift(bar.track);
  for (HudDial& dial : layout.dials) shift(dial.face), shift(dial.depth);
  shift(layout.column);
  return layout;
}

PixelRect picture_right(const PixelRect& picture, int width) {
  return {width - picture.x - picture.width, picture.y, picture.width, picture.height};
}

void draw_rim_arrow(double x, double y, double radius, double angle_rad, double size, Ink colour) {
  Pencil pen(*ImGui::GetBackgroundDrawList());
  const double c = std::cos(angle_rad), s = -std::sin(angle_rad);  // y down
  const double tip_x = x + radius * c, tip_y = y + radius * s, foot = radius - size;
  const double foot_x = x + foot * c, foot_y = y + foot * s, half = 0.6 * size;
  const Rgb inside = shape_colour(colour);
  const auto arrow = [&](double grow, const Colour& filled) {
    pen.triangle(tip_x + grow * c, tip_y + grow * s, foot_x - grow * c - (half + grow) * s,
                 foot_y - grow * s + (half + grow) * c, foot_x - grow * c + (half + grow) * s,
                 foot_y - grow * s - (half + grow) * c, filled);
  };
  arrow(3, hud_colour::kToast);
  arrow(0, {inside.r, inside.g, inside.b});
}

}  // namespace trocar
