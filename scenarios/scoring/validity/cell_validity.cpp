#include "scenarios/scoring/validity/cell_validity.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace trocar {
namespace {

constexpr std::array kGroups{"expert", "intermediate", "novice"};
constexpr int kLeastOfGroup = 3, kLeastPersons = 3;

using Place = std::pair<std::int64_t, std::int64_t>;  // seed, board

struct Person {
  double skill = 0;
  std::map<Place, double> scores;
};

ValidityCheck at_least(const std::string& name, double value, double bar) {
  char text[32];
  std::snprintf(text, sizeof text, ">= %g", bar);
  return {name, value, text, value >= bar, ""};
}

ValidityCheck not_asked(const std::string& name, const std::string& why) { return {name, 0, "", true, why}; }

double earned(const ScoredAttempt& attempt) { return attempt.grade.score.value_or(0); }

std::map<std::string, Person> persons_of(const std::vector<ScoredAttempt>& attempts) {
  std::map<std::string, Person> persons;
  for (const ScoredAttempt& attempt : attempts) {
    if (!attempt.skill) continue;
    Person& person = persons[attempt.hand];
    person.skill = *attempt.skill;
    person.scores[{attempt.seed, attempt.board}] = earned(attempt);
  }
  return persons;
}

/// Attempts with a seed and a board that no other of them has; all where that leaves a single one.
std::vector<Place> retests_among(const std::set<Place>& places) {
  std::set<std::int64_t> seeds, boards;
  std::vector<Place> apart;
  for (const Place& place : places) {
    if (seeds.count(place.first) != 0 || boards.count(place.second) != 0) continue;
    seeds.insert(place.first);
    boards.insert(place.second);
    apart.push_back(place);
  }
  return apart.size() > 1 ? apart : std::vector<Place>(places.begin(), places.end());
}

void add_reliability(PopulationValidity& out, const std::map<std::string, Person>& persons) {
  std::set<Place> places;
  for (const auto& [name, person] : persons) {
    for (const auto& [place, score] : person.scores) places.insert(place);
  }
  std::vector<const Person*> complete;
  for (const auto& [name, person] : persons) {
    if (person.scores.size() == places.size()) complete.push_back(&person);
  }
  out.incomplete = static_cast<int>(persons.size() - complete.size());
  if (complete.size() < 2 || places.size() < 2) return;

  const std::vector<Place> retests = retests_among(places);
  std::vector<std::vector<double>> table;
  for (const Person* person : complete) {
    table.emplace_back();
    for (const Place& place : retests) table.back().push_back(person->scores.at(place));
  }
  out.retests = static_cast<int>(retests.size());
  out.icc = icc_agreement(table);

  std::set<std::int64_t> seeds, boards;
  for (const Place& place : places) {
    seeds.insert(place.first);
    boards.insert(place.second);
  }
  // Where each seed has a board of its own the two cannot be told apart: the attempt carries both.
  const bool crossed = places.size() == seeds.size() * boards.size();
  out.design = {complete.size(), crossed ? boards.size() : 1, crossed ? seeds.size() : places.size()};
  ScoreCube cube(out.design[0], out.design[1], out.design[2]);
  for (std::size_t p = 0; p < complete.size(); ++p) {
    std::size_t i = 0;
    for (const auto& [place, score] : complete[p]->scores) {  // by seed, then by board
      cube.at(p, i % out.design[1], i / out.design[1]) = score;
      ++i;
    }
  }
  out.components = variance_components(cube);
}

void classify(CellValidity& cell, const std::vector<ScoredAttempt>& attempts) {
  std::vector<GroupedPoint> subscores, scores;
  std::map<std::string, int> counts;
  for (const ScoredAttempt& attempt : attempts) {
    if (!attempt.grade.score || std::find(kGroups.begin(), kGroups.end(), attempt.hand) == kGroups.end()) continue;
    ++counts[attempt.hand];
    scores.push_back({attempt.hand, {*attempt.grade.score}});
    subscores.push_back({attempt.hand, {}});
    for (const Subscore& subscore : attempt.grade.subscores) subscores.back().values.push_back(subscore.value);
  }
  const std::string name = "three hands told apart, each left out";
  for (const char* group : kGroups) {
    if (counts[group] >= kLeastOfGroup) continue;
    cell.checks.push_back(not_asked(name, "needs three attempts with a number of each"));
    return;
  }
  cell.by_subscores = leave_one_out(subscores);
  cell.by_score = leave_one_out(scores);
  cell.checks.push_back(at_least(name, cell.by_subscores->share(), ValidityBars().left_out_share));
}

void check_population(CellValidity& cell) {
  const PopulationValidity& found = *cell.population;
  const ValidityBars bars;
  cell.checks.push_back(at_least("correlation of skill and score", found.one_attempt, bars.skill_correlation));
  if (found.icc)
    cell.checks.push_back(at_least("test-retest ICC(2,1)", *found.icc, bars.retest_icc));
  else
    cell.checks.push_back(not_asked("test-retest ICC(2,1)", "needs two attempts of a person"));
}

void check_bad_scorers(CellValidity& cell) {
  for (const BadScorer& bad : cell.bad_scorers) {
    const int found = static_cast<int>(bad.lost.size());
    cell.checks.push_back(at_least("checks that notice: " + bad.name, found, 1));
  }
}

}  // namespace

std::optional<PopulationValidity> population_validity(const std::vector<ScoredAttempt>& attempts) {
  const std::map<std::string, Person> persons = persons_of(attempts);
  if (static_cast<int>(persons.size()) < kLeastPersons) return std::nullopt;
  PopulationValidity out;
  out.persons = static_cast<int>(persons.size());
  std::vector<double> skills, scores, person_skills, person_means;
  for (const ScoredAttempt& attempt : attempts) {
    if (!attempt.skill) continue;
    skills.push_back(*attempt.skill);
    scores.push_back(earned(attempt));
    out.without_number += attempt.grade.score ? 0 : 1;
  }
  out.attempts = static_cast<int>(scores.size());
  for (const auto& [name, person] : persons) {
    double sum = 0;
    for (const auto& [place, score] : person.scores) sum += score;
    person_skills.push_back(person.skill);
    person_means.push_back(sum / static_cast<double>(person.scores.size()));
  }
  out.one_attempt = correlation(skills, scores);
  out.one_attempt_interval = correlation_interval(out.one_attempt, persons.size());
  out.ranks = rank_correlation(skills, scores);
  out.person_mean = correlation(person_skills, person_means);
  add_reliability(out, persons);
  return out;
}

CellValidity cell_validity(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                           const ValidityScope& scope) {
  CellValidity cell;
  cell.checks = check_attempts(attempts, rubric, scope, [&](const Grade& grade) { return regrade(grade, rubric); });
  const std::map<std::string, HandOutcomes> outcomes = outcomes_by_hand(attempts);
  const auto has = [&](const char* hand) { return outcomes.count(hand) != 0; };
  if (has("expert") && has("intermediate") && has("novice")) classify(cell, attempts);
  cell.population = population_validity(attempts);
  if (cell.population) check_population(cell);
  if (has("expert") && has("novice")) {
    cell.weights = try_weights(attempts, rubric, scope);
    cell.bad_scorers = try_bad_scorers(attempts, rubric, scope);
    check_bad_scorers(cell);
  }
  return cell;
}

}  // namespace trocar
