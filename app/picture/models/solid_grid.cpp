#include "app/picture/models/solid_grid.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr int kGrid = 64;  // voxels along the longest side

std::size_t index(int x, int y, int z) { return static_cast<std::size_t>((z * kGrid + y) * kGrid + x); }

}  // namespace

SolidGrid::SolidGrid(const TriangleSurface& surface) : bounds_(surface.bounds()) {
  cell_ = std::max(bounds_.sizes().maxCoeff(), 1e-6) / (kGrid - 8);
  origin_ = bounds_.center() - Vec3::Constant(cell_ * kGrid / 2);
  voxelise(surface);
}

SolidGrid::SolidGrid(const TriangleSurface& surface, const SolidGrid& rest) : bounds_(surface.bounds()) {
  cell_ = std::max(rest.cell_, bounds_.sizes().maxCoeff() / (kGrid - 3));
  const Vec3 cells = (bounds_.center() - rest.bounds_.center()) / cell_;
  origin_ = rest.bounds_.center() - Vec3::Constant(cell_ * kGrid / 2) + cell_ * cells.array().round().matrix();
  voxelise(surface);
}

void SolidGrid::voxelise(const TriangleSurface& surface) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(kGrid) * kGrid);
  for (const auto& t : surface.triangles)
    add_crossings(surface.vertices[static_cast<std::size_t>(t[0])], surface.vertices[static_cast<std::size_t>(t[1])],
                  surface.vertices[static_cast<std::size_t>(t[2])], crossings);
  fill(crossings);
  for (int axis = 0; axis < 3; ++axis) blur(axis);
}

double SolidGrid::density(const Vec3& point) const {
  const Vec3 g = (point - origin_) / cell_ - Vec3::Constant(0.5);
  const Eigen::Vector3i i = g.array().floor().cast<int>();
  if ((i.array() < 0).any() || (i.array() >= kGrid - 1).any()) return 0;
  const Vec3 f = g - i.cast<double>();
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = corner & 1, b = (corner >> 1) & 1, c = corner >> 2;
    sum += solid_[index(i.x() + a, i.y() + b, i.z() + c)] * (a ? f.x() : 1 - f.x()) * (b ? f.y() : 1 - f.y()) *
           (c ? f.z() : 1 - f.z());
  }
  return sum;
}

void SolidGrid::add_crossings(const Vec3& a, const Vec3& b, const Vec3& c,
                              std::vector<std::vector<double>>& crossings) const {
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  // A column passes at an irrational offset in its cell, so that it does not hit vertices of regular meshes.
  const auto column = [this](int i, int axis) { return origin_[axis] + (i + 0.4142135 + 0.1 * axis) * cell_; };
  const auto first = [&](int axis) { return std::max(0, static_cast<int>((low[axis] - origin_[axis]) / cell_) - 1); };
  const auto last = [&](int axis) {
    return std::min(kGrid - 1, static_cast<int>((high[axis] - origin_[axis]) / cell_) + 1);
  };
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (area == 0) return;
  for (int y = first(1); y <= last(1); ++y)
    for (int x = first(0); x <= last(0); ++x) {
      const double px = column(x, 0), py = column(y, 1);
      const double u = ((b.x() - px) * (c.y() - py) - (b.y() - py) * (c.x() - px)) / area;
      const double v = ((c.x() - px) * (a.y() - py) - (c.y() - py) * (a.x() - px)) / area;
      const double w = 1 - u - v;
      if (u >= 0 && v >= 0 && w >= 0)
        crossings[static_cast<std::size_t>(y * kGrid + x)].push_back(u * a.z() + v * b.z() + w * c.z());
    }
}

void SolidGrid::fill(std::vector<std::vector<double>>& crossings) {
  solid_.assign(static_cast<std::size_t>(kGrid) * kGrid * kGrid, 0.0F);
  const auto cell = [this](double height) { return static_cast<int>(std::floor((height - origin_.z()) / cell_)); };
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x) {
      auto& heights = crossings[static_cast<std::size_t>(y * kGrid + x)];
      std::sort(heights.begin(), heights.end());
      for (std::size_t pair = 0; pair + 1 < heights.size(); pair += 2)
        for (int z = std::max(0, cell(heights[pair]) - 1); z <= std::min(kGrid - 1, cell(heights[pair + 1]) + 1); ++z) {
          const double height = origin_.z() + (z + 0.5) * cell_;
          if (height > heights[pair] && height < heights[pair + 1]) solid_[index(x, y, z)] = 1;
        }
    }
}

/// Binomial blur of five cells along one axis; beyond the grid all is as at its face.
void SolidGrid::blur(int axis) {
  using Cells = Eigen::Map<const Eigen::ArrayXf>;
  constexpr Eigen::Index kWay[] = {1, kGrid, kGrid * kGrid};
  const std::vector<float> from = solid_;
  const Eigen::Index step = kWay[axis], run = step * kGrid;
  std::vector<float> line(
      static_cast<std::size_t>(run + 4 * step));  // the cells along the axis and two beyond each end
  for (std::size_t at = 0; at < from.size(); at += static_cast<std::size_t>(run)) {
    const Cells first(&from[at], step), last(&from[at] + run - step, step);
    Eigen::Map<Eigen::ArrayXf> all(line.data(), run + 4 * step);
    all << first, first, Cells(&from[at], run), last, last;
    const auto beside = [&](Eigen::Index cells) { return all.segment((2 + cells) * step, run); };
    Eigen::Map<Eigen::ArrayXf>(&solid_[at], run) =
        (beside(-2) + beside(2) + 4 * (beside(-1) + beside(1)) + 6 * beside(0)) / 16;
  }
}

}  // namespace trocar
