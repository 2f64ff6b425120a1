#include "haptics/control/velocity_estimator.h"

#include <algorithm>
#include <cstdlib>

namespace trocar {

double VelocityEstimator::update(std::int64_t count, std::uint32_t elapsed_periods) {
  // A missed period is filled with the straight line: the window stays in units of periods.
  const std::int64_t last = filled_ > 0 ? at(0) : count;
  const int steps =
      filled_ > 0
          ? static_cast<int>(std::clamp<std::uint32_t>(elapsed_periods, 1, static_cast<std::uint32_t>(longest_)))
          : 1;
  for (int i = 1; i <= steps; ++i) {
    head_ = (head_ + 1) % (kMaxWindow + 1);
    history_[head_] = last + (count - last) * i / steps;
    filled_ = std::min(filled_ + 1, longest_ + 1);
  }
  window_ = 0;
  for (int n = 1; n < filled_ && line_fits(n); ++n) window_ = n;
  if (window_ == 0) return 0;
  return static_cast<double>(at(0) - at(window_)) * quantum_ / (window_ * period_s_);
}

bool VelocityEstimator::line_fits(int n) const {
  // |x(k-i) - (x(k) - i/n (x(k) - x(k-n)))| <= 1 count, in integers: multiply by n.
  const std::int64_t rise = at(0) - at(n);
  for (int i = 1; i < n; ++i) {
    if (std::abs(n * (at(0) - at(i)) - i * rise) > n) return false;
  }
  return true;
}

}  // namespace trocar
