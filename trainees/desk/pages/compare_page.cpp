#include <algorithm>
#include <cmath>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/compare_moment.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"
#include "trainees/markup/pacing.h"

namespace trocar::review {
namespace {

constexpr const char *kLeftColour = "#0072b2", *kRightColour = "#b04a00", *kRightDash = "6 3";

std::optional<double> metric_of(const AttemptView& view, const std::string& name) {
  for (const Metric& metric : view.result.grade.metrics)
    if (metric.name == name && metric.value && std::isfinite(*metric.value)) return metric.value;
  return {};
}

/// "better", "worse" or "" where the rubric does not judge that number.
std::string judged(const std::optional<bool>& less, double difference) {
  if (!less || difference == 0) return "";
  const bool better = *less == (difference < 0);
  return shape(better ? "pass" : "fail") + (better ? "better" : "worse");
}

std::string row(const std::string& name, const std::string& unit, const std::optional<double>& left,
                const std::optional<double>& right, const std::optional<bool>& less) {
  std::string difference = "\xE2\x80\x93", verdict;
  if (left && right) {
    const double d = *left - *right;
    difference = (d > 0 ? "+" : d < 0 ? "\xE2\x88\x92" : "") + quantity_text(std::abs(d), unit);
    verdict = judged(less, d);
  }
  const auto words = [&](const std::optional<double>& v) {
    return v ? quantity_text(v, unit) : std::string("\xE2\x80\x93");
  };
  return "<tr><th scope=\"row\">" + escape_html(metric_title(name)) + "</th>" + number_cell(words(left)) +
         number_cell(words(right)) + number_cell(difference) + "<td>" + verdict + "</td></tr>";
}

std::string metrics(const CompareView& view) {
  std::string rows = row("score", "", view.left.result.grade.score, view.right.result.grade.score, false);
  for (const Metric& metric : view.left.result.grade.metrics)
    rows += row(metric.name, metric.unit, metric_of(view.left, metric.name), metric_of(view.right, metric.name),
                less_is_better(view.left, metric.name));
  for (const Metric& metric : view.right.result.grade.metrics) {
    const auto& known = view.left.result.grade.metrics;
    if (std::none_of(known.begin(), known.end(), [&](const Metric& m) { return m.name == metric.name; }))
      rows += row(metric.name, metric.unit, {}, metric_of(view.right, metric.name), {});
  }
  return section(
      "metrics", "Numbers",
      table("First attempt, second attempt and their difference; judged only where the rubric judges that number",
            head_cells({"Metric", ">" + view.left_words, ">" + view.right_words, ">Difference", "First is"}), rows));
}

std::string head_of(const AttemptView& view, const std::string& words, bool first) {
  const std::string swatch = std::string(
                                 "<svg class=\"swatch\" viewBox=\"0 0 22 12\" aria-hidden=\"true\"><path d=\"M1 6H21\" "
                                 "stroke-width=\"3\" stroke=\"") +
                             (first ? kLeftColour : kRightColour) + "\"" +
                             (first ? "" : std::string(" stroke-dasharray=\"") + kRightDash + "\"") + "/></svg>";
  const Grade& grade = view.result.grade;
  const Verdict judged = view.verdict();
  const std::string verdict =
      !grade.score && !judged.decision
          ? shape("void") + "not graded"
          : shape(judged.passed ? "pass" : "fail") + (judged.passed ? "pass" : "not yet") +
                (judged.decision ? " by decision of " + printed_html(judged.decision->printed, judged.decision->author)
                                 : "");
  return "<section class=\"card side\" aria-label=\"" + escape_html(words) + "\"><h2>" + swatch +
         "<a href=\"/attempt/" + url_part(view.result.uuid) + "\">" + escape_html(words) + "</a></h2><p><strong>" +
         score_text(grade.score) + "</strong> " + verdict + ", " + verbatim(view.result.trainee) + ", " +
         date_html(view.result.started_utc) + "</p><p>" + escape_html(verdict_reason(view)) + "</p>" +
         (grade.score && !soft_real_time(view.result.device).empty()
              ? "<p><span class=\"tag\">soft real time</span></p>"
              : "") +
         "</section>";
}

std::string traces(const CompareView& view) {
  TimePlot plot;
  plot.limits = view.left.limits;
  plot.cursor_s = view.left.trace ? std::min(view.t_s, length_s(*view.left.trace)) : -1;
  plot.moment_href_html = "/compare/" + url_part(view.left.result.uuid) + "/" + url_part(view.right.result.uuid) +
                          "?by=" + std::to_string(view.aligned) + "&amp;t=";
  if (view.left.trace) plot.lines.push_back({&*view.left.trace, false, view.left_words, kLeftColour, ""});
  if (view.right.trace) plot.lines.push_back({&*view.right.trace, false, view.right_words, kRightColour, kRightDash});
  if (plot.lines.empty())
    return section("traces", "Force", "<p class=\"empty\">There is no recording of either attempt.</p>");
  std::string missing;
  if (!view.left.trace) missing = "No recording of the first. ";
  if (!view.right.trace) missing = "No recording of the second. ";
  return section(
      "traces", "Force",
      figure(time_plot_svg(plot),
             escape_html(missing) +
                 "Both from their own beginning. Click the plot to go there; the line is the first's moment."));
}

std::string paths(const CompareView& view) {
  std::string out;
  for (const auto& [side, words] : {std::pair(&view.left, &view.left_words), std::pair(&view.right, &view.right_words)})
    if (side->trace && !side->trace->samples.empty())
      out += "<figure>" + path_svg(*side->trace, kFromAbove, side->limits, -1) + "<figcaption>" + escape_html(*words) +
             ", from above</figcaption></figure><figure>" + path_svg(*side->trace, kFromFront, side->limits, -1) +
             "<figcaption>" + escape_html(*words) + ", from the front</figcaption></figure>";
  return out.empty() ? "" : section("path", "Path of the tip", "<div class=\"squares four\">" + out + "</div>");
}

std::string cautions(const CompareView& view) {
  const AttemptResult &a = view.left.result, &b = view.right.result;
  std::string out;
  if (a.exercise_id != b.exercise_id || a.level != b.level)
    out += "<li>They are of different exercises or levels.</li>";
  if (a.rubric_sha256 != b.rubric_sha256) out += "<li>They were graded by different rules.</li>";
  if (a.hand != b.hand)
    out +=
        "<li>They were made with different inputs: " + escape_html(a.hand) + " and " + escape_html(b.hand) + ".</li>";
  if (a.board != b.board) out += "<li>The boards differ.</li>";
  return out.empty() ? ""
                     : "<div class=\"warning\"><p>" + shape("integrity") + "Read the differences with care:</p><ul>" +
                           out + "</ul></div>";
}

}  // namespace

std::string compare_page(const CompareView& view, Frame frame) {
  frame.title = "Compare";
  return document(frame, "<div class=\"title\"><h1>Compare: " + escape_html(view.exercise) + "</h1></div>" +
                             cautions(view) + "<div class=\"two even\">" + head_of(view.left, view.left_words, true) +
                             head_of(view.right, view.right_words, false) + "</div>" + compare_moment_section(view) +
                             traces(view) + paths(view) + metrics(view));
}

}  // namespace trocar::review
