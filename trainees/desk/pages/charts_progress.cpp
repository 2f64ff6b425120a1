#include <algorithm>
#include <cmath>
#include <tuple>

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

constexpr const char* kBlue = "#0072b2";
constexpr const char* kPassLine = "stroke=\"#b04a00\" stroke-width=\"1.6\" stroke-dasharray=\"7 4\"";

std::string open(double width, double height, const std::string& words, const char* kind = "chart",
                 const char* role = "img") {
  return std::string("<svg class=\"") + kind + "\" viewBox=\"0 0 " + px(width) + " " + px(height) + "\" role=\"" +
         role + "\"" + attribute("aria-label", escape_html(words)) + ">";
}

std::string polyline(const std::string& points, const std::string& style) {
  return points.empty() ? "" : "<polyline points=\"" + points + "\" fill=\"none\" " + style + "/>";
}

/// Frame of a chart over attempts: x by number, y by value.
struct Axes {
  double width = 720, height = 300, left = 44, right = 622, top = 14, bottom = 252;
  int first = 1, last = 1;
  double low = 0, high = 100;
  double x(double number) const {
    return last == first ? 0.5 * (left + right) : left + (right - left) * (number - first) / (last - first);
  }
  double y(double value) const { return bottom - (bottom - top) * std::clamp((value - low) / (high - low), 0.0, 1.0); }

  std::string grid(double step, const std::string& words) const {
    std::string out;
    for (const double v : svg::ticks(low, high + 1e-4 * step, step))
      out += line(left, y(v), right, y(v), "stroke=\"#d9dee4\"") + label(left - 8, y(v) + 5, number_text(v), "end");
    const int stride = std::max(1, static_cast<int>(std::lround(svg::nice_step(std::max(1, last - first), 9))));
    for (int n = first; n <= last; n += stride) out += label(x(n), bottom + 20, std::to_string(n), "middle");
    return out + label(0.5 * (left + right), bottom + 40, words, "middle");
  }
};

/// Words at the right of lines, moved apart where they would lie on each other.
class RightLabels {
 public:
  void add(double y, const std::string& words, const char* fill) { all_.push_back({y, words, fill}); }
  std::string draw(double x, double least_gap) {
    std::sort(all_.begin(), all_.end(), [](const Item& a, const Item& b) { return a.y < b.y; });
    std::string out;
    double last = -1e9;
    for (Item& item : all_) {
      item.y = std::max(item.y, last + least_gap);
      last = item.y;
      out += label(x, item.y, item.words, "start", ("fill=\"" + item.fill + "\"").c_str());
    }
    return out;
  }

 private:
  struct Item {
    double y;
    std::string words, fill;
  };
  std::vector<Item> all_;
};

std::string cohort_area(const std::vector<CohortBand>& cohort, const Axes& axes) {
  std::string upper, lower, middle;
  for (const CohortBand& band : cohort) {
    if (band.attempt < axes.first || band.attempt > axes.last) continue;
    const std::string at = px(axes.x(band.attempt)) + ",";
    upper += at + px(axes.y(band.quartiles.high)) + " ";
    lower = at + px(axes.y(band.quartiles.low)) + " " + lower;
    middle += at + px(axes.y(band.quartiles.median)) + " ";
  }
  if (upper.empty()) return "";
  return "<polygon points=\"" + upper + lower + "\" fill=\"#56b4e9\" fill-opacity=\"0.25\"/>" +
         polyline(middle, "stroke=\"#2d7fab\" stroke-width=\"1.2\" stroke-dasharray=\"2 3\"");
}

/// A diamond round the point: orange where it passed, grey where not.
std::string decided_mark(const CurvePoint& point, double x, double y) {
  constexpr double kReach = 9;
  return "<path class=\"decided\" d=\"M" + px(x) + " " + px(y - kReach) + "L" + px(x + kReach) + " " + px(y) + "L" +
         px(x) + " " + px(y + kReach) + "L" + px(x - kReach) + " " + px(y) +
         "Z\" fill=\"none\" stroke-width=\"2\" stroke=\"" + (point.passed ? "#b04a00" : "#1d2630") + "\"/>";
}

/// @param value of what is drawn; nothing: a cross.
std::string own_point(const CurvePoint& point, const std::optional<double>& value, const std::string& value_words,
                      double x, double y, int number) {
  const std::string at = attribute("cx", px(x)) + attribute("cy", px(y));
  std::string mark;
  if (!value)
    mark = "<path d=\"M" + px(x - 4) + " " + px(y - 4) + "L" + px(x + 4) + " " + px(y + 4) + "M" + px(x - 4) + " " +
           px(y + 4) + "L" + px(x + 4) + " " + px(y - 4) + "\" stroke=\"#5b6570\" stroke-width=\"2.4\"/>";
  else
    mark = "<circle r=\"4.6\" stroke-width=\"2\"" + at + " stroke=\"" + kBlue + "\" fill=\"" +
           (point.passed ? kBlue : "#fff") + "\"/>";
  if (!point.decided_by.empty()) mark += decided_mark(point, x, y);
  const std::string by = point.decided_by.empty() ? "" : " by decision of " + point.decided_by;
  const std::string words = "attempt " + std::to_string(number) + ", " + dated(point.utc.substr(0, 10)) + ": " +
                            (value ? value_words + (point.passed ? ", passed" : ", not passed") + by
                                   : point.status + ", no score" +
                                         (by.empty()     ? ""
                                          : point.passed ? ", passed" + by
                                                         : ", not passed" + by)) +
                            (point.number > 0 ? ", number " + std::to_string(point.number) : "");
  return "<a href=\"/attempt/" + url_part(point.uuid) + "\"><title>" + escape_html(words) + "</title>" + mark + "</a>";
}

/// @param value of the i-th point, and its words.
template <class Value, class Words>
std::string own_points(const std::vector<CurvePoint>& points, std::size_t begin, const Axes& axes, Value value,
                       Words words) {
  std::string line_points, marks;
  for (std::size_t i = begin; i < points.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    const std::optional<double> at = value(i);
    const double y = axes.y(at.value_or(axes.low));
    if (at) line_points += px(axes.x(number)) + "," + px(y) + " ";
    marks += own_point(points[i], at, at ? words(*at) : "", axes.x(number), y, number);
  }
  return polyline(line_points, std::string("stroke=\"") + kBlue + "\" stroke-width=\"2\"") + marks;
}

}  // namespace

std::string spark_svg(const std::vector<double>& scores, double pass_at) {
  constexpr double kWide = 120, kHigh = 34;
  // From 40, or from the lowest score where that is less, so that lines of different trainees mostly share a scale.
  const double low =
      std::max(0.0, std::min(40.0, scores.empty() ? 40.0 : *std::min_element(scores.begin(), scores.end())));
  const auto y = [&](double score) {
    return 3 + (kHigh - 6) * (1 - std::clamp((score - low) / (100 - low), 0.0, 1.0));
  };
  const double step = scores.size() > 1 ? (kWide - 8) / static_cast<double>(scores.size() - 1) : 0;
  std::string points;
  for (std::size_t i = 0; i < scores.size(); ++i)
    points += px(3 + step * static_cast<double>(i)) + "," + px(y(scores[i])) + " ";
  std::string out =
      "<svg class=\"spark\" viewBox=\"0 0 " + px(kWide) + " " + px(kHigh) + "\" role=\"img\" aria-label=\"";
  out += scores.empty() ? "no scores"
                        : "last " + plural(static_cast<std::int64_t>(scores.size()), "score", "scores") + ", from " +
                              fixed_text(scores.front(), 0) + " to " + fixed_text(scores.back(), 0);
  out += "\">" + line(0, y(pass_at), kWide, y(pass_at), "stroke=\"#b04a00\" stroke-dasharray=\"5 3\"");
  out += polyline(points, std::string("stroke=\"") + kBlue + "\" stroke-width=\"1.8\"");
  if (!scores.empty())
    out += "<circle r=\"2.8\" fill=\"" + std::string(kBlue) + "\"" +
           attribute("cx", px(3 + step * static_cast<double>(scores.size() - 1))) +
           attribute("cy", px(y(scores.back()))) + "/>";
  return out + "</svg>";
}

std::string curve_svg(const CurveView& curve) {
  Axes axes;
  const std::size_t begin = curve.points.size() > kPointsDrawn ? curve.points.size() - kPointsDrawn : 0;
  axes.first = static_cast<int>(begin) + 1;
  axes.last = std::max(axes.first, static_cast<int>(curve.points.size()));
  RightLabels words;
  std::string out = open(axes.width, axes.height, "Score by attempt", "chart", "group") + axes.grid(20, "attempt") +
                    cohort_area(curve.cohort, axes);
  out += line(axes.left, axes.y(curve.pass_at), axes.right, axes.y(curve.pass_at), kPassLine);
  words.add(axes.y(curve.pass_at) + 5, "pass " + number_text(curve.pass_at), "#9c4100");
  if (curve.benchmark) {
    const double y = axes.y(curve.benchmark->full_at);
    out += line(axes.left, y, axes.right, y,
                "stroke=\"#00785a\" stroke-width=\"1.8\" stroke-dasharray=\"1.5 4\" stroke-linecap=\"round\"");
    words.add(y + 5, "bench " + number_text(curve.benchmark->full_at), "#00593f");
  }
  out += own_points(
      curve.points, begin, axes, [&curve](std::size_t i) { return curve.points[i].score; },
      [](double score) { return score_text(score); });
  return out + words.draw(axes.right + 8, 16) + "</svg>";
}

std::string metric_svg(const MetricCurve& metric, const std::vector<CurvePoint>& points) {
  const std::size_t begin = points.size() > kPointsDrawn ? points.size() - kPointsDrawn : 0;
  Axes axes;
  axes.left = 66;
  axes.right = 712;
  axes.first = static_cast<int>(begin) + 1;
  axes.last = std::max(axes.first, static_cast<int>(points.empty() ? metric.cohort.size() : points.size()));
  double low = 0, high = 0;
  const auto reach = [&low, &high](double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (std::size_t i = begin; i < metric.values.size(); ++i)
    if (metric.values[i]) reach(*metric.values[i]);
  for (const CohortBand& band : metric.cohort) {
    if (band.attempt < axes.first || band.attempt > axes.last) continue;
    reach(band.quartiles.low);
    reach(band.quartiles.high);
  }
  const double largest = std::max({-low, high, 1e-9});
  auto [shown, shown_unit] = readable_unit(largest, metric.unit);
  if (metric.name.ends_with("_share")) std::tie(shown, shown_unit) = std::pair(100 * largest, std::string("%"));
  const double factor = shown / largest;
  const double step = svg::nice_step(std::max((high - low) * factor, 1e-6), 5);
  axes.low = step * std::floor(low * factor / step);
  axes.high = std::max(axes.low + step, step * std::ceil(high * factor / step));
  std::vector<CohortBand> bands = metric.cohort;
  for (CohortBand& band : bands)
    for (double* value : {&band.quartiles.low, &band.quartiles.median, &band.quartiles.high}) *value *= factor;
  std::string out = open(axes.width, axes.height, words_of(metric.name) + " by attempt", "measure", "group") +
                    axes.grid(step, "attempt") + cohort_area(bands, axes);
  if (!shown_unit.empty()) out += label(6, 14, shown_unit);
  return out +
         own_points(
             points, begin, axes,
             [&, factor](std::size_t i) {
               return i < metric.values.size() && metric.values[i] ? std::optional(*metric.values[i] * factor)
                                                                   : std::nullopt;
             },
             [unit = shown_unit](double value) { return number_text(value) + (unit.empty() ? "" : " " + unit); }) +
         "</svg>";
}

std::string cusum_svg(const CurveView& curve) {
  Axes axes;
  axes.width = 580;
  axes.right = 500;
  axes.height = 300;
  const std::size_t begin = curve.cusum.size() > kPointsDrawn ? curve.cusum.size() - kPointsDrawn : 0;
  axes.first = static_cast<int>(begin) + 1;
  axes.last = std::max(axes.first, static_cast<int>(curve.cusum.size()));
  axes.high = 1.2 * std::max(curve.rule.shown_at, curve.rule.relapse_at);
  for (std::size_t i = begin; i < curve.cusum.size(); ++i) axes.high = std::max(axes.high, 1.05 * curve.cusum[i].value);
  std::string out =
      open(axes.width, axes.height, "Sequential tests by attempt") + axes.grid(svg::nice_step(axes.high, 4), "attempt");
  RightLabels words;
  out += line(axes.left, axes.y(curve.rule.shown_at), axes.right, axes.y(curve.rule.shown_at),
              "stroke=\"#00785a\" stroke-width=\"1.6\" stroke-dasharray=\"7 4\"");
  words.add(axes.y(curve.rule.shown_at) + 5, "shown", "#00593f");
  out += line(axes.left, axes.y(curve.rule.relapse_at), axes.right, axes.y(curve.rule.relapse_at), kPassLine);
  words.add(axes.y(curve.rule.relapse_at) + 5, "relapse", "#9c4100");
  std::string points, marks;
  for (std::size_t i = begin; i < curve.cusum.size(); ++i) {
    const CusumPoint& point = curve.cusum[i];
    const bool keeping = point.test == CusumPoint::Test::kKeeping;
    const double x = axes.x(static_cast<double>(i) + 1), y = axes.y(point.value);
    points += px(x) + "," + px(y) + " ";
    const char* colour = keeping ? "#b04a00" : "#00785a";
    const double r = point.decided ? 6.5 : 3.2;
    if (keeping)
      marks += rect(x - r, y - r, 2 * r, 2 * r, std::string("fill=\"") + colour + "\"");
    else
      marks += "<circle" + attribute("cx", px(x)) + attribute("cy", px(y)) + attribute("r", px(r)) + " fill=\"" +
               colour + "\"/>";
  }
  return out + polyline(points, "stroke=\"#5b6570\" stroke-width=\"1.2\"") + marks + words.draw(axes.right + 8, 16) +
         "</svg>";
}

std::string weeks_svg(const std::vector<std::pair<std::string, double>>& minutes_by_week) {
  constexpr std::size_t kWeeks = 26;
  const std::size_t begin = minutes_by_week.size() > kWeeks ? minutes_by_week.size() - kWeeks : 0,
                    count = minutes_by_week.size() - begin;
  Axes axes;
  axes.width = 540;
  axes.height = 200;
  axes.right = 532;
  axes.bottom = 168;
  axes.high = 10;
  for (std::size_t i = begin; i < minutes_by_week.size(); ++i)
    axes.high = std::max(axes.high, minutes_by_week[i].second);
  std::string out = open(axes.width, axes.height, "Minutes a week", "weeks");
  const double step = svg::nice_step(axes.high, 4);
  for (const double v : svg::ticks(0, axes.high * 1.0001, step))
    out += line(axes.left, axes.y(v), axes.right, axes.y(v), "stroke=\"#d9dee4\"") +
           label(axes.left - 6, axes.y(v) + 5, number_text(v), "end");
  const double slot = count == 0 ? 0 : std::min(40.0, (axes.right - axes.left) / static_cast<double>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [week, minutes] = minutes_by_week[begin + k];
    const double x = axes.left + slot * static_cast<double>(k), top = axes.y(minutes);
    out += "<g><title>" + escape_html("week of " + dated(week) + ": " + fixed_text(minutes, 0) + " min") + "</title>" +
           rect(x + 0.12 * slot, top, 0.76 * slot, axes.bottom - top, std::string("fill=\"") + kBlue + "\"") + "</g>";
  }
  if (count > 0) out += label(axes.left, axes.bottom + 20, dated(minutes_by_week[begin].first));
  if (count > 1) out += label(axes.right, axes.bottom + 20, "to " + dated(minutes_by_week.back().first), "end");
  return out + "</svg>";
}

}  // namespace trocar::review
