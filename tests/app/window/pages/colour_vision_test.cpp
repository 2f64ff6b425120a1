// States that are told apart by colour stay apart for protanopes, deuteranopes and tritanopes, and each has a shape of
// its own besides.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "app/picture/display/hud_drawing.h"
#include "app/window/ui/theme.h"

namespace trocar::colour_vision_test {
namespace {

using Linear = std::array<double, 3>;
using Matrix = std::array<Linear, 3>;

struct Vision {
  const char* name;
  Matrix seen;  ///< of linear RGB
};

// G. M. Machado, M. M. Oliveira, L. A. F. Fernandes: A physiologically-based model for simulation of color vision
// deficiency, IEEE TVCG 15(6), 2009: severity 1.0.
constexpr Vision kVisions[] = {
    {"usual", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"protanopia",
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    {"deuteranopia",
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
    {"tritanopia",
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

/// Distance in OKLab (B. Ottosson, 2020; black to white is 1). 0.02 is just seen side by side; states of small shapes
/// get three times that.
constexpr double kApart = 0.06;

Linear applied(const Matrix& m, const Linear& v) {
  Linear out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Linear oklab(const Linear& rgb) {
  constexpr Matrix kCones{{{0.4122214708, 0.5363325363, 0.0514459929},
                           {0.2119034982, 0.6806995451, 0.1073969566},
                           {0.0883024619, 0.2817188376, 0.6299787005}}};
  constexpr Matrix kLab{{{0.2104542553, 0.7936177850, -0.0040720468},
                         {1.9779984951, -2.4285922050, 0.4505937099},
                         {0.0259040371, 0.7827717662, -0.8086757660}}};
  Linear lms = applied(kCones, rgb);
  for (double& one : lms) one = std::cbrt(one);
  return applied(kLab, lms);
}

Linear seen(const Vision& vision, const Rgb& c) {
  Linear rgb = applied(vision.seen, {linear(c.r), linear(c.g), linear(c.b)});
  for (double& one : rgb) one = std::min(1.0, std::max(0.0, one));
  return oklab(rgb);
}

double distance(const Vision& vision, const Rgb& a, const Rgb& b) {
  const Linear p = seen(vision, a), q = seen(vision, b);
  return std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
}

Rgb plain(const Colour& c) { return {c.r, c.g, c.b}; }

struct State {
  const char* name;
  Rgb colour;
};

void expect_apart(const std::vector<State>& states) {
  for (const Vision& vision : kVisions)
    for (std::size_t i = 0; i < states.size(); ++i)
      for (std::size_t j = i + 1; j < states.size(); ++j)
        EXPECT_GE(distance(vision, states[i].colour, states[j].colour), kApart)
            << vision.name << ": " << states[i].name << " and " << states[j].name;
}

TEST(ColourVision, ModelKeepsGreysAndConfusesWhatItMust) {
  const Rgb black{0, 0, 0}, white{255, 255, 255};
  for (const Vision& vision : kVisions) {
    EXPECT_NEAR(distance(vision, black, white), 1, 1e-3) << vision.name;
    for (const Linear& row : vision.seen) EXPECT_NEAR(row[0] + row[1] + row[2], 1, 1e-5) << vision.name;
  }
  // A red and a green of the same lightness, the pair that such displays must not hang on.
  const Rgb red{200, 90, 60}, green{120, 130, 60};
  EXPECT_LT(distance(kVisions[2], red, green), 0.5 * distance(kVisions[0], red, green));
}

TEST(ColourVision, LevelsOfAForceBarStayApart) {
  using Level = HudBar::Level;
  using hud_colour::of;
  expect_apart({{"below", plain(of(Level::kBelow))},
                {"in band", plain(of(Level::kInBand))},
                {"above", plain(of(Level::kAbove))},
                {"over the limit", plain(of(Level::kOverLimit))}});
}

TEST(ColourVision, InksOfTheDisplayStayApart) {
  using hud_colour::of;
  expect_apart({{"good", plain(of(HudInk::kGood))},
                {"caution", plain(of(HudInk::kCaution))},
                {"alarm", plain(of(HudInk::kAlarm))},
                {"text", plain(of(HudInk::kText))}});
}

TEST(ColourVision, DotOfTheDialStaysApart) {
  expect_apart({{"inside", plain(hud_colour::kGood)}, {"outside", plain(hud_colour::kYellow)}});
}

TEST(ColourVision, InksAndShapesOfTheThemeStayApart) {
  for (const auto colour : {ink_colour, shape_colour})
    expect_apart({{"good", colour(Ink::kGood)},
                  {"caution", colour(Ink::kCaution)},
                  {"alarm", colour(Ink::kAlarm)},
                  {"heading", colour(Ink::kHeading)}});
}

/// Notes what is drawn and where, without colours.
struct ColourlessPen {
  std::ostringstream drawn = {};
  void put(const char* what, std::initializer_list<double> numbers) {
    drawn << what;
    for (const double n : numbers) drawn << ' ' << std::lround(10 * n);
    drawn << ';';
  }
  void box(const HudBox& b, const Colour&, double = 0) { put("box", {b.x, b.y, b.width, b.height}); }
  void frame(const HudBox& b, const Colour&, double, double) { put("frame", {b.x, b.y, b.width, b.height}); }
  void disc(double x, double y, double r, const Colour&) { put("disc", {x, y, r}); }
  void ring(double x, double y, double r, double w, const Colour&) { put("ring", {x, y, r, w}); }
  void line(double a, double b, double c, double d, double w, const Colour&) { put("line", {a, b, c, d, w}); }
  void triangle(double a, double b, double c, double d, double e, double f, const Colour&) {
    put("triangle", {a, b, c, d, e, f});
  }
  void hatch(const HudBox& b, double pitch, double, const Colour&) {
    put("hatch", {b.x, b.y, b.width, b.height, pitch});
  }
  void text(const HudText& t, const Colour&) { drawn << t.text << ';'; }
};

TEST(ColourVision, EverySymbolOfTheDisplayHasAShapeOfItsOwn) {
  using Kind = HudShape::Kind;
  std::set<std::string> all;
  const Kind kinds[] = {Kind::kTick, Kind::kCurrent, Kind::kOpen, Kind::kUp, Kind::kDown, Kind::kWarning, Kind::kInfo};
  for (const Kind kind : kinds) {
    ColourlessPen pen;
    draw_hud_symbol(pen, {kind, {0, 0, 20, 20}});
    EXPECT_TRUE(all.insert(pen.drawn.str()).second) << static_cast<int>(kind);
  }
}

TEST(ColourVision, LimitIsHatchedAndTheBandHasEdges) {
  ColourlessPen with, without;
  HudBar bar;
  bar.track = {0, 0, 100, 20};
  draw_hud_bar(without, bar);
  EXPECT_EQ(without.drawn.str().find("hatch"), std::string::npos);
  bar.band_low = 0.3;
  bar.band_high = 0.5;
  bar.limit = 0.8;
  draw_hud_bar(with, bar);
  EXPECT_NE(with.drawn.str().find("hatch 800 0 200 200"), std::string::npos) << with.drawn.str();
  EXPECT_NE(with.drawn.str().find("box 290 0 20 200"), std::string::npos) << with.drawn.str();
}

/// The symbol beside the value of a force: none, tick, arrow, warning.
TEST(ColourVision, EveryLevelOfAForceHasASymbol) {
  FontSet fonts;
  std::set<std::vector<int>> all;
  for (const double value : {0.2, 0.6, 1.1, 1.8}) {
    Hud hud;
    ForceBar bar;
    bar.label = "Tip force";
    bar.value_n = value;
    bar.band_low_n = 0.4;
    bar.band_high_n = 0.8;
    bar.limit_n = 1.5;
    bar.full_scale_n = 2;
    hud.bars = {bar};
    std::vector<int> kinds;
    for (const HudShape& shape : layout_hud(hud, 1280, 720, 1, fonts).shapes)
      kinds.push_back(static_cast<int>(shape.kind));
    EXPECT_TRUE(all.insert(kinds).second) << value << " N looks like another level but for its colour";
  }
}

}  // namespace
}  // namespace trocar::colour_vision_test
