// What a stick's deflection means: nothing within a round dead zone, then gentle at first.
//
//   r' = ((r - d) / (1 - d))^1.8, direction kept; d = 0.12. Values -1..1. Thread: any.
#pragma once

#include <Eigen/Core>

namespace trocar {

inline constexpr double kStickDeadZone = 0.12;

Eigen::Vector2d shaped_stick(double x, double y);
double shaped_axis(double value);

}  // namespace trocar
