#include "app/picture/gl/canvas.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

/// Coverage of a pixel whose centre lies at a signed distance (negative inside) from an edge.
double edge(double distance) { return std::clamp(0.5 - distance, 0.0, 1.0); }

double box_distance(double x, double y, const HudBox& box, double corner) {
  const double qx = std::abs(x - box.x - 0.5 * box.width) - 0.5 * box.width + corner;
  const double qy = std::abs(y - box.y - 0.5 * box.height) - 0.5 * box.height + corner;
  return std::hypot(std::max(qx, 0.0), std::max(qy, 0.0)) + std::min(std::max(qx, qy), 0.0) - corner;
}

double segment_distance(double x, double y, double x0, double y0, double x1, double y1) {
  const double dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((x - x0) * dx + (y - y0) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - x0 - t * dx, y - y0 - t * dy);
}

}  // namespace

void Canvas::blend(int x, int y, const Colour& colour, double coverage) {
  const double a = colour.alpha * coverage;
  if (a <= 0) return;
  std::uint8_t* p = image_.pixel(x, y);
  const auto mix = [a](std::uint8_t under, std::uint8_t over) {
    return static_cast<std::uint8_t>(std::lround(under + a * (static_cast<double>(over) - under)));
  };
  p[0] = mix(p[0], colour.r);
  p[1] = mix(p[1], colour.g);
  p[2] = mix(p[2], colour.b);
}

template <typename Coverage>
void Canvas::fill(double x0, double y0, double x1, double y1, const Colour& colour, const Coverage& coverage) {
  const int left = std::max(0, static_cast<int>(std::floor(x0)) - 1),
            right = std::min(image_.width - 1, static_cast<int>(std::ceil(x1)) + 1);
  const int top = std::max(0, static_cast<int>(std::floor(y0)) - 1),
            low = std::min(image_.height - 1, static_cast<int>(std::ceil(y1)) + 1);
  for (int y = top; y <= low; ++y)
    for (int x = left; x <= right; ++x) blend(x, y, colour, coverage(x + 0.5, y + 0.5));
}

void Canvas::box(const HudBox& b, const Colour& colour, double corner) {
  fill(b.x, b.y, b.right(), b.bottom(), colour,
       [&](double x, double y) { return edge(box_distance(x, y, b, corner)); });
}

void Canvas::frame(const HudBox& b, const Colour& colour, double corner, double thickness) {
  fill(b.x, b.y, b.right(), b.bottom(), colour, [&](double x, double y) {
    return edge(std::abs(box_distance(x, y, b, corner) + 0.5 * thickness) - 0.5 * thickness);
  });
}

void Canvas::disc(double cx, double cy, double radius, const Colour& colour) {
  fill(cx - radius, cy - radius, cx + radius, cy + radius, colour,
       [&](double x, double y) { return edge(std::hypot(x - cx, y - cy) - radius); });
}

void Canvas::ring(double cx, double cy, double radius, double thickness, const Colour& colour) {
  fill(cx - radius, cy - radius, cx + radius, cy + radius, colour, [&](double x, double y) {
    return edge(std::abs(std::hypot(x - cx, y - cy) - radius + 0.5 * thickness) - 0.5 * thickness);
  });
}

void Canvas::line(double x0, double y0, double x1, double y1, double thickness, const Colour& colour) {
  const double t = 0.5 * thickness;
  fill(std::min(x0, x1) - t, std::min(y0, y1) - t, std::max(x0, x1) + t, std::max(y0, y1) + t, colour,
       [&](double x, double y) { return edge(segment_distance(x, y, x0, y0, x1, y1) - t); });
}

void Canvas::triangle(double x0, double y0, double x1, double y1, double x2, double y2, const Colour& colour) {
  const auto side = [](double x, double y, double ax, double ay, double bx, double by) {
    return ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / std::max(std::hypot(bx - ax, by - ay), 1e-9);
  };
  const double turn = side(x2, y2, x0, y0, x1, y1) < 0 ? 1 : -1;  // distances positive outside
  fill(std::min({x0, x1, x2}), std::min({y0, y1, y2}), std::max({x0, x1, x2}), std::max({y0, y1, y2}), colour,
       [&](double x, double y) {
         return edge(std::max({turn * side(x, y, x0, y0, x1, y1), turn * side(x, y, x1, y1, x2, y2),
                               turn * side(x, y, x2, y2, x0, y0)}));
       });
}

void Canvas::hatch(const HudBox& b, double pitch, double thickness, const Colour& colour) {
  fill(b.x, b.y, b.right(), b.bottom(), colour, [&](double x, double y) {
    const double across = (x + y) * 0.70710678;
    const double off = across - pitch * std::round(across / pitch);
    return std::min(edge(box_distance(x, y, b, 0)), edge(std::abs(off) - 0.5 * thickness));
  });
}

void Canvas::text(const std::string& words, double x, double baseline, int size, bool bold, const Colour& colour,
                  FontSet& fonts) {
  double pen = x;
  for (const char32_t code : decode_utf8(words)) {
    const Glyph& glyph = fonts.glyph(code, size, bold);
    const int left = static_cast<int>(std::lround(pen)) + glyph.left,
              top = static_cast<int>(std::lround(baseline)) - glyph.top;
    for (int row = 0; row < glyph.height; ++row)
      for (int column = 0; column < glyph.width; ++column) {
        const int px = left + column, py = top + row;
        if (px < 0 || py < 0 || px >= image_.width || py >= image_.height) continue;
        blend(px, py, colour, glyph.coverage[static_cast<std::size_t>(row * glyph.width + column)] / 255.0);
      }
    pen += glyph.advance;
  }
}

}  // namespace trocar
