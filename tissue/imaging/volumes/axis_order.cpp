#include "tissue/imaging/volumes/axis_order.h"

#include <algorithm>
#include <cmath>

namespace trocar {

AxisOrder ras_order(const Eigen::Matrix3d& linear) {
  const Eigen::Matrix3d axes = linear.colwise().normalized();
  AxisOrder order;
  std::array<int, 3> best{0, 1, 2}, trial{0, 1, 2};
  double best_score = -1;
  do {
    double score = 0;
    for (int world = 0; world < 3; ++world) score += std::abs(axes(world, trial[static_cast<std::size_t>(world)]));
    if (score > best_score + 1e-9) best_score = score, best = trial;
  } while (std::next_permutation(trial.begin(), trial.end()));
  order.stored = best;
  for (std::size_t world = 0; world < 3; ++world) order.flipped[world] = axes(static_cast<int>(world), best[world]) < 0;
  return order;
}

std::array<int, 3> reordered_size(const std::array<int, 3>& size, const AxisOrder& order) {
  std::array<int, 3> result{};
  for (std::size_t world = 0; world < 3; ++world) result[world] = size[static_cast<std::size_t>(order.stored[world])];
  return result;
}

Eigen::Affine3d reordered_frame(const Eigen::Affine3d& frame, const std::array<int, 3>& size, const AxisOrder& order) {
  Eigen::Affine3d result = frame;
  for (std::size_t world = 0; world < 3; ++world) {
    const Eigen::Vector3d step = frame.linear().col(order.stored[world]);
    const int last = size[static_cast<std::size_t>(order.stored[world])] - 1;
    result.linear().col(static_cast<int>(world)) = order.flipped[world] ? Eigen::Vector3d(-step) : step;
    if (order.flipped[world]) result.translation() += step * last;
  }
  return result;
}

}  // namespace trocar
