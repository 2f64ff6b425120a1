// How a laid-out head-up display is drawn, whatever draws it: the CPU's canvas (pictures, films) or the window's
// interface.
//
// A Pen has box, frame, disc, ring, line, triangle and hatch as Canvas has them (canvas.h), and text(const HudText&,
// const Colour&). Colours: Okabe and Ito's set, some lighter where they carry text; every state has a shape of its own
// too. px. Thread: any.
#pragma once

#include <algorithm>
#include <cmath>

#include "app/picture/display/hud_layout.h"
#include "app/picture/gl/canvas.h"

namespace trocar {

namespace hud_colour {
inline constexpr Colour kSkyBlue{86, 180, 233}, kBluishGreen{0, 158, 115}, kOrange{230, 159, 0},
    kVermillion{225, 104, 20}, kBlue{0, 114, 178};
inline constexpr Colour kBelow{60, 140, 215};  // darker than sky blue, which tritanopes take for the green of the band
inline constexpr Colour kWhite{240, 242, 245}, kGrey{178, 184, 192}, kDarkPanel{12, 14, 17}, kTrack{38, 43, 50},
    kToast{10, 12, 15, 0.90};
inline constexpr Colour kGood{40, 200, 150}, kCaution{240, 180, 41}, kAlarm{255, 130, 95}, kYellow{240, 200, 20},
    kForbidden{120, 52, 10, 0.55};
inline constexpr Colour faded(Colour colour, double alpha) { return {colour.r, colour.g, colour.b, alpha}; }

inline constexpr Colour of(HudInk ink) {
  switch (ink) {
    case HudInk::kText:
      return kWhite;
    case HudInk::kDim:
      return kGrey;
    case HudInk::kHeading:
      return kSkyBlue;
    case HudInk::kGood:
      return kGood;
    case HudInk::kCaution:
      return kCaution;
    case HudInk::kAlarm:
      return kAlarm;
  }
  return kWhite;
}

/// Of a force bar.
inline constexpr Colour of(HudBar::Level level) {
  switch (level) {
    case HudBar::Level::kOverLimit:
      return kVermillion;
    case HudBar::Level::kAbove:
      return kOrange;
    case HudBar::Level::kInBand:
      return kGood;
    case HudBar::Level::kBelow:
      return kBelow;
  }
  return kBelow;
}
}  // namespace hud_colour

template <typename Pen>
void draw_hud_symbol(Pen& pen, const HudShape& shape) {
  using namespace hud_colour;
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
    case HudShape::Kind::kOpen:
      pen.ring(x, y, 0.92 * r, 0.2 * r, faded(kGrey, 0.8));
      break;
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
    case HudShape::Kind::kPanel:
      pen.box(b, kDarkPanel);
      break;
    case HudShape::Kind::kStripe:
      pen.box(b, faded(kWhite, 0.055), 3);
      break;
    case HudShape::Kind::kToast:
      pen.box(b, kToast, 7);
      pen.frame(b, kGrey, 7, 2);
      break;
  }
}

/// Fill by the level's colour; the band has edges, the limit hatching, the peak a flag, so nothing hangs on colour.
template <typename Pen>
void draw_hud_bar(Pen& pen, const HudBar& bar) {
  using namespace hud_colour;
  const HudBox& t = bar.track;
  const auto x_of = [&](double share) { return t.x + share * t.width; };
  const auto slice = [&](double from, double to, double inset) {
    return HudBox{x_of(from), t.y + inset, std::max(0.0, (to - from) * t.width), t.height - 2 * inset};
  };
  const bool banded = bar.band_high > bar.band_low, limited = bar.limit < 1;
  pen.box(t, kTrack, 3);
  if (banded) pen.box(slice(bar.band_low, bar.band_high, 0), faded(kBluishGreen, 0.38));
  if (limited) {
    pen.box(slice(bar.limit, 1, 0), kForbidden);
    pen.hatch(slice(bar.limit, 1, 0), 0.32 * t.height, 0.10 * t.height, kVermillion);
  }
  if (bar.value > 0) pen.box(slice(0, bar.value, 0.26 * t.height), of(bar.level), 2);
  if (banded)
    for (const double share : {bar.band_low, bar.band_high}) pen.box({x_of(share) - 1, t.y, 2, t.height}, kGood);
  if (limited) pen.box({x_of(bar.limit) - 1, t.y, 2, t.height}, kVermillion);
  if (!(bar.peak > 0)) return;
  const double x = x_of(bar.peak), half = 0.24 * t.height;
  pen.box({x - 1.5, t.y, 3, t.height}, kWhite);
  pen.triangle(x - half, t.y, x + half, t.y, x, t.y + 0.3 * t.height, kWhite);
}

/// Dot on a bullseye, needle on its depth track, roll mark on the rim. A dot within the ring is round and green,
/// outside it is a yellow one with a line to the middle that says where to go.
template <typename Pen>
void draw_hud_dial(Pen& pen, const HudDial& dial) {
  using namespace hud_colour;
  const double r = 0.5 * dial.face.width, cx = dial.face.x + r, cy = dial.face.y + r;
  pen.disc(cx, cy, r, kTrack);
  pen.disc(cx, cy, dial.tolerance * r, faded(kBluishGreen, 0.38));
  pen.ring(cx, cy, dial.tolerance * r, 2, kGood);
  pen.line(cx - 0.94 * r, cy, cx + 0.94 * r, cy, 1, faded(kGrey, 0.4));
  pen.line(cx, cy - 0.94 * r, cx, cy + 0.94 * r, 1, faded(kGrey, 0.4));
  if (dial.turns) {
    pen.triangle(cx - 0.12 * r, cy - r, cx + 0.12 * r, cy - r, cx, cy - 0.84 * r, kGood);
    const double s = std::sin(dial.roll_rad), c = std::cos(dial.roll_rad);
    pen.line(cx + 0.72 * r * s, cy - 0.72 * r * c, cx + 0.98 * r * s, cy - 0.98 * r * c, 0.09 * r, kWhite);
  }
  const double x = cx + 0.9 * r * dial.x, y = cy - 0.9 * r * dial.y;
  const Colour lit = dial.inside ? kGood : kYellow;
  if (!dial.inside) pen.line(cx, cy, x, y, 0.05 * r, faded(kYellow, 0.7));
  pen.disc(x, y, 0.14 * r, lit);
  const HudBox& t = dial.depth;
  pen.box(t, kTrack, 3);
  const double middle = t.y + 0.5 * t.height, band = 0.5 * dial.tolerance * t.height;
  pen.box({t.x, middle - band, t.width, 2 * band}, faded(kBluishGreen, 0.38));
  pen.box({t.x - 2, middle - 0.48 * t.height * dial.away - 2, t.width + 4, 4}, lit);
}

template <typename Pen>
void draw_hud_with(Pen& pen, const HudLayout& layout) {
  for (const HudShape& shape : layout.shapes) draw_hud_symbol(pen, shape);
  for (const HudDial& dial : layout.dials) draw_hud_dial(pen, dial);
  for (const HudBar& bar : layout.bars) draw_hud_bar(pen, bar);
  for (const HudText& text : layout.texts) pen.text(text, hud_colour::of(text.ink));
}

}  // namespace trocar
