#include "app/graphics/picture_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trocar {
namespace {

constexpr double kCurvature = 0.55;  // share of the way onto the tangent planes (Boubekeur and Alexa use 3/4 at most)
constexpr int kGrid = 64;            // voxels along the longest side

Vec3 onto_plane(const Vec3& point, const Vec3& origin, const Vec3& normal) {
  return point - normal * normal.dot(point - origin);
}

/// Solid voxels of a closed surface: crossings along z per column, filled by parity, then blurred.
class SolidGrid {
 public:
  explicit SolidGrid(const TriangleSurface& surface) {
    const Eigen::AlignedBox3d box = surface.bounds();
    cell_ = std::max(box.sizes().maxCoeff(), 1e-6) / (kGrid - 8);
    origin_ = box.center() - Vec3::Constant(cell_ * kGrid / 2);
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(kGrid) * kGrid);
    for (const auto& t : surface.triangles)
      add_crossings(surface.vertices[static_cast<std::size_t>(t[0])], surface.vertices[static_cast<std::size_t>(t[1])],
                    surface.vertices[static_cast<std::size_t>(t[2])], crossings);
    fill(crossings);
    for (int axis = 0; axis < 3; ++axis) blur(axis);
  }

  double cell() const { return cell_; }

  /// Share of solid around a point, trilinear, 0 outside the grid.
  double density(const Vec3& point) const {
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

 private:
  static std::size_t index(int x, int y, int z) { return static_cast<std::size_t>((z * kGrid + y) * kGrid + x); }

  void add_crossings(const Vec3& a, const Vec3& b, const Vec3& c, std::vector<std::vector<double>>& crossings) const {
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

  void fill(std::vector<std::vector<double>>& crossings) {
    solid_.assign(static_cast<std::size_t>(kGrid) * kGrid * kGrid, 0.0F);
    for (int y = 0; y < kGrid; ++y)
      for (int x = 0; x < kGrid; ++x) {
        auto& heights = crossings[static_cast<std::size_t>(y * kGrid + x)];
        std::sort(heights.begin(), heights.end());
        for (std::size_t pair = 0; pair + 1 < heights.size(); pair += 2)
          for (int z = 0; z < kGrid; ++z) {
            const double height = origin_.z() + (z + 0.5) * cell_;
            if (height > heights[pair] && height < heights[pair + 1]) solid_[index(x, y, z)] = 1;
          }
      }
  }

  /// Binomial blur of five cells along one axis.
  void blur(int axis) {
    const std::vector<float> from = solid_;
    const auto at = [&](int x, int y, int z) {
      return from[index(std::clamp(x, 0, kGrid - 1), std::clamp(y, 0, kGrid - 1), std::clamp(z, 0, kGrid - 1))];
    };
    const int dx = axis == 0, dy = axis == 1, dz = axis == 2;
    for (int z = 0; z < kGrid; ++z)
      for (int y = 0; y < kGrid; ++y)
        for (int x = 0; x < kGrid; ++x)
          solid_[index(x, y, z)] = (at(x - 2 * dx, y - 2 * dy, z - 2 * dz) + at(x + 2 * dx, y + 2 * dy, z + 2 * dz) +
                                    4 * (at(x - dx, y - dy, z - dz) + at(x + dx, y + dy, z + dz)) + 6 * at(x, y, z)) /
                                   16;
  }

  double cell_ = 0;
  Vec3 origin_ = Vec3::Zero();
  std::vector<float> solid_;
};

}  // namespace

TriangleSurface subdivide_curved(const TriangleSurface& surface) {
  const std::vector<Vec3> normals = surface.vertex_normals();
  TriangleSurface fine;
  fine.vertices = surface.vertices;
  fine.triangles.reserve(surface.triangles.size() * 4);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> midpoints;
  const auto midpoint = [&](std::int32_t a, std::int32_t b) {
    const auto key = std::minmax(a, b);
    const auto [place, inserted] =
        midpoints.try_emplace({key.first, key.second}, static_cast<std::int32_t>(fine.vertices.size()));
    if (inserted) {
      const auto first = static_cast<std::size_t>(key.first), second = static_cast<std::size_t>(key.second);
      const Vec3 flat = 0.5 * (surface.vertices[first] + surface.vertices[second]);
      const Vec3 curved = 0.5 * (onto_plane(flat, surface.vertices[first], normals[first]) +
                                 onto_plane(flat, surface.vertices[second], normals[second]));
      fine.vertices.push_back(flat + kCurvature * (curved - flat));
    }
    return place->second;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    const std::int32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({ab, b, bc});
    fine.triangles.push_back({ca, bc, c});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

std::vector<float> bake_openness(const TriangleSurface& surface) {
  const SolidGrid grid(surface);
  const std::vector<Vec3> normals = surface.vertex_normals();
  std::vector<float> openness(surface.vertices.size(), 1.0F);
  for (std::size_t i = 0; i < openness.size(); ++i) {
    double met = 0;
    for (const double step : {2.2, 3.6, 5.5})
      met += grid.density(surface.vertices[i] + normals[i] * (step * grid.cell()));
    openness[i] = static_cast<float>(std::clamp(1.0 - 0.75 * met, 0.0, 1.0));
  }
  return openness;
}

PictureMesh build_picture_mesh(const TriangleSurface& surface, std::size_t max_triangles) {
  TriangleSurface fine = surface;
  if (fine.volume_m3() < 0)  // inside out: culling would show the far wall
    for (auto& triangle : fine.triangles) std::swap(triangle[1], triangle[2]);
  while (!fine.triangles.empty() && fine.triangles.size() * 4 <= max_triangles) fine = subdivide_curved(fine);
  const std::vector<float> openness = bake_openness(fine);
  const std::vector<Vec3> normals = fine.vertex_normals();
  PictureMesh mesh;
  mesh.vertices.reserve(fine.vertices.size());
  for (std::size_t i = 0; i < fine.vertices.size(); ++i) {
    const Eigen::Vector3f p = fine.vertices[i].cast<float>(), n = normals[i].cast<float>();
    mesh.vertices.push_back({{p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}, {openness[i], 0.0F}});
  }
  mesh.indices.reserve(fine.triangles.size() * 3);
  for (const auto& triangle : fine.triangles)
    for (const std::int32_t index : triangle) mesh.indices.push_back(static_cast<std::uint32_t>(index));
  return mesh;
}

std::vector<std::uint32_t> triangles_near(const PictureMesh& mesh, const Vec3& centre, double radius) {
  const auto point = [&](std::uint32_t index) {
    const float* p = mesh.vertices[index].position;
    return Vec3(p[0], p[1], p[2]);
  };
  std::vector<std::uint32_t> near;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    Eigen::AlignedBox3d box(point(a));
    box.extend(point(b)).extend(point(c));
    if (box.exteriorDistance(centre) <= radius) near.insert(near.end(), {a, b, c});
  }
  return near;
}

}  // namespace trocar
