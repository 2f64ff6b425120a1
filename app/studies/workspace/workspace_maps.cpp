#include "app/studies/workspace/workspace_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "app/device_bench/device_drawing.h"
#include "app/picture/maps/colour_scale.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

constexpr int kLevels = 10;
constexpr double kPixelsPerM = 480, kPanel = 340, kMapTop = 60, kMapLeft = 62, kDocHeight = 470;
constexpr double kHalf = 0.28;  // m: half the width of a panel

struct Plane {
  int u, v, w;  // axes to the right, upwards, and the one that is held
  double at, v_low, v_high;
  const char* name;
};
constexpr std::array kPlanes{Plane{1, 2, 0, 0, -kHalf, 0.20, "x' = 0"}, Plane{0, 2, 1, 0, -kHalf, 0.20, "y' = 0"},
                             Plane{0, 1, 2, -0.2, -kHalf, kHalf, "z' = -200 mm"}};
constexpr const char* kAxisNames[] = {"x', mm", "y', mm", "z', mm"};

std::string colour_of(double share) {
  const auto [red, green, blue] = viridis(share);
  return "rgb(" + std::to_string(red) + ',' + std::to_string(green) + ',' + std::to_string(blue) + ')';
}

/// One panel: where its cells lie on the page.
struct Panel {
  const WorkspaceGrid& grid;
  const Plane& plane;
  double left;
  int layer = grid.layer(plane.w, plane.at);

  const ReachCell& cell(int a, int b) const {
    std::array<int, 3> index{};
    index[static_cast<std::size_t>(plane.u)] = a;
    index[static_cast<std::size_t>(plane.v)] = b;
    index[static_cast<std::size_t>(plane.w)] = layer;
    return grid.cell(index[0], index[1], index[2]);
  }
  int columns() const { return grid.size()[static_cast<std::size_t>(plane.u)]; }
  int rows() const { return grid.size()[static_cast<std::size_t>(plane.v)]; }
  double edge(int axis, int n) const { return grid.centre(n, n, n)[axis] - 0.5 * grid.side(); }
  double x(double u) const { return left + (u + kHalf) * kPixelsPerM; }
  double y(double v) const { return kMapTop + (plane.v_high - v) * kPixelsPerM; }
  double cell_x(int a) const { return x(edge(plane.u, a)); }
  double cell_y(int b) const { return y(edge(plane.v, b)); }
};

using Level = std::function<int(const ReachCell&)>;

/// Runs of cells of one level as one path a level.
std::string filled(const Panel& panel, const Level& level, const std::vector<std::string>& colours) {
  std::vector<std::ostringstream> path(colours.size());
  const std::string height = svg::px(-panel.grid.side() * kPixelsPerM), back = svg::px(panel.grid.side() * kPixelsPerM);
  for (int b = 0; b < panel.rows(); ++b) {
    for (int a = 0; a < panel.columns();) {
      const int now = level(panel.cell(a, b));
      int end = a + 1;
      while (end < panel.columns() && level(panel.cell(end, b)) == now) ++end;
      if (now >= 0) {
        path[static_cast<std::size_t>(now)] << 'M' << svg::px(panel.cell_x(a)) << ' ' << svg::px(panel.cell_y(b)) << 'H'
                                            << svg::px(panel.cell_x(end)) << 'v' << height << 'H'
                                            << svg::px(panel.cell_x(a)) << 'v' << back;
      }
      a = end;
    }
  }
  std::string out;
  for (std::size_t n = 0; n < colours.size(); ++n) {
    if (path[n].tellp() <= 0) continue;
    out += "<path fill=\"" + colours[n] + "\" stroke=\"" + colours[n] + "\" stroke-width=\"0.4\" d=\"" + path[n].str() +
           "\"/>\n";
  }
  return out;
}

/// Edges between a set and what lies outside it.
std::string border(const Panel& panel, ReachSet set) {
  std::ostringstream path;
  for (int b = 0; b <= panel.rows(); ++b) {
    for (int a = 0; a <= panel.columns(); ++a) {
      const bool here = panel.cell(a, b).in(set);
      if (here != panel.cell(a - 1, b).in(set)) {
        path << 'M' << svg::px(panel.cell_x(a)) << ' ' << svg::px(panel.cell_y(b)) << 'V'
             << svg::px(panel.cell_y(b + 1));
      }
      if (here != panel.cell(a, b - 1).in(set)) {
        path << 'M' << svg::px(panel.cell_x(a)) << ' ' << svg::px(panel.cell_y(b)) << 'H'
             << svg::px(panel.cell_x(a + 1));
      }
    }
  }
  return "<path fill=\"none\" stroke=\"black\" stroke-width=\"1.4\" d=\"" + path.str() + "\"/>\n";
}

std::string frame(const Panel& panel) {
  std::string out;
  for (int mm = -200; mm <= 200; mm += 100) {
    const double u = mm * 1e-3, bottom = panel.y(panel.plane.v_low);
    out += svg::line(panel.x(u), kMapTop, panel.x(u), bottom, "stroke=\"#ddd\"");
    out += svg::label(panel.x(u), bottom + 16, std::to_string(mm), "middle", "font-size=\"11\"");
    if (u > panel.plane.v_high + 1e-9) continue;
    out += svg::line(panel.x(-kHalf), panel.y(u), panel.x(kHalf), panel.y(u), "stroke=\"#ddd\"");
    out += svg::label(panel.left - 5, panel.y(u) + 4, std::to_string(mm), "end", "font-size=\"11\"");
  }
  out += svg::rect(panel.left, kMapTop, 2 * kHalf * kPixelsPerM, panel.y(panel.plane.v_low) - kMapTop,
                   "fill=\"none\" stroke=\"#888\"");
  out += svg::label(panel.x(0), panel.y(panel.plane.v_low) + 34, kAxisNames[panel.plane.u], "middle");
  const double middle = panel.y(0.5 * (panel.plane.v_low + panel.plane.v_high));
  const std::string turn = "transform=\"rotate(-90 " + svg::px(panel.left - 34) + ' ' + svg::px(middle) + ")\"";
  out += svg::label(panel.left - 34, middle, kAxisNames[panel.plane.v], "middle", turn.c_str());
  return out + svg::label(panel.left, kMapTop - 8, panel.plane.name, "start", "font-weight=\"bold\"") + "\n";
}

std::string three_panels(const WorkspaceGrid& grid, const Level& level, const std::vector<std::string>& colours,
                         bool outline) {
  std::string out;
  for (std::size_t n = 0; n < kPlanes.size(); ++n) {
    const Panel panel{grid, kPlanes[n], kMapLeft + kPanel * static_cast<double>(n)};
    out += frame(panel) + filled(panel, level, colours);
    if (outline) out += border(panel, ReachSet::kRulesClear);
  }
  return out;
}

constexpr double kDocWidth = kMapLeft + 3 * kPanel;
constexpr double kKeyY = kDocHeight - 78;

}  // namespace

std::string set_sections(const WorkspaceGrid& grid) {
  const std::vector<std::string> shades{"#e3e3e3", "#bdbdbd", "#7f9db5", "#1f3f5f"};
  const char* const names[] = {"within the limits of table 2.4", "and l1 inside the ring, bodies without width",
                               "and l1 clear of ring and legs", "and 8 deg from limits, det A >= 0.30"};
  const Level level = [](const ReachCell& c) {
    return c.in(ReachSet::kRulesClear)    ? 3
           : c.in(ReachSet::kLimitsClear) ? 2
           : c.in(ReachSet::kRing)        ? 1
           : c.in(ReachSet::kLimits)      ? 0
                                          : -1;
  };
  std::string key;
  for (int n = 0; n < 4; ++n) {
    const double x = kMapLeft + (n % 2) * 420, y = kKeyY + 24 + 24 * (n / 2);
    key += svg::rect(x, y - 12, 26, 14, "stroke=\"#666\" fill=\"" + shades[static_cast<std::size_t>(n)] + "\"");
    key += svg::label(x + 34, y, names[n]);
  }
  return drawing_svg(kDocWidth, kDocHeight, "Where the stylus can be: sections through W'",
                     {three_panels(grid, level, shades, false), key});
}

std::string value_sections(const WorkspaceGrid& grid, const MapScale& scale,
                           const std::function<double(const ReachCell&)>& value) {
  std::vector<std::string> colours;
  for (int n = 0; n < kLevels; ++n) colours.push_back(colour_of((n + 0.5) / kLevels));
  const Level level = [&](const ReachCell& c) {
    if (!c.in(ReachSet::kLimitsClear)) return -1;
    const double share = (value(c) - scale.low) / (scale.high - scale.low);
    return share >= 1 ? kLevels - 1 : static_cast<int>(std::max(0.0, share) * kLevels);  // infinite is brightest
  };
  std::string key = svg::label(kMapLeft, kKeyY + 12, scale.unit);
  for (int n = 0; n < kLevels; ++n) {
    key += svg::rect(kMapLeft + 44 * n, kKeyY + 22, 44, 14, "fill=\"" + colours[static_cast<std::size_t>(n)] + "\"");
  }
  for (int n = 0; n <= kLevels; n += 2) {
    const double v = scale.low + n * (scale.high - scale.low) / kLevels;
    key += svg::label(kMapLeft + 44 * n, kKeyY + 52, fixed_text(v, scale.decimals), "middle", "font-size=\"11\"");
  }
  key += svg::label(kMapLeft + 480, kKeyY + 33, "black line: clear of the links, 8 deg from limits, det A >= 0.30");
  return drawing_svg(kDocWidth, kDocHeight, scale.title, {three_panels(grid, level, colours, true), key});
}

}  // namespace trocar
