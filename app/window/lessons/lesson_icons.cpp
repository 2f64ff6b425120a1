#include "app/window/lessons/lesson_icons.h"

#include <cmath>
#include <numbers>

namespace trocar {
namespace {

/// A square with its corner at the top left, in which 0..1 is drawn.
struct Canvas {
  Ui& ui;
  Area area;
  double x(double u) const { return area.x + u * area.width; }
  double y(double v) const { return area.y + v * area.height; }
  double size(double s) const { return s * area.width; }
  void line(double u0, double v0, double u1, double v1, Ink ink, double thickness = 2) const {
    ui.paint_line(x(u0), y(v0), x(u1), y(v1), ink, thickness);
  }
  void disc(double u, double v, double r, Ink ink) const { ui.paint_disc(x(u), y(v), size(r), ink); }
  void ring(double u, double v, double r, Ink ink, double thickness = 2) const {
    ui.paint_ring(x(u), y(v), size(r), ink, thickness);
  }
  void box(double u, double v, double w, double h, Ink ink) const {
    ui.paint_box({x(u), y(v), size(w), size(h)}, ink, 1, size(0.03));
  }
  void down(double u, double v, double s, Ink ink) const {
    ui.paint_triangle(x(u), y(v + s), x(u + 0.6 * s), y(v), x(u - 0.6 * s), y(v), ink);
  }
  void up(double u, double v, double s, Ink ink) const {
    ui.paint_triangle(x(u), y(v), x(u + 0.6 * s), y(v + s), x(u - 0.6 * s), y(v + s), ink);
  }
  void right(double u, double v, double s, Ink ink) const {
    ui.paint_triangle(x(u + s), y(v), x(u), y(v - 0.6 * s), x(u), y(v + 0.6 * s), ink);
  }
};

void shaft(const Canvas& c, double u, double v) {
  c.line(0.95, v - 0.55 > 0.05 ? v - 0.55 : 0.05, u, v, Ink::kText, 3);
}
void tissue(const Canvas& c) { c.box(0.06, 0.78, 0.88, 0.14, Ink::kAlarm); }
void jaws(const Canvas& c, double v, double half) {
  c.line(0.5, v - 0.34, 0.5, v - 0.24, Ink::kText, 4);
  for (const double s : {-1.0, 1.0}) {
    c.line(0.5, v - 0.24, 0.5 + s * half, v - 0.1, Ink::kText, 3);
    c.line(0.5 + s * half, v - 0.1, 0.5 + s * half, v + 0.1, Ink::kText, 3);
  }
}

void clock_face(const Canvas& c, double u, double v, double r) {
  c.ring(u, v, r, Ink::kHeading);
  c.line(u, v, u, v - 0.7 * r, Ink::kHeading);
  c.line(u, v, u + 0.5 * r, v, Ink::kHeading);
}

void turn_arrow(const Canvas& c) {
  std::vector<Ui::Point> points;
  for (int i = 0; i <= 14; ++i) {
    const double a = std::numbers::pi * (-0.95 + 1.3 * i / 14);
    points.push_back({c.x(0.45 + 0.32 * std::cos(a)), c.y(0.55 + 0.32 * std::sin(a))});
  }
  c.ui.paint_curve(points, Ink::kHeading, 2);
  c.down(0.62, 0.80, 0.14, Ink::kHeading);
}

/// An arrow of stem and head from (u, v0) to v1.
void upright_arrow(const Canvas& c, double u, double v0, double v1) {
  c.line(u, v0, u, v1, Ink::kHeading, 3);
  if (v1 > v0)
    c.down(u, v1, 0.2, Ink::kHeading);
  else
    c.up(u, v1 - 0.2, 0.2, Ink::kHeading);
}

void paint_rest(const Canvas& c) {
  c.ring(0.38, 0.62, 0.24, Ink::kAccent);
  shaft(c, 0.38, 0.62);
  c.disc(0.38, 0.62, 0.05, Ink::kText);
}

void paint_reach(const Canvas& c) {
  c.ring(0.3, 0.74, 0.14, Ink::kAccent);
  c.disc(0.3, 0.74, 0.05, Ink::kAccent);
  shaft(c, 0.62, 0.42);
  c.line(0.57, 0.47, 0.43, 0.61, Ink::kHeading);
}

void paint_turn(const Canvas& c) {
  c.line(0.45, 0.1, 0.45, 0.9, Ink::kAccent, 2);
  c.line(0.8, 0.12, 0.45, 0.86, Ink::kText, 3);
  turn_arrow(c);
}

void paint_hold(const Canvas& c) {
  shaft(c, 0.34, 0.78);
  clock_face(c, 0.32, 0.34, 0.22);
  c.disc(0.34, 0.8, 0.05, Ink::kAccent);
}

void paint_press(const Canvas& c, bool withdraw) {
  tissue(c);
  c.line(0.62, 0.08, 0.62, withdraw ? 0.5 : 0.8, Ink::kText, 3);
  upright_arrow(c, 0.28, withdraw ? 0.66 : 0.2, withdraw ? 0.4 : 0.44);
}

void paint_squeeze(const Canvas& c) {
  c.box(0.38, 0.46, 0.24, 0.3, Ink::kCaution);
  jaws(c, 0.6, 0.16);
  c.right(0.1, 0.6, 0.16, Ink::kHeading);
  c.ui.paint_triangle(c.x(0.74), c.y(0.6), c.x(0.9), c.y(0.5), c.x(0.9), c.y(0.7), Ink::kHeading);
}

void paint_carry(const Canvas& c) {
  c.box(0.14, 0.5, 0.22, 0.26, Ink::kCaution);
  upright_arrow(c, 0.25, 0.44, 0.34);
  c.line(0.46, 0.3, 0.72, 0.3, Ink::kHeading, 3);
  c.right(0.72, 0.3, 0.18, Ink::kHeading);
  c.ring(0.76, 0.78, 0.14, Ink::kAccent);
}

void paint_pick(const Canvas& c) {
  c.box(0.4, 0.6, 0.2, 0.26, Ink::kCaution);
  jaws(c, 0.6, 0.26);
}

void paint_place(const Canvas& c) {
  c.ring(0.5, 0.76, 0.2, Ink::kAccent);
  c.box(0.4, 0.6, 0.2, 0.22, Ink::kCaution);
  upright_arrow(c, 0.5, 0.08, 0.3);
}

}  // namespace

void paint_step(Ui& ui, StepIcon icon, const Area& area) {
  const Canvas c{ui, area};
  ui.paint_frame(area, Ink::kDim, 1, c.size(0.08));
  switch (icon) {
    case StepIcon::kRest:
      return paint_rest(c);
    case StepIcon::kReach:
      return paint_reach(c);
    case StepIcon::kTurn:
      return paint_turn(c);
    case StepIcon::kHold:
      return paint_hold(c);
    case StepIcon::kPress:
      return paint_press(c, false);
    case StepIcon::kWithdraw:
      return paint_press(c, true);
    case StepIcon::kSqueeze:
      return paint_squeeze(c);
    case StepIcon::kPick:
      return paint_pick(c);
    case StepIcon::kCarry:
      return paint_carry(c);
    case StepIcon::kPlace:
      return paint_place(c);
  }
}

}  // namespace trocar
