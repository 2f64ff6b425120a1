// Shapes: bars, curves, hatching, and the marks that stand beside words so that colour is never alone.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <imgui.h>
#include <imgui_internal.h>

#include "app/window/ui/theme.h"
#include "app/window/ui/ui_parts.h"
#include "app/window/ui/ui_style.h"

namespace trocar {
namespace {

float f(double value) { return static_cast<float>(value); }

/// Of the panel that is open; without one the ground below all panels.
ImDrawList& list() {
  const ImGuiWindow* window = GImGui->CurrentWindow;
  return window == nullptr || window->IsFallbackWindow ? *ImGui::GetBackgroundDrawList() : *ImGui::GetWindowDrawList();
}

unsigned shape(Ink ink, double opacity = 1) { return packed(shape_colour(ink), opacity); }

/// A square with its middle, from which a mark is drawn.
struct Square {
  double x, y, side;
  ImVec2 point(double u, double v) const { return at(x + u * side, y + v * side); }
};

void paint_tick(const Square& s, double thick) {
  list().AddCircleFilled(s.point(0.5, 0.5), f(0.46 * s.side), shape(Ink::kGood), 24);
  const ImVec2 line[] = {s.point(0.28, 0.53), s.point(0.44, 0.69), s.point(0.74, 0.34)};
  list().AddPolyline(line, 3, packed({255, 255, 255}), ImDrawFlags_None, f(thick * 1.1));
}

void paint_lock(const Square& s, double thick) {
  const unsigned grey = packed(ink_colour(Ink::kDim));
  list().AddRectFilled(s.point(0.22, 0.46), s.point(0.78, 0.88), grey, f(0.08 * s.side));
  list().PathArcTo(s.point(0.5, 0.46), f(0.19 * s.side), f(-std::numbers::pi), 0, 12);
  list().PathStroke(grey, ImDrawFlags_None, f(thick));
}

void paint_warning(const Square& s, double thick) {
  list().AddTriangleFilled(s.point(0.5, 0.06), s.point(0.97, 0.92), s.point(0.03, 0.92), shape(Ink::kAlarm));
  list().AddLine(s.point(0.5, 0.36), s.point(0.5, 0.64), packed({255, 255, 255}), f(thick * 1.2));
  list().AddCircleFilled(s.point(0.5, 0.78), f(thick * 0.75), packed({255, 255, 255}));
}

void paint_info(const Square& s, double thick) {
  list().AddCircleFilled(s.point(0.5, 0.5), f(0.46 * s.side), packed(okabe_ito::kBlue), 24);
  list().AddLine(s.point(0.5, 0.44), s.point(0.5, 0.74), packed({255, 255, 255}), f(thick * 1.2));
  list().AddCircleFilled(s.point(0.5, 0.29), f(thick * 0.8), packed({255, 255, 255}));
}

void paint_half(const Square& s, double thick) {
  const ImVec2 middle = s.point(0.5, 0.5);
  list().AddCircle(middle, f(0.42 * s.side), shape(Ink::kCaution), 24, f(thick));
  list().PathArcTo(middle, f(0.42 * s.side), f(-std::numbers::pi / 2), f(std::numbers::pi / 2), 16);
  list().PathFillConvex(shape(Ink::kCaution));
}

}  // namespace

void Ui::paint_box(const Area& a, Ink ink, double opacity, double corner) {
  list().AddRectFilled(at(a.x, a.y), at(a.x + a.width, a.y + a.height), shape(ink, opacity), f(corner));
}

void Ui::paint_frame(const Area& a, Ink ink, double thickness, double corner) {
  list().AddRect(at(a.x, a.y), at(a.x + a.width, a.y + a.height), shape(ink), f(corner), 0, f(px(thickness)));
}

void Ui::paint_ground(const Area& a, double opacity, double corner) {
  list().AddRectFilled(at(a.x, a.y), at(a.x + a.width, a.y + a.height), packed(ground_colour(Ground::kPanel), opacity),
                       f(corner));
}

void Ui::paint_hatch(const Area& a, Ink ink, double pitch, double thickness) {
  ImDrawList& l = list();
  l.PushClipRect(at(a.x, a.y), at(a.x + a.width, a.y + a.height), true);
  const double step = std::max(2.0, px(pitch) * std::sqrt(2.0));
  for (double x = a.x - a.height; x < a.x + a.width; x += step)
    l.AddLine(at(x, a.y + a.height), at(x + a.height, a.y), shape(ink), f(px(thickness)));
  l.PopClipRect();
}

void Ui::paint_line(double x0, double y0, double x1, double y1, Ink ink, double thickness, bool dashed) {
  if (!dashed) return list().AddLine(at(x0, y0), at(x1, y1), shape(ink), f(px(thickness)));
  const double length = std::hypot(x1 - x0, y1 - y0), dash = std::max(2.0, px(7));
  for (double d = 0; d < length; d += 2 * dash) {
    const double from = d / length, to = std::min(1.0, (d + dash) / length);
    list().AddLine(at(x0 + from * (x1 - x0), y0 + from * (y1 - y0)), at(x0 + to * (x1 - x0), y0 + to * (y1 - y0)),
                   shape(ink), f(px(thickness)));
  }
}

void Ui::paint_disc(double x, double y, double radius, Ink ink, double opacity) {
  list().AddCircleFilled(at(x, y), f(radius), shape(ink, opacity), 0);
}

void Ui::paint_ring(double x, double y, double radius, Ink ink, double thickness) {
  list().AddCircle(at(x, y), f(radius), shape(ink), 0, f(px(thickness)));
}

void Ui::paint_triangle(double x0, double y0, double x1, double y1, double x2, double y2, Ink ink) {
  list().AddTriangleFilled(at(x0, y0), at(x1, y1), at(x2, y2), shape(ink));
}

namespace {

void polyline(const std::vector<Ui::Point>& points, unsigned colour, double thickness_px) {
  std::vector<ImVec2> line;
  line.reserve(points.size());
  for (const Ui::Point& p : points) line.push_back(at(p.x, p.y));
  list().AddPolyline(line.data(), static_cast<int>(line.size()), colour, ImDrawFlags_None, f(thickness_px));
}

}  // namespace

void Ui::paint_curve(const std::vector<Point>& points, Ink ink, double thickness) {
  polyline(points, shape(ink), px(thickness));
}

void Ui::paint_outlined(const std::vector<Point>& points, Ink ink, double thickness) {
  polyline(points, packed({0, 0, 0}, 0.75), px(thickness + 2.5));
  polyline(points, shape(ink), px(thickness));
}

void Ui::paint_mark(Mark mark, double x, double y, double side) {
  const Square s{x, y, side};
  const double thick = std::max(1.0, 0.11 * side);
  switch (mark) {
    case Mark::kNone:
      return;
    case Mark::kTick:
      return paint_tick(s, thick);
    case Mark::kHalf:
      return paint_half(s, thick);
    case Mark::kOpen:
      return list().AddCircle(s.point(0.5, 0.5), f(0.42 * side), packed(ink_colour(Ink::kDim)), 24, f(thick));
    case Mark::kLock:
      return paint_lock(s, thick);
    case Mark::kWarning:
      return paint_warning(s, thick);
    case Mark::kInfo:
      return paint_info(s, thick);
    case Mark::kUp:
      return list().AddTriangleFilled(s.point(0.5, 0.14), s.point(0.9, 0.82), s.point(0.1, 0.82), shape(Ink::kGood));
    case Mark::kDown:
      return list().AddTriangleFilled(s.point(0.5, 0.86), s.point(0.9, 0.18), s.point(0.1, 0.18), shape(Ink::kAlarm));
    case Mark::kPlay:
      list().AddCircle(s.point(0.5, 0.5), f(0.42 * side), packed(okabe_ito::kSky), 24, f(thick));
      return list().AddTriangleFilled(s.point(0.4, 0.28), s.point(0.76, 0.5), s.point(0.4, 0.72),
                                      packed(okabe_ito::kSky));
  }
}

}  // namespace trocar
