// The reachable region asked through the forward model: its extents by a sweep of the joint box, and percentiles of
// force, weight and resolution over the part of it that the reference names.
//
// Shares no step with the cubes of workspace_grid.h, which it checks. Frame W', SI. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

/// Box of stylus positions over a sweep of theta1..theta4 within the limits.
struct SweptExtent {
  Eigen::AlignedBox3d limits, ring, clear;  ///< clear: of ring and legs with their widths
};
SweptExtent sweep_extent(int steps);

/// Percentiles over joint angles drawn inside the limits whose stylus lies in the reference's region:
/// x' +-130, y' -180..60, z' -274..-120 mm, det A >= 0.05.
struct RegionPercentiles {
  /// One percentile, and the range in which it lies for 19 of 20 draws as small as the reference's (4000).
  struct Quantile {
    double value = 0, low = 0, high = 0;
  };
  using Three = std::array<Quantile, 3>;                                ///< 5, 50, 95 %
  Three step_m{}, force_28_n{}, force_100_n{}, gravity_nm{}, left_n{};  ///< left: continuous force after the weight
  double over_rating = 0;  ///< share where the weight alone needs more than 28 mN m
};
/// Percentiles of values, at least 20 of them.
RegionPercentiles::Three quantiles(std::vector<double> values);
RegionPercentiles region_percentiles(int samples, std::uint64_t seed);

}  // namespace trocar
