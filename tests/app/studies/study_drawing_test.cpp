// What the device studies draw: areas and counts read back out of the SVG, legends, labels.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <sstream>

#include "app/device_bench/device_drawing.h"
#include "app/studies/study_files.h"
#include "app/studies/workspace/workspace_maps.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar::study_drawing_test {
namespace {

const WorkspaceGrid& grid() {
  static const WorkspaceGrid one(0.02, 24);
  return one;
}

/// Area of the runs of a path "M x y H x1 v h H x v back", px^2.
double area_of_runs(const std::string& path) {
  static const std::regex run("M([-0-9.]+) ([-0-9.]+)H([-0-9.]+)v([-0-9.]+)H");
  double area = 0;
  for (std::sregex_iterator it(path.begin(), path.end(), run), end; it != end; ++it) {
    area += (std::stod((*it)[3]) - std::stod((*it)[1])) * std::abs(std::stod((*it)[4]));
  }
  return area;
}

/// Sum over all paths of one fill colour.
double filled_area(const std::string& svg, const std::string& colour) {
  double area = 0;
  for (std::size_t at = svg.find("<path fill=\"" + colour); at != std::string::npos;
       at = svg.find("<path fill=\"" + colour, at + 1)) {
    area += area_of_runs(svg.substr(at, svg.find("/>", at) - at));
  }
  return area;
}

int cells_in_the_three_planes(const std::function<bool(const ReachCell&)>& counts) {
  int n = 0;
  const auto [nx, ny, nz] = grid().size();
  const int middle_x = grid().layer(0, 0), middle_y = grid().layer(1, 0), height = grid().layer(2, -0.2);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) n += counts(grid().cell(middle_x, j, k));
    for (int i = 0; i < nx; ++i) n += counts(grid().cell(i, middle_y, k));
  }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) n += counts(grid().cell(i, j, height));
  return n;
}

TEST(WorkspaceSections, ShadeAsMuchAreaAsTheirSetsHaveCells) {
  const std::string svg = set_sections(grid());
  const double cell = std::pow(480 * grid().side(), 2);  // px^2 at 480 px/m
  const auto only = [](ReachSet in, ReachSet not_in) {
    return [=](const ReachCell& c) { return c.in(in) && !c.in(not_in); };
  };
  const int ruled = cells_in_the_three_planes([](const ReachCell& c) { return c.in(ReachSet::kRulesClear); });
  ASSERT_GT(ruled, 50);
  EXPECT_NEAR(filled_area(svg, "#1f3f5f") / cell, ruled, 0.02 * ruled) << "rounding to a tenth of a pixel";
  const int clear = cells_in_the_three_planes(only(ReachSet::kLimitsClear, ReachSet::kRulesClear));
  EXPECT_NEAR(filled_area(svg, "#7f9db5") / cell, clear, 1 + 0.02 * clear);
  const int ring = cells_in_the_three_planes(only(ReachSet::kRing, ReachSet::kLimitsClear));
  EXPECT_NEAR(filled_area(svg, "#bdbdbd") / cell, ring, 1 + 0.02 * ring);
}

TEST(WorkspaceSections, AValueGoesToItsLevel) {
  const MapScale scale{"x", "N", 0, 10, 0};
  const auto by_height = [](const ReachCell& c) { return c.posture[3] / kDegree < -60 ? 0.5 : 9.5; };
  const std::string svg = value_sections(grid(), scale, by_height);
  std::set<std::string> fills;
  static const std::regex fill("<path fill=\"(rgb[^\"]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), fill), end; it != end; ++it) fills.insert((*it)[1]);
  EXPECT_EQ(fills.size(), 2u) << "two values, two colours";
  const double cell = std::pow(480 * grid().side(), 2);
  double area = 0;
  for (const std::string& colour : fills) area += filled_area(svg, colour) / cell;
  const int clear = cells_in_the_three_planes([](const ReachCell& c) { return c.in(ReachSet::kLimitsClear); });
  EXPECT_NEAR(area, clear, 0.02 * clear);
}

TEST(WorkspacePicture, DrawsEveryFaceThatCanBeSeenAndNoOther) {
  const std::string svg = workspace_picture(grid());
  int faces = 0;
  for (std::size_t at = svg.find("<use "); at != std::string::npos; at = svg.find("<use ", at + 1)) ++faces;
  const auto shown = [&](int i, int j, int k) {
    if (!grid().cell(i, j, k).in(ReachSet::kLimitsClear)) return false;
    const Vec3 p = grid().centre(i, j, k);
    return p.x() <= 0 || p.y() >= 0;
  };
  int expected = 0;
  for (int k = 0; k < grid().size()[2]; ++k) {
    for (int j = 0; j < grid().size()[1]; ++j) {
      for (int i = 0; i < grid().size()[0]; ++i) {
        if (shown(i, j, k)) expected += !shown(i + 1, j, k) + !shown(i, j - 1, k) + !shown(i, j, k + 1);
      }
    }
  }
  EXPECT_EQ(faces, expected);
  EXPECT_GT(faces, 200);
  for (const char* axis : {"x&#39;, mm", "y&#39;, mm", "z&#39;, mm"})
    EXPECT_NE(svg.find(axis), std::string::npos) << axis;
}

TEST(DeviceGroup, IsOneColourAndHasTheThreeJointsOfTheArm) {
  const DrawingView view{0.5, 0.3, 1000, 300, 200};
  const std::string svg = device_group(home_angles(), view, "#123456", 5);
  std::size_t circles = 0, lines = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++circles;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1)) ++lines;
  EXPECT_EQ(circles, 3u) << "centre, elbow, stylus origin";
  EXPECT_EQ(lines, device_strokes(home_angles()).size());
  EXPECT_NE(svg.find("#123456"), std::string::npos);
  const Eigen::Vector2d tip = view.project(home_pose().p);
  std::ostringstream at;
  at << "cx=\"" << std::fixed << std::setprecision(1) << tip.x() << "\" cy=\"" << tip.y();
  EXPECT_NE(svg.find(at.str()), std::string::npos) << "the stylus origin is where the jig holds it";
}

TEST(DeviceAxes, CountTheirTicksInMillimetres) {
  const DrawingView view = DrawingView::fitted(0.5, 0.3, {-0.1, -0.1, -0.3}, {0.1, 0.1, 0}, {0, 0}, {600, 500});
  const std::string svg = axes_group({-0.1, -0.1, -0.3}, {0.1, 0.1, 0}, 0.1, view);
  for (const char* number : {">-100<", ">0<", ">100<", ">-200<", ">-300<"}) {
    EXPECT_NE(svg.find(number), std::string::npos) << number;
  }
  EXPECT_EQ(svg.find(">-0<"), std::string::npos);
  EXPECT_EQ(svg.find(">50<"), std::string::npos);
}

TEST(DrawingSvg, EscapesItsTitle) {
  const std::string svg = drawing_svg(100, 50, "a < b & c", {"<g/>"});
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"0 0 100 50\""), std::string::npos);
  EXPECT_NE(svg.find("<g/>"), std::string::npos);
}

TEST(StudyPlots, SixCurvesDifferInDashAndShareTheLegendsLine) {
  StudyCurves curves{"six", "six", "x", "y", {0, 10000, 20000}, {}};
  for (int n = 0; n < 6; ++n) curves.series.push_back({"s" + std::to_string(n), {n + 0.0, n + 1.0, n + 2.0}});
  const std::string svg = curves_svg(curves);
  std::set<std::string> dashes;
  static const std::regex dash("stroke-width=\"2\" stroke-dasharray=\"([^\"]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), dash), end; it != end; ++it) dashes.insert((*it)[1]);
  EXPECT_EQ(dashes.size(), 6u) << "told apart without colour";
  static const std::regex entry("x=\"([0-9.]+)\" y=\"54\"");
  double last = -100;
  int entries = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), entry), end; it != end; ++it, ++entries) {
    EXPECT_GT(std::stod((*it)[1]), last + 80) << "names do not run into each other";
    last = std::stod((*it)[1]);
  }
  EXPECT_EQ(entries, 6);
  EXPECT_LT(last, 690) << "and stay on the page";
  EXPECT_NE(svg.find(">20000<"), std::string::npos) << "ticks are written out";
}

}  // namespace
}  // namespace trocar::study_drawing_test
