// What a scanner does to the truth: noise, and a point spread of 1.5 mm full width at half maximum.
//
// White noise is drawn strong enough to have the wanted standard deviation after the Gaussian point spread, which gives
// it the grain of a reconstructed image. One seed, one noise, on every machine (mt19937_64, Box and Muller). Thread:
// any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace trocar::phantom {

struct Scanner {
  double voxel_mm = 2.5;
  double noise_hu = 10;  ///< standard deviation in the image
  std::uint64_t seed = 1;
};

/// Standard deviation of the Gaussian point spread.
inline constexpr double kPointSpreadMm = 0.65;

/// @param hounsfield i fastest, size[0] * size[1] * size[2] of them
void scan(std::vector<float>& hounsfield, const std::array<int, 3>& size, const Scanner& scanner);

}  // namespace trocar::phantom
