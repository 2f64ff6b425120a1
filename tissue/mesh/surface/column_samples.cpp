#include "tissue/mesh/surface/column_samples.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kShiftX = 1.4142135e-5, kShiftY = 1.7320508e-5;  ///< of a step

struct Crossing {
  double z;
  int turn;  ///< -1 where a column that rises enters the surface, 1 where it leaves
  bool operator<(const Crossing& other) const { return z < other.z; }
};

/// Twice the area of the triangle (a, b, p) in the plane.
double side(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

class Columns {
 public:
  Columns(const Vec3& first, double step, const std::array<int, 3>& samples)
      : first_(first), step_(step), samples_(samples) {
    crossings_.resize(static_cast<std::size_t>(samples[0]) * static_cast<std::size_t>(samples[1]));
  }

  double x(int i) const { return first_.x() + step_ * (i + kShiftX); }
  double y(int j) const { return first_.y() + step_ * (j + kShiftY); }
  std::vector<Crossing>& at(int i, int j) {
    return crossings_[static_cast<std::size_t>(i) +
                      static_cast<std::size_t>(samples_[0]) * static_cast<std::size_t>(j)];
  }

  void cross(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double doubled = side(a, b, c.x(), c.y());
    if (doubled == 0) return;
    const auto from = [&](double low, double start, int count) {
      return std::clamp(static_cast<int>(std::floor((low - start) / step_)), 0, count);
    };
    const auto [x_low, x_high] = std::minmax({a.x(), b.x(), c.x()});
    const auto [y_low, y_high] = std::minmax({a.y(), b.y(), c.y()});
    const int i_end = from(x_high, first_.x(), samples_[0] - 1), j_end = from(y_high, first_.y(), samples_[1] - 1);
    for (int j = from(y_low, first_.y(), samples_[1] - 1); j <= j_end; ++j)
      for (int i = from(x_low, first_.x(), samples_[0] - 1); i <= i_end; ++i) {
        const double u = side(b, c, x(i), y(j)) / doubled, v = side(c, a, x(i), y(j)) / doubled, w = 1 - u - v;
        if (u < 0 || v < 0 || side(a, b, x(i), y(j)) / doubled < 0) continue;
        at(i, j).push_back({u * a.z() + v * b.z() + w * c.z(), doubled > 0 ? 1 : -1});
      }
  }

 private:
  Vec3 first_;
  double step_;
  std::array<int, 3> samples_;
  std::vector<std::vector<Crossing>> crossings_;
};

}  // namespace

void for_inside_samples(const TriangleSurface& surface, const Vec3& first, double step,
                        const std::array<int, 3>& samples, const std::function<void(int, int, int)>& inside) {
  Columns columns(first, step, samples);
  for (const auto& [a, b, c] : surface.triangles)
    columns.cross(surface.vertices[static_cast<std::size_t>(a)], surface.vertices[static_cast<std::size_t>(b)],
                  surface.vertices[static_cast<std::size_t>(c)]);
  for (int j = 0; j < samples[1]; ++j)
    for (int i = 0; i < samples[0]; ++i) {
      auto& crossings = columns.at(i, j);
      std::sort(crossings.begin(), crossings.end());
      int turns = 0;
      for (std::size_t n = 0; n + 1 < crossings.size(); ++n) {
        turns -= crossings[n].turn;
        if (turns < 1) continue;
        const int begin = std::max(0, static_cast<int>(std::ceil((crossings[n].z - first.z()) / step)));
        const int end =
            std::min(samples[2] - 1, static_cast<int>(std::ceil((crossings[n + 1].z - first.z()) / step)) - 1);
        for (int k = begin; k <= end; ++k) inside(i, j, k);
      }
    }
}

}  // namespace trocar
