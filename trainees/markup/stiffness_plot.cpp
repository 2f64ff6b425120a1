#include "trainees/markup/stiffness_plot.h"

#include <algorithm>
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
using svg::ticks;

constexpr double kPlotWidth = 1000, kHeight = 240, kPlotLeft = 52, kPlotRight = 986, kPlotTop = 26, kPlotBottom = 196;

struct Curve {
  const char* words;
  const char* style;
  double StiffnessColumn::*value;
};

// Told apart by brightness, width and dash, not by hue alone.
constexpr Curve kCurves[] = {
    {"asked by the contact", "stroke=\"#9aa5b1\" stroke-width=\"7\"", &StiffnessColumn::asked},
    {"displayed", "stroke=\"#14191f\" stroke-width=\"3\"", &StiffnessColumn::displayed},
    {"K max, what the device can display", "stroke=\"#d55e00\" stroke-width=\"1.5\" stroke-dasharray=\"6 3\"",
     &StiffnessColumn::k_max}};

double duration(const Trace& trace) {
  if (trace.samples.empty()) return 1;
  const double span = trace.samples.back().t_s - trace.samples.front().t_s;
  return std::isfinite(span) ? std::max(span, 1e-3) : 1;
}

bool touches(const TraceSample& s) {
  return std::isfinite(s.t_s) && std::isfinite(s.stiffness_n_per_m) && std::isfinite(s.k_max_n_per_m) &&
         s.stiffness_n_per_m > 0 && s.k_max_n_per_m > 0;
}

/// A polyline for each touch: neighbouring columns only are joined.
std::string polylines(const std::vector<StiffnessColumn>& columns, const Curve& curve, double top) {
  std::string out, points;
  const auto y = [&](double value) {
    return kPlotBottom - (kPlotBottom - kPlotTop) * std::clamp(value / top, 0.0, 1.0);
  };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const StiffnessColumn& c = columns[i];
    points += (points.empty() ? "" : " ") + px(kPlotLeft + c.column) + "," + px(y(c.*curve.value));
    const bool ends = i + 1 == columns.size() || columns[i + 1].column > c.column + 1;
    if (!ends) continue;
    if (points.find(' ') == std::string::npos)
      points += " " + px(kPlotLeft + c.column + 1) + "," + px(y(c.*curve.value));
    out += std::string("<polyline fill=\"none\" stroke-linejoin=\"round\" ") + curve.style +
           attribute("points", points) + "/>";
    points.clear();
  }
  return out;
}

std::string axes(double top, double t_end_s) {
  std::string out;
  const auto x = [&](double t) { return kPlotLeft + (kPlotRight - kPlotLeft) * t / t_end_s; };
  const auto y = [&](double value) { return kPlotBottom - (kPlotBottom - kPlotTop) * value / top; };
  const double step = nice_step(top, 4), step_s = nice_step(t_end_s, 10);
  for (const double n : ticks(0, top, step))
    out += line(kPlotLeft, y(n), kPlotRight, y(n), "stroke=\"#000\" stroke-opacity=\"0.12\"") +
           label(kPlotLeft - 7, y(n) + 5, number_text(n), "end");
  for (const double t : ticks(0, t_end_s * 1.0001, step_s))
    out += line(x(t), kPlotBottom, x(t), kPlotBottom + 5, "stroke=\"#555\"") +
           label(x(t), kPlotBottom + 20, number_text(t), "middle");
  return out + label(kPlotRight, kPlotBottom + 40, "time, s", "end") + label(6, kPlotTop - 10, "N/m at the stylus");
}

std::string legend() {
  std::string out;
  double at = kPlotLeft;
  for (const Curve& curve : kCurves) {
    out += line(at, kPlotBottom + 35, at + 30, kPlotBottom + 35, curve.style) +
           label(at + 36, kPlotBottom + 40, curve.words);
    at += 62 + 7.6 * static_cast<double>(std::string(curve.words).size());
  }
  return out;
}

std::string percent(double share) { return fixed_text(100 * share, 0) + " %"; }

}  // namespace

std::vector<StiffnessColumn> stiffness_columns(const Trace& trace, int columns) {
  std::vector<StiffnessColumn> means;
  const double t_end_s = duration(trace);
  std::vector<int> count;
  for (const TraceSample& s : trace.samples) {
    if (!touches(s)) continue;
    const double t_s = s.t_s - trace.samples.front().t_s;
    const int column = std::clamp(static_cast<int>(t_s / t_end_s * columns), 0, columns - 1);
    if (means.empty() || means.back().column != column) means.push_back({column}), count.push_back(0);
    StiffnessColumn& mean = means.back();
    const double n = ++count.back();
    const double left = s.commanded_n > 0 && std::isfinite(s.rendered_n) ? s.rendered_n / s.commanded_n : 0;
    mean.asked += (s.stiffness_n_per_m - mean.asked) / n;
    mean.k_max += (s.k_max_n_per_m - mean.k_max) / n;
    mean.displayed += (left * s.stiffness_n_per_m - mean.displayed) / n;
  }
  return means;
}

std::string stiffness_plot_svg(const Trace& trace) {
  const auto columns = stiffness_columns(trace, static_cast<int>(kPlotRight - kPlotLeft));
  double top = 1;
  for (const StiffnessColumn& c : columns) top = std::max({top, 1.1 * c.asked, 1.1 * c.k_max, 1.1 * c.displayed});
  std::string out = "<svg viewBox=\"0 0 " + px(kPlotWidth) + " " + px(kHeight) +
                    "\" role=\"img\" aria-label=\"Stiffness against time\">";
  out += axes(top, duration(trace));
  for (const Curve& curve : kCurves) out += polylines(columns, curve, top);
  if (columns.empty())
    out += label(0.5 * (kPlotLeft + kPlotRight), 0.5 * (kPlotTop + kPlotBottom), "nothing was touched", "middle");
  return out + legend() + "</svg>";
}

std::string stiffness_words(const StiffnessReport& s) {
  if (!s.recorded) return "";
  const std::string clamp = s.clamped ? "The clamp was on: " : "The clamp was off: ";
  if (s.contact_ticks == 0) return clamp + "nothing was touched.";
  const std::string limit = "Contacts of up to " + number_text(std::round(s.asked_max_n_per_m)) +
                            " N/m met a device that can display " + number_text(std::round(s.k_max_min_n_per_m)) +
                            " to " + number_text(std::round(s.k_max_max_n_per_m)) +
                            " N/m without making energy of its own, by pose and direction. ";
  if (s.above_share == 0) return limit + "None asked for more than that.";
  if (s.clamped)
    return limit + clamp + "for " + percent(s.above_share) +
           " of the contact time they were weakened to that limit, at worst to " + percent(s.share_min) +
           ", so they felt softer than the exercise says.";
  return limit + clamp + "for " + percent(s.above_share) +
         " of the contact time they were rendered stiffer than that (the limit was " + percent(s.share_min) +
         " of what was asked at worst), and passivity control had to keep them stable.";
}

}  // namespace trocar
