// Benchmarks from people: a limit on a metric or score, with the rule that made it, its n and its rates of error.
//
// One value a person (the mean of that person's runs): a script run a hundred times is one person. Contrasting groups:
// the limit where the densities of two fitted normals cross between their means; with small groups the fitted rates say
// more than the counted ones, so both are given. Not every pair of groups has a crossing there, and then there is no
// limit. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

struct PersonValue {
  std::string who;
  double value = 0;
};

enum class BenchmarkRule : std::uint8_t {
  kMeanLessSds,  ///< mean less so many SD over persons (more where less is better)
  kMedian,
  kBestQuartile,  ///< what the best quarter reaches
  kContrastingGroups,
};
const char* benchmark_rule_name(BenchmarkRule rule);  ///< "mean - SD", "median", "best quartile", "contrasting groups"

/// Shares of the people who are judged wrongly.
struct ErrorRates {
  double false_pass = 0;  ///< of those who are not competent
  double false_fail = 0;  ///< of those who are
};

struct DerivedBenchmark {
  double limit = 0;
  BenchmarkRule rule = BenchmarkRule::kMedian;
  int n = 0, n_other = 0;   ///< persons; of the contrasted group
  double mean = 0, sd = 0;  ///< of the n
  bool less_is_better = false;
  std::string who, utc;                             ///< who the n were, when it was derived
  std::string text;                                 ///< the rule in words with its numbers
  std::optional<ErrorRates> theoretical, observed;  ///< of contrasting groups
};

/// Empty with fewer than three persons. @param sds for kMeanLessSds. @param who, utc are kept as given.
std::optional<DerivedBenchmark> derive_benchmark(BenchmarkRule rule, const std::vector<PersonValue>& persons,
                                                 bool less_is_better, double sds, const std::string& who,
                                                 const std::string& utc);

/// Empty with fewer than three in a group, when the competent are not the better ones, or when
/// the densities do not cross between the means.
std::optional<DerivedBenchmark> contrast_groups(const std::vector<PersonValue>& competent,
                                                const std::vector<PersonValue>& others, bool less_is_better,
                                                const std::string& who, const std::string& utc);

/// Where two normal densities are equal between their means. Empty when nowhere there.
std::optional<double> density_crossing(double mean_a, double sd_a, double mean_b, double sd_b);

/// Values that a limit on a metric may have: a score 0 to 100, a share 0 to 1, an angle to 180 degrees, smoothness not
/// above 0, the rest (forces, times, paths, counts) not below 0.
struct LawfulRange {
  double low = 0;
  std::optional<double> high = {};
  bool has_low = true;
};
LawfulRange lawful_range(const std::string& metric);
/// "from 0 to 100", "0 or more", "0 or less".
std::string range_words(const LawfulRange& range);
bool lawful(const LawfulRange& range, double value);

/// How far the persons' means can be trusted: share of the variance between them that is not chance within. Empty with
/// fewer than three persons who have three values. @param values_of each person.
std::optional<double> reliability_of_means(const std::vector<std::vector<double>>& values_of);

/// Those whose value reaches the limit, in the order given.
std::vector<std::string> who_would_pass(double limit, bool less_is_better, const std::vector<PersonValue>& persons);

}  // namespace trocar
