#include "app/window/ui/theme.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(Rgb c) { return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b); }

const char* ink_name(Ink ink) {
  switch (ink) {
    case Ink::kText:
      return "text";
    case Ink::kDim:
      return "dim";
    case Ink::kHeading:
      return "heading";
    case Ink::kGood:
      return "good";
    case Ink::kCaution:
      return "caution";
    case Ink::kAlarm:
      return "alarm";
    case Ink::kAccent:
      return "accent";
    case Ink::kTip:
      return "tip";
  }
  return "text";
}

constexpr Ink kInks[] = {Ink::kText, Ink::kDim, Ink::kHeading, Ink::kGood, Ink::kCaution, Ink::kAlarm, Ink::kAccent};

}  // namespace

Rgb ink_colour(Ink ink) {
  switch (ink) {
    case Ink::kText:
      return {241, 243, 245};
    case Ink::kDim:
      return {176, 184, 193};
    case Ink::kHeading:
      return {146, 205, 243};
    case Ink::kGood:
      return {63, 205, 160};
    case Ink::kCaution:
      return {240, 180, 41};
    case Ink::kAlarm:
      return {255, 130, 95};
    case Ink::kAccent:
      return {244, 233, 104};
    case Ink::kTip:
      return {255, 170, 240};
  }
  return {241, 243, 245};
}

Rgb shape_colour(Ink ink) {
  switch (ink) {
    case Ink::kText:
      return {241, 243, 245};
    case Ink::kDim:
      return {128, 137, 147};
    case Ink::kHeading:
      return okabe_ito::kSky;
    case Ink::kGood:
      return okabe_ito::kGreen;
    case Ink::kCaution:
      return okabe_ito::kOrange;
    case Ink::kAlarm:
      return okabe_ito::kVermillion;
    case Ink::kAccent:
      return okabe_ito::kYellow;
    case Ink::kTip:
      return {255, 170, 240};  // okabe_ito::kPurple, lighter: no tissue, no highlight and no text has it
  }
  return {241, 243, 245};
}

Rgb ground_colour(Ground ground) {
  switch (ground) {
    case Ground::kBackdrop:
      return {0, 0, 0};
    case Ground::kPanel:
      return {17, 20, 24};
    case Ground::kField:
      return {32, 38, 45};
    case Ground::kButton:
      return {38, 45, 53};
    case Ground::kButtonHover:
      return {50, 59, 69};
    case Ground::kStrong:
      return {0, 96, 152};
    case Ground::kStrongHover:
      return {0, 110, 173};
    case Ground::kRow:
      return {24, 28, 33};
    case Ground::kChosen:
      return {18, 58, 86};
  }
  return {17, 20, 24};
}

double contrast(Rgb a, Rgb b) {
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

Rgb over(Rgb top, double opacity, Rgb below) {
  const auto mix = [opacity](std::uint8_t t, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(opacity * t + (1 - opacity) * b));
  };
  return {mix(top.r, below.r), mix(top.g, below.g), mix(top.b, below.b)};
}

std::vector<ThemePair> theme_pairs() {
  std::vector<ThemePair> pairs;
  constexpr Rgb kBrightTissue{230, 190, 180};  // the lightest that a panel covers: a lit organ, never a white sheet
  const Rgb panel = ground_colour(Ground::kPanel);
  for (const Ink ink : kInks) {
    const std::string name = ink_name(ink);
    pairs.push_back({name + " on a panel", ink_colour(ink), panel});
    pairs.push_back(
        {name + " on a panel over bright tissue", ink_colour(ink), over(panel, kPanelOpacity, kBrightTissue)});
    pairs.push_back({name + " on the backdrop", ink_colour(ink), ground_colour(Ground::kBackdrop)});
    pairs.push_back({name + " on a row", ink_colour(ink), ground_colour(Ground::kRow)});
    pairs.push_back({name + " on a chosen row", ink_colour(ink), ground_colour(Ground::kChosen)});
    pairs.push_back({name + " on a button", ink_colour(ink), ground_colour(Ground::kButton)});
  }
  const Rgb text = ink_colour(Ink::kText);
  pairs.push_back({"text in a field", text, ground_colour(Ground::kField)});
  pairs.push_back({"text on a button under the pointer", text, ground_colour(Ground::kButtonHover)});
  pairs.push_back({"text on a strong button", text, ground_colour(Ground::kStrong)});
  pairs.push_back({"text on a strong button under the pointer", text, ground_colour(Ground::kStrongHover)});
  return pairs;
}

double ui_unit(double scale, double width_px, double height_px) {
  const double fits = std::min(height_px / 720, width_px / 1280);
  return std::floor(std::clamp(fits * std::clamp(scale, 1.0, 2.0), kLeastUnit, 4.0) * 16 + 1e-6) / 16;
}

bool too_small(double width_px, double height_px) {
  return width_px < kLeastWidth * kLeastUnit || height_px < kLeastHeight * kLeastUnit;
}

}  // namespace trocar
