#include "scenarios/scoring/construct_validity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace trocar {
namespace {

constexpr double kFullMarks = 100 - 1e-9;

/// Collects checks about hands, leaving out those whose hands did not run.
class Checks {
 public:
  explicit Checks(const std::map<std::string, HandOutcomes>& outcomes) : outcomes_(outcomes) {}

  bool has(const std::string& hand) const { return outcomes_.count(hand) != 0; }
  const HandOutcomes& of(const std::string& hand) const { return outcomes_.at(hand); }
  double mean(const std::string& hand) const { return summarise(of(hand).scores).mean; }
  double pass_share(const std::string& hand) const {
    const HandOutcomes& o = of(hand);
    const auto attempts = static_cast<double>(o.scores.size()) + o.without_score;
    return attempts > 0 ? o.passes / attempts : 0;
  }

  void at_least(const std::string& name, double value, double bar) { add(name, value, ">=", bar, value >= bar); }
  void at_most(const std::string& name, double value, double bar) { add(name, value, "<=", bar, value <= bar); }
  void add_number_check() {
    int missing = 0;
    for (const auto& [hand, o] : outcomes_) missing += o.without_score + (o.scores.empty() ? 1 : 0);
    at_most("attempts without a score", missing, 0);
  }
  std::vector<ValidityCheck> take() { return std::move(checks_); }

 private:
  void add(const std::string& name, double value, const char* sign, double bar, bool met) {
    char text[32];
    std::snprintf(text, sizeof text, "%s %g", sign, bar);
    checks_.push_back({name, value, text, met});
  }

  const std::map<std::string, HandOutcomes>& outcomes_;
  std::vector<ValidityCheck> checks_;
};

void check_skill(Checks& c, const ValidityBars& bars) {
  if (c.has("expert")) {
    c.at_least("expert mean", c.mean("expert"), bars.expert_mean);
    const std::vector<double>& scores = c.of("expert").scores;
    const auto full = std::count_if(scores.begin(), scores.end(), [](double s) { return s >= kFullMarks; });
    c.at_most("expert at full marks", scores.empty() ? 0 : static_cast<double>(full) / static_cast<double>(scores.size()),
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

void check_cheats(Checks& c, bool first_level, const ValidityBars& bars) {
  if (c.has("novice") && !first_level) c.at_most("novice passes", c.pass_share("novice"), bars.novice_pass_share);
  if (c.has("clumsy")) {
    c.at_most("clumsy mean", c.mean("clumsy"), bars.clumsy_mean);
    c.at_most("clumsy passes", c.pass_share("clumsy"), bars.clumsy_pass_share);
  }
  if (c.has("speed-runner")) {
    c.at_most("speed-runner mean", c.mean("speed-runner"), bars.speed_runner_mean);
    c.at_most("speed-runner passes", c.pass_share("speed-runner"), 0);
  }
  if (c.has("heavy-handed")) c.at_most("heavy-handed passes", c.pass_share("heavy-handed"), 0);
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

double cliffs_delta(const std::vector<double>& first, const std::vector<double>& second) {
  if (first.empty() || second.empty()) return 0;
  long long balance = 0;
  for (const double a : first) {
    for (const double b : second) balance += (a > b) - (a < b);
  }
  return static_cast<double>(balance) / (static_cast<double>(first.size()) * static_cast<double>(second.size()));
}

std::vector<ValidityCheck> check_validity(const std::map<std::string, HandOutcomes>& outcomes, bool first_level,
                                          const ValidityBars& bars) {
  Checks checks(outcomes);
  checks.add_number_check();
  check_skill(checks, bars);
  check_cheats(checks, first_level, bars);
  return checks.take();
}

}  // namespace trocar
