// Where every piece of the head-up display stands: a pure function of its content, so that overlap can be tested.
//
// Top bar, right column (force bars, steps, "So far", device), credit strip, one toast over the picture. Body text is
// 18 px at 720 lines times the text scale, 12 px at the least; what is too wide for its place is drawn smaller, by a
// quarter at most, and only then shortened with an ellipsis: a number never. When the column is full, lists are cut
// with a line that says how many entries are left out, gauges (HudRow::gauge, force bars) last. Pixels of the image, y
// down.
#pragma once

#include <string>
#include <vector>

#include "app/picture/gl/font.h"
#include "app/picture/scene/scene_view.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar {

struct HudBox {
  double x = 0, y = 0, width = 0, height = 0;  ///< px
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

enum class HudInk : std::uint8_t { kText, kDim, kHeading, kGood, kCaution, kAlarm };

struct HudText {
  std::string text;
  HudBox box;           ///< from ascent to descent
  double baseline = 0;  ///< px
  int size = 0;
  bool bold = false;
  HudInk ink = HudInk::kText;
};

/// A filled rectangle or a symbol; symbols carry meaning by shape, colour only repeats it.
struct HudShape {
  enum class Kind : std::uint8_t {
    kPanel,
    kStripe,
    kToast,
    kTick,
    kCurrent,
    kOpen,
    kUp,
    kDown,
    kWarning,
    kInfo
  } kind = Kind::kPanel;
  HudBox box;
};

/// Force bar; shares are of the track's width, 0..1.
struct HudBar {
  HudBox track;
  double value = 0, peak = 0, band_low = 0, band_high = 0, limit = 1;
  enum class Level : std::uint8_t { kBelow, kInBand, kAbove, kOverLimit } level = Level::kBelow;
};

/// Bullseye with a needle for depth beside it; places are shares of its radius, -1..1, compressed beyond the tolerance.
struct HudDial {
  HudBox face;             ///< square round the bullseye
  HudBox depth;            ///< upright track of the needle, right of it
  double x = 0, y = 0;     ///< of the dot: right, up
  double away = 0;         ///< of the needle: up is away from the lens
  double tolerance = 0.4;  ///< radius of the ring
  bool turns = false;      ///< has a roll mark on its rim
  double roll_rad = 0;
  bool inside = false;  ///< within the tolerance
};

struct HudLayout {
  std::vector<HudShape> shapes;  ///< painted first, in order
  std::vector<HudDial> dials;
  std::vector<HudBar> bars;
  std::vector<HudText> texts;
  HudBox column;  ///< the right column, empty when there is none
};

/// True when nothing but the credit is to be shown.
bool hud_is_empty(const Hud& hud);

/// Part of the image left to the scope's picture.
PixelRect hud_scene_window(const Hud& hud, int width, int height, double text_scale);

/// @param text_scale 1 to 2; values outside are limited to that.
HudLayout layout_hud(const Hud& hud, int width, int height, double text_scale, FontSet& fonts);

/// Place on a dial of an error that is `error` tolerances: the ring at 0.4, the rim at the horizon.
double dial_share(double error);

/// How a force stands to band and limit.
HudBar::Level force_level(const ForceBar& bar);

}  // namespace trocar
