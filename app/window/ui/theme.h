// Colours and sizes of the trainee's window: Okabe and Ito's palette on a dark ground.
//
// Shapes carry the palette itself; text takes lighter tints of it, so that it reads at 4.5:1 or better on every ground
// that it stands on (WCAG 2.1, 1.4.3). Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/window/ui/ui.h"

namespace trocar {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// M. Okabe, K. Ito: Color Universal Design (2008).
namespace okabe_ito {
inline constexpr Rgb kOrange{230, 159, 0}, kSky{86, 180, 233}, kGreen{0, 158, 115}, kYellow{240, 228, 66},
    kBlue{0, 114, 178}, kVermillion{213, 94, 0}, kPurple{204, 121, 167};
}

/// What lies behind a text.
enum class Ground : std::uint8_t {
  kBackdrop,
  kPanel,
  kField,
  kButton,
  kButtonHover,
  kStrong,
  kStrongHover,
  kRow,
  kChosen
};

Rgb ink_colour(Ink ink);    ///< of text
Rgb shape_colour(Ink ink);  ///< of bars, marks, lines: the palette itself
Rgb ground_colour(Ground ground);
inline constexpr double kPanelOpacity = 0.92;

/// (L1 + 0.05) / (L2 + 0.05), L relative luminance of sRGB: 1 to 21.
double contrast(Rgb a, Rgb b);
/// What is seen of `top` over `below`.
Rgb over(Rgb top, double opacity, Rgb below);

/// Every pair of text and ground that the pieces of Ui use.
struct ThemePair {
  std::string name;
  Rgb ink, ground;
};
std::vector<ThemePair> theme_pairs();

/// px that one px at 720 lines and scale 1 becomes: in steps of 1/16, 0.625 to 4, so that fonts need not be built at
/// every size of a window.
double ui_unit(double scale, double width_px, double height_px);

/// Pages need so much at the least, px at 720 lines: what 1280 x 720 leaves at 200 %. Smaller windows get one sentence.
inline constexpr double kLeastUnit = 0.625, kLeastWidth = 640, kLeastHeight = 360;
bool too_small(double width_px, double height_px);

}  // namespace trocar
