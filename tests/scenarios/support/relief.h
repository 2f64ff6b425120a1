// Closed surfaces by a height over a rectangle: organs with ridges, pits and valleys where a test wants them. Frame T,
// m.
#pragma once

#include <cmath>
#include <functional>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Upper face z = height(x, y) on a grid of `step`, flat floor at `floor_z`, walls between; outward.
inline TriangleSurface relief(double half_x, double half_y, double step, double floor_z,
                              const std::function<double(double, double)>& height) {
  const int nx = static_cast<int>(std::lround(2 * half_x / step)) + 1,
            ny = static_cast<int>(std::lround(2 * half_y / step)) + 1;
  TriangleSurface surface;
  for (const bool top : {true, false})
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const double x = -half_x + i * step, y = -half_y + j * step;
        surface.vertices.emplace_back(x, y, top ? height(x, y) : floor_z);
      }
  const auto at = [&](int i, int j, bool top) { return (top ? 0 : nx * ny) + j * nx + i; };
  const auto quad = [&](int a, int b, int c, int d) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  };
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      quad(at(i, j, true), at(i + 1, j, true), at(i + 1, j + 1, true), at(i, j + 1, true));
      quad(at(i, j, false), at(i, j + 1, false), at(i + 1, j + 1, false), at(i + 1, j, false));
    }
  for (int i = 0; i + 1 < nx; ++i) {
    quad(at(i, 0, false), at(i + 1, 0, false), at(i + 1, 0, true), at(i, 0, true));
    quad(at(i + 1, ny - 1, false), at(i, ny - 1, false), at(i, ny - 1, true), at(i + 1, ny - 1, true));
  }
  for (int j = 0; j + 1 < ny; ++j) {
    quad(at(0, j + 1, false), at(0, j, false), at(0, j, true), at(0, j + 1, true));
    quad(at(nx - 1, j, false), at(nx - 1, j + 1, false), at(nx - 1, j + 1, true), at(nx - 1, j, true));
  }
  return surface;
}

/// Level ground of 110 x 90 mm, finely bumped so that no two places are equal, with a wall `height_m` high along the
/// side where the instrument of level L1 comes from: the patient's left (+x) and the feet (-y).
inline TriangleSurface walled_ground(double height_m) {
  return relief(0.055, 0.045, 0.003, -0.03, [=](double x, double y) {
    const double along = (x - y) / std::sqrt(2.0);  // towards the instrument
    const double wall = 0.5 * (1 + std::tanh((along - 0.030) / 0.004));
    return height_m * wall + 1e-4 * std::sin(90 * x) * std::cos(70 * y);
  });
}

/// The same ground at the bottom of a tub: the wall goes round it.
inline TriangleSurface tub(double height_m) {
  return relief(0.055, 0.045, 0.003, -0.03, [=](double x, double y) {
    const double out = std::max(std::abs(x) - 0.040, std::abs(y) - 0.030);
    return height_m * 0.5 * (1 + std::tanh(out / 0.003)) + 1e-4 * std::sin(90 * x) * std::cos(70 * y);
  });
}

/// A surface of T as an image holds it: RAS axes.
inline TriangleSurface in_ras(const TriangleSurface& surface_T) {
  Pose X;
  X.R << -1, 0, 0, 0, 0, 1, 0, 1, 0;  // its own inverse
  return surface_T.transformed(X);
}

}  // namespace trocar
