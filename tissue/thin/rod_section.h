// The cross-section of a tube that is squeezed flat: round 0 .. both walls on one another 1.
//
// Its round keeps its length; the outline between goes from circle to slit. m. Thread: pure functions, any.
#pragma once

#include <algorithm>
#include <numbers>

#include "tissue/thin/elastic_rod.h"

namespace trocar {

struct RodSection {
  double half_thickness_m = 0;  ///< along the squeeze
  double half_width_m = 0;      ///< across
};

/// Outline of a rod. A thread without lumen stays round. @param flatness 0..1
inline RodSection rod_section(const RodOptions& rod, double flatness) {
  const double r = rod.outer_radius_m, f = std::clamp(flatness, 0.0, 1.0);
  if (rod.inner_radius_m() <= 0) return {r, r};
  return {r + f * (rod.wall_m - r), r * (1 + f * (std::numbers::pi / 2 - 1))};
}

/// How flat two pads at this distance squeeze it.
inline double flatness_between(const RodOptions& rod, double opening_m) {
  const double way = 2 * rod.inner_radius_m();
  return way > 0 ? std::clamp((2 * rod.outer_radius_m - opening_m) / way, 0.0, 1.0) : 0.0;
}

/// Of a lumen's area, what is left open.
inline double open_area(double flatness) {
  const double f = std::clamp(flatness, 0.0, 1.0);
  return (1 - f) * (1 + f * (std::numbers::pi / 2 - 1));
}

/// Of a round lumen's laminar flow at the same pressure, what an ellipse of the flattened lumen's axes lets through:
/// a^3 b^3 / (a^2 + b^2) over that of the circle.
inline double open_flow(double flatness) {
  const double f = std::clamp(flatness, 0.0, 1.0), b = 1 - f, a = 1 + f * (std::numbers::pi / 2 - 1);
  return std::min(1.0, 2 * a * a * a * b * b * b / (a * a + b * b));
}

}  // namespace trocar
