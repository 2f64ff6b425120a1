// Whether two numbers of the same attempts go together, and whether groups can be told by their sub-scores.
//
// Pure. Thread: any.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace trocar {

/// Pearson's product-moment correlation, -1..1; 0 for fewer than two pairs or a number that never changes.
/// @param first, second as long as each other.
double correlation(const std::vector<double>& first, const std::vector<double>& second);

/// Spearman's: Pearson's of the ranks, ties sharing their mean rank.
double rank_correlation(const std::vector<double>& first, const std::vector<double>& second);

/// 95 % interval of a correlation of so many pairs, by Fisher's z. -1 to 1 for fewer than four pairs.
std::pair<double, double> correlation_interval(double correlation, std::size_t pairs);

/// A point whose group is known.
struct GroupedPoint {
  std::string group;
  std::vector<double> values;
};

/// How often each group was taken for which when it was guessed without itself.
struct LeftOut {
  std::map<std::string, std::map<std::string, int>> taken_for;  ///< by true group
  int right = 0, all = 0;
  double share() const { return all > 0 ? static_cast<double>(right) / all : 0; }
};

/// Each point is guessed by Fisher's linear discriminants of all others: the nearest mean of a group, in the metric of
/// the covariance within groups, each group as likely as the next. Values that hardly vary are kept from deciding by a
/// ridge of a thousandth of the mean variance.
/// @param points as many values each; a group needs two points.
LeftOut leave_one_out(const std::vector<GroupedPoint>& points);

}  // namespace trocar
