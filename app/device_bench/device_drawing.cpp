#include "app/device_bench/device_drawing.h"

#include <cmath>
#include <numbers>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/link_clearance.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

using Part = DeviceStroke::Part;

constexpr double kStylusLength = 0.060;  // m, drawn only
constexpr double kTickRoom = 62;         // px for ticks, their numbers and the axis' name
constexpr int kArcSteps = 12, kRingSteps = 60;

/// Quarter arc between two unit axes at right angles, about O.
std::vector<Vec3> quarter(const Vec3& from, const Vec3& to, double radius) {
  std::vector<Vec3> points;
  for (int k = 0; k <= kArcSteps; ++k) {
    const double a = std::numbers::pi / 2 * k / kArcSteps;
    points.push_back(radius * (std::cos(a) * from + std::sin(a) * to));
  }
  return points;
}

/// Circle on the sphere of radius d1 through the three motors' ends.
std::vector<Vec3> base_ring() {
  const Vec3 axis = Vec3::Constant(1 / std::sqrt(3.0)), middle = kBaseRing / std::sqrt(3.0) * axis;
  const Vec3 u = (kBaseRing * Vec3::UnitX() - middle), v = axis.cross(u);
  std::vector<Vec3> points;
  for (int k = 0; k <= kRingSteps; ++k) {
    const double a = 2 * std::numbers::pi * k / kRingSteps;
    points.push_back(middle + std::cos(a) * u + std::sin(a) * v);
  }
  return points;
}

double width_of(Part part, double links) {
  switch (part) {
    case Part::kFirstLink:
    case Part::kSecondLink:
      return links;
    case Part::kStylus:
      return 1.6 * links;
    case Part::kBase:
      return 0.8 * links;
    default:
      return 0.55 * links;
  }
}

std::string points_of(const std::vector<Vec3>& points, const DrawingView& view) {
  std::string text;
  for (const Vec3& p : points) {
    const Eigen::Vector2d at = view.project(p);
    text += (text.empty() ? "" : " ") + svg::px(at.x()) + ',' + svg::px(at.y());
  }
  return text;
}

std::string ticks_along(const Vec3& from, int axis, double end, double tick_m, const DrawingView& view) {
  std::string out;
  Vec3 to = from;
  to[axis] = end;
  out += path_group({from, to}, view, "stroke=\"#555\" stroke-width=\"1\"");
  const Eigen::Vector2d a = view.project(from), b = view.project(to);
  const Eigen::Vector2d along = (b - a).normalized(), out_of(along.y(), -along.x());
  const Eigen::Vector2d off = (out_of.y() < 0 || (out_of.y() == 0 && out_of.x() > 0) ? -1.0 : 1.0) * out_of;
  for (int k = static_cast<int>(std::ceil(from[axis] / tick_m - 1e-9)); k * tick_m <= end + 1e-9; ++k) {
    Vec3 p = from;
    p[axis] = k * tick_m;
    const Eigen::Vector2d at = view.project(p), tip = at + 5 * off, text = at + 15 * off;
    out += svg::line(at.x(), at.y(), tip.x(), tip.y(), "stroke=\"#555\"");
    if (axis == 1 && p.y() - from.y() < 0.5 * tick_m) continue;  // this corner carries the number of x'
    const char* anchor = off.x() < -0.5 ? "end" : off.x() > 0.5 ? "start" : "middle";
    out += svg::label(text.x(), text.y() + 4, fixed_text(k * tick_m * 1000 + 0.0, 0), anchor, "font-size=\"11\"");
  }
  const Eigen::Vector2d name = 0.5 * (a + b) + (std::abs(off.x()) > 0.5 ? 46 : 40) * off;
  const char* const names[] = {"x', mm", "y', mm", "z', mm"};
  const char* anchor = off.x() < -0.5 ? "end" : off.x() > 0.5 ? "start" : "middle";
  return out + svg::label(name.x(), name.y() + 4, names[axis], anchor, "font-size=\"12\"");
}

}  // namespace

DrawingView DrawingView::fitted(double azimuth, double elevation, const Vec3& low, const Vec3& high,
                                const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  DrawingView view{azimuth, elevation, 1, 0, 0};
  Eigen::AlignedBox2d box;
  for (int k = 0; k < 8; ++k) {
    box.extend(view.project({k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(), k & 4 ? high.z() : low.z()}));
  }
  const Eigen::Vector2d room = size - Eigen::Vector2d::Constant(2 * kTickRoom);
  view.pixels_per_m = (room.array() / box.sizes().array()).minCoeff();
  const Eigen::Vector2d middle = corner + 0.5 * size - view.pixels_per_m * box.center();
  view.origin_x = middle.x();
  view.origin_y = middle.y();
  return view;
}

Eigen::Vector2d DrawingView::project(const Vec3& p) const {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), se = std::sin(elevation), ce = std::cos(elevation);
  const double right = ca * p.x() + sa * p.y(), back = -sa * p.x() + ca * p.y();
  return {origin_x + pixels_per_m * right, origin_y - pixels_per_m * (ce * p.z() + se * back)};
}

std::vector<DeviceStroke> device_strokes(const JointVector& q) { return device_strokes(q, forward_solutions(q)[0]); }

std::vector<DeviceStroke> device_strokes(const JointVector& q, const ForwardSolution& solution) {
  const Mat3& V = solution.R_WP;
  const Vec3 elbow = rotation_W_Wprime().transpose() * V * rotation_P_Pprime().col(0) * -kLink1;
  const Pose& X = solution.X_WS;
  const Vec3 s = q.head<3>().array().sin(), c = q.head<3>().array().cos();
  const Vec3 U[] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  const Vec3 W[] = {{s[0], -c[0], 0}, {0, s[1], -c[1]}, {-c[2], 0, s[2]}};
  std::vector<DeviceStroke> strokes{{Part::kBase, base_ring()}};
  for (int i = 0; i < 3; ++i) {
    strokes.push_back({Part::kMotor, {kProximalArc * U[i], kBaseRing * U[i]}});
    strokes.push_back({Part::kProximal, quarter(U[i], W[i], kProximalArc)});
    strokes.push_back({Part::kMotor, {kDistalArc * W[i], kProximalArc * W[i]}});  // the passive axis
    strokes.push_back({Part::kDistal, quarter(W[i], V.col(i), kDistalArc)});
    strokes.push_back({Part::kPlatform, {Vec3::Zero(), kDistalArc * V.col(i)}});
  }
  for (DeviceStroke& stroke : strokes)
    for (Vec3& p : stroke.points) p = (rotation_W_Wprime().transpose() * p).eval();
  strokes.push_back({Part::kFirstLink, {Vec3::Zero(), elbow}});
  strokes.push_back({Part::kSecondLink, {elbow, X.p}});
  strokes.push_back({Part::kStylus, {X.p, X.p + kStylusLength * X.R.col(2)}});
  return strokes;
}

std::string device_group(const JointVector& q, const DrawingView& view, const std::string& colour, double width) {
  return device_group(device_strokes(q), view, colour, width);
}

std::string device_group(const std::vector<DeviceStroke>& strokes, const DrawingView& view, const std::string& colour,
                         double width) {
  std::string out = "<g fill=\"none\" stroke=\"" + colour + "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  std::string joints;
  for (const DeviceStroke& stroke : strokes) {
    out += "<polyline stroke-width=\"" + svg::px(width_of(stroke.part, width)) + "\" points=\"" +
           points_of(stroke.points, view) + "\"/>\n";
    const bool link =
        stroke.part == Part::kFirstLink || stroke.part == Part::kSecondLink || stroke.part == Part::kStylus;
    if (!link) continue;
    const Eigen::Vector2d at = view.project(stroke.points.front());  // centre, elbow, stylus origin
    joints += "<circle cx=\"" + svg::px(at.x()) + "\" cy=\"" + svg::px(at.y()) + "\" r=\"" + svg::px(1.2 * width) +
              "\" fill=\"white\" stroke-width=\"" + svg::px(0.5 * width) + "\"/>\n";
  }
  return out + joints + "</g>\n";
}

std::string path_group(const std::vector<Vec3>& points, const DrawingView& view, const std::string& style) {
  return "<polyline fill=\"none\" " + style + " points=\"" + points_of(points, view) + "\"/>\n";
}

std::string axes_group(const Vec3& low, const Vec3& high, double tick_m, const DrawingView& view) {
  // The edges that the eye meets first at the bottom, and the upright edge furthest to the left.
  const double near_y = std::cos(view.azimuth) >= 0 ? low.y() : high.y();
  const double near_x = std::sin(view.azimuth) >= 0 ? high.x() : low.x();
  const double left_x = std::cos(view.azimuth) >= 0 ? low.x() : high.x();
  const double left_y = std::sin(view.azimuth) >= 0 ? low.y() : high.y();
  std::string out = "<g>\n";
  out += ticks_along({low.x(), near_y, low.z()}, 0, high.x(), tick_m, view);
  if (std::abs(std::sin(view.azimuth)) > 0.05)
    out += ticks_along({near_x, low.y(), low.z()}, 1, high.y(), tick_m, view);
  out += ticks_along({left_x, left_y, low.z()}, 2, high.z(), tick_m, view);
  return out + "</g>\n";
}

std::string drawing_svg(double width, double height, const std::string& title, const std::vector<std::string>& pieces) {
  const std::string w = fixed_text(width, 0), h = fixed_text(height, 0);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + w + ' ' + h + "\" width=\"" + w +
                    "\" height=\"" + h + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
                    svg::label(20, 26, title, "start", "font-size=\"15\" font-weight=\"bold\"") + "\n";
  for (const std::string& piece : pieces) out += piece;
  return out + "</svg>\n";
}

}  // namespace trocar
