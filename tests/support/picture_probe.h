// Looking at pictures in tests: mean colours and counts of pixels that differ.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "app/picture/gl/image.h"
#include "haptics/quantities.h"

namespace trocar::testing_support {

using Pixel = std::array<double, 3>;

/// Mean colour of a small square, clipped to the picture.
inline Pixel mean_at(const Image& image, const Eigen::Vector2d& at, int half) {
  Pixel sum{};
  int n = 0;
  const int x0 = static_cast<int>(at.x()), y0 = static_cast<int>(at.y());
  for (int y = std::max(0, y0 - half); y <= std::min(image.height - 1, y0 + half); ++y)
    for (int x = std::max(0, x0 - half); x <= std::min(image.width - 1, x0 + half); ++x, ++n)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += image.pixel(x, y)[c];
  for (double& c : sum) c /= std::max(n, 1);
  return sum;
}

inline double distance(const Pixel& a, const Pixel& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// Pixels of which a channel differs by more than `by`.
inline int changed(const Image& a, const Image& b, int by) {
  int n = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    n += std::max({std::abs(a.rgb[i] - b.rgb[i]), std::abs(a.rgb[i + 1] - b.rgb[i + 1]),
                   std::abs(a.rgb[i + 2] - b.rgb[i + 2])}) > by;
  return n;
}

}  // namespace trocar::testing_support
