#include "app/window/input/stick_curve.h"

#include <algorithm>
#include <cmath>

namespace trocar {

Eigen::Vector2d shaped_stick(double x, double y) {
  const Eigen::Vector2d stick(x, y);
  const double r = stick.norm();
  if (!std::isfinite(r) || r <= kStickDeadZone) return Eigen::Vector2d::Zero();
  const double travel = (std::min(r, 1.0) - kStickDeadZone) / (1 - kStickDeadZone);
  return stick / r * std::pow(travel, 1.8);
}

double shaped_axis(double value) { return shaped_stick(value, 0).x(); }

}  // namespace trocar
