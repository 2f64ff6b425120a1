// One trainee: how each exercise stands and why, the curves, what was certified and decided, every attempt.
#include <algorithm>

#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/reports/report_words.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

using printed::Block;
using printed::Cell;
using printed::Heading;
using printed::Paragraph;
using printed::Table;
using printed::Tone;

constexpr std::size_t kSparkPoints = 20;

std::string words_of(const CurveView& curve) { return curve_words(curve.title, curve.key.level, curve.key.hand); }

const VerdictOverride* decision_on(const TraineeReportView& view, const std::string& uuid) {
  const auto it = view.decisions.find(uuid);
  return it == view.decisions.end() ? nullptr : &it->second;
}

/// First and last attempt.
std::pair<std::string, std::string> period_of(const TraineeView& view) {
  std::pair<std::string, std::string> out;
  for (const CurveView& curve : view.curves)
    for (const CurvePoint& point : curve.points) {
      if (out.first.empty() || point.utc < out.first) out.first = point.utc;
      out.second = std::max(out.second, point.utc);
    }
  return out;
}

std::string newest_entry(const TraineeReportView& view, bool notes) {
  const std::string last = period_of(view.trainee).second;
  std::string out = last.empty() ? view.trainee.created_utc : last;
  for (const Certificate& c : view.trainee.certificates) out = std::max({out, c.utc, c.revoked_utc});
  for (const auto& [uuid, decision] : view.decisions) out = std::max(out, decision.utc);
  if (notes)
    for (const Note& note : view.trainee.notes) out = std::max(out, note.utc);
  return out;
}

Block overview(const TraineeView& view) {
  int tries = 0, graded = 0, passed = 0, held = 0;
  double trained_s = 0;
  for (const CurveView& curve : view.curves) {
    tries += static_cast<int>(curve.points.size());
    graded += curve.graded;
    passed += curve.passed;
    trained_s += curve.trained_s;
  }
  for (const Certificate& c : view.certificates) held += c.revoked_utc.empty() ? 1 : 0;
  const auto [first, last] = period_of(view);
  return printed::Facts{
      {{"Period", first.empty() ? "no attempts yet" : period_words(first, last)},
       {"Attempts", std::to_string(tries)},
       {"Graded", std::to_string(graded)},
       {"Passed", std::to_string(passed)},
       {"Time trained", fixed_text(trained_s / 60, 0) + " min"},
       {"Certificates held", std::to_string(held)},
       {"Rules of progress", "version " + (view.rules_version.empty() ? "unknown" : view.rules_version)},
       {"In the record since", view.created_utc.empty() ? "not recorded" : printed::day_text(view.created_utc)}},
      4,
      false};
}

Table standing(const TraineeView& view) {
  Table table{"A line for each exercise, level and input; newest first. The dashed line of a trend is the pass mark.",
              {{"Exercise", 2.3},
               {"Level", 0.75},
               {"State", 1.15},
               {"Evidence", 3.9},
               {"Tries", 0.75, true},
               {"Passed", 0.95, true},
               {"Best", 0.8, true},
               {"Last", 0.8, true},
               {"Trend", 1.6}},
              {},
              "No attempts yet."};
  for (const CurveView& curve : view.curves) {
    const Flag flag = curve.judgements.empty() ? Flag::kLearning : curve.judgements.front().flag;
    std::string why;
    for (const Judgement& j : curve.judgements)
      why += (why.empty() ? "" : "\n") + (curve.judgements.size() > 1 ? flag_words(j.flag) + ": " : std::string()) +
             dated(j.evidence) + " (n = " + std::to_string(j.n) + ", rules " + j.rule_version + ")";
    std::vector<double> scores;
    for (const CurvePoint& point : curve.points)
      if (point.score) scores.push_back(*point.score);
    if (scores.size() > kSparkPoints) scores.erase(scores.begin(), scores.end() - kSparkPoints);
    table.rows.push_back({curve.title + (curve.key.hand.empty() ? "" : "\n" + curve.key.hand), curve.key.level,
                          Cell(flag_words(flag), tone_of(flag)), why, std::to_string(curve.points.size()),
                          std::to_string(curve.passed), score_text(curve.best), score_text(curve.last),
                          Cell::drawn(spark_svg(scores, curve.pass_at))});
  }
  return table;
}

Table due_table(const TraineeView& view) {
  Table table{"", {{"Exercise", 3}, {"Level", 1}, {"Due", 2}, {"Why", 4}, {"Now", 1.5}}, {}, "Nothing is due."};
  for (const DueDate& due : view.due)
    table.rows.push_back({due.exercise, due.level, printed::day_text(due.utc), due.why,
                          due.over ? Cell("due", Tone::kBad) : Cell("not yet", Tone::kQuiet)});
  return table;
}

Table certificate_table(const TraineeView& view) {
  Table table{"",
              {{"For", 2.4},
               {"Given", 1.5},
               {"By", 1.9},
               {"Rules", 0.9},
               {"Evidence", 4},
               {"State", 2.6},
               {"Number", 2.4, false, true}},
              {},
              "None yet."};
  for (const Certificate& c : view.certificates) {
    std::string title = c.exercise_id;
    for (const CurveView& curve : view.curves)
      if (curve.key.exercise_id == c.exercise_id) title = curve.title;
    const bool holds = c.revoked_utc.empty();
    const auto shaken = view.shaken.find(c.uuid);
    const Cell held = shaken == view.shaken.end() ? Cell("holds", Tone::kGood)
                                                  : Cell("in question: " + dated(shaken->second), Tone::kBad);
    table.rows.push_back(
        {title + " " + c.level, printed::day_text(c.utc), c.printed, c.rule_version, evidence_words(c.evidence),
         holds ? held : Cell("WITHDRAWN " + printed::day_text(c.revoked_utc) + ": " + c.revoked_reason, Tone::kBad),
         c.uuid});
  }
  return table;
}

std::string curve_caption(const CurveView& curve) {
  std::string out =
      "Score (0 to 100) by attempt. Filled: passed; hollow: not passed; cross: no score. Dashed: pass mark " +
      number_text(curve.pass_at) + ". ";
  if (curve.points.size() > kPointsDrawn)
    out += "Newest " + std::to_string(kPointsDrawn) + " of " + std::to_string(curve.points.size()) + " attempts. ";
  if (curve.cohort.empty()) {
    out += "Too few others for quartiles. ";
  } else {
    int fewest = curve.cohort.front().n, most = fewest;
    for (const CohortBand& band : curve.cohort) {
      fewest = std::min(fewest, band.n);
      most = std::max(most, band.n);
    }
    out += "Shaded: quartiles and median of the cohort, n = " + span_words(fewest, most) + " trainees. ";
  }
  if (!curve.benchmark) return out + "No benchmark is set.";
  const Benchmark& b = *curve.benchmark;
  return out + "Dotted: benchmark " + number_text(b.full_at) + ", " + b.rule + " of " + b.source +
         ", n = " + std::to_string(b.n) + ", " + printed::day_text(b.utc) + ".";
}

std::string cusum_caption(const CurveView& curve) {
  return "Sequential tests by attempt. Circles: that competence is shown, at " + number_text(curve.rule.shown_at) +
         "; squares: that it is lost again, at " + number_text(curve.rule.relapse_at) +
         "; a large mark decided. Failure rates " + number_text(curve.rule.adequate) + " adequate, " +
         number_text(curve.rule.inadequate) + " inadequate.";
}

void add_curve(std::vector<Block>& out, const CurveView& curve) {
  const Competence competence = competence_of(curve.cusum);
  out.emplace_back(Heading{words_of(curve), 1, true});
  for (const Judgement& j : curve.judgements)
    out.emplace_back(Paragraph{flag_words(j.flag) + ": " + dated(j.evidence) + " (n = " + std::to_string(j.n) +
                                   ", rules " + j.rule_version + ")",
                               tone_of(j.flag), true});
  out.emplace_back(printed::Facts{
      {{"Tries", std::to_string(curve.points.size())},
       {"Graded", std::to_string(curve.graded)},
       {"Passed", std::to_string(curve.passed)},
       {"Passed in a row", std::to_string(curve.in_a_row)},
       {"Best", score_text(curve.best)},
       {"Last", score_text(curve.last)},
       {"Pass mark", number_text(curve.pass_at)},
       {"Trained", fixed_text(curve.trained_s / 60, 0) + " min"},
       {"Reliability", reliability_text(curve.reliability)},
       {"Competence", competence.shown         ? "shown"
                      : competence.first_shown ? "lost again"
                                               : "not shown yet"},
       {"Period", curve.points.empty() ? "none" : period_words(curve.points.front().utc, curve.points.back().utc)},
       {"Exercise's rules", curve.key.rubric_sha256.substr(0, 12)}},
      4,
      false});
  out.emplace_back(printed::Figures{{{curve_svg(curve), curve_caption(curve), 1}}});
  out.emplace_back(printed::Figures{{{cusum_svg(curve), cusum_caption(curve), 0.72}}});
}

void add_decisions(std::vector<Block>& out, const TraineeReportView& view) {
  if (view.decisions.empty()) return;
  Table table{"A decision stands beside the score, which stays as it was.",
              {{"Attempt", 3.4}, {"Score", 0.9, true}, {"Decision", 1.6}, {"By", 2}, {"When", 1.9}, {"Reason", 4}},
              {}};
  for (const CurveView& curve : view.trainee.curves)
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      if (const VerdictOverride* d = decision_on(view, curve.points[i].uuid))
        table.rows.push_back({words_of(curve) + ", attempt " + std::to_string(i + 1), score_text(curve.points[i].score),
                              Cell(d->passed ? "passed" : "not passed", d->passed ? Tone::kGood : Tone::kBad),
                              d->printed, moment_text(d->utc), d->reason});
  if (table.rows.empty()) return;
  out.emplace_back(Heading{"Decisions by a person", 1});
  out.emplace_back(std::move(table));
}

void add_attempts(std::vector<Block>& out, const TraineeReportView& view) {
  bool first = true;
  for (const CurveView& curve : view.trainee.curves) {
    if (first) out.emplace_back(Heading{"All attempts", 1, true});
    first = false;
    out.emplace_back(Heading{words_of(curve), 2});
    Table table{"",
                {{"No.", 0.7, true},
                 {"When (UTC)", 2.4},
                 {"Ended", 1.6},
                 {"Score", 1, true},
                 {"Result", 3.4},
                 {"Attempt", 4, false, true}},
                {}};
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CurvePoint& point = curve.points[i];
      const VerdictOverride* d = decision_on(view, point.uuid);
      const bool passed = d != nullptr ? d->passed : point.passed;
      const std::string result = d == nullptr
                                     ? result_words(point.score.has_value(), passed)
                                     : std::string(passed ? "passed" : "not passed") + " by decision of " + d->printed;
      table.rows.push_back(
          {std::to_string(i + 1), moment_text(point.utc), trocar::words_of(point.status), score_text(point.score),
           Cell(result + (point.soft_real_time ? ", soft real time" : ""), passed ? Tone::kGood : Tone::kPlain),
           point.uuid});
    }
    out.emplace_back(std::move(table));
  }
}

}  // namespace

printed::Report trainee_report(const TraineeReportView& view, const ReportSetting& setting) {
  const TraineeView& trainee = view.trainee;
  printed::Report out;
  out.kind = "Trainee report";
  out.title = trainee.name.empty() ? trainee.code : trainee.name;
  std::string groups;
  for (const std::string& group : trainee.groups) groups += (groups.empty() ? "" : ", ") + group;
  out.subtitle = "Trainee " + trainee.code + ", " + (groups.empty() ? "in no group" : "group " + groups);
  out.who = out.title == trainee.code ? trainee.code : out.title + " (" + trainee.code + ")";
  out.newest_utc = newest_entry(view, setting.notes);
  out.mark = mark_of(setting);
  out.blocks = {overview(trainee),          Heading{"Where things stand", 1}, standing(trainee),
                Heading{"Certificates", 1}, certificate_table(trainee),       Heading{"Due", 1},
                due_table(trainee)};
  if (!trainee.minutes_by_week.empty()) {
    out.blocks.emplace_back(Heading{"Time trained", 1});
    out.blocks.emplace_back(
        printed::Figures{{{weeks_svg(trainee.minutes_by_week),
                           "Minutes a week on the exercises' clocks; weeks begin on Monday.", 0.6}}});
  }
  add_decisions(out.blocks, view);
  if (setting.notes) note_blocks(out.blocks, trainee.notes);
  for (const CurveView& curve : trainee.curves) add_curve(out.blocks, curve);
  add_attempts(out.blocks, view);
  append(out.blocks, report_terms(TermsOf::kTrainee, setting.rules));
  return out;
}

}  // namespace trocar::review
