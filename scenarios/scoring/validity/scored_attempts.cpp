#include "scenarios/scoring/validity/scored_attempts.h"

#include <algorithm>
#include <cstdio>

#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/score.h"

namespace trocar {
namespace {

constexpr double kLessWeight = 0.5, kMoreWeight = 1.5;
constexpr double kFullSubscore = 1 - 1e-9, kRounding = 1e-9;

bool is_expert(const ScoredAttempt& attempt) { return attempt.hand == "expert"; }

bool is_time(const SubscoreRule& rule) {
  const MetricDefinition* metric = find_metric(rule.metric);
  return metric && metric->unit == "s";
}

/// Experts whose time earns all that it can: where many do, the score cannot tell them apart by it.
ValidityCheck check_head_room(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric) {
  const double bar = ValidityBars().expert_best_time_share;
  char bar_text[32];
  std::snprintf(bar_text, sizeof bar_text, "<= %g", bar);
  ValidityCheck check;
  check.name = "expert at the best time";
  check.bar = bar_text;
  int experts = 0, best = 0;
  for (const ScoredAttempt& attempt : attempts) {
    if (!is_expert(attempt) || attempt.grade.subscores.size() != rubric.subscores.size()) continue;
    ++experts;
    for (std::size_t k = 0; k < rubric.subscores.size(); ++k)
      best += is_time(rubric.subscores[k]) && attempt.grade.subscores[k].value >= kFullSubscore ? 1 : 0;
  }
  const auto times = std::count_if(rubric.subscores.begin(), rubric.subscores.end(), is_time);
  if (times == 0 || experts == 0) {
    check.met = true;
    check.not_asked = times == 0 ? "no sub-score is a time" : "no expert has a number";
    return check;
  }
  check.value = static_cast<double>(best) / (static_cast<double>(times) * experts);
  check.met = check.value <= bar;
  return check;
}

Grade with_critical_event(Grade grade) {
  for (Metric& metric : grade.metrics) {
    if (metric.name == "critical_events") metric.value = 1;
  }
  return grade;
}

Grade with_half_undone(Grade grade) {
  grade.caps = {{.kind = CapKind::kUnfinished, .done = 1, .total = 2}};
  return grade;
}

/// The most that a scorer gives an expert whose finished attempts are spoilt.
ValidityCheck check_spoilt(const std::vector<ScoredAttempt>& attempts, const Scorer& scorer, const std::string& name,
                           double bar, Grade (*spoil)(Grade)) {
  char bar_text[32];
  std::snprintf(bar_text, sizeof bar_text, "<= %g", bar);
  ValidityCheck check{"expert " + name + ", highest", 0, bar_text, true, ""};
  for (const ScoredAttempt& attempt : attempts) {
    if (is_expert(attempt) && attempt.grade.score)
      check.value = std::max(check.value, scorer(spoil(attempt.grade)).score.value_or(0));
  }
  check.met = check.value <= bar + kRounding;
  return check;
}

Scorer scorer_of(const Rubric& rubric) {
  return [&rubric](const Grade& grade) { return regrade(grade, rubric); };
}

std::vector<ScoredAttempt> regraded(std::vector<ScoredAttempt> attempts, const Scorer& scorer) {
  for (ScoredAttempt& attempt : attempts) attempt.grade = scorer(attempt.grade);
  return attempts;
}

/// Names of the checks that hold before and no longer after.
std::vector<std::string> lost_checks(const std::vector<ValidityCheck>& before,
                                     const std::vector<ValidityCheck>& after) {
  std::vector<std::string> names;
  for (const ValidityCheck& check : after) {
    const auto same = std::find_if(before.begin(), before.end(),
                                   [&](const ValidityCheck& other) { return other.name == check.name; });
    if (!check.met && same != before.end() && same->met) names.push_back(check.name);
  }
  return names;
}

Rubric reweighted(Rubric rubric, std::size_t which, double factor) {
  rubric.subscores[which].weight *= factor;
  double sum = 0;
  for (const SubscoreRule& rule : rubric.subscores) sum += rule.weight;
  if (sum > 0) {
    for (SubscoreRule& rule : rubric.subscores) rule.weight /= sum;
  }
  return rubric;
}

double changed_decisions(const std::vector<ScoredAttempt>& before, const std::vector<ScoredAttempt>& after) {
  int changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changed += before[i].grade.passed != after[i].grade.passed ? 1 : 0;
  return before.empty() ? 0 : static_cast<double>(changed) / static_cast<double>(before.size());
}

template <typename Value>
double skill_delta(const std::vector<ScoredAttempt>& attempts, Value value) {
  std::vector<double> experts, novices;
  for (const ScoredAttempt& attempt : attempts) {
    if (!attempt.grade.score) continue;
    if (is_expert(attempt)) experts.push_back(value(attempt));
    if (attempt.hand == "novice") novices.push_back(value(attempt));
  }
  return cliffs_delta(experts, novices);
}

/// The weighted sum alone, and a pass wherever it is high enough.
Grade without_caps(Grade grade, const Rubric& rubric) {
  if (!grade.score) return grade;
  double total = 0;
  for (const Subscore& subscore : grade.subscores) total += subscore.weight * subscore.value;
  grade.score = 100 * total;
  grade.caps.clear();
  grade.passed = *grade.score >= rubric.pass_at;
  return grade;
}

/// Full marks where the expert is on average, as far as that lies on the same side of no marks.
Rubric anchored_at_expert_mean(Rubric rubric, const std::vector<ScoredAttempt>& attempts) {
  for (std::size_t k = 0; k < rubric.subscores.size(); ++k) {
    SubscoreRule& rule = rubric.subscores[k];
    double sum = 0;
    int count = 0;
    for (const ScoredAttempt& attempt : attempts) {
      if (!is_expert(attempt) || k >= attempt.grade.subscores.size() || !attempt.grade.subscores[k].raw) continue;
      sum += *attempt.grade.subscores[k].raw;
      ++count;
    }
    const double mean = count > 0 ? sum / count : rule.full_at;
    if ((mean - rule.zero_at) * (rule.full_at - rule.zero_at) > 0) rule.full_at = mean;
  }
  return rubric;
}

}  // namespace

std::map<std::string, HandOutcomes> outcomes_by_hand(const std::vector<ScoredAttempt>& attempts) {
  std::map<std::string, HandOutcomes> outcomes;
  for (const ScoredAttempt& attempt : attempts) {
    if (attempt.skill) continue;
    HandOutcomes& of = outcomes[attempt.hand];
    if (attempt.grade.score) {
      of.scores.push_back(*attempt.grade.score);
    } else {
      ++of.without_score;
      of.too_fast += attempt.too_fast ? 1 : 0;
    }
    of.passes += attempt.grade.passed ? 1 : 0;
  }
  return outcomes;
}

std::vector<ValidityCheck> check_attempts(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                                          const ValidityScope& scope, const Scorer& scorer) {
  const std::map<std::string, HandOutcomes> outcomes = outcomes_by_hand(attempts);
  if (outcomes.empty()) return {};
  std::vector<ValidityCheck> checks = check_validity(outcomes, scope);
  if (outcomes.count("expert") == 0) return checks;
  const ValidityBars bars;
  checks.push_back(check_head_room(attempts, rubric));
  checks.push_back(check_spoilt(attempts, scorer, "with a critical event", bars.critical_score, with_critical_event));
  checks.push_back(check_spoilt(attempts, scorer, "with half undone", bars.unfinished_score / 2, with_half_undone));
  return checks;
}

Grade regrade(const Grade& grade, const Rubric& rubric) {
  if (!grade.score) return grade;
  AttemptEnd end{grade.status};
  for (const Cap& cap : grade.caps) {
    if (cap.kind != CapKind::kUnfinished) continue;
    end.objects_done = cap.done;
    end.objects_total = cap.total;
  }
  return grade_metrics(grade.metrics, rubric, end);
}

std::vector<WeightTrial> try_weights(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                                     const ValidityScope& scope) {
  const std::vector<ValidityCheck> checks = check_attempts(attempts, rubric, scope, scorer_of(rubric));
  std::vector<WeightTrial> trials;
  for (std::size_t k = 0; k < rubric.subscores.size(); ++k) {
    WeightTrial trial;
    trial.subscore = rubric.subscores[k].name;
    trial.weight = rubric.subscores[k].weight;
    trial.alone_delta = skill_delta(attempts, [k](const ScoredAttempt& a) { return a.grade.subscores[k].value; });
    const Rubric without = reweighted(rubric, k, 0);
    trial.without_delta =
        skill_delta(regraded(attempts, scorer_of(without)), [](const ScoredAttempt& a) { return *a.grade.score; });
    for (const double factor : {kLessWeight, kMoreWeight}) {
      const Rubric other = reweighted(rubric, k, factor);
      const std::vector<ScoredAttempt> after = regraded(attempts, scorer_of(other));
      (factor < 1 ? trial.less_changes : trial.more_changes) = changed_decisions(attempts, after);
      for (const std::string& name : lost_checks(checks, check_attempts(after, other, scope, scorer_of(other)))) {
        if (std::find(trial.lost.begin(), trial.lost.end(), name) == trial.lost.end()) trial.lost.push_back(name);
      }
    }
    trials.push_back(trial);
  }
  return trials;
}

std::vector<BadScorer> try_bad_scorers(const std::vector<ScoredAttempt>& attempts, const Rubric& rubric,
                                       const ValidityScope& scope) {
  const std::vector<ValidityCheck> checks = check_attempts(attempts, rubric, scope, scorer_of(rubric));
  std::vector<ScoredAttempt> swapped = attempts;
  for (ScoredAttempt& attempt : swapped) {
    const std::string hand = attempt.hand;
    if (hand == "expert") attempt.hand = "novice";
    if (hand == "novice") attempt.hand = "expert";
  }
  const Rubric lenient = anchored_at_expert_mean(rubric, attempts);
  const auto lost_by = [&](const std::vector<ScoredAttempt>& graded, const Rubric& by, const Scorer& scorer) {
    return lost_checks(checks, check_attempts(graded, by, scope, scorer));
  };
  const Scorer uncapped = [&](const Grade& grade) { return without_caps(regrade(grade, rubric), rubric); };
  return {{"labels of expert and novice swapped", lost_by(swapped, rubric, scorer_of(rubric))},
          {"caps dropped", lost_by(regraded(attempts, uncapped), rubric, uncapped)},
          {"full marks at the expert's mean",
           lost_by(regraded(attempts, scorer_of(lenient)), lenient, scorer_of(lenient))}};
}

}  // namespace trocar
