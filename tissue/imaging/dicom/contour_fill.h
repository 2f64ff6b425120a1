// Contours of one plane filled on a grid of pixels by the even-odd rule.
//
// A pixel is inside when its centre is, counting the crossings of the half-line to its left with all edges of all
// contours, each edge half open (y_a <= y < y_b): so two contours make a hole, and a keyhole's two coinciding edges
// cancel. Thread: any.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace trocar {

using PlaneContour = std::vector<Eigen::Vector2d>;  ///< closed, in pixels: the centre of pixel (i, j) lies at (i, j)

/// Crossings of rows and edges that filling would have to hold: to be asked before filling contours from a stranger's
/// file.
std::uint64_t crossing_count(const std::vector<PlaneContour>& contours, int height);

/// Calls `run(first, last + 1, row)` for every run of inside pixels with 0 <= i < width, 0 <= j < height.
void fill_even_odd(const std::vector<PlaneContour>& contours, int width, int height,
                   const std::function<void(int, int, int)>& run);

/// Area of one contour that does not cross itself, pixels^2.
double contour_area(const PlaneContour& contour);

}  // namespace trocar
