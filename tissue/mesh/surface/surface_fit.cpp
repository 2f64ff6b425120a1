#include "tissue/mesh/surface/surface_fit.h"

#include "tissue/mesh/surface/nearest_surface.h"

namespace trocar {
namespace {

std::array<Vec3, 3> corners(const TriangleSurface& surface, std::size_t triangle) {
  std::array<Vec3, 3> p;
  for (std::size_t n = 0; n < 3; ++n) p[n] = surface.vertices[static_cast<std::size_t>(surface.triangles[triangle][n])];
  return p;
}

/// Shares of the three corners at a point of the triangle, by areas.
Vec3 barycentric(const std::array<Vec3, 3>& p, const Vec3& point) {
  Vec3 shares;
  for (std::size_t n = 0; n < 3; ++n)
    shares[static_cast<Eigen::Index>(n)] = (p[(n + 1) % 3] - point).cross(p[(n + 2) % 3] - point).norm();
  const double sum = shares.sum();
  return sum > 0 ? Vec3(shares / sum) : Vec3::Constant(1.0 / 3);
}

/// Samples used at each sweep: of a denser target every second, third, ... vertex.
std::size_t sample_stride(const TriangleSurface& surface, const TriangleSurface& target) {
  constexpr std::size_t kSamplesPerTriangle = 8;
  return std::max<std::size_t>(1, target.vertices.size() / (kSamplesPerTriangle * surface.triangles.size() + 1));
}

void sweep(TriangleSurface& surface, const TriangleSurface& target, const std::vector<Vec3>& target_normals) {
  const NearestSurface nearest(surface);
  std::vector<Vec3> moments(surface.vertices.size(), Vec3::Zero());
  std::vector<double> weights(surface.vertices.size(), 0.0);
  std::size_t last = 0;  // neighbouring samples follow each other: the last answer is a good guess
  const std::size_t stride = sample_stride(surface, target);
  for (std::size_t n = 0; n < target.vertices.size(); n += stride) {
    const Vec3& sample = target.vertices[n];
    const NearestSurface::Hit hit = nearest.nearest(sample, last);
    last = hit.triangle;
    if (hit.normal.dot(target_normals[n]) <= 0) continue;  // the other side of something thin
    const Vec3 shares = barycentric(corners(surface, hit.triangle), hit.place);
    for (std::size_t m = 0; m < 3; ++m) {
      const auto vertex = static_cast<std::size_t>(surface.triangles[hit.triangle][m]);
      moments[vertex] += shares[static_cast<Eigen::Index>(m)] * (sample - hit.place);
      weights[vertex] += shares[static_cast<Eigen::Index>(m)];
    }
  }
  const std::vector<Vec3> normals = surface.vertex_normals();
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (weights[v] > 0) surface.vertices[v] += normals[v] * normals[v].dot(moments[v]) / weights[v];
}

}  // namespace

TriangleSurface fitted(const TriangleSurface& surface, const TriangleSurface& target, int sweeps) {
  TriangleSurface result = surface;
  const std::vector<Vec3> normals = target.vertex_normals();
  for (int n = 0; n < sweeps; ++n) sweep(result, target, normals);
  return result;
}

}  // namespace trocar
