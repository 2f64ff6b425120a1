#include "trainees/markup/plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::nice_step;
using svg::px;
using svg::rect;

// Okabe and Ito's colours, told apart also by width.
constexpr std::array<const char*, 4> kClassColour = {"#7a8794", "#009e73", "#e69f00", "#d55e00"};
constexpr std::array<const char*, 4> kClassWidth = {"1.2", "2", "2.4", "3.4"};

struct Series {
  std::vector<double> t_s, force_n, grip_n;
  double t_end_s = 1, highest_n = 0;
  bool gripped = false;
};

Series series_of(const Trace& trace) {
  Series s;
  const double start = trace.samples.empty() ? 0 : trace.samples.front().t_s;
  for (const TraceSample& sample : trace.samples) {
    s.t_s.push_back(sample.t_s - start);
    s.force_n.push_back(sample.force_T.norm());
    s.grip_n.push_back(sample.grip_n);
    for (const double value : {s.force_n.back(), s.grip_n.back()})
      if (std::isfinite(value)) s.highest_n = std::max(s.highest_n, value);
    s.gripped = s.gripped || sample.grip_n > 0.02;
  }
  if (!s.t_s.empty() && std::isfinite(s.t_s.back())) s.t_end_s = std::max(s.t_s.back(), 1e-3);
  return s;
}

constexpr double kWidth = 1000, kHeight = 322, kLeft = 52, kRight = 986, kTop = 46, kBottom = 278;

/// Axes and data of the force plot in one coordinate system.
class ForcePlot {
 public:
  ForcePlot(const Series& series, const ForceLimits& band) : series_(series), band_(band) {
    top_n_ = std::max({1.1 * series.highest_n, 1.15 * band.hard_n, 1.2 * band.high_n, 0.5});
  }

  std::string draw(const std::vector<Event>& events, double start_s) const {
    return zones() + axes() + trace(series_.grip_n, "#56b4e9", series_.gripped) +
           trace(series_.force_n, "#1d2630", true) + marks(events, start_s) + legend();
  }

 private:
  double x(double t_s) const { return kLeft + (kRight - kLeft) * std::clamp(t_s / series_.t_end_s, 0.0, 1.0); }
  double y(double n) const { return kBottom - (kBottom - kTop) * std::clamp(n / top_n_, 0.0, 1.0); }

  std::string zones() const {
    std::string out;
    if (band_.high_n > band_.low_n)
      out += rect(kLeft, y(band_.high_n), kRight - kLeft, y(band_.low_n) - y(band_.high_n),
                  "fill=\"#009e73\" fill-opacity=\"0.17\"");
    if (band_.hard_n > 0) {
      out += rect(kLeft, kTop, kRight - kLeft, y(band_.hard_n) - kTop, "fill=\"url(#over)\"");
      out += line(kLeft, y(band_.hard_n), kRight, y(band_.hard_n), "stroke=\"#d55e00\" stroke-width=\"1.6\"");
    }
    return out;
  }

  std::string axes() const {
    std::string out;
    const double step_n = nice_step(top_n_, 5), step_s = nice_step(series_.t_end_s, 10);
    for (double n = 0; n <= top_n_; n += step_n)
      out += line(kLeft, y(n), kRight, y(n), "stroke=\"#000\" stroke-opacity=\"0.12\"") +
             label(kLeft - 7, y(n) + 5, number_text(n), "end");
    for (double t = 0; t <= series_.t_end_s * 1.0001; t += step_s)
      out += line(x(t), kBottom, x(t), kBottom + 5, "stroke=\"#555\"") +
             label(x(t), kBottom + 20, number_text(t), "middle");
    return out + label(kRight, kBottom + 40, "time, s", "end") + label(6, kTop - 8, "N");
  }

  std::string trace(const std::vector<double>& values, const char* colour, bool shown) const {
    if (!shown) return "";
    std::string points;
    const auto columns = column_ranges(series_.t_s, values, series_.t_end_s, static_cast<int>(kRight - kLeft));
    for (const ColumnRange& c : columns) {
      const std::string at = px(kLeft + c.column) + ",";
      points += at + px(y(c.low)) + " ";
      if (c.high > c.low) points += at + px(y(c.high)) + " ";
    }
    if (!points.empty()) points.pop_back();
    return "<polyline fill=\"none\" stroke-width=\"1.3\" stroke-linejoin=\"round\"" + attribute("stroke", colour) +
           attribute("points", points) + "/>";
  }

  /// Numbers of the event list over the plot; neighbours go to a second and third row instead of on top of each other.
  std::string marks(const std::vector<Event>& events, double start_s) const {
    std::string out;
    std::array<double, 2> row_end = {-1e9, -1e9};
    for (std::size_t i = 0; i < events.size(); ++i) {
      const double at = x(events[i].t_s - start_s);
      const bool severe = events[i].severity >= Severity::kMajor;
      const char* colour = severe ? "#d55e00" : "#0072b2";
      out += line(at, kTop, at, kBottom,
                  std::string("stroke-dasharray=\"2 3\" stroke-opacity=\"0.55\" stroke=\"") + colour + "\"");
      const std::string words = std::to_string(i + 1) + (severe ? "!" : "");
      const double half = 4.5 * static_cast<double>(words.size()) + 2;
      for (std::size_t row = 0; row < row_end.size(); ++row) {
        if (at - half < row_end[row]) continue;
        row_end[row] = at + half;
        out += label(at, kTop - 6 - 17 * static_cast<double>(row), words, "middle",
                     severe ? "fill=\"#b04a00\" font-weight=\"bold\"" : "fill=\"#00507e\"");
        break;
      }
    }
    return out;
  }

  std::string legend() const {
    std::string out;
    double at = kLeft;
    const double base = kBottom + 40;
    const auto entry = [&](const std::string& swatch, const std::string& words) {
      out += swatch + label(at + 26, base, words);
      at += 42 + 7.6 * static_cast<double>(words.size());
    };
    entry(line(at, base - 5, at + 20, base - 5, "stroke=\"#1d2630\" stroke-width=\"2\""), "tissue force");
    if (series_.gripped)
      entry(line(at, base - 5, at + 20, base - 5, "stroke=\"#56b4e9\" stroke-width=\"2\""), "grip force");
    if (band_.high_n > band_.low_n)
      entry(rect(at, base - 11, 20, 12, "fill=\"#009e73\" fill-opacity=\"0.25\""),
            "band " + number_text(band_.low_n) + " to " + number_text(band_.high_n) + " N");
    if (band_.hard_n > 0)
      entry(rect(at, base - 11, 20, 12, "fill=\"url(#over)\" stroke=\"#d55e00\""),
            "over the limit of " + number_text(band_.hard_n) + " N");
    return out;
  }

  const Series& series_;
  const ForceLimits& band_;
  double top_n_ = 1;
};

constexpr double kSide = 420, kMargin = 26;

/// Tip path in millimetres, x right, y up, one scale for both.
struct PathFrame {
  double x0 = 0, y0 = 0, scale = 1;  // lower left corner in m, px per m
  double px_x(double x) const { return kMargin + (x - x0) * scale; }
  double px_y(double y) const { return kSide - kMargin - (y - y0) * scale; }
};

PathFrame frame_path(const Trace& trace) {
  Eigen::AlignedBox2d box;
  for (const TraceSample& sample : trace.samples)
    if (sample.tip_T.allFinite()) box.extend(Eigen::Vector2d(sample.tip_T.head<2>()));
  if (box.isEmpty()) return {};
  const double extent = std::max(box.sizes().maxCoeff(), 0.005);
  const Eigen::Vector2d corner = box.center() - Eigen::Vector2d::Constant(0.5 * extent);
  return {corner.x(), corner.y(), (kSide - 2 * kMargin) / extent};
}

/// Consecutive samples of one force class as one polyline; points closer than half a pixel are dropped.
std::string path_lines(const Trace& trace, const PathFrame& frame, const ForceLimits& band) {
  std::string out, points;
  int current = -1;
  double last_x = 1e9, last_y = 1e9;
  const auto finish = [&] {
    if (points.empty()) return;
    points.pop_back();
    const auto k = static_cast<std::size_t>(current);
    out += "<polyline fill=\"none\" stroke-linecap=\"round\"" + attribute("stroke", kClassColour[k]) +
           attribute("stroke-width", kClassWidth[k]) + attribute("points", points) + "/>";
  };
  for (const TraceSample& sample : trace.samples) {
    if (!sample.tip_T.allFinite()) continue;
    const double x = frame.px_x(sample.tip_T.x()), y = frame.px_y(sample.tip_T.y());
    const int next = force_class(sample.force_T.norm(), band);
    const std::string point = px(x) + "," + px(y) + " ";
    if (next != current) {
      if (current >= 0) points += point;
      finish();
      points.clear();
      current = next;
    } else if (std::hypot(x - last_x, y - last_y) < 0.5) {
      continue;
    }
    points += point;
    last_x = x;
    last_y = y;
  }
  finish();
  return out;
}

std::string path_ends(const Trace& trace, const PathFrame& frame) {
  const Vec3 &a = trace.samples.front().tip_T, &b = trace.samples.back().tip_T;
  if (!a.allFinite() || !b.allFinite()) return "";
  const auto mark = [&](const Vec3& p, const char* style, const std::string& words) {
    const double x = frame.px_x(p.x()), y = frame.px_y(p.y());
    const bool right_half = x > 0.7 * kSide;
    return "<circle r=\"5\"" + attribute("cx", px(x)) + attribute("cy", px(y)) + " " + style + "/>" +
           label(x + (right_half ? -9 : 9), y + (words == "end" ? 17 : -8), words, right_half ? "end" : "start",
                 "font-weight=\"bold\"");
  };
  return mark(a, "fill=\"#fff\" stroke=\"#000\" stroke-width=\"2\"", "start") + mark(b, "fill=\"#000\"", "end");
}

std::string scale_bar(const PathFrame& frame) {
  const double length = nice_step((kSide - 2 * kMargin) / frame.scale, 4);
  const double x0 = kMargin, x1 = kMargin + length * frame.scale, y = kSide - 8;
  return line(x0, y, x1, y, "stroke=\"#000\" stroke-width=\"2\"") +
         label(x1 + 6, y + 4, number_text(length * 1000) + " mm");
}

}  // namespace

std::vector<ColumnRange> column_ranges(const std::vector<double>& t_s, const std::vector<double>& values,
                                       double t_end_s, int columns) {
  std::vector<ColumnRange> ranges;
  for (std::size_t i = 0; i < t_s.size() && i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || !std::isfinite(t_s[i])) continue;
    const int column = std::clamp(static_cast<int>(t_s[i] / t_end_s * columns), 0, columns - 1);
    if (ranges.empty() || ranges.back().column != column) ranges.push_back({column, values[i], values[i]});
    ranges.back().low = std::min(ranges.back().low, values[i]);
    ranges.back().high = std::max(ranges.back().high, values[i]);
  }
  return ranges;
}

int force_class(double force_n, const ForceLimits& band) {
  if (band.hard_n > 0 && force_n >= band.hard_n) return 3;
  if (band.high_n > 0 && force_n > band.high_n) return 2;
  return band.high_n > 0 && force_n >= band.low_n && force_n > 0 ? 1 : 0;
}

std::string force_plot_svg(const Trace& trace, const std::vector<Event>& events, const ForceLimits& band) {
  const Series series = series_of(trace);
  const double start = trace.samples.empty() ? 0 : trace.samples.front().t_s;
  std::string out =
      "<svg viewBox=\"0 0 " + px(kWidth) + " " + px(kHeight) + "\" role=\"img\" aria-label=\"Force against time\">";
  out +=
      "<defs><pattern id=\"over\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\">"
      "<rect width=\"8\" height=\"8\" fill=\"#d55e00\" fill-opacity=\"0.10\"/>"
      "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"8\" stroke=\"#d55e00\" stroke-width=\"2\" "
      "stroke-opacity=\"0.45\"/></pattern></defs>";
  return out + ForcePlot(series, band).draw(events, start) + "</svg>";
}

std::string path_plot_svg(const Trace& trace, const std::vector<Event>& events, const ForceLimits& band) {
  std::string out =
      "<svg viewBox=\"0 0 " + px(kSide) + " " + px(kSide) + "\" role=\"img\" aria-label=\"Tip path from above\">";
  out += rect(0.5, 0.5, kSide - 1, kSide - 1, "fill=\"#fff\" stroke=\"#c9ced4\"");
  if (trace.samples.empty()) return out + label(0.5 * kSide, 0.5 * kSide, "no samples", "middle") + "</svg>";
  const PathFrame frame = frame_path(trace);
  out += path_lines(trace, frame, band);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double x = frame.px_x(events[i].tip_T.x()), y = frame.px_y(events[i].tip_T.y());
    if (events[i].object < 0 || !events[i].tip_T.allFinite() || x < 0 || y < 0 || x > kSide || y > kSide) continue;
    out += "<circle r=\"8\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.4\"" + attribute("cx", px(x)) +
           attribute("cy", px(y)) + "/>";
  }
  return out + path_ends(trace, frame) + scale_bar(frame) + "</svg>";
}

}  // namespace trocar
