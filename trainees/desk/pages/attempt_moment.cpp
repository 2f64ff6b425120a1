#include <algorithm>
#include <array>
#include <cmath>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string moment_href(const AttemptView& view) { return "/attempt/" + url_part(view.result.uuid) + "?t="; }

std::string step(const AttemptView& view, double t_s, const std::string& words) {
  const double at = std::clamp(t_s, 0.0, view.trace ? length_s(*view.trace) : 0.0);
  return "<a class=\"button\" href=\"" + moment_href(view) + fixed_text(at, 2) + "#moment\">" + escape_html(words) +
         "</a>";
}

std::string steps(const AttemptView& view) {
  std::string out;
  constexpr std::array<std::pair<double, const char*>, 4> kSteps = {{{-5,
                                                                      "\xE2\x88\x92"
                                                                      "5 s"},
                                                                     {-1,
                                                                      "\xE2\x88\x92"
                                                                      "1 s"},
                                                                     {1, "+1 s"},
                                                                     {5, "+5 s"}}};
  for (const auto& [by, words] : kSteps) out += step(view, view.t_s + by, words);
  const Event *before = nullptr, *after = nullptr;
  for (const Event& event : view.result.events) {
    const double t = event.t_s - view.begin_s();
    if (t < view.t_s - 0.005 && (before == nullptr || event.t_s > before->t_s)) before = &event;
    if (t > view.t_s + 0.005 && (after == nullptr || event.t_s < after->t_s)) after = &event;
  }
  if (before != nullptr) out += step(view, before->t_s - view.begin_s(), "event before");
  if (after != nullptr) out += step(view, after->t_s - view.begin_s(), "next event");
  return "<p class=\"steps\">" + out + step(view, peak_moment_s(view), "largest force") + "</p>";
}

/// Largest force in each of `slots` parts of the time, for the script that follows the cursor.
std::string force_slots(const Trace& trace, int slots) {
  const double length = std::max(1e-3, length_s(trace)), start = trace.samples.front().t_s;
  std::vector<double> most(static_cast<std::size_t>(slots), 0.0);
  for (const TraceSample& sample : trace.samples) {
    const double force = sample.force_T.norm(), at = (sample.t_s - start) / length * slots;
    if (!std::isfinite(force) || !std::isfinite(at)) continue;
    double& slot = most[static_cast<std::size_t>(std::clamp(at, 0.0, slots - 1.0))];
    slot = std::max(slot, force);
  }
  std::string out;
  for (const double value : most) out += (out.empty() ? "" : ",") + fixed_text(value, 1);
  return out;
}

std::string now_words(const AttemptView& view) {
  const TraceSample* sample = sample_at(*view.trace, view.t_s);
  if (sample == nullptr) return "";
  std::string out = fixed_text(view.t_s, 1) + " s: " + fixed_text(sample->force_T.norm(), 2) + " N at the tip";
  if (sample->grip_n > 0.02) out += ", grip " + fixed_text(sample->grip_n, 2) + " N";
  out += sample->contact ? ", in contact" : ", free";
  if (sample->saturated) out += ", device at its limit";
  return out;
}

std::string scrub(const AttemptView& view) {
  return "<form class=\"scrub\" id=\"scrub\" method=\"get\" action=\"/attempt/" + url_part(view.result.uuid) +
         "#moment\" data-force=\"" + force_slots(*view.trace, 400) +
         "\"><label for=\"t\">Time</label><input id=\"t\" name=\"t\" type=\"range\" min=\"0\" max=\"" +
         fixed_text(length_s(*view.trace), 1) + "\" step=\"0.1\" value=\"" + fixed_text(view.t_s, 1) +
         "\"/><button>Show</button></form>" +
         "<p><output id=\"now\" for=\"t\" data-words=\"0.0 s: up to 0.0 N at the tip\">" +
         escape_html(now_words(view)) + "</output></p>";
}

std::string picture(const AttemptView& view) {
  if (!view.picture) return "<p class=\"empty\">No picture: this desk runs without graphics.</p>";
  const std::string base = "/attempt/" + url_part(view.result.uuid) + "/picture.png?t=";
  return "<img id=\"picture\" class=\"scope\" width=\"800\" height=\"450\" data-base=\"" + base + "\" src=\"" + base +
         fixed_text(view.t_s, 2) + "\" alt=\"View of the scope at " + fixed_text(view.t_s, 1) +
         " s\"/><p class=\"dim\"><small>The first picture of an attempt takes some seconds.</small></p>";
}

std::string force_key(const ForceLimits& limits) {
  if (limits.high_n <= 0 && limits.hard_n <= 0) return "Path in grey: this exercise sets no force limits.";
  std::string out =
      "<span class=\"key\"><svg class=\"swatch\" viewBox=\"0 0 22 12\" aria-hidden=\"true\"><path d=\"M1 6H21\" "
      "stroke=\"#7a8794\" "
      "stroke-width=\"1.2\"/></svg>below</span> ";
  if (limits.high_n > 0)
    out +=
        "<span class=\"key\"><svg class=\"swatch\" viewBox=\"0 0 22 12\" aria-hidden=\"true\"><path d=\"M1 6H21\" "
        "stroke=\"#009e73\" "
        "stroke-width=\"2.4\"/></svg>wanted force</span> "
        "<span class=\"key\"><svg class=\"swatch\" viewBox=\"0 0 22 12\" aria-hidden=\"true\"><path d=\"M1 6H21\" "
        "stroke=\"#e69f00\" "
        "stroke-width=\"3.6\"/></svg>above it</span> ";
  if (limits.hard_n > 0)
    out +=
        "<span class=\"key\"><svg class=\"swatch\" viewBox=\"0 0 22 12\" aria-hidden=\"true\"><path d=\"M1 6H21\" "
        "stroke=\"#d55e00\" "
        "stroke-width=\"5\"/></svg>over the limit of " +
        number_text(limits.hard_n) + " N</span> ";
  return out + "White dot: start; black dot: end; ring: this moment.";
}

}  // namespace

double peak_moment_s(const AttemptView& view) {
  double most = -1, at = 0;
  if (view.trace)
    for (const TraceSample& sample : view.trace->samples)
      if (sample.force_T.norm() > most) {
        most = sample.force_T.norm();
        at = sample.t_s - view.begin_s();
      }
  return at;
}

std::string moment_section(const AttemptView& view) {
  if (!view.trace || view.trace->samples.empty())
    return section("moment", "Force and picture",
                   "<p class=\"empty\">" +
                       escape_html(view.no_trace.empty() ? "There is no recording of this attempt." : view.no_trace) +
                       "</p>");
  TimePlot plot;
  plot.lines = {{&*view.trace, false, "force at the tip", "#1d2630", ""}};
  const bool gripped = std::any_of(view.trace->samples.begin(), view.trace->samples.end(),
                                   [](const TraceSample& s) { return s.grip_n > 0.02; });
  if (gripped) plot.lines.push_back({&*view.trace, true, "grip", "#2d7fab", "5 3"});
  plot.limits = view.limits;
  plot.events = view.result.events;
  plot.begin_s = view.begin_s();
  plot.cursor_s = view.t_s;
  plot.moment_href_html = moment_href(view);
  return section("moment", "Force and picture at " + fixed_text(view.t_s, 1) + " s",
                 "<div class=\"two moment\"><div>" + picture(view) + "</div><div>" +
                     figure(time_plot_svg(plot),
                            "Click the plot or a mark to go there. Circle: information; square: minor; triangle: major "
                            "or critical event.") +
                     scrub(view) + steps(view) + "</div></div>");
}

std::string path_section(const AttemptView& view) {
  if (!view.trace || view.trace->samples.empty()) return "";
  std::string out = "<div class=\"squares\">";
  for (const Projection& projection : {kFromAbove, kFromFront, kFromSide})
    out += "<figure>" + path_svg(*view.trace, projection, view.limits, view.t_s) + "<figcaption>Path " +
           axes_words(projection) + "</figcaption></figure>";
  out += "<figure>" + heat_svg(*view.trace, kFromAbove, false) +
         "<figcaption>Where the tip was, from above</figcaption></figure><figure>" +
         heat_svg(*view.trace, kFromAbove, true) +
         "<figcaption>Where it touched, from above</figcaption></figure><figure>" +
         heat_svg(*view.trace, kFromFront, true) +
         "<figcaption>Where it touched, from the front</figcaption></figure></div><p class=\"keys\">" +
         force_key(view.limits) + " Maps: darker is longer, logarithmic.</p>";
  return section("path", "Path of the tip", out);
}

}  // namespace trocar::review
