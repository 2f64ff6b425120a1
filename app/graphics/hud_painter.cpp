#include "app/graphics/hud_painter.h"

#include <algorithm>
#include <cmath>

#include "app/graphics/canvas.h"

namespace trocar {
namespace {

constexpr Colour kSkyBlue{86, 180, 233, 1}, kBluishGreen{0, 158, 115, 1}, kOrange{230, 159, 0, 1},
    kVermillion{225, 104, 20, 1};
constexpr Colour kWhite{240, 242, 245, 1}, kGrey{178, 184, 192, 1}, kDarkPanel{12, 14, 17, 1}, kTrack{38, 43, 50, 1};

Colour ink_colour(HudInk ink) {
  switch (ink) {
    case HudInk::kText:
      return kWhite;
    case HudInk::kDim:
      return kGrey;
    case HudInk::kHeading:
      return kSkyBlue;
    case HudInk::kGood:
      return {40, 200, 150, 1};
    case HudInk::kCaution:
      return kOrange;
    case HudInk::kAlarm:
      return {255, 132, 60, 1};
  }
  return kWhite;
}

Colour faded(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

void paint_symbol(Canvas& canvas, const HudShape& shape) {
  const HudBox& b = shape.box;
  const double r = 0.5 * b.width, x = b.x + r, y = b.y + r;
  switch (shape.kind) {
    case HudShape::Kind::kTick:
      canvas.disc(x, y, r, kBluishGreen);
      canvas.line(x - 0.42 * r, y + 0.02 * r, x - 0.10 * r, y + 0.38 * r, 0.24 * r, kWhite);
      canvas.line(x - 0.10 * r, y + 0.38 * r, x + 0.45 * r, y - 0.34 * r, 0.24 * r, kWhite);
      break;
    case HudShape::Kind::kCurrent:
      canvas.ring(x, y, r, 0.24 * r, kSkyBlue);
      canvas.triangle(x - 0.28 * r, y - 0.48 * r, x - 0.28 * r, y + 0.48 * r, x + 0.55 * r, y, kSkyBlue);
      break;
    case HudShape::Kind::kOpen:
      canvas.ring(x, y, 0.92 * r, 0.2 * r, faded(kGrey, 0.8));
      break;
    case HudShape::Kind::kUp:
      canvas.triangle(x - 0.9 * r, y + 0.2 * r, x + 0.9 * r, y + 0.2 * r, x, y - 0.9 * r, kOrange);
      canvas.box({x - 0.32 * r, y + 0.1 * r, 0.64 * r, 0.8 * r}, kOrange);
      break;
    case HudShape::Kind::kDown:
      canvas.triangle(x - 0.9 * r, y - 0.2 * r, x + 0.9 * r, y - 0.2 * r, x, y + 0.9 * r, kSkyBlue);
      canvas.box({x - 0.32 * r, y - 0.9 * r, 0.64 * r, 0.8 * r}, kSkyBlue);
      break;
    case HudShape::Kind::kWarning:
      canvas.triangle(x - r, y + 0.85 * r, x + r, y + 0.85 * r, x, y - 0.9 * r, kVermillion);
      canvas.line(x, y - 0.32 * r, x, y + 0.26 * r, 0.22 * r, kWhite);
      canvas.disc(x, y + 0.58 * r, 0.13 * r, kWhite);
      break;
    case HudShape::Kind::kInfo:
      canvas.disc(x, y, r, {0, 114, 178, 1});
      canvas.disc(x, y - 0.42 * r, 0.14 * r, kWhite);
      canvas.line(x, y - 0.05 * r, x, y + 0.5 * r, 0.24 * r, kWhite);
      break;
    default:
      break;
  }
}

void paint_shape(Canvas& canvas, const HudShape& shape) {
  switch (shape.kind) {
    case HudShape::Kind::kPanel:
      canvas.box(shape.box, kDarkPanel);
      break;
    case HudShape::Kind::kStripe:
      canvas.box(shape.box, {255, 255, 255, 0.055}, 3);
      break;
    case HudShape::Kind::kToast:
      canvas.box(shape.box, {10, 12, 15, 0.90}, 7);
      canvas.frame(shape.box, kGrey, 7, 2);
      break;
    default:
      paint_symbol(canvas, shape);
      break;
  }
}

void paint_bar(Canvas& canvas, const HudBar& bar) {
  const HudBox& t = bar.track;
  const auto at = [&](double share) { return t.x + share * t.width; };
  const auto slice = [&](double from, double to, double inset) {
    return HudBox{at(from), t.y + inset, std::max(0.0, (to - from) * t.width), t.height - 2 * inset};
  };
  canvas.box(t, kTrack, 3);
  if (bar.band_high > bar.band_low) canvas.box(slice(bar.band_low, bar.band_high, 0), {0, 158, 115, 0.38});
  if (bar.limit < 1) {
    canvas.box(slice(bar.limit, 1, 0), {120, 52, 10, 0.55});
    canvas.hatch(slice(bar.limit, 1, 0), 0.32 * t.height, 0.10 * t.height, kVermillion);
  }
  const Colour fill = bar.level == HudBar::Level::kOverLimit ? kVermillion
                      : bar.level == HudBar::Level::kAbove   ? kOrange
                      : bar.level == HudBar::Level::kInBand  ? Colour{40, 200, 150, 1}
                                                             : kSkyBlue;
  if (bar.value > 0) canvas.box(slice(0, bar.value, 0.26 * t.height), fill, 2);
  if (bar.band_high > bar.band_low)
    for (const double share : {bar.band_low, bar.band_high})
      canvas.box({at(share) - 1, t.y, 2, t.height}, {40, 200, 150, 1});
  if (bar.limit < 1) canvas.box({at(bar.limit) - 1, t.y, 2, t.height}, kVermillion);
  if (bar.peak > 0) {
    canvas.box({at(bar.peak) - 1.5, t.y, 3, t.height}, kWhite);
    canvas.triangle(at(bar.peak) - 0.24 * t.height, t.y, at(bar.peak) + 0.24 * t.height, t.y, at(bar.peak),
                    t.y + 0.3 * t.height, kWhite);
  }
}

/// Dot on a bullseye, needle on its depth track, roll mark on the rim. A dot within the ring is round and green,
/// outside it is a yellow one with a line to the middle that says where to go.
void paint_dial(Canvas& canvas, const HudDial& dial) {
  const double r = 0.5 * dial.face.width, cx = dial.face.x + r, cy = dial.face.y + r;
  const Colour good{40, 200, 150, 1}, lit{240, 200, 20, 1};
  canvas.disc(cx, cy, r, kTrack);
  canvas.disc(cx, cy, dial.tolerance * r, {0, 158, 115, 0.38});
  canvas.ring(cx, cy, dial.tolerance * r, 2, good);
  canvas.line(cx - 0.94 * r, cy, cx + 0.94 * r, cy, 1, faded(kGrey, 0.4));
  canvas.line(cx, cy - 0.94 * r, cx, cy + 0.94 * r, 1, faded(kGrey, 0.4));
  if (dial.turns) {
    canvas.triangle(cx - 0.12 * r, cy - r, cx + 0.12 * r, cy - r, cx, cy - 0.84 * r, good);
    const double s = std::sin(dial.roll_rad), c = std::cos(dial.roll_rad);
    canvas.line(cx + 0.72 * r * s, cy - 0.72 * r * c, cx + 0.98 * r * s, cy - 0.98 * r * c, 0.09 * r, kWhite);
  }
  const double x = cx + 0.9 * r * dial.x, y = cy - 0.9 * r * dial.y;
  if (!dial.inside) canvas.line(cx, cy, x, y, 0.05 * r, faded(lit, 0.7));
  canvas.disc(x, y, 0.14 * r, dial.inside ? good : lit);
  const HudBox& t = dial.depth;
  canvas.box(t, kTrack, 3);
  const double middle = t.y + 0.5 * t.height, band = 0.5 * dial.tolerance * t.height;
  canvas.box({t.x, middle - band, t.width, 2 * band}, {0, 158, 115, 0.38});
  canvas.box({t.x - 2, middle - 0.48 * t.height * dial.away - 2, t.width + 4, 4}, dial.inside ? good : lit);
}

}  // namespace

void paint_hud(Image& image, const HudLayout& layout, FontSet& fonts) {
  Canvas canvas(image);
  for (const HudShape& shape : layout.shapes) paint_shape(canvas, shape);
  for (const HudDial& dial : layout.dials) paint_dial(canvas, dial);
  for (const HudBar& bar : layout.bars) paint_bar(canvas, bar);
  for (const HudText& text : layout.texts)
    canvas.text(text.text, text.box.x, text.baseline, text.size, text.bold, ink_colour(text.ink), fonts);
}

}  // namespace trocar
