#include <algorithm>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/loss_parts.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"
#include "trainees/markup/score_words.h"

namespace trocar::review {
namespace {

std::string of_words(int n, int all) { return std::to_string(n) + " of " + std::to_string(all); }

/// "3 of 15; asks 65 % or more", "met by all", "" of what is no gate.
std::string gate_cell(const LostSubscore& lost, int graded) {
  if (!lost.part.gate) return "<td></td>";
  if (lost.gate_failed == 0) return "<td>" + shape("pass") + "met by all</td>";
  const double asked = lost.part.zero_at + lost.gate_below * (lost.part.full_at - lost.part.zero_at);
  return "<td class=\"long bad\">" + shape("unsafe") + "not met in " + of_words(lost.gate_failed, graded) + "; asks " +
         escape_html(part_value_text(lost.part, asked)) +
         (lost.part.full_at < lost.part.zero_at ? " or less" : " or more") + "</td>";
}

std::string bar(double lost, double most) {
  return "<td><svg class=\"bar\" viewBox=\"0 0 60 10\" aria-hidden=\"true\"><rect width=\"60\" height=\"10\" "
         "fill=\"#dfe3e8\"/><rect width=\"" +
         fixed_text(most > 0 ? 60 * std::clamp(lost / most, 0.0, 1.0) : 0, 1) +
         "\" height=\"10\" fill=\"#d55e00\"/></svg></td>";
}

std::string summary(const Losses& l) {
  std::string out = "<p>" + plural(l.attempts, "attempt", "attempts") + " of " + plural(l.people, "person", "people") +
                    ": " + of_words(l.passed, l.graded) + " graded ones passed";
  if (l.attempts > l.graded) out += ", " + std::to_string(l.attempts - l.graded) + " without a score";
  if (l.unfinished > 0) out += ", " + std::to_string(l.unfinished) + " not finished";
  std::string grave;
  for (const HarmfulEvents& e : l.critical)
    grave += (grave.empty() ? " Critical: " : ", ") + lower_words_of(e.type) + " " + std::to_string(e.count) + "x";
  return out + "." + (grave.empty() ? "" : "<strong class=\"bad\">" + escape_html(grave) + ".</strong>") + "</p>";
}

std::string loss_table(const LossLine& line) {
  const Losses& l = line.losses;
  std::string rows;
  const double most = l.parts.empty() ? 0 : l.parts.front().points_lost;
  for (const LostSubscore& lost : l.parts)
    rows += "<tr><th scope=\"row\">" + escape_html(words_of(lost.part.name)) +
            (lost.part.gate ? " <span class=\"tag\">safety gate</span>" : "") + "</th>" +
            number_cell(fixed_text(lost.points_lost, 1)) + bar(lost.points_lost, most) +
            number_cell(part_value_text(lost.part, lost.part.raw)) + "<td><small>" +
            escape_html(anchors_text(lost.part)) + "</small></td>" + gate_cell(lost, l.graded) + "</tr>";
  return summary(l) + (rows.empty() ? ""
                                    : stacked_table("Mean points lost of each part, most first",
                                                    {"Part", ">Points lost", "", ">Median", "Anchors", "Gate"}, rows));
}

std::vector<Choice> metric_choices(const std::vector<std::string>& names) {
  std::vector<Choice> out;
  for (const std::string& name : names) out.emplace_back(name, metric_title(name));
  std::sort(out.begin(), out.end(), [](const Choice& a, const Choice& b) { return a.second < b.second; });
  return out;
}

std::string filters(const WhyView& view) {
  std::vector<Choice> exercises = {{"", "all exercises"}};
  exercises.insert(exercises.end(), view.exercises.begin(), view.exercises.end());
  std::string out =
      "<form class=\"filters\" method=\"get\" action=\"/why\">" +
      select_field("f-group", "group", "Group", all_or_one("all groups", view.groups), view.asked.group, true) +
      select_field("f-exercise", "exercise", "Exercise", exercises, view.asked.exercise_id) +
      select_field("f-level", "level", "Level", all_or_one("all levels", view.levels), view.asked.level);
  if (!view.metrics.empty())
    out += select_field("f-metric", "metric", "Measure drawn", metric_choices(view.metrics), view.metric);
  return out + "<p class=\"field\"><button>Show</button> " + link_html("/why", "Reset") + "</p></form>";
}

}  // namespace

std::string loss_tables(const std::vector<LossLine>& lines) {
  std::string out;
  for (const LossLine& line : lines) {
    const CurveKey& key = line.losses.key;
    const auto alike = std::count_if(lines.begin(), lines.end(), [&key](const LossLine& other) {
      const CurveKey& k = other.losses.key;
      return k.exercise_id == key.exercise_id && k.level == key.level && k.hand == key.hand;
    });
    out += "<h3>" + escape_html(line.title + " " + key.level) + " <small class=\"dim\">" + escape_html(key.hand) +
           (alike > 1 ? ", rules " + escape_html(key.rubric_sha256.substr(0, 6)) : "") + "</small></h3>" +
           loss_table(line);
    if (!line.metric.cohort.empty()) out += metric_figure(line.metric, {});
  }
  return out.empty() ? "<p>No attempt yet that says anything.</p>" : out;
}

std::string metric_form(const std::string& action_html, const std::vector<std::pair<std::string, std::string>>& kept,
                        const std::vector<std::string>& choices, const std::string& chosen) {
  std::string out = "<form class=\"filters\" method=\"get\" action=\"" + action_html + "\">";
  for (const auto& [name, value] : kept)
    out += "<input type=\"hidden\" name=\"" + escape_html(name) + "\" value=\"" + escape_html(value) + "\"/>";
  return out + select_field("measure-name", "metric", "Measure", metric_choices(choices), chosen) +
         "<p class=\"field\"><button>Show</button></p></form>";
}

std::string metric_figure(const MetricCurve& metric, const std::vector<CurvePoint>& points) {
  std::string caption =
      escape_html(metric_title(metric.name) + (metric.words.empty() ? "" : ": " + metric.words)) + ". ";
  if (!points.empty()) caption += "Filled: passed; hollow: not passed; cross: no value. ";
  if (metric.cohort.empty()) return figure(metric_svg(metric, points), caption + "Too few others for quartiles.");
  const auto [fewest, most] = std::minmax_element(metric.cohort.begin(), metric.cohort.end(),
                                                  [](const CohortBand& a, const CohortBand& b) { return a.n < b.n; });
  return figure(metric_svg(metric, points),
                caption + "Shaded: quartiles and median of the cohort by attempt, n = " + std::to_string(fewest->n) +
                    (fewest->n == most->n ? "" : " to " + std::to_string(most->n)) + ".");
}

std::string why_page(const WhyView& view, Frame frame) {
  frame.title = "Why";
  const std::string drawn =
      view.metric.empty() && !view.lines.empty()
          ? "<p class=\"dim\">Choose an exercise and a level to draw a measure over the attempts.</p>"
          : "";
  return document(frame, "<div class=\"title\"><h1>Why attempts fail</h1><p class=\"dim\">" +
                             (view.asked.group.empty() ? "everybody" : "group " + verbatim(view.asked.group)) +
                             ", the newest " + std::to_string(kRowsForLosses) + " attempts of each person</p></div>" +
                             section("losses", "Where the points go", filters(view) + drawn + loss_tables(view.lines)));
}

}  // namespace trocar::review
