// Cubes seen from the front right and above, painted row by row towards the eye; three kinds of face, drawn once and
// reused.
#include <cmath>
#include <vector>

#include "app/device_bench/device_drawing.h"
#include "app/studies/workspace/workspace_maps.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

constexpr double kAzimuth = 30 * kDegree, kElevation = 25 * kDegree;

bool shown(const WorkspaceGrid& grid, int i, int j, int k) {
  if (!grid.cell(i, j, k).in(ReachSet::kLimitsClear)) return false;
  const Vec3 p = grid.centre(i, j, k);
  return !(p.x() > 0 && p.y() < 0);  // the quarter that is cut away
}

struct Face {
  char kind;
  bool ruled;
  Eigen::Vector2d at;
};

/// Visible faces: +x' (x), -y' (y), +z' (z), anchored at the middle of the cube; what lies nearer comes later.
std::vector<Face> faces(const WorkspaceGrid& grid, const DrawingView& view) {
  std::vector<Face> all;
  for (int k = 0; k < grid.size()[2]; ++k) {
    for (int j = grid.size()[1] - 1; j >= 0; --j) {
      for (int i = 0; i < grid.size()[0]; ++i) {
        if (!shown(grid, i, j, k)) continue;
        const Vec3 p = grid.centre(i, j, k);
        const bool ruled = grid.cell(i, j, k).in(ReachSet::kRulesClear);
        if (!shown(grid, i + 1, j, k)) all.push_back({'x', ruled, view.project(p)});
        if (!shown(grid, i, j - 1, k)) all.push_back({'y', ruled, view.project(p)});
        if (!shown(grid, i, j, k + 1)) all.push_back({'z', ruled, view.project(p)});
      }
    }
  }
  return all;
}

std::string face_shape(const std::string& id, const std::vector<Vec3>& corners, const DrawingView& view,
                       const char* fill) {
  std::string points;
  for (const Vec3& c : corners) {
    const Eigen::Vector2d at = view.project(c) - view.project(Vec3::Zero());
    points += svg::px(at.x()) + ',' + svg::px(at.y()) + ' ';
  }
  return "<polygon id=\"" + id + "\" points=\"" + points + "\" fill=\"" + fill +
         "\" stroke=\"#333\" stroke-width=\"0.3\"/>\n";
}

std::string shapes(double side, const DrawingView& view) {
  const double h = 0.5 * side;
  std::string out = "<defs>\n";
  for (const bool ruled : {false, true}) {
    const std::string tail = ruled ? "r" : "";
    out +=
        face_shape("x" + tail, {{h, -h, -h}, {h, h, -h}, {h, h, h}, {h, -h, h}}, view, ruled ? "#3d6a8f" : "#9a9a9a");
    out += face_shape("y" + tail, {{-h, -h, -h}, {h, -h, -h}, {h, -h, h}, {-h, -h, h}}, view,
                      ruled ? "#5f8fb5" : "#c2c2c2");
    out +=
        face_shape("z" + tail, {{-h, -h, h}, {h, -h, h}, {h, h, h}, {-h, h, h}}, view, ruled ? "#a9c9e0" : "#ececec");
  }
  return out + "</defs>\n";
}

}  // namespace

std::string workspace_picture(const WorkspaceGrid& grid) {
  const Vec3 low(-0.20, -0.25, -0.30), high(0.20, 0.20, 0.05);
  const DrawingView view = DrawingView::fitted(kAzimuth, kElevation, low, high, {0, 30}, {720, 540});
  std::string cubes;
  for (const Face& face : faces(grid, view)) {
    cubes += "<use href=\"#" + std::string(1, face.kind) + (face.ruled ? "r" : "") + "\" x=\"" + svg::px(face.at.x()) +
             "\" y=\"" + svg::px(face.at.y()) + "\"/>\n";
  }
  std::string key = svg::rect(20, 40, 22, 14, "fill=\"#5f8fb5\" stroke=\"#333\"") +
                    svg::label(50, 52, "clear of the links, 8 deg from limits, det A >= 0.30") +
                    svg::rect(20, 62, 22, 14, "fill=\"#c2c2c2\" stroke=\"#333\"") +
                    svg::label(50, 74, "clear of the links, within the limits only") +
                    svg::label(400, 52, "quarter x' > 0, y' < 0 cut away; device at home");
  return drawing_svg(720, 570, "Reachable region of the stylus",
                     {axes_group(low, high, 0.1, view), shapes(grid.side(), view), cubes,
                      device_group(home_angles(), view, "#000000", 4), key});
}

}  // namespace trocar
