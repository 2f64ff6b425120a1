#include "app/window/pages/progress_page.h"

#include <algorithm>
#include <cmath>

#include "app/window/ui/plot.h"

namespace trocar {
namespace {

constexpr double kTwoColumns = 900, kProgressMargin = 20, kList = 400;  // px at 720 lines and scale 1

Mark progress_mark(const ProgressEntry& entry) {
  if (entry.open) return Mark::kTick;
  return entry.curve.passed > 0 ? Mark::kHalf : Mark::kOpen;
}

std::string curve_legend(const Translator& w) {
  return w("Score by attempt; full disc: passed, ring: not yet, triangle: left, diamond: decided by a person");
}
std::string cusum_legend(const Translator& w) {
  return w("CUSUM by attempt; disc: showing competence, diamond: keeping it");
}

std::string minutes(const Translator& w, double seconds) {
  return seconds < 60 ? w("{0} s", {w.number(seconds, 0)})
                      : w("{0} min", {w.number(seconds / 60, seconds < 600 ? 1 : 0)});
}

Axis attempts_axis(const Ui& ui, std::size_t count, double width_px) {
  return count_axis(1, static_cast<int>(count), x_ticks_for(ui, width_px, ui.text_width("000")));
}

double score_of(const PastAttempt& attempt) { return attempt.summary.score.value_or(0); }

/// Passed: full disc. Not yet: ring. Left before its end: triangle at the foot. A person's decision: diamond, in the
/// colour of what was decided.
void attempt_mark(Plot& plot, const PastAttempt& attempt, double n) {
  const Ink verdict = attempt.summary.passed ? Ink::kGood : Ink::kCaution;
  if (!attempt.summary.decided_by.empty()) return plot.mark(n, score_of(attempt), PlotMark::kDiamond, verdict);
  if (!attempt.summary.score) return plot.mark(n, 0, PlotMark::kTriangle, Ink::kDim);
  plot.mark(n, score_of(attempt), attempt.summary.passed ? PlotMark::kDisc : PlotMark::kRing, verdict);
}

}  // namespace

std::string competence_words(const Translator& w, const std::vector<CusumPoint>& points, const CusumRule& rule) {
  const Competence c = competence_of(points);
  const std::string value = w.number(c.value, 1);
  if (c.shown && c.relapses == 0)
    return w("Competence was shown after {0} attempts; relapse alarm at {1} of {2}.",
             {std::to_string(*c.first_shown), value, w.number(rule.relapse_at, 1)});
  if (c.shown)
    return w("Competence was lost once and is shown again; relapse alarm at {0} of {1}.",
             {value, w.number(rule.relapse_at, 1)});
  if (c.relapses > 0)
    return w("A relapse: competence is to be shown again, now {0} of {1}.", {value, w.number(rule.shown_at, 1)});
  return w("Competence not shown yet: {0} of {1}. The shortest way is {2} passes in a row.",
           {value, w.number(rule.shown_at, 1), std::to_string(shortest_run(rule))});
}

void ProgressPage::list(Ui& ui, const std::vector<ProgressEntry>& entries, const std::string& who) {
  const Translator& w = ui.words();
  ui.title(w("My progress"));
  double trained = 0;
  int attempts = 0;
  for (const ProgressEntry& entry : entries) {
    trained += entry.curve.trained_s;
    attempts += static_cast<int>(entry.curve.attempts.size());
  }
  ui.text(w(w.one(attempts) ? "{0}: {1} attempt, {2} trained" : "{0}: {1} attempts, {2} trained",
            {who, std::to_string(attempts), minutes(w, trained)}),
          Ink::kDim);
  ui.gap(4);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const ProgressEntry& entry = entries[i];
    const std::string id = "curve" + std::to_string(i);
    const std::string right = entry.input + "  " + std::to_string(entry.curve.attempts.size());
    if (!ui.selectable(id.c_str(), progress_mark(entry), entry.name, static_cast<int>(i) == chosen_, right)) continue;
    chosen_ = static_cast<int>(i);
    attempt_ = -1;
  }
}

void ProgressPage::curve_plot(Ui& ui, const ProgressEntry& entry, double height_at_720) {
  const Translator& w = ui.words();
  const auto& attempts = entry.curve.attempts;
  const int count = static_cast<int>(attempts.size());
  ui.text(curve_legend(w), Ink::kDim);
  const Area area = ui.drawing("curve", height_at_720);
  const Ui::Pointer pointer = ui.pointer();
  if (const int steps = ui.key_steps(); steps != 0)
    attempt_ = std::clamp((attempt_ < 0 ? count - 1 : attempt_) + steps, 0, count - 1);
  Plot plot(ui, area,
            {attempts_axis(ui, attempts.size(), area.width),
             nice_axis(0, 100, y_ticks_for(ui, area.height - 1.6 * ui.line_height())), "", "", true, true, 0});
  plot.line(entry.pass_at, w("pass {0}", {w.number(entry.pass_at, 0)}), Ink::kText, false);
  if (const auto& band = entry.curve.band) {
    plot.band(band->low, band->high, "", Ink::kHeading);
    plot.line(band->median, w("your median {0}", {w.number(band->median, 1)}), Ink::kHeading, true);
  }
  std::vector<Ui::Point> points;
  for (int i = 0; i < count; ++i)
    if (attempts[static_cast<std::size_t>(i)].summary.score)
      points.push_back({i + 1.0, score_of(attempts[static_cast<std::size_t>(i)])});
  plot.curve(points, Ink::kDim);
  for (int i = 0; i < count; ++i) attempt_mark(plot, attempts[static_cast<std::size_t>(i)], i + 1.0);
  if (pointer.clicked) attempt_ = std::clamp(static_cast<int>(std::lround(plot.x_at(pointer.x))) - 1, 0, count - 1);
  if (attempt_ >= 0) {
    const PastAttempt& a = attempts[static_cast<std::size_t>(attempt_)];
    const std::string score = a.summary.score ? w.number(score_of(a), 1) : w("no score");
    std::string said =
        w("attempt {0}: {1}, {2}", {std::to_string(attempt_ + 1), score, a.summary.started_utc.substr(0, 10)});
    if (!a.summary.decided_by.empty())
      said += " " + w(a.summary.passed ? "(passed: {0} decided)" : "(not passed: {0} decided)", {a.summary.decided_by});
    plot.cursor(attempt_ + 1.0, said);
  }
  plot.labels();
}

void ProgressPage::cusum_plot(Ui& ui, const ProgressEntry& entry, double height_at_720) const {
  using Test = CusumPoint::Test;
  const Translator& w = ui.words();
  const CusumRule rule;
  ui.text(cusum_legend(w), Ink::kDim);
  const Area area = ui.drawing("cusum", height_at_720);
  double high = rule.shown_at * 1.25;
  for (const CusumPoint& point : entry.cusum) high = std::max(high, point.value * 1.05);
  Plot plot(ui, area,
            {attempts_axis(ui, entry.cusum.size(), area.width),
             nice_axis(0, high, y_ticks_for(ui, area.height - 1.6 * ui.line_height())), "", "", true, true, 0});
  const bool keeps =
      std::any_of(entry.cusum.begin(), entry.cusum.end(), [](const CusumPoint& p) { return p.test == Test::kKeeping; });
  plot.line(rule.shown_at, w("shown at {0}", {w.number(rule.shown_at, 1)}), Ink::kGood, false);
  if (keeps) plot.line(rule.relapse_at, w("relapse at {0}", {w.number(rule.relapse_at, 1)}), Ink::kAlarm, true);
  std::vector<Ui::Point> run;
  for (std::size_t i = 0; i < entry.cusum.size(); ++i) {
    const CusumPoint& point = entry.cusum[i];
    run.push_back({static_cast<double>(i) + 1, point.value});
    if (!point.decided && i + 1 < entry.cusum.size()) continue;
    plot.curve(run, point.test == Test::kLearning ? Ink::kGood : Ink::kCaution);
    run.clear();
  }
  for (std::size_t i = 0; i < entry.cusum.size(); ++i) {
    const CusumPoint& point = entry.cusum[i];
    const bool learning = point.test == Test::kLearning;
    plot.mark(static_cast<double>(i) + 1, point.value, learning ? PlotMark::kDisc : PlotMark::kDiamond,
              learning ? Ink::kGood : Ink::kCaution);
  }
  plot.labels();
}

void ProgressPage::details(Ui& ui, const ProgressEntry& entry) {
  const Translator& w = ui.words();
  const LearningCurve& c = entry.curve;
  ui.heading(w("{0}, by {1}", {entry.name, entry.input}));
  const auto count = static_cast<int>(c.attempts.size());
  std::string line = w(w.one(count) ? "{0} attempt, {1} passed, {2} of 3 in a row on different boards; {3} trained."
                                    : "{0} attempts, {1} passed, {2} of 3 in a row on different boards; {3} trained.",
                       {std::to_string(count), std::to_string(c.passed), std::to_string(std::min(3, entry.in_a_row)),
                        minutes(w, c.trained_s)});
  if (c.best) line += " " + w("Best {0}, last {1}.", {w.number(*c.best, 1), w.number(*c.last, 1)});
  if (const auto& band = c.band)
    line += " " + w("Last {0}: median {1}, middle half {2} to {3}.",
                    {std::to_string(std::min(kBandAttempts, c.graded)), w.number(band->median, 1),
                     w.number(band->low, 1), w.number(band->high, 1)});
  ui.text(line);
  if (entry.older_rubric)
    ui.marked(Mark::kInfo, w("Graded by an older version of the exercise: not comparable with today's."),
              Ink::kCaution);
  if (!entry.note.empty()) ui.marked(Mark::kInfo, entry.note, Ink::kCaution);
  const std::string said = competence_words(w, entry.cusum);
  const double texts = ui.text_height(curve_legend(w), ui.room()) + ui.text_height(cusum_legend(w), ui.room()) +
                       ui.text_height(said, ui.room());
  const double room = (ui.room_below() - texts) / ui.px(1) - 4 * 7 - 2;
  curve_plot(ui, entry, std::max(170.0, 0.56 * room));
  cusum_plot(ui, entry, std::max(135.0, 0.44 * room));
  ui.text(said, Ink::kDim);
}

std::vector<RowButton> ProgressPage::foot_buttons(const Translator& w,
                                                  const std::vector<ProgressEntry>& entries) const {
  std::vector<RowButton> out{{"back", w("Back"), "Esc", true}};
  if (!entries.empty()) out.push_back({"csv", w("Export as CSV"), "X"});
  if (!entries.empty() && attempt_ >= 0)
    out.push_back({"open", w("Open attempt {0}", {std::to_string(attempt_ + 1)}), "O"});
  return out;
}

ProgressChoice ProgressPage::meant(const std::string& id, const std::vector<ProgressEntry>& entries) const {
  using Kind = ProgressChoice::Kind;
  if (id == "back") return {Kind::kBack, ""};
  if (id == "csv") return {Kind::kExport, ""};
  if (id != "open") return {};
  return {Kind::kOpen,
          entries[static_cast<std::size_t>(chosen_)].curve.attempts[static_cast<std::size_t>(attempt_)].summary.uuid};
}

ProgressChoice ProgressPage::draw(Ui& ui, const std::vector<ProgressEntry>& entries, const std::string& who) {
  const Translator& w = ui.words();
  const double margin = std::min(ui.px(kProgressMargin), 0.02 * ui.width()), gap = ui.px(8),
               wide = ui.width() - 2 * margin;
  const std::vector<RowButton> buttons = foot_buttons(w, entries);
  const double foot_high = button_rows_height(ui, buttons, wide), high = ui.height() - 2 * margin - foot_high - gap;
  const bool two = wide >= ui.px(kTwoColumns);
  chosen_ = std::clamp(chosen_, 0, std::max(0, static_cast<int>(entries.size()) - 1));
  const double left = two ? ui.px(kList) : wide;
  ui.begin_panel("progress.list", {margin, margin, left, high});
  list(ui, entries, who);
  if (entries.empty())
    ui.text(w("No attempt yet. After the first one its score, your pass line and your own median stand here."));
  if (two) ui.end_panel();
  if (two && !entries.empty()) ui.begin_panel("progress.curve", {margin + left + gap, margin, wide - left - gap, high});
  if (!entries.empty()) details(ui, entries[static_cast<std::size_t>(chosen_)]);
  if (!two || !entries.empty()) ui.end_panel();
  ui.begin_strip("progress.foot", {margin, margin + high + gap, wide, foot_high});
  const ProgressChoice choice = meant(button_rows(ui, buttons), entries);
  ui.end_panel();
  return choice;
}

}  // namespace trocar
