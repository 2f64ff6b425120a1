#include "scenarios/scoring/validity/construct_validity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

constexpr double kFullMarks = 100 - 1e-9;
constexpr const char* kSpeedRunner = "speed-runner";

/// Collects checks about hands, leaving out those whose hands did not run.
class Checks {
 public:
  explicit Checks(const std::map<std::string, HandOutcomes>& outcomes) : outcomes_(outcomes) {}

  bool has(const std::string& hand) const { return outcomes_.count(hand) != 0; }
  const HandOutcomes& of(const std::string& hand) const { return outcomes_.at(hand); }
  double mean(const std::string& hand) const { return summarise(of(hand).scores).mean; }
  double share(const std::string& hand) const { return pass_share(of(hand)); }

  void at_least(const std::string& name, double value, double bar) { add(name, value, ">=", bar, value >= bar); }
  void at_most(const std::string& name, double value, double bar) { add(name, value, "<=", bar, value <= bar); }
  void not_asked(const std::string& name, const std::string& why) { checks_.push_back({name, 0, "", true, why}); }
  void add_number_check() {
    int missing = 0;
    for (const auto& [hand, o] : outcomes_) {
      const int excused = hand == kSpeedRunner ? o.too_fast : 0;
      missing += o.without_score - excused + (o.scores.empty() && excused == 0 ? 1 : 0);
    }
    at_most("attempts without a score", missing, 0);
  }
  /// An attempt that the device stopped because the arm went too fast counts as 0.
  double speed_runner_mean() const {
    std::vector<double> scores = of(kSpeedRunner).scores;
    scores.insert(scores.end(), static_cast<std::size_t>(of(kSpeedRunner).too_fast), 0.0);
    return summarise(scores).mean;
  }
  std::vector<ValidityCheck> take() { return std::move(checks_); }

 private:
  void add(const std::string& name, double value, const char* sign, double bar, bool met) {
    char text[32];
    std::snprintf(text, sizeof text, "%s %g", sign, bar);
    checks_.push_back({name, value, text, met, ""});
  }

  const std::map<std::string, HandOutcomes>& outcomes_;
  std::vector<ValidityCheck> checks_;
};

void check_skill(Checks& c, const ValidityBars& bars) {
  if (c.has("expert")) {
    c.at_least("expert mean", c.mean("expert"), bars.expert_mean);
    const std::vector<double>& scores = c.of("expert").scores;
    const auto full = std::count_if(scores.begin(), scores.end(), [](double s) { return s >= kFullMarks; });
    c.at_most("expert at full marks",
              scores.empty() ? 0 : static_cast<double>(full) / static_cast<double>(scores.size()),
              bars.expert_full_marks_share);
  }
  if (c.has("expert") && c.has("intermediate")) {
    c.at_least("expert - intermediate", c.mean("expert") - c.mean("intermediate"), bars.expert_over_intermediate);
    c.at_least("Cliff's delta expert, intermediate", cliffs_delta(c.of("expert").scores, c.of("intermediate").scores),
               bars.delta_expert_intermediate);
  }
  if (c.has("intermediate") && c.has("novice")) {
    c.at_least("intermediate - novice", c.mean("intermediate") - c.mean("novice"), bars.intermediate_over_novice);
    c.at_least("Cliff's delta intermediate, novice", cliffs_delta(c.of("intermediate").scores, c.of("novice").scores),
               bars.delta_intermediate_novice);
  }
}

void check_cheats(Checks& c, const ValidityScope& scope, const ValidityBars& bars) {
  if (c.has("novice")) {
    if (scope.first_level)
      c.not_asked("novice passes", "not asked at the first level");
    else
      c.at_most("novice passes", c.share("novice"), bars.novice_pass_share);
  }
  if (c.has("clumsy")) {
    c.at_most("clumsy mean", c.mean("clumsy"), bars.clumsy_mean);
    c.at_most("clumsy passes", c.share("clumsy"), bars.clumsy_pass_share);
  }
  if (c.has(kSpeedRunner)) {
    c.at_most("speed-runner mean", c.speed_runner_mean(), bars.speed_runner_mean);
    c.at_most("speed-runner passes", c.share(kSpeedRunner), 0);
  }
  if (c.has("heavy-handed")) {
    if (!scope.judges_force)
      c.not_asked("heavy-handed passes", "the exercise judges no force");
    else
      c.at_most("heavy-handed passes", c.share("heavy-handed"), 0);
  }
  if (c.has("idle")) c.at_most("idle highest", summarise(c.of("idle").scores).highest, 0);
}

}  // namespace

GroupSummary summarise(const std::vector<double>& scores) {
  GroupSummary s;
  s.count = static_cast<int>(scores.size());
  if (scores.empty()) return s;
  const auto [lowest, highest] = std::minmax_element(scores.begin(), scores.end());
  s.lowest = *lowest;
  s.highest = *highest;
  s.mean = std::accumulate(scores.begin(), scores.end(), 0.0) / s.count;
  double squares = 0;
  for (const double score : scores) squares += (score - s.mean) * (score - s.mean);
  if (s.count > 1) s.sd = std::sqrt(squares / (s.count - 1));
  return s;
}

double pass_share(const HandOutcomes& outcomes) {
  const double attempts = static_cast<double>(outcomes.scores.size()) + outcomes.without_score;
  return attempts > 0 ? outcomes.passes / attempts : 0;
}

double cliffs_delta(const std::vector<double>& first, const std::vector<double>& second) {
  if (first.empty() || second.empty()) return 0;
  long long balance = 0;
  for (const double a : first) {
    for (const double b : second) balance += (a > b) - (a < b);
  }
  return static_cast<double>(balance) / (static_cast<double>(first.size()) * static_cast<double>(second.size()));
}

bool judges_force(const Rubric& rubric) {
  return std::any_of(rubric.subscores.begin(), rubric.subscores.end(),
                     [](const SubscoreRule& rule) { return is_force_metric(rule.metric); });
}

std::vector<ValidityCheck> check_validity(const std::map<std::string, HandOutcomes>& outcomes,
                                          const ValidityScope& scope, const ValidityBars& bars) {
  Checks checks(outcomes);
  checks.add_number_check();
  check_skill(checks, bars);
  check_cheats(checks, scope, bars);
  return checks.take();
}

}  // namespace trocar
