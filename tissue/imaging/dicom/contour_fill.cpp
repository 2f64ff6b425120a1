#include "tissue/imaging/dicom/contour_fill.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

/// First and last + 1 of the rows whose centres an edge crosses, within the grid.
std::pair<int, int> rows_of(double low, double high, int height) {
  const double first = std::clamp(std::ceil(low), 0.0, static_cast<double>(height));
  const double last = std::clamp(std::ceil(high), 0.0, static_cast<double>(height));
  return {static_cast<int>(first), static_cast<int>(last)};
}

void add_crossings(const PlaneContour& contour, int height, std::vector<std::vector<double>>& crossings) {
  for (std::size_t n = 0; n < contour.size(); ++n) {
    const Eigen::Vector2d &a = contour[n], &b = contour[(n + 1) % contour.size()];
    const Eigen::Vector2d &low = a.y() < b.y() ? a : b,
                          &high = a.y() < b.y() ? b : a;  // same arithmetic both ways: keyholes cancel
    const auto [first, last] = rows_of(low.y(), high.y(), height);
    for (int row = first; row < last; ++row)
      crossings[static_cast<std::size_t>(row)].push_back(low.x() +
                                                         (row - low.y()) / (high.y() - low.y()) * (high.x() - low.x()));
  }
}

}  // namespace

std::uint64_t crossing_count(const std::vector<PlaneContour>& contours, int height) {
  std::uint64_t count = 0;
  for (const PlaneContour& contour : contours)
    for (std::size_t n = 0; n < contour.size(); ++n) {
      const double a = contour[n].y(), b = contour[(n + 1) % contour.size()].y();
      const auto [first, last] = rows_of(std::min(a, b), std::max(a, b), height);
      count += static_cast<std::uint64_t>(last - first);
    }
  return count;
}

void fill_even_odd(const std::vector<PlaneContour>& contours, int width, int height,
                   const std::function<void(int, int, int)>& run) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(height));
  for (const PlaneContour& contour : contours) add_crossings(contour, height, crossings);
  for (int row = 0; row < height; ++row) {
    std::vector<double>& at = crossings[static_cast<std::size_t>(row)];
    std::sort(at.begin(), at.end());
    for (std::size_t n = 0; n + 1 < at.size(); n += 2) {
      const int first = static_cast<int>(std::clamp(std::ceil(at[n]), 0.0, static_cast<double>(width)));
      const int last = static_cast<int>(std::clamp(std::ceil(at[n + 1]), 0.0, static_cast<double>(width)));
      if (first < last) run(first, last, row);
    }
  }
}

double contour_area(const PlaneContour& contour) {
  double twice = 0;
  for (std::size_t n = 0; n < contour.size(); ++n) {
    const Eigen::Vector2d &a = contour[n], &b = contour[(n + 1) % contour.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

}  // namespace trocar
