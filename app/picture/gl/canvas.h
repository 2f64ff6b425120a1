// Anti-aliased shapes and text on an 8-bit picture, by the CPU: enough for a head-up display, the same on every
// machine.
//
// Pixels, y down; a pixel's centre is at +0.5. Coverage from signed distances. Thread: any.
#pragma once

#include <string>

#include "app/picture/display/hud_layout.h"
#include "app/picture/gl/font.h"
#include "app/picture/gl/image.h"

namespace trocar {

struct Colour {
  std::uint8_t r = 255, g = 255, b = 255;
  double alpha = 1;
};

class Canvas {
 public:
  explicit Canvas(Image& image) : image_(image) {}
  void box(const HudBox& box, const Colour& colour, double corner = 0);
  void frame(const HudBox& box, const Colour& colour, double corner, double thickness);
  void disc(double x, double y, double radius, const Colour& colour);
  void ring(double x, double y, double radius, double thickness, const Colour& colour);
  void line(double x0, double y0, double x1, double y1, double thickness, const Colour& colour);
  void triangle(double x0, double y0, double x1, double y1, double x2, double y2, const Colour& colour);
  /// 45-degree hatching inside a box. @param pitch,thickness px across the lines.
  void hatch(const HudBox& box, double pitch, double thickness, const Colour& colour);
  void text(const std::string& words, double x, double baseline, int size, bool bold, const Colour& colour,
            FontSet& fonts);

 private:
  template <typename Coverage>
  void fill(double x0, double y0, double x1, double y1, const Colour& colour, const Coverage& coverage);
  void blend(int x, int y, const Colour& colour, double coverage);
  Image& image_;
};

}  // namespace trocar
