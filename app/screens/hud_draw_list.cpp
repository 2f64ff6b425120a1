#include "app/screens/hud_draw_list.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace trocar {
namespace {

struct Paint {
  int r, g, b;
  double alpha = 1;
  operator ImU32() const { return IM_COL32(r, g, b, static_cast<int>(std::lround(255 * alpha))); }
  Paint faded(double by) const { return {r, g, b, by}; }
};

constexpr Paint kSkyBlue{86, 180, 233}, kBluishGreen{0, 158, 115}, kOrange{230, 159, 0}, kVermillion{225, 104, 20};
constexpr Paint kWhite{240, 242, 245}, kGrey{178, 184, 192}, kDarkPanel{12, 14, 17}, kTrack{38, 43, 50};
constexpr Paint kGood{40, 200, 150}, kAlarm{255, 132, 60}, kYellow{240, 200, 20}, kBlue{0, 114, 178};
constexpr double kLinePerEm = 1.164;   // ImGui's size of DejaVu Sans is that of its line, ours that of the em square

Paint ink_paint(HudInk ink) {
  switch (ink) {
    case HudInk::kText: return kWhite;
    case HudInk::kDim: return kGrey;
    case HudInk::kHeading: return kSkyBlue;
    case HudInk::kGood: return kGood;
    case HudInk::kCaution: return kOrange;
    case HudInk::kAlarm: return kAlarm;
  }
  return kWhite;
}

ImVec2 at(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }
float px(double length) { return static_cast<float>(length); }

/// ImGui's list with doubles and boxes.
class Pencil {
 public:
  explicit Pencil(ImDrawList& list) : list_(list) {}
  void box(const HudBox& b, Paint paint, double round = 0) {
    if (b.width > 0 && b.height > 0) list_.AddRectFilled(at(b.x, b.y), at(b.right(), b.bottom()), paint, px(round));
  }
  void frame(const HudBox& b, Paint paint, double round, double width) {
    list_.AddRect(at(b.x, b.y), at(b.right(), b.bottom()), paint, px(round), 0, px(width));
  }
  void disc(double x, double y, double r, Paint paint) { list_.AddCircleFilled(at(x, y), px(r), paint, 0); }
  /// @param r outer radius.
  void ring(double x, double y, double r, double width, Paint paint) {
    list_.AddCircle(at(x, y), px(r - 0.5 * width), paint, 0, px(width));
  }
  void line(double x0, double y0, double x1, double y1, double width, Paint paint) {
    list_.AddLine(at(x0, y0), at(x1, y1), paint, px(width));
  }
  void triangle(double x0, double y0, double x1, double y1, double x2, double y2, Paint paint) {
    list_.AddTriangleFilled(at(x0, y0), at(x1, y1), at(x2, y2), paint);
  }
  /// Slanted stripes, clipped to the box.
  void hatch(const HudBox& b, double pitch, double width, Paint paint) {
    list_.PushClipRect(at(b.x, b.y), at(b.right(), b.bottom()), true);
    for (double x = b.x - b.height; x < b.right(); x += pitch) line(x, b.bottom(), x + b.height, b.y, width, paint);
    list_.PopClipRect();
  }
  /// No wider than the layout measured it.
  void text(const HudText& text) {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    ImFont* font = text.bold && fonts.Size > 1 ? fonts[1] : fonts[0];
    double size = kLinePerEm * text.size;
    const char* begin = text.text.c_str();
    const double width = font->CalcTextSizeA(px(size), 1e9F, 0, begin).x;
    if (width > text.box.width && text.box.width > 0) size *= text.box.width / width;
    const double ascent = size * font->Ascent / font->FontSize;
    list_.AddText(font, px(size), at(std::round(text.box.x), std::round(text.baseline - ascent)), ink_paint(text.ink), begin);
  }

 private:
  ImDrawList& list_;
};

void draw_symbol(Pencil& pen, const HudShape& shape) {
  const HudBox& b = shape.box;
  const double r = 0.5 * b.width, x = b.x + r, y = b.y + r;
  switch (shape.kind) {
    case HudShape::Kind::kTick:
      pen.disc(x, y, r, kBluishGreen);
      pen.line(x - 0.42 * r, y + 0.02 * r, x - 0.10 * r, y + 0.38 * r, 0.24 * r, kWhite);
      pen.line(x - 0.10 * r, y + 0.38 * r, x + 0.45 * r, y - 0.34 * r, 0.24 * r, kWhite);
      break;
    case HudShape::Kind::kCurrent:
      pen.ring(x, y, r, 0.24 * r, kSkyBlue);
      pen.triangle(x - 0.28 * r, y - 0.48 * r, x - 0.28 * r, y + 0.48 * r, x + 0.55 * r, y, kSkyBlue);
      break;
    case HudShape::Kind::kOpen: pen.ring(x, y, 0.92 * r, 0.2 * r, kGrey.faded(0.8)); break;
    case HudShape::Kind::kUp:
      pen.triangle(x - 0.9 * r, y + 0.2 * r, x + 0.9 * r, y + 0.2 * r, x, y - 0.9 * r, kOrange);
      pen.box({x - 0.32 * r, y + 0.1 * r, 0.64 * r, 0.8 * r}, kOrange);
      break;
    case HudShape::Kind::kDown:
      pen.triangle(x - 0.9 * r, y - 0.2 * r, x + 0.9 * r, y - 0.2 * r, x, y + 0.9 * r, kSkyBlue);
      pen.box({x - 0.32 * r, y - 0.9 * r, 0.64 * r, 0.8 * r}, kSkyBlue);
      break;
    case HudShape::Kind::kWarning:
      pen.triangle(x - r, y + 0.85 * r, x + r, y + 0.85 * r, x, y - 0.9 * r, kVermillion);
      pen.line(x, y - 0.32 * r, x, y + 0.26 * r, 0.22 * r, kWhite);
      pen.disc(x, y + 0.58 * r, 0.13 * r, kWhite);
      break;
    case HudShape::Kind::kInfo:
      pen.disc(x, y, r, kBlue);
      pen.disc(x, y - 0.42 * r, 0.14 * r, kWhite);
      pen.line(x, y - 0.05 * r, x, y + 0.5 * r, 0.24 * r, kWhite);
      break;
    default: break;
  }
}

void draw_shape(Pencil& pen, const HudShape& shape) {
  switch (shape.kind) {
    case HudShape::Kind::kPanel: return pen.box(shape.box, kDarkPanel);
    case HudShape::Kind::kStripe: return pen.box(shape.box, kWhite.faded(0.055), 3);
    case HudShape::Kind::kToast:
      pen.box(shape.box, {10, 12, 15, 0.90}, 7);
      return pen.frame(shape.box, kGrey, 7, 2);
    default: return draw_symbol(pen, shape);
  }
}

Paint fill_paint(HudBar::Level level) {
  switch (level) {
    case HudBar::Level::kOverLimit: return kVermillion;
    case HudBar::Level::kAbove: return kOrange;
    case HudBar::Level::kInBand: return kGood;
    case HudBar::Level::kBelow: break;
  }
  return kSkyBlue;
}

void draw_bar(Pencil& pen, const HudBar& bar) {
  const HudBox& t = bar.track;
  const auto x_of = [&](double share) { return t.x + share * t.width; };
  const auto slice = [&](double from, double to, double inset) {
    return HudBox{x_of(from), t.y + inset, std::max(0.0, (to - from) * t.width), t.height - 2 * inset};
  };
  pen.box(t, kTrack, 3);
  if (bar.band_high > bar.band_low) pen.box(slice(bar.band_low, bar.band_high, 0), kBluishGreen.faded(0.38));
  if (bar.limit < 1) {
    pen.box(slice(bar.limit, 1, 0), {120, 52, 10, 0.55});
    pen.hatch(slice(bar.limit, 1, 0), 0.32 * t.height, 0.10 * t.height, kVermillion);
  }
  if (bar.value > 0) pen.box(slice(0, bar.value, 0.26 * t.height), fill_paint(bar.level), 2);
  if (bar.band_high > bar.band_low)
    for (const double share : {bar.band_low, bar.band_high}) pen.box({x_of(share) - 1, t.y, 2, t.height}, kGood);
  if (bar.limit < 1) pen.box({x_of(bar.limit) - 1, t.y, 2, t.height}, kVermillion);
  if (bar.peak > 0) {
    pen.box({x_of(bar.peak) - 1.5, t.y, 3, t.height}, kWhite);
    const double x = x_of(bar.peak), half = 0.24 * t.height;
    pen.triangle(x - half, t.y, x + half, t.y, x, t.y + 0.3 * t.height, kWhite);
  }
}

void draw_dial(Pencil& pen, const HudDial& dial) {
  const double r = 0.5 * dial.face.width, cx = dial.face.x + r, cy = dial.face.y + r;
  pen.disc(cx, cy, r, kTrack);
  pen.disc(cx, cy, dial.tolerance * r, kBluishGreen.faded(0.38));
  pen.ring(cx, cy, dial.tolerance * r, 2, kGood);
  pen.line(cx - 0.94 * r, cy, cx + 0.94 * r, cy, 1, kGrey.faded(0.4));
  pen.line(cx, cy - 0.94 * r, cx, cy + 0.94 * r, 1, kGrey.faded(0.4));
  if (dial.turns) {
    pen.triangle(cx - 0.12 * r, cy - r, cx + 0.12 * r, cy - r, cx, cy - 0.84 * r, kGood);
    const double s = std::sin(dial.roll_rad), c = std::cos(dial.roll_rad);
    pen.line(cx + 0.72 * r * s, cy - 0.72 * r * c, cx + 0.98 * r * s, cy - 0.98 * r * c, 0.09 * r, kWhite);
  }
  const double x = cx + 0.9 * r * dial.x, y = cy - 0.9 * r * dial.y;
  if (!dial.inside) pen.line(cx, cy, x, y, 0.05 * r, kYellow.faded(0.7));
  pen.disc(x, y, 0.14 * r, dial.inside ? kGood : kYellow);
  const HudBox& t = dial.depth;
  pen.box(t, kTrack, 3);
  const double middle = t.y + 0.5 * t.height, band = 0.5 * dial.tolerance * t.height;
  pen.box({t.x, middle - band, t.width, 2 * band}, kBluishGreen.faded(0.38));
  pen.box({t.x - 2, middle - 0.48 * t.height * dial.away - 2, t.width + 4, 4}, dial.inside ? kGood : kYellow);
}

}  // namespace

void draw_hud(const HudLayout& layout) {
  Pencil pen(*ImGui::GetBackgroundDrawList());
  for (const HudShape& shape : layout.shapes) draw_shape(pen, shape);
  for (const HudDial& dial : layout.dials) draw_dial(pen, dial);
  for (const HudBar& bar : layout.bars) draw_bar(pen, bar);
  for (const HudText& text : layout.texts) pen.text(text);
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

void draw_rim_arrow(double x, double y, double radius, double angle_rad, double size) {
  Pencil pen(*ImGui::GetBackgroundDrawList());
  const double c = std::cos(angle_rad), s = -std::sin(angle_rad);  // y down
  const double tip_x = x + radius * c, tip_y = y + radius * s, foot = radius - size;
  const double foot_x = x + foot * c, foot_y = y + foot * s, half = 0.6 * size;
  const auto arrow = [&](double grow, Paint paint) {
    pen.triangle(tip_x + grow * c, tip_y + grow * s, foot_x - grow * c - (half + grow) * s, foot_y - grow * s + (half + grow) * c,
                 foot_x - grow * c + (half + grow) * s, foot_y - grow * s - (half + grow) * c, paint);
  };
  arrow(3, {10, 12, 15, 0.9});
  arrow(0, kYellow);
}

}  // namespace trocar
