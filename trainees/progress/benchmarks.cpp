#include "trainees/progress/benchmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "trainees/progress/cohort_bands.h"

namespace trocar {
namespace {

constexpr std::size_t kLeastPersons = 3;

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::vector<double> values_of(const std::vector<PersonValue>& persons) {
  std::vector<double> out;
  for (const PersonValue& person : persons) out.push_back(person.value);
  return out;
}

bool reaches(double value, double limit, bool less_is_better) {
  return less_is_better ? value <= limit : value >= limit;
}

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// Share of a normal group that reaches the limit.
double share_passing(double limit, const Spread& group, bool less_is_better) {
  const double z = (limit - group.mean) / group.sd;
  return normal_cdf(less_is_better ? z : -z);
}

double counted_passing(double limit, bool less_is_better, const std::vector<PersonValue>& persons) {
  return static_cast<double>(who_would_pass(limit, less_is_better, persons).size()) /
         static_cast<double>(persons.size());
}

}  // namespace

const char* benchmark_rule_name(BenchmarkRule rule) {
  switch (rule) {
    case BenchmarkRule::kMeanLessSds:
      return "mean - SD";
    case BenchmarkRule::kMedian:
      return "median";
    case BenchmarkRule::kBestQuartile:
      return "best quartile";
    case BenchmarkRule::kContrastingGroups:
      return "contrasting groups";
  }
  return "unknown";
}

std::optional<DerivedBenchmark> derive_benchmark(BenchmarkRule rule, const std::vector<PersonValue>& persons,
                                                 bool less_is_better, double sds, const std::string& who,
                                                 const std::string& utc) {
  if (persons.size() < kLeastPersons || rule == BenchmarkRule::kContrastingGroups) return std::nullopt;
  const Spread spread = *spread_of(values_of(persons));
  const Quartiles fourths = *quartiles(values_of(persons));
  DerivedBenchmark out;
  out.rule = rule;
  out.n = spread.n;
  out.mean = spread.mean;
  out.sd = spread.sd;
  out.less_is_better = less_is_better;
  out.who = who;
  out.utc = utc;
  switch (rule) {
    case BenchmarkRule::kMeanLessSds:
      out.limit = spread.mean + (less_is_better ? sds : -sds) * spread.sd;
      out.text = "mean " + text_of(spread.mean) + (less_is_better ? " + " : " - ") + text_of(sds) + " SD of " +
                 text_of(spread.sd);
      break;
    case BenchmarkRule::kMedian:
      out.limit = fourths.median;
      out.text = "median";
      break;
    default:
      out.limit = less_is_better ? fourths.low : fourths.high;
      out.text = "best quartile";
  }
  out.text += " over " + std::to_string(out.n) + " persons";
  return out;
}

std::optional<double> density_crossing(double mean_a, double sd_a, double mean_b, double sd_b) {
  if (!(sd_a > 0 && sd_b > 0) || mean_a == mean_b) return std::nullopt;
  const double low = std::min(mean_a, mean_b), high = std::max(mean_a, mean_b);
  // log density of a less that of b: quadratic a x^2 + b x + c.
  const double va = sd_a * sd_a, vb = sd_b * sd_b;
  const double a = 0.5 / vb - 0.5 / va, b = mean_a / va - mean_b / vb;
  const double c = 0.5 * mean_b * mean_b / vb - 0.5 * mean_a * mean_a / va + std::log(sd_b / sd_a);
  const auto within = [&](double x) { return x > low && x < high; };
  if (std::abs(a) * (high - low) * (high - low) < 1e-12) {
    const double x = -c / b;
    return within(x) ? std::optional(x) : std::nullopt;
  }
  const double root = b * b - 4 * a * c;
  if (root < 0) return std::nullopt;
  const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));  // no cancellation
  if (within(q / a)) return q / a;
  return q != 0 && within(c / q) ? std::optional(c / q) : std::nullopt;
}

std::optional<DerivedBenchmark> contrast_groups(const std::vector<PersonValue>& competent,
                                                const std::vector<PersonValue>& others, bool less_is_better,
                                                const std::string& who, const std::string& utc) {
  if (competent.size() < kLeastPersons || others.size() < kLeastPersons) return std::nullopt;
  const Spread good = *spread_of(values_of(competent)), poor = *spread_of(values_of(others));
  if (less_is_better ? good.mean >= poor.mean : good.mean <= poor.mean) return std::nullopt;
  const auto limit = density_crossing(good.mean, good.sd, poor.mean, poor.sd);
  if (!limit) return std::nullopt;
  DerivedBenchmark out{
      *limit, BenchmarkRule::kContrastingGroups, good.n, poor.n, good.mean, good.sd, less_is_better, who, utc, "", {},
      {}};
  out.text = "densities of " + text_of(good.mean) + " (SD " + text_of(good.sd) + ", n " + std::to_string(good.n) +
             ") and " + text_of(poor.mean) + " (SD " + text_of(poor.sd) + ", n " + std::to_string(poor.n) + ") cross";
  out.theoretical =
      ErrorRates{share_passing(*limit, poor, less_is_better), 1 - share_passing(*limit, good, less_is_better)};
  out.observed = ErrorRates{counted_passing(*limit, less_is_better, others),
                            1 - counted_passing(*limit, less_is_better, competent)};
  return out;
}

LawfulRange lawful_range(const std::string& metric) {
  if (metric == "score") return {0, 100, true};
  if (metric == "sparc" || metric == "ldlj") return {0, 0, false};
  if (metric == "angle_error_deg") return {0, 180, true};
  if (metric == "ring_angle_deg") return {0, 90, true};
  if (metric.ends_with("_share") || metric == "economy") return {0, 1, true};
  return {0, std::nullopt, true};
}

std::string range_words(const LawfulRange& range) {
  if (range.has_low && range.high) return "from " + text_of(range.low) + " to " + text_of(*range.high);
  return range.has_low ? text_of(range.low) + " or more" : text_of(range.high.value_or(0)) + " or less";
}

bool lawful(const LawfulRange& range, double value) {
  return std::isfinite(value) && (!range.has_low || value >= range.low) && (!range.high || value <= *range.high);
}

std::optional<double> reliability_of_means(const std::vector<std::vector<double>>& values_of) {
  constexpr int kAll = 1000000;
  const auto between = between_variance(values_of, kAll);
  if (!between) return std::nullopt;
  std::vector<double> means;
  for (const auto& values : values_of)
    if (values.size() >= kLeastPersons) means.push_back(spread_of(values)->mean);
  const auto observed = spread_of(means);
  if (!observed || !(observed->sd > 0)) return std::nullopt;
  return *between / (observed->sd * observed->sd);
}

std::vector<std::string> who_would_pass(double limit, bool less_is_better, const std::vector<PersonValue>& persons) {
  std::vector<std::string> out;
  for (const PersonValue& person : persons)
    if (reaches(person.value, limit, less_is_better)) out.push_back(person.who);
  return out;
}

}  // namespace trocar
