#include "app/studies/device/kinematics_drawings.h"

#include "app/device_bench/device_drawing.h"
#include "app/device_bench/thesis_kinematics.h"
#include "app/studies/device/kinematics_study.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

constexpr const char* kGreys[] = {"#000000", "#7d7d7d", "#c4c4c4"};  // S1, S2, S3 as in figure 3.35

/// The three configurations, S3 first so that S1 lies in front.
std::string three_devices(const DrawingView& view, double width) {
  std::string out;
  for (int i = 2; i >= 0; --i)
    out += device_group(thesis::samples()[static_cast<std::size_t>(i)].q, view, kGreys[i], width);
  return out;
}

std::string key(double x, double y) {
  std::string out;
  for (int i = 0; i < 3; ++i) {
    out += svg::line(x, y + 20 * i, x + 26, y + 20 * i, "stroke-width=\"5\" stroke=\"" + std::string(kGreys[i]) + "\"");
    out += svg::label(x + 34, y + 4 + 20 * i, thesis::samples()[static_cast<std::size_t>(i)].name);
  }
  return out + "\n";
}

/// The shoulder alone: the links beyond the frame are cut off.
std::string shoulder_panel(double x, double y, double side) {
  DrawingView view{30 * kDegree, 30 * kDegree, 2300, x + side / 2, y + side / 2 - 10};
  const std::string clip = svg::rect(x, y, side, side, "");
  return "<clipPath id=\"shoulder\">" + clip + "</clipPath>\n<g clip-path=\"url(#shoulder)\">\n" +
         three_devices(view, 5) + "</g>\n" + svg::rect(x, y, side, side, "fill=\"none\" stroke=\"#888\"") +
         svg::label(x + side / 2, y + side + 18, "shoulder enlarged: base ring, legs, platform", "middle") + "\n";
}

StudyFile overlay() {
  const Vec3 low(-0.15, -0.2, -0.3), high(0.1, 0.1, 0.05);
  const DrawingView view = DrawingView::fitted(30 * kDegree, 20 * kDegree, low, high, {10, 40}, {520, 560});
  return {"device_overlay.svg", drawing_svg(860, 600, "The device at S1, S2 and S3 (figure 3.35), drawn from table 2.3",
                                            {axes_group(low, high, 0.05, view), three_devices(view, 5), key(540, 450),
                                             shoulder_panel(540, 60, 290),
                                             svg::label(540, 400, "d1 55, d2 40, d3 28, l1 146, l2 128 mm") +
                                                 svg::label(540, 420, "parallel projection, W' with z' up")})};
}

StudyFile path() {
  const Vec3 low(-0.15, -0.2, -0.3), high(0.15, 0.05, -0.15);
  const DrawingView view = DrawingView::fitted(55 * kDegree, 25 * kDegree, low, high, {10, 40}, {620, 430});
  std::vector<Vec3> points;
  for (int k = 0; k <= 400; ++k) points.push_back(arm_state(kinematic_trajectory(k * kTrajectoryS / 400)).X_WS.p);
  std::vector<Vec3> shadow = points;
  for (Vec3& p : shadow) p.z() = -0.30;
  std::string marks;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d at = view.project(arm_state(thesis::samples()[static_cast<std::size_t>(i)].q).X_WS.p);
    marks +=
        svg::rect(at.x() - 4, at.y() - 4, 8, 8, "fill=\"black\"") +
        svg::label(at.x() + 10, at.y() - 6, i == 0 ? "S1, home" : thesis::samples()[static_cast<std::size_t>(i)].name);
  }
  return {"stylus_path.svg",
          drawing_svg(640, 480, "Way of the stylus in W', home - S2 - S3 - home (figure 3.34)",
                      {axes_group(low, high, 0.05, view),
                       path_group(shadow, view, "stroke=\"#bbb\" stroke-width=\"1.5\" stroke-dasharray=\"5 4\""),
                       path_group(points, view, "stroke=\"black\" stroke-width=\"2.5\""), marks,
                       svg::label(20, 48, "dashed: its shadow on z' = -300 mm")})};
}

/// One of the four non-trivial solutions with its room in the ring.
std::string mode_panel(int mode, double x, double y, double side) {
  const JointVector q = thesis::example();
  const ForwardSolution solution = forward_solutions(q)[static_cast<std::size_t>(mode)];
  const DrawingView view{30 * kDegree, 25 * kDegree, 560, x + side / 2, y + side / 2};
  const std::string room = fixed_text(1e3 * solution.ring_room_m, 0);
  const std::string verdict = solution.ring_room_m > 0 ? "l1 inside the ring, room " + room + " mm: the device"
                                                       : "l1 crosses the ring (" + room + " mm)";
  return svg::rect(x, y, side, side, "fill=\"none\" stroke=\"#bbb\"") +
         device_group(device_strokes(q, solution), view, mode == 0 ? "#000000" : "#7d7d7d", 4) +
         svg::label(x + 8, y + 18, "solution " + std::to_string(mode + 1), "start", "font-weight=\"bold\"") +
         svg::label(x + 8, y + side - 10, verdict) + "\n";
}

StudyFile modes() {
  std::vector<std::string> pieces;
  constexpr double kSide = 330;
  for (int mode = 0; mode < 4; ++mode) {
    pieces.push_back(mode_panel(mode, 20 + (mode % 2) * (kSide + 10), 64 + mode / 2 * (kSide + 10), kSide));
  }
  pieces.push_back(svg::label(20, 48, "theta1 to theta3 = 30, 20, 25 deg, elbow -60 deg; parallel projection, z' up"));
  return {"assembly_modes.svg", drawing_svg(710, 754, "The four non-trivial solutions (figure 2.12)", pieces)};
}

}  // namespace

std::vector<StudyFile> kinematics_drawings() { return {overlay(), path(), modes()}; }

}  // namespace trocar
