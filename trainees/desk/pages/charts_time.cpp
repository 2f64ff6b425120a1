#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/page_frame.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar::review {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::px;
using svg::rect;

constexpr double kWidth = 760, kHeight = 352, kLeft = 44, kRight = 748, kTop = 12, kBottom = 258, kEventRow = 276;
constexpr double kLegendRow = 22;
constexpr int kStrips = 88;  ///< links over the plot, one for so many parts of the time

struct Values {
  std::vector<double> t_s, value;
  double highest = 0;
};

Values values_of(const TimeLine& source) {
  Values out;
  if (source.trace == nullptr || source.trace->samples.empty()) return out;
  const double start = source.trace->samples.front().t_s;
  out.t_s.reserve(source.trace->samples.size());
  out.value.reserve(source.trace->samples.size());
  for (const TraceSample& sample : source.trace->samples) {
    out.t_s.push_back(sample.t_s - start);
    out.value.push_back(source.grip ? sample.grip_n : sample.force_T.norm());
    if (std::isfinite(out.value.back())) out.highest = std::max(out.highest, out.value.back());
  }
  return out;
}

/// Up: harmless; square: minor; down and filled: major and critical.
std::string event_mark(double x, double y, Severity severity) {
  switch (severity) {
    case Severity::kInfo:
      return "<circle r=\"4\" fill=\"#fff\" stroke=\"#0072b2\" stroke-width=\"1.8\"" + attribute("cx", px(x)) +
             attribute("cy", px(y)) + "/>";
    case Severity::kMinor:
      return rect(x - 4, y - 4, 8, 8, "fill=\"#e69f00\" stroke=\"#7a5200\"");
    case Severity::kMajor:
    case Severity::kCritical:
      break;
  }
  const double r = severity == Severity::kCritical ? 7.5 : 5.5;
  return "<path fill=\"#d55e00\" stroke=\"#7a3000\" d=\"M" + px(x - r) + " " + px(y - r) + "H" + px(x + r) + "L" +
         px(x) + " " + px(y + r) + "Z\"/>";
}

class Drawing {
 public:
  explicit Drawing(const TimePlot& plot) : plot_(plot) {
    for (const TimeLine& source : plot.lines) {
      values_.push_back(values_of(source));
      if (!values_.back().t_s.empty() && std::isfinite(values_.back().t_s.back()))
        t_end_ = std::max(t_end_, values_.back().t_s.back());
      top_n_ = std::max(top_n_, 1.08 * values_.back().highest);
    }
    t_end_ = std::max(t_end_, 1e-3);
    top_n_ = std::max({top_n_, 1.15 * plot.limits.hard_n, 1.2 * plot.limits.high_n});
  }

  std::string draw() const {
    const Legend key = legend();
    std::string out = "<svg class=\"time\" viewBox=\"0 0 " + px(kWidth) + " " +
                      px(kHeight + kLegendRow * (key.rows - 1)) +
                      "\" role=\"group\" aria-label=\"Force against time\"" + attribute("data-left", px(kLeft)) +
                      attribute("data-right", px(kRight)) + attribute("data-end", fixed_text(t_end_, 3)) + ">";
    out +=
        "<defs><pattern id=\"hatch\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" "
        "patternTransform=\"rotate(45)\">"
        "<path d=\"M0 0V8\" stroke=\"#d55e00\" stroke-width=\"2\" stroke-opacity=\"0.4\"/></pattern></defs>";
    return out + zones() + axes() + traces() + events() + cursor() + links() + key.svg + "</svg>";
  }

 private:
  double x(double t_s) const { return kLeft + (kRight - kLeft) * std::clamp(t_s / t_end_, 0.0, 1.0); }
  double y(double n) const { return kBottom - (kBottom - kTop) * std::clamp(n / top_n_, 0.0, 1.0); }

  std::string zones() const {
    const ForceLimits& band = plot_.limits;
    std::string out;
    if (band.high_n > band.low_n)
      out += rect(kLeft, y(band.high_n), kRight - kLeft, y(band.low_n) - y(band.high_n),
                  "fill=\"#009e73\" fill-opacity=\"0.17\"");
    if (band.hard_n > 0)
      out += rect(kLeft, kTop, kRight - kLeft, y(band.hard_n) - kTop, "fill=\"url(#hatch)\"") +
             line(kLeft, y(band.hard_n), kRight, y(band.hard_n), "stroke=\"#d55e00\" stroke-width=\"1.6\"");
    return out;
  }

  std::string axes() const {
    std::string out;
    const double step_n = svg::nice_step(top_n_, 5), step_s = svg::nice_step(t_end_, 9);
    for (const double n : svg::ticks(0, top_n_, step_n))
      out += line(kLeft, y(n), kRight, y(n), "stroke=\"#000\" stroke-opacity=\"0.12\"") +
             label(kLeft - 6, y(n) + 5, number_text(n), "end");
    for (const double t : svg::ticks(0, t_end_ * 1.0001, step_s)) {
      const bool last = x(t) > kRight - 14;
      out += line(x(t), kBottom, x(t), kBottom + 5, "stroke=\"#555\"") +
             label(x(t), kEventRow + 28, number_text(t), last ? "end" : "middle");
    }
    return out + label(2, kTop + 2, "N") + label(kRight, kEventRow + 46, "time, s", "end");
  }

  std::string traces() const {
    std::string out;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      std::string points;
      for (const ColumnRange& c :
           column_ranges(values_[i].t_s, values_[i].value, t_end_, static_cast<int>(kRight - kLeft))) {
        const std::string at = px(kLeft + c.column) + ",";
        points += at + px(y(c.low)) + " ";
        if (c.high > c.low) points += at + px(y(c.high)) + " ";
      }
      const TimeLine& source = plot_.lines[i];
      if (!points.empty())
        out += "<polyline fill=\"none\" stroke-width=\"1.4\" stroke-linejoin=\"round\"" +
               attribute("stroke", source.colour) +
               (*source.dash == '\0' ? "" : attribute("stroke-dasharray", source.dash)) + attribute("points", points) +
               "/>";
    }
    return out;
  }

  /// Shapes in a row of their own under the plot, each a link to its moment; grave ones drawn last, on top.
  std::string events() const {
    std::string light, grave;
    for (std::size_t i = 0; i < plot_.events.size(); ++i) {
      const Event& event = plot_.events[i];
      if (!std::isfinite(event.t_s)) continue;
      const double at = event.t_s - plot_.begin_s;
      const bool heavy = event.severity >= Severity::kMajor;
      std::string mark =
          "<title>" +
          escape_html(std::to_string(i + 1) + ": " + words_of(event.type) + " at " + fixed_text(at, 1) + " s") +
          "</title>" + event_mark(x(at), kEventRow, event.severity);
      if (!plot_.moment_href_html.empty())
        mark = "<a tabindex=\"-1\" href=\"" + plot_.moment_href_html + fixed_text(at, 2) + "#moment\">" + mark + "</a>";
      else
        mark = "<g>" + mark + "</g>";
      if (heavy) mark = line(x(at), kTop, x(at), kBottom, "stroke=\"#b04a00\" stroke-dasharray=\"2 3\"") + mark;
      (heavy ? grave : light) += mark;
    }
    return light + grave;
  }

  std::string cursor() const {
    if (plot_.cursor_s < 0) return "";
    const double at = x(plot_.cursor_s);
    return "<g id=\"cursor\"" + attribute("transform", "translate(" + px(at) + " 0)") + ">" +
           line(0, kTop, 0, kBottom + 8, "stroke=\"#14191f\" stroke-width=\"2\"") + "<path d=\"M-7 " + px(kTop - 9) +
           "H7L0 " + px(kTop + 3) + "Z\" fill=\"#14191f\"/></g>";
  }

  std::string links() const {
    if (plot_.moment_href_html.empty()) return "";
    std::string out = "<g class=\"strips\">";
    const double width = (kRight - kLeft) / kStrips;
    for (int i = 0; i < kStrips; ++i) {
      const std::string t = fixed_text(t_end_ * (i + 0.5) / kStrips, 2);
      out += "<a tabindex=\"-1\" href=\"" + plot_.moment_href_html + t + "#moment\"><title>" + t + " s</title>" +
             rect(kLeft + width * i, kTop, width, kBottom - kTop, "fill=\"#fff\" fill-opacity=\"0\"") + "</a>";
    }
    return out + "</g>";
  }

  struct Legend {
    std::string svg = {};
    int rows = 1;
  };

  /// Entries from left to right, in a further row where the next would not fit.
  Legend legend() const {
    Legend out;
    double at = kLeft, base = kHeight - 8;
    const auto entry = [&](const std::function<std::string()>& swatch, const std::string& words) {
      const double wide = 42 + 7.9 * static_cast<double>(words.size());
      if (at > kLeft && at + wide - 16 > kWidth) {
        at = kLeft;
        base += kLegendRow;
        ++out.rows;
      }
      out.svg += swatch() + label(at + 26, base, words);
      at += wide;
    };
    for (const TimeLine& source : plot_.lines) {
      std::string style = std::string("stroke-width=\"2.4\" stroke=\"") + source.colour + "\"";
      if (*source.dash != '\0') style += attribute("stroke-dasharray", source.dash);
      entry([&] { return line(at, base - 5, at + 20, base - 5, style); }, source.words);
    }
    const auto box = [&](const char* style) {
      return [&at, &base, style] { return rect(at, base - 11, 20, 12, style); };
    };
    const ForceLimits& band = plot_.limits;
    if (band.high_n > band.low_n)
      entry(box("fill=\"#009e73\" fill-opacity=\"0.25\""),
            "wanted " + number_text(band.low_n) + " to " + number_text(band.high_n) + " N");
    if (band.hard_n > 0)
      entry(box("fill=\"url(#hatch)\" stroke=\"#d55e00\""), "over " + number_text(band.hard_n) + " N");
    return out;
  }

  const TimePlot& plot_;
  std::vector<Values> values_;
  double t_end_ = 0, top_n_ = 0.5;
};

}  // namespace

std::string time_plot_svg(const TimePlot& plot) { return Drawing(plot).draw(); }

double length_s(const Trace& trace) {
  if (trace.samples.empty()) return 0;
  const double length = trace.samples.back().t_s - trace.samples.front().t_s;
  return std::isfinite(length) ? std::max(0.0, length) : 0;
}

const TraceSample* sample_at(const Trace& trace, double t_s) {
  if (trace.samples.empty()) return nullptr;
  const double wanted = trace.samples.front().t_s + t_s;
  const auto after = std::lower_bound(trace.samples.begin(), trace.samples.end(), wanted,
                                      [](const TraceSample& s, double t) { return s.t_s < t; });
  if (after == trace.samples.begin()) return &trace.samples.front();
  if (after == trace.samples.end()) return &trace.samples.back();
  const auto before = after - 1;
  return wanted - before->t_s <= after->t_s - wanted ? &*before : &*after;
}

}  // namespace trocar::review
