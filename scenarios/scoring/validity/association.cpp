#include "scenarios/scoring/validity/association.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace trocar {
namespace {

constexpr double kNormal95 = 1.959963984540054;
constexpr double kRidge = 1e-3, kLeastVariance = 1e-12;

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> out(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    for (std::size_t i = first; i <= last; ++i) out[order[i]] = 0.5 * static_cast<double>(first + last);
    first = last + 1;
  }
  return out;
}

Eigen::VectorXd vector_of(const GroupedPoint& point) {
  return Eigen::Map<const Eigen::VectorXd>(point.values.data(), static_cast<Eigen::Index>(point.values.size()));
}

/// The group that the others would put a point into.
std::string guess(const std::vector<GroupedPoint>& points, std::size_t left_out) {
  const Eigen::Index n = static_cast<Eigen::Index>(points.front().values.size());
  std::map<std::string, std::pair<Eigen::VectorXd, int>> means;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == left_out) continue;
    auto& [sum, count] = means.try_emplace(points[i].group, Eigen::VectorXd::Zero(n), 0).first->second;
    sum += vector_of(points[i]);
    ++count;
  }
  for (auto& [group, mean] : means) mean.first /= mean.second;
  Eigen::MatrixXd within = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == left_out) continue;
    const Eigen::VectorXd off = vector_of(points[i]) - means.at(points[i].group).first;
    within += off * off.transpose();
  }
  within /= std::max<double>(1, static_cast<double>(points.size() - 1 - means.size()));
  within.diagonal().array() += kRidge * within.trace() / static_cast<double>(n) + kLeastVariance;
  const Eigen::LDLT<Eigen::MatrixXd> metric(within);
  std::string nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [group, mean] : means) {
    const Eigen::VectorXd off = vector_of(points[left_out]) - mean.first;
    const double distance = off.dot(metric.solve(off));
    if (distance < least) nearest = group;
    least = std::min(least, distance);
  }
  return nearest;
}

}  // namespace

double correlation(const std::vector<double>& first, const std::vector<double>& second) {
  const double n = static_cast<double>(first.size());
  if (first.size() < 2) return 0;
  const double mean_first = std::accumulate(first.begin(), first.end(), 0.0) / n;
  const double mean_second = std::accumulate(second.begin(), second.end(), 0.0) / n;
  double both = 0, squares_first = 0, squares_second = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double a = first[i] - mean_first, b = second[i] - mean_second;
    both += a * b;
    squares_first += a * a;
    squares_second += b * b;
  }
  return squares_first > 0 && squares_second > 0 ? both / std::sqrt(squares_first * squares_second) : 0;
}

double rank_correlation(const std::vector<double>& first, const std::vector<double>& second) {
  return correlation(ranks(first), ranks(second));
}

std::pair<double, double> correlation_interval(double r, std::size_t pairs) {
  if (pairs < 4) return {-1, 1};
  const double z = std::atanh(std::clamp(r, -1 + 1e-15, 1 - 1e-15));
  const double half = kNormal95 / std::sqrt(static_cast<double>(pairs) - 3);
  return {std::tanh(z - half), std::tanh(z + half)};
}

LeftOut leave_one_out(const std::vector<GroupedPoint>& points) {
  LeftOut out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string taken = guess(points, i);
    ++out.taken_for[points[i].group][taken];
    out.right += taken == points[i].group ? 1 : 0;
    ++out.all;
  }
  return out;
}

}  // namespace trocar
