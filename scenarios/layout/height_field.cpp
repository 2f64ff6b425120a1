#include "scenarios/layout/height_field.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

/// Barycentric coordinates of (x, y) in the projected triangle; empty when outside or seen edge-on.
std::optional<Vec3> barycentric(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  if (std::abs(area) < 1e-18) return std::nullopt;
  const double u = ((b.x() - x) * (c.y() - y) - (c.x() - x) * (b.y() - y)) / area;
  const double v = ((c.x() - x) * (a.y() - y) - (a.x() - x) * (c.y() - y)) / area;
  const double w = 1 - u - v;
  constexpr double kSlack = -1e-12;  // a point on a shared edge belongs to both triangles
  if (u < kSlack || v < kSlack || w < kSlack) return std::nullopt;
  return Vec3(u, v, w);
}

}  // namespace

HeightField::HeightField(const TriangleSurface& surface, double column_m)
    : surface_(surface), normals_(surface.vertex_normals()), bounds_(surface.bounds()), column_m_(column_m) {
  if (surface.triangles.empty()) return;
  columns_x_ = static_cast<int>(bounds_.sizes().x() / column_m_) + 1;
  columns_y_ = static_cast<int>(bounds_.sizes().y() / column_m_) + 1;
  const auto visit = [&](const auto& action) {
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      Eigen::AlignedBox3d box;
      for (const auto vertex : surface_.triangles[t]) box.extend(surface_.vertices[static_cast<std::size_t>(vertex)]);
      for (int iy = index_y(box.min().y()); iy <= index_y(box.max().y()); ++iy)
        for (int ix = index_x(box.min().x()); ix <= index_x(box.max().x()); ++ix)
          action(column(ix, iy), static_cast<std::int32_t>(t));
    }
  };
  first_.assign(static_cast<std::size_t>(columns_x_) * static_cast<std::size_t>(columns_y_) + 1, 0);
  visit([&](std::size_t cell, std::int32_t) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  triangles_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  visit([&](std::size_t cell, std::int32_t t) { triangles_[static_cast<std::size_t>(next[cell]++)] = t; });
}

int HeightField::index_x(double x) const {
  return std::clamp(static_cast<int>((x - bounds_.min().x()) / column_m_), 0, columns_x_ - 1);
}

int HeightField::index_y(double y) const {
  return std::clamp(static_cast<int>((y - bounds_.min().y()) / column_m_), 0, columns_y_ - 1);
}

std::optional<SurfacePoint> HeightField::top(double x, double y) const {
  if (first_.empty() || x < bounds_.min().x() || x > bounds_.max().x() || y < bounds_.min().y() ||
      y > bounds_.max().y())
    return std::nullopt;
  const std::size_t cell = column(index_x(x), index_y(y));
  std::optional<SurfacePoint> best;
  for (auto k = first_[cell]; k < first_[cell + 1]; ++k) {
    const auto& [ia, ib, ic] = surface_.triangles[static_cast<std::size_t>(triangles_[static_cast<std::size_t>(k)])];
    const Vec3& a = surface_.vertices[static_cast<std::size_t>(ia)];
    const Vec3& b = surface_.vertices[static_cast<std::size_t>(ib)];
    const Vec3& c = surface_.vertices[static_cast<std::size_t>(ic)];
    const auto weights = barycentric(a, b, c, x, y);
    if (!weights) continue;
    const double z = weights->x() * a.z() + weights->y() * b.z() + weights->z() * c.z();
    if (best && z <= best->position.z()) continue;
    SurfacePoint point;
    point.position = Vec3(x, y, z);
    point.normal =
        (weights->x() * normals_[static_cast<std::size_t>(ia)] + weights->y() * normals_[static_cast<std::size_t>(ib)] +
         weights->z() * normals_[static_cast<std::size_t>(ic)])
            .normalized();
    point.slope_rad = std::acos(std::clamp((b - a).cross(c - a).normalized().z(), -1.0, 1.0));
    best = point;
  }
  return best;
}

}  // namespace trocar
