#include "app/cli/sweep/validity_page.h"

#include <algorithm>
#include <array>
#include <map>

#include "app/cli/sweep/validity_plots.h"
#include "trainees/markup/html.h"

namespace trocar {
namespace {

using printed::Column;
using printed::Facts;
using printed::Heading;
using printed::Paragraph;
using printed::Table;
using printed::Tone;
using Report = printed::Report;

constexpr std::size_t kShownHash = 12;

/// What no sweep can show, on every report.
constexpr std::array kNotShown{
    "No human has been measured. Every attempt here is a script's, on a simulated arm.",
    "The hands were written by those who wrote the rubrics: that they are ordered shows that the rubrics keep an order "
    "that "
    "was put in, not that people with more skill score higher.",
    "Correlation and reliability hold for persons spread evenly from novice to expert; a group whose skill is alike "
    "gets less "
    "of both.",
    "Nothing here tells whether training on the simulator makes anybody better in an operating room.",
    "An anchor or bar that is met here is provisional until experts and trainees have been measured."};

Tone tone_of(const ValidityCheck& check) {
  return !check.not_asked.empty() ? Tone::kQuiet : check.met ? Tone::kGood : Tone::kBad;
}

std::string verdict_words(const ValidityCheck& check) {
  return !check.not_asked.empty() ? "n/a" : check.met ? "met" : "NOT MET";
}

std::string joined_words(const std::vector<std::string>& words, const char* none) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : "; ") + word;
  return all.empty() ? none : all;
}

/// Outcomes by hand, those whose order is asked first.
std::vector<std::pair<std::string, HandOutcomes>> ordered_outcomes(const std::vector<ScoredAttempt>& attempts) {
  const std::map<std::string, HandOutcomes> outcomes = outcomes_by_hand(attempts);
  std::vector<std::pair<std::string, HandOutcomes>> ordered;
  for (const char* hand : {"expert", "intermediate", "novice"}) {
    if (const auto found = outcomes.find(hand); found != outcomes.end()) ordered.push_back(*found);
  }
  const std::size_t skilled = ordered.size();
  for (const auto& one : outcomes) {
    const auto end = ordered.begin() + static_cast<std::ptrdiff_t>(skilled);
    if (std::find_if(ordered.begin(), end, [&](const auto& other) { return other.first == one.first; }) == end)
      ordered.push_back(one);
  }
  return ordered;
}

int unmet(const CellValidity& found) {
  return static_cast<int>(
      std::count_if(found.checks.begin(), found.checks.end(), [](const ValidityCheck& check) { return !check.met; }));
}

Table overview(const std::vector<ReportedCell>& cells) {
  Table table{.caption = "Exercises and levels. The bars are those of docs/scoring.md.",
              .columns = {{"exercise, level", 3},
                          {"checks", 1.2},
                          {"attempts", 1, true},
                          {"expert", 1.2, true},
                          {"intermediate", 1.4, true},
                          {"novice", 1.2, true},
                          {"r(skill)", 0.8, true},
                          {"ICC(2,1)", 0.9, true},
                          {"SEM", 0.6, true}}};
  for (const ReportedCell& cell : cells) {
    const std::map<std::string, HandOutcomes> outcomes = outcomes_by_hand(cell.attempts);
    const auto mean = [&](const char* hand) {
      const auto found = outcomes.find(hand);
      if (found == outcomes.end() || found->second.scores.empty()) return std::string("-");
      const GroupSummary s = summarise(found->second.scores);
      return fixed_text(s.mean, 1) + " \xC2\xB1 " + fixed_text(s.sd, 1);
    };
    const std::optional<PopulationValidity>& people = cell.found.population;
    const int failed = unmet(cell.found);
    table.rows.push_back(
        {cell.title,
         {failed == 0 ? "all met" : std::to_string(failed) + " NOT MET", failed == 0 ? Tone::kGood : Tone::kBad},
         std::to_string(cell.attempts.size()),
         mean("expert"),
         mean("intermediate"),
         mean("novice"),
         people ? fixed_text(people->one_attempt, 2) : std::string("-"),
         people && people->icc ? fixed_text(*people->icc, 2) : std::string("-"),
         people && people->components ? fixed_text(people->components->standard_error(), 1) : std::string("-")});
  }
  return table;
}

Table hands_table(const std::vector<ScoredAttempt>& attempts) {
  Table table{.caption = "By hand. An attempt without a number ended in a fault or was void.",
              .columns = {{"hand", 1.4},
                          {"attempts", 0.8, true},
                          {"mean", 0.8, true},
                          {"SD", 0.7, true},
                          {"lowest", 0.8, true},
                          {"highest", 0.8, true},
                          {"passed", 0.8, true},
                          {"at 100", 0.7, true},
                          {"no number", 0.9, true}}};
  for (const auto& [hand, of] : ordered_outcomes(attempts)) {
    const GroupSummary s = summarise(of.scores);
    const auto full =
        std::count_if(of.scores.begin(), of.scores.end(), [](double score) { return score >= 100 - 1e-9; });
    table.rows.push_back({hand, std::to_string(s.count + of.without_score), fixed_text(s.mean, 1), fixed_text(s.sd, 1),
                          fixed_text(s.lowest, 1), fixed_text(s.highest, 1), std::to_string(of.passes),
                          std::to_string(full), std::to_string(of.without_score)});
  }
  return table;
}

Table checks_table(const CellValidity& found) {
  Table table{.caption = "Checks", .columns = {{"check", 3}, {"value", 1, true}, {"bar", 1}, {"", 1}}};
  for (const ValidityCheck& check : found.checks) {
    const bool asked = check.not_asked.empty();
    table.rows.push_back({asked ? check.name : check.name + ": " + check.not_asked,
                          asked ? fixed_text(check.value, 2) : "",
                          check.bar,
                          {verdict_words(check), tone_of(check)}});
  }
  return table;
}

Table weights_table(const std::vector<WeightTrial>& weights) {
  Table table{.caption =
                  "Sensitivity: each weight halved, and half as much again, the others scaled. Delta is Cliff's, of "
                  "expert and novice.",
              .columns = {{"sub-score", 1.5},
                          {"weight", 0.7, true},
                          {"delta by it alone", 1, true},
                          {"delta without it", 1, true},
                          {"decisions changed", 1.3},
                          {"checks lost", 2}}};
  for (const WeightTrial& trial : weights)
    table.rows.push_back(
        {trial.subscore, fixed_text(trial.weight, 2), fixed_text(trial.alone_delta, 2),
         fixed_text(trial.without_delta, 2),
         fixed_text(100 * trial.less_changes, 1) + " %, " + fixed_text(100 * trial.more_changes, 1) + " %",
         joined_words(trial.lost, "none")});
  return table;
}

Table bad_scorers_table(const std::vector<BadScorer>& scorers) {
  Table table{.caption = "Scorers that are known to be bad, and the checks that hold for the rubric and fail for them",
              .columns = {{"scorer", 2}, {"", 1}, {"noticed by", 4}}};
  for (const BadScorer& bad : scorers)
    table.rows.push_back({bad.name,
                          {bad.lost.empty() ? "NOT NOTICED" : "noticed", bad.lost.empty() ? Tone::kBad : Tone::kGood},
                          joined_words(bad.lost, "")});
  return table;
}

Table classes_table(const LeftOut& by_subscores) {
  Table table{.caption = "Each attempt guessed from the sub-scores of all others: taken for",
              .columns = {{"hand", 1.4}, {"expert", 1, true}, {"intermediate", 1, true}, {"novice", 1, true}}};
  for (const auto& [hand, taken] : by_subscores.taken_for) {
    const auto times = [&taken = taken](const char* other) {
      const auto found = taken.find(other);
      return std::to_string(found == taken.end() ? 0 : found->second);
    };
    table.rows.push_back({hand, times("expert"), times("intermediate"), times("novice")});
  }
  return table;
}

Table components_table(const PopulationValidity& people) {
  const VarianceComponents& found = *people.components;
  const bool own_boards = people.design[1] == 1;
  Table table{.caption = std::to_string(people.design[0]) + " persons x " +
                         (own_boards ? "" : std::to_string(people.design[1]) + " boards x ") +
                         std::to_string(people.design[2]) + " attempts" +
                         (own_boards ? ", each on a board of its own" : ""),
              .columns = {{"source", 3}, {"variance", 1, true}, {"share", 1, true}}};
  const double total = found.total();
  for (std::size_t facets = 1; facets < kFacetSets; ++facets) {
    if (found.mean_square[facets] == 0 && found.estimate[facets] == 0) continue;
    const std::string note =
        found.estimate[facets] < 0 ? ": estimate " + fixed_text(found.estimate[facets], 2) + ", set to 0" : "";
    table.rows.push_back({facet_words(facets) + note, fixed_text(found.variance(facets), 2),
                          total > 0 ? fixed_text(100 * found.variance(facets) / total, 1) + " %" : std::string("-")});
  }
  return table;
}

Facts population_facts(const PopulationValidity& people) {
  Facts facts;
  facts.pairs = {{"Persons, attempts", std::to_string(people.persons) + ", " + std::to_string(people.attempts)},
                 {"Correlation of skill and one score",
                  fixed_text(people.one_attempt, 2) + " (95 %: " + fixed_text(people.one_attempt_interval.first, 2) +
                      " to " + fixed_text(people.one_attempt_interval.second, 2) + ")"},
                 {"The same of ranks", fixed_text(people.ranks, 2)},
                 {"With a person's mean score", fixed_text(people.person_mean, 2)},
                 {"Without a number, counted as 0", std::to_string(people.without_number)}};
  if (people.icc)
    facts.pairs.emplace_back("ICC(2,1), " + std::to_string(people.retests) + " attempts", fixed_text(*people.icc, 2));
  if (people.incomplete > 0)
    facts.pairs.emplace_back("Persons with attempts missing, left out", std::to_string(people.incomplete));
  if (people.components) {
    facts.pairs.emplace_back("Standard error of one attempt",
                             fixed_text(people.components->standard_error(), 1) + " points");
    facts.pairs.emplace_back("Dependability of 1, 3, 5 attempts",
                             fixed_text(people.components->dependability(1), 2) + ", " +
                                 fixed_text(people.components->dependability(3), 2) + ", " +
                                 fixed_text(people.components->dependability(5), 2));
    facts.pairs.emplace_back("Attempts for 0.8", std::to_string(people.components->attempts_for(0.8)));
  }
  return facts;
}

void add_population(Report& report, const ReportedCell& cell) {
  const PopulationValidity& people = *cell.found.population;
  report.blocks.push_back(Heading{"A drawn population", 2, true});
  std::vector<std::pair<double, double>> points;
  for (const ScoredAttempt& attempt : cell.attempts) {
    if (attempt.skill) points.emplace_back(*attempt.skill, attempt.grade.score.value_or(0));
  }
  report.blocks.push_back(printed::Figures{
      {{skill_scores_svg(points, cell.rubric.pass_at), "Score of each attempt over latent skill", 0.8}}});
  report.blocks.push_back(population_facts(people));
  if (people.components) report.blocks.push_back(components_table(people));
}

void add_hands(Report& report, const ReportedCell& cell) {
  std::vector<HandScores> hands;
  for (const auto& [hand, of] : ordered_outcomes(cell.attempts)) hands.push_back({hand, of.scores});
  if (hands.empty()) return;
  report.blocks.push_back(
      printed::Figures{{{hand_scores_svg(hands, cell.rubric.pass_at), "Scores by hand, one dot an attempt", 0.8}}});
  report.blocks.push_back(hands_table(cell.attempts));
}

void add_cell(Report& report, const ReportedCell& cell) {
  report.blocks.push_back(Heading{cell.title, 1, true});
  report.blocks.push_back(Paragraph{"Rubric of version " + cell.exercise_version + ", ruleset " +
                                        cell.rubric_sha256.substr(0, kShownHash) + ", organ " + cell.key.organ + " (" +
                                        cell.key.tissue + ")",
                                    Tone::kQuiet});
  add_hands(report, cell);
  report.blocks.push_back(checks_table(cell.found));
  if (cell.found.by_subscores) {
    report.blocks.push_back(classes_table(*cell.found.by_subscores));
    report.blocks.push_back(Paragraph{"By the score alone " + fixed_text(100 * cell.found.by_score->share(), 1) +
                                      " % are taken for what they are, by the sub-scores " +
                                      fixed_text(100 * cell.found.by_subscores->share(), 1) + " %."});
  }
  if (cell.found.population) add_population(report, cell);
  if (!cell.found.weights.empty()) report.blocks.push_back(weights_table(cell.found.weights));
  if (!cell.found.bad_scorers.empty()) report.blocks.push_back(bad_scorers_table(cell.found.bad_scorers));
}

}  // namespace

Report validity_report(const std::vector<ReportedCell>& cells, const std::string& program) {
  Report report;
  report.kind = "Validity report";
  report.title = "Does the score tell skill apart?";
  report.who = "scripted hands on simulated arms";
  report.subtitle = "Scripted hands on simulated arms, Trocar " + program + ".";
  report.blocks.push_back(Heading{"What this does not show"});
  for (const char* words : kNotShown) report.blocks.push_back(Paragraph{words, Tone::kPlain, true});
  report.blocks.push_back(Heading{"Overview"});
  report.blocks.push_back(overview(cells));
  report.blocks.push_back(Paragraph{
      "r(skill): correlation of latent skill and the score of one attempt in a drawn population. ICC(2,1): agreement "
      "of attempts on different boards (Shrout and Fleiss 1979). SEM: standard error of one attempt's score, points, "
      "from the variance components of persons, boards and attempts; negative estimates are set to 0 and said.",
      Tone::kQuiet});
  for (const ReportedCell& cell : cells) add_cell(report, cell);
  return report;
}

}  // namespace trocar
