// A cohort: who stands where and why, the spread of scores, benchmarks, and what was not counted.
#include <algorithm>
#include <map>
#include <set>

#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/reports/report_words.h"
#include "trainees/markup/html.h"
#include "trainees/progress/cohort_bands.h"

namespace trocar::review {
namespace {

using printed::Block;
using printed::Cell;
using printed::Heading;
using printed::Table;
using printed::Tone;

constexpr std::size_t kBandsInFigure = 14;

/// What may be compared: exercise, level, input and rules.
using SkillKey = std::tuple<std::string, std::string, std::string, std::string>;
using Skills = std::map<SkillKey, std::vector<const CohortEntry*>>;

std::string shown_name(const CohortEntry& line) { return line.name.empty() ? line.code : line.name; }

Skills skills_of(const std::vector<CohortEntry>& lines) {
  Skills out;
  for (const CohortEntry& line : lines)
    if (line.state() != Flag::kNotStarted)
      out[{line.exercise, line.level, line.hand, line.rubric_sha256}].push_back(&line);
  return out;
}

/// Rules are named only where an exercise at that level and input was graded by several.
std::string skill_words(const Skills& skills, const SkillKey& key) {
  const auto& [exercise, level, hand, rubric] = key;
  const auto alike = std::count_if(skills.begin(), skills.end(), [&](const auto& other) {
    return std::get<0>(other.first) == exercise && std::get<1>(other.first) == level &&
           std::get<2>(other.first) == hand;
  });
  return curve_words(exercise, level, hand) + (alike > 1 ? ", rules " + rubric.substr(0, 6) : "");
}

const Benchmark* benchmark_for(const CohortReportView& view, const CohortEntry& line) {
  for (const Benchmark& b : view.benchmarks)
    if (b.exercise_id == line.exercise_id && b.level == line.level && b.metric == "score") return &b;
  return nullptr;
}

Block overview(const CohortReportView& view, const std::vector<CohortEntry>& lines) {
  std::set<std::string> who;
  int tries = 0, graded = 0, passes = 0;
  std::string last_seen;
  for (const CohortEntry& line : lines) {
    if (line.state() == Flag::kNotStarted) continue;
    who.insert(line.code);
    tries += line.tries;
    graded += line.graded;
    passes += line.passes;
    last_seen = std::max(last_seen, line.last_utc);
  }
  const CohortQuestion& asked = view.cohort.asked;
  std::string only;
  for (const std::string& part : {asked.exercise_id, asked.level, asked.state})
    only += part.empty() ? "" : (only.empty() ? "" : ", ") + part;
  return printed::Facts{
      {{"Trainees with attempts", std::to_string(who.size())},
       {"Tries", std::to_string(tries)},
       {"Graded", std::to_string(graded)},
       {"Passed", std::to_string(passes)},
       {"Group", asked.group.empty() ? "all" : asked.group},
       {"Only", only.empty() ? "everything" : only},
       {"Last seen", last_seen.empty() ? "nobody yet" : printed::day_text(last_seen)},
       {"Rules of progress", "version " + (view.cohort.rules_version.empty() ? "unknown" : view.cohort.rules_version)}},
      4,
      false};
}

Table states(const CohortReportView& view) {
  Table table{"A trainee stands in every state that one of the lines below has.",
              {{"State", 1.5}, {"Trainees", 1, true}, {"Who", 8}},
              {}};
  for (const Flag flag : {Flag::kUnsafe, Flag::kRelapsed, Flag::kInQuestion, Flag::kStuck, Flag::kIntegrity,
                          Flag::kPlateau, Flag::kRetentionDue, Flag::kReady, Flag::kCertified, Flag::kNotStarted}) {
    const auto who = trainees_in_state(view.cohort, flag);
    std::string names;
    for (const CohortEntry* line : who) names += (names.empty() ? "" : ", ") + shown_name(*line);
    table.rows.push_back(
        {Cell(flag_words(flag), who.empty() ? Tone::kQuiet : tone_of(flag)), std::to_string(who.size()), names});
  }
  return table;
}

Table trainee_table(const std::vector<CohortEntry>& lines) {
  Table table{
      "A line for each trainee, exercise, level and input, gravest first. n: attempts that the evidence rests on. Peak "
      "force and over "
      "force: see the terms.",
      {{"Trainee", 2.1},
       {"Exercise", 2},
       {"State and evidence", 4},
       {"Passed, tries", 1, true},
       {"Best", 0.75, true},
       {"Last", 0.75, true},
       {"Trend", 1.55},
       {"Peak N", 0.7, true},
       {"Over", 0.7, true},
       {"Reliability", 0.9, true},
       {"Last seen", 1.25}},
      {},
      "Nobody has an attempt here yet."};
  for (const CohortEntry& line : lines) {
    const Judgement* j = line.judgements.empty() ? nullptr : &line.judgements.front();
    std::string state = flag_words(line.state());
    for (std::size_t i = 1; i < line.judgements.size(); ++i) state += ", " + flag_words(line.judgements[i].flag);
    if (j != nullptr && !j->evidence.empty())
      state += "\n" + dated(j->evidence) + " (n = " + std::to_string(j->n) + ")";
    table.rows.push_back(
        {shown_name(line) + (line.name.empty() ? "" : "\n" + line.code),
         line.hand.empty() ? line.exercise : curve_words(line.exercise, line.level, line.hand),
         Cell(state, tone_of(line.state())), std::to_string(line.passes) + " / " + std::to_string(line.tries),
         score_text(line.best), score_text(line.last), Cell::drawn(spark_svg(line.scores, line.pass_at)),
         line.peak_force_n ? fixed_text(*line.peak_force_n, 1) : "\xE2\x80\x93",
         Cell(std::to_string(line.over_force), line.over_force > 0 ? Tone::kBad : Tone::kPlain),
         line.reliability ? reliability_words(*line.reliability) : "\xE2\x80\x93", printed::day_text(line.last_utc)});
  }
  return table;
}

std::string quartile_words(const std::vector<double>& values) {
  if (static_cast<int>(values.size()) < kLeastForCohort) return "fewer than " + std::to_string(kLeastForCohort);
  const auto q = quartiles(values);
  return q ? fixed_text(q->low, 1) + " / " + fixed_text(q->median, 1) + " / " + fixed_text(q->high, 1) : "";
}

void add_spread(std::vector<Block>& out, const CohortReportView& view, const Skills& skills) {
  Table table{"Quartiles over trainees: lower / median / upper, points of 100. n: trainees with a score.",
              {{"Exercise, level, input", 3.4},
               {"n", 0.5, true},
               {"Newest score", 2, true},
               {"Best score", 2, true},
               {"Graded", 0.9, true},
               {"Passed", 0.9, true},
               {"Pass mark", 0.8, true},
               {"Benchmark", 1.2, true}},
              {},
              "No scores yet."};
  std::vector<ScoreBand> bands;
  for (const auto& [key, lines] : skills) {
    ScoreBand band{skill_words(skills, key), {}, lines.front()->pass_at, {}};
    std::vector<double> best;
    int graded = 0, passes = 0;
    for (const CohortEntry* line : lines) {
      if (line->last) band.scores.push_back(*line->last);
      if (line->best) best.push_back(*line->best);
      graded += line->graded;
      passes += line->passes;
    }
    const Benchmark* benchmark = benchmark_for(view, *lines.front());
    if (benchmark != nullptr) band.benchmark = benchmark->full_at;
    table.rows.push_back({band.title, std::to_string(band.scores.size()), quartile_words(band.scores),
                          quartile_words(best), std::to_string(graded), std::to_string(passes),
                          number_text(band.pass_at), benchmark == nullptr ? "none" : number_text(benchmark->full_at)});
    if (!band.scores.empty()) bands.push_back(std::move(band));
  }
  out.emplace_back(Heading{"Spread of scores", 1});
  for (std::size_t from = 0; from < bands.size(); from += kBandsInFigure) {
    const std::vector<ScoreBand> part(
        bands.begin() + static_cast<std::ptrdiff_t>(from),
        bands.begin() + static_cast<std::ptrdiff_t>(std::min(bands.size(), from + kBandsInFigure)));
    out.emplace_back(
        printed::Figures{{{score_bands_svg(part),
                           "Dots: trainees. Shaded: quartiles with the median, from three trainees on. Dashed: "
                           "pass mark. Dotted: benchmark.",
                           0.9}}});
  }
  out.emplace_back(std::move(table));
}

Table benchmark_table(const CohortReportView& view) {
  Table table{"",
              {{"Exercise", 2.2},
               {"Level", 0.7},
               {"Metric", 1.5},
               {"Full marks at", 1.2, true},
               {"Rule", 2.2},
               {"Of whom", 2.4},
               {"n", 0.5, true},
               {"Set", 1.4}},
              {},
              "None is set."};
  const std::map<std::string, std::string> titles(view.cohort.exercises.begin(), view.cohort.exercises.end());
  for (const Benchmark& b : view.benchmarks) {
    const auto title = titles.find(b.exercise_id);
    table.rows.push_back({title == titles.end() ? b.exercise_id : title->second, b.level, b.metric,
                          number_text(b.full_at), b.rule, b.source, std::to_string(b.n), printed::day_text(b.utc)});
  }
  return table;
}

Table exclusion_table(const CohortReportView& view) {
  Table table{"Attempts of the group that no score above holds, and those that count with a doubt.",
              {{"What", 6}, {"Attempts", 1, true}, {"Trainees", 1, true}},
              {}};
  for (const Exclusion& e : view.exclusions)
    table.rows.push_back({e.words, std::to_string(e.attempts), std::to_string(e.trainees)});
  return table;
}

/// Of those who have a line.
Table certificate_table(const CohortReportView& view, const std::vector<CohortEntry>& lines) {
  Table table{"",
              {{"Trainee", 2}, {"For", 2.6}, {"Given", 1.3}, {"By", 2}, {"Rules", 0.8}, {"State", 3.4}},
              {},
              "None was given."};
  for (const Certificate& c : view.certificates) {
    const auto line = std::find_if(lines.begin(), lines.end(), [&](const CohortEntry& l) {
      return l.code == c.trainee && l.exercise_id == c.exercise_id && l.level == c.level;
    });
    if (line == lines.end()) continue;
    table.rows.push_back(
        {shown_name(*line), line->exercise + " " + c.level, printed::day_text(c.utc), c.printed, c.rule_version,
         view.shaken.contains(c.uuid) ? Cell("in question: " + dated(view.shaken.at(c.uuid)), Tone::kBad)
         : c.revoked_utc.empty()
             ? Cell("holds", Tone::kGood)
             : Cell("WITHDRAWN " + printed::day_text(c.revoked_utc) + ": " + c.revoked_reason, Tone::kBad)});
  }
  return table;
}

}  // namespace

printed::Report cohort_report(const CohortReportView& view, const ReportSetting& setting) {
  const std::vector<CohortEntry> lines = selected_lines(view.cohort);
  printed::Report out;
  out.kind = "Cohort report";
  out.title = view.cohort.asked.group.empty() ? "Cohort" : "Cohort " + view.cohort.asked.group;
  std::set<std::string> tried;
  for (const CohortEntry& line : view.cohort.lines)
    if (line.state() != Flag::kNotStarted) tried.insert(line.code);
  out.subtitle = plural(static_cast<std::int64_t>(tried.size()), "trainee", "trainees") +
                 " with attempts, rules version " + view.cohort.rules_version;
  out.who = view.cohort.asked.group.empty() ? "all groups" : "group " + view.cohort.asked.group;
  for (const CohortEntry& line : view.cohort.lines) out.newest_utc = std::max(out.newest_utc, line.last_utc);
  for (const Certificate& c : view.certificates) out.newest_utc = std::max({out.newest_utc, c.utc, c.revoked_utc});
  out.mark = mark_of(setting);
  out.blocks = {overview(view, lines),
                Heading{"Who needs attention, who is ready", 1},
                states(view),
                Heading{"Trainees", 1},
                trainee_table(lines),
                Heading{"Certificates", 1},
                certificate_table(view, lines)};
  add_spread(out.blocks, view, skills_of(lines));
  out.blocks.emplace_back(Heading{"Benchmarks", 1});
  out.blocks.emplace_back(benchmark_table(view));
  out.blocks.emplace_back(Heading{"What is not counted", 1});
  out.blocks.emplace_back(exclusion_table(view));
  append(out.blocks, report_terms(TermsOf::kCohort, setting.rules));
  return out;
}

}  // namespace trocar::review
