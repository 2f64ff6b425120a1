#include <algorithm>
#include <array>
#include <cmath>

#include "trainees/desk/pages/charts.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar::review {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::px;
using svg::rect;

constexpr double kSide = 320, kMargin = 22, kFoot = 26;
constexpr std::array<const char*, 4> kClassColour = {"#7a8794", "#009e73", "#e69f00", "#d55e00"};
constexpr std::array<const char*, 4> kClassWidth = {"1.1", "1.9", "2.6", "3.6"};
/// Light to dark, one direction of lightness, so that it reads in grey too.
constexpr std::array<const char*, 7> kHeat = {"#f6e7c1", "#edc98f", "#dd9f77", "#bf7474",
                                              "#964e7c", "#673283", "#371763"};

Eigen::Vector2d flat(const Vec3& p, const Projection& view) { return {p[view.right], p[view.up]}; }

Eigen::AlignedBox2d box_of(const Trace& trace, const Projection& view) {
  Eigen::AlignedBox2d box;
  for (const TraceSample& sample : trace.samples)
    if (sample.tip_T.allFinite()) box.extend(flat(sample.tip_T, view));
  return box;
}

/// Square frame in pixels, one scale for both axes.
struct Square {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  double scale = 1, extent = 1;
  double x(double right) const { return kMargin + (right - corner.x()) * scale; }
  double y(double up) const { return kSide - kMargin - (up - corner.y()) * scale; }
};

Square square_of(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return {};
  Square square;
  square.extent = std::max(box.sizes().maxCoeff(), 0.005);
  square.corner = box.center() - Eigen::Vector2d::Constant(0.5 * square.extent);
  square.scale = (kSide - 2 * kMargin) / square.extent;
  return square;
}

std::string open(const std::string& words) {
  return "<svg class=\"square\" viewBox=\"0 0 " + px(kSide) + " " + px(kSide + kFoot) + "\" role=\"img\"" +
         attribute("aria-label", escape_html(words)) + ">" +
         rect(0.5, 0.5, kSide - 1, kSide - 1, "fill=\"#fff\" stroke=\"#c9ced4\"");
}

std::string scale_bar(const Square& square) {
  const double length = svg::nice_step(square.extent, 4), y = kSide + 15;
  return line(kMargin, y, kMargin + length * square.scale, y, "stroke=\"#000\" stroke-width=\"3\"") +
         label(kMargin + length * square.scale + 8, y + 7, number_text(length * 1000) + " mm");
}

/// Runs of one force class as one polyline; points closer than a pixel are dropped.
std::string runs(const Trace& trace, const Projection& view, const Square& square, const ForceLimits& limits) {
  std::string out, points;
  int current = -1;
  Eigen::Vector2d last(1e9, 1e9);
  const auto finish = [&] {
    const auto k = static_cast<std::size_t>(current);
    if (!points.empty())
      out += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"" +
             attribute("stroke", kClassColour.at(k)) + attribute("stroke-width", kClassWidth.at(k)) +
             attribute("points", points) + "/>";
    points.clear();
  };
  for (const TraceSample& sample : trace.samples) {
    if (!sample.tip_T.allFinite()) continue;
    const Eigen::Vector2d p = flat(sample.tip_T, view), at(square.x(p.x()), square.y(p.y()));
    const int kind = force_class(sample.force_T.norm(), limits);
    if (kind == current && (at - last).norm() < 1.0) continue;
    const std::string text = px(at.x()) + "," + px(at.y()) + " ";
    points += text;
    if (kind != current) {
      if (current >= 0) finish();
      points = text;
      current = kind;
    }
    last = at;
  }
  finish();
  return out;
}

std::string marks(const Trace& trace, const Projection& view, const Square& square, double cursor_s) {
  std::string out;
  const auto at = [&](const Vec3& p) {
    return attribute("cx", px(square.x(p[view.right]))) + attribute("cy", px(square.y(p[view.up])));
  };
  const Vec3 &first = trace.samples.front().tip_T, &last = trace.samples.back().tip_T;
  if (first.allFinite())
    out += "<circle r=\"4.5\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"2\"" + at(first) +
           "><title>start</title></circle>";
  if (last.allFinite()) out += "<circle r=\"4.5\" fill=\"#000\"" + at(last) + "><title>end</title></circle>";
  const TraceSample* now = cursor_s < 0 ? nullptr : sample_at(trace, cursor_s);
  if (now != nullptr && now->tip_T.allFinite())
    out += "<circle r=\"8\" fill=\"none\" stroke=\"#14191f\" stroke-width=\"3\"" + at(now->tip_T) +
           "><title>tip at this moment</title></circle>";
  return out;
}

}  // namespace

std::string axes_words(const Projection& projection) {
  constexpr std::array<char, 3> kAxis = {'x', 'y', 'z'};
  return std::string(projection.words) + " (" + kAxis.at(static_cast<std::size_t>(projection.right)) + " right, " +
         kAxis.at(static_cast<std::size_t>(projection.up)) + " up)";
}

std::string path_svg(const Trace& trace, const Projection& projection, const ForceLimits& limits, double cursor_s) {
  std::string out = open(std::string("Tip path ") + projection.words);
  const Eigen::AlignedBox2d box = box_of(trace, projection);
  if (box.isEmpty()) return out + label(0.5 * kSide, 0.5 * kSide, "no samples", "middle") + "</svg>";
  const Square square = square_of(box);
  return out + runs(trace, projection, square, limits) + marks(trace, projection, square, cursor_s) +
         scale_bar(square) + "</svg>";
}

Histogram2 tip_histogram(const Trace& trace, const Projection& projection, bool contacts_only, int cells) {
  Histogram2 h;
  const Eigen::AlignedBox2d box = box_of(trace, projection);
  if (box.isEmpty() || cells < 1) return h;
  h.cell_m = std::max(box.sizes().maxCoeff(), 0.005) / cells;
  h.columns = std::clamp(static_cast<int>(std::ceil(box.sizes().x() / h.cell_m - 1e-9)), 1, cells);
  h.rows = std::clamp(static_cast<int>(std::ceil(box.sizes().y() / h.cell_m - 1e-9)), 1, cells);
  h.right0_m = box.center().x() - 0.5 * h.columns * h.cell_m;
  h.up0_m = box.center().y() - 0.5 * h.rows * h.cell_m;
  h.ticks.assign(static_cast<std::size_t>(h.columns) * static_cast<std::size_t>(h.rows), 0);
  for (const TraceSample& sample : trace.samples) {
    if (!sample.tip_T.allFinite() || (contacts_only && !sample.contact)) continue;
    const Eigen::Vector2d p = flat(sample.tip_T, projection);
    const int column = std::clamp(static_cast<int>((p.x() - h.right0_m) / h.cell_m), 0, h.columns - 1);
    const int row = std::clamp(static_cast<int>((p.y() - h.up0_m) / h.cell_m), 0, h.rows - 1);
    int& count =
        h.ticks[static_cast<std::size_t>(row) * static_cast<std::size_t>(h.columns) + static_cast<std::size_t>(column)];
    h.most = std::max(h.most, ++count);
    ++h.total;
  }
  return h;
}

std::string heat_svg(const Trace& trace, const Projection& projection, bool contacts_only) {
  std::string out =
      open(std::string(contacts_only ? "Where the tip touched, " : "Where the tip was, ") + projection.words);
  const Histogram2 h = tip_histogram(trace, projection, contacts_only, 40);
  if (h.total == 0)
    return out + label(0.5 * kSide, 0.5 * kSide, contacts_only ? "nothing was touched" : "no samples", "middle") +
           "</svg>";
  const Square square = square_of(box_of(trace, projection));
  // Logarithm of the time, so that places passed through stand beside those stayed at. Neighbours of one shade are one
  // rectangle.
  const auto shade = [&](int ticks) {
    return ticks == 0 ? -1
                      : std::min<int>(kHeat.size() - 1,
                                      static_cast<int>(kHeat.size() * std::log1p(ticks) / std::log1p(h.most)));
  };
  const double side = h.cell_m * square.scale;
  for (int row = 0; row < h.rows; ++row)
    for (int begin = 0, column = 1; begin < h.columns; ++column) {
      const auto tick = [&](int c) { return h.ticks[static_cast<std::size_t>(row * h.columns + c)]; };
      if (column < h.columns && shade(tick(column)) == shade(tick(begin))) continue;
      if (shade(tick(begin)) >= 0)
        out += rect(square.x(h.right0_m + begin * h.cell_m), square.y(h.up0_m + (row + 1) * h.cell_m),
                    side * (column - begin), side,
                    std::string("shape-rendering=\"crispEdges\" fill=\"") +
                        kHeat.at(static_cast<std::size_t>(shade(tick(begin)))) + "\"");
      begin = column;
    }
  return out + scale_bar(square) + "</svg>";
}

}  // namespace trocar::review
