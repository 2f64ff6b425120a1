#include "app/picture/models/picture_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trocar {
namespace {

constexpr double kFlat_per_m = 15, kDeep_per_m = 190;  // curvature of folds that begin to, and fully, hold light back
constexpr double kReach_m = 0.014;                     // how far a neighbour takes light away

void put(float (&to)[3], const Vec3& from) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

}  // namespace

std::vector<float> bake_openness(const TriangleSurface& surface, const std::vector<Vec3>& normals,
                                 const SolidGrid& grid) {
  std::vector<float> openness(surface.vertices.size(), 1.0F);
  for (std::size_t i = 0; i < openness.size(); ++i) {
    double met = 0;
    for (const double step : {2.2, 3.6, 5.5})
      met += grid.density(surface.vertices[i] + normals[i] * (step * grid.cell()));
    openness[i] = static_cast<float>(std::clamp(1.0 - 0.75 * met, 0.0, 1.0));
  }
  return openness;
}

void darken_beside(std::vector<PictureVertex>& vertices, const SolidGrid& other) {
  Eigen::AlignedBox3d near = other.bounds();
  near.min().array() -= kReach_m;
  near.max().array() += kReach_m;
  for (PictureVertex& vertex : vertices) {
    const Vec3 p(vertex.position[0], vertex.position[1], vertex.position[2]);
    if (!near.contains(p)) continue;
    const Vec3 n(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
    double met = 0;
    for (const double step : {0.2, 0.45, 0.8}) met += other.density(p + n * (step * kReach_m));
    vertex.light[0] *= static_cast<float>(std::clamp(1.0 - 0.42 * met, 0.12, 1.0));
  }
}

std::vector<float> bake_creases(const TriangleSurface& surface, const std::vector<Vec3>& normals) {
  std::vector<double> rise(surface.vertices.size(), 0.0), weight(surface.vertices.size(), 0.0);
  const auto each_edge = [&](const auto& visit) {
    for (const auto& t : surface.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        visit(static_cast<std::size_t>(t[i]), static_cast<std::size_t>(t[(i + 1) % 3]));
  };
  each_edge([&](std::size_t a, std::size_t b) {
    const Vec3 along = surface.vertices[b] - surface.vertices[a];
    const double length = std::max(along.norm(), 1e-9);
    // Turn of the normal along the edge: negative where the surface folds inwards.
    rise[a] -= (normals[b] - normals[a]).dot(along) / length;
    weight[a] += length;
  });
  std::vector<double> bend(rise.size());
  for (std::size_t i = 0; i < rise.size(); ++i) bend[i] = weight[i] > 0 ? rise[i] / weight[i] : 0;
  std::vector<double> sum = bend;
  std::vector<int> count(bend.size(), 1);
  each_edge([&](std::size_t a, std::size_t b) {  // once over the neighbours, so that single vertices do not speckle
    sum[a] += bend[b];
    ++count[a];
  });
  std::vector<float> shade(bend.size());
  for (std::size_t i = 0; i < bend.size(); ++i) {
    const double per_m = sum[i] / count[i];
    shade[i] = static_cast<float>(1 - 0.72 * std::clamp((per_m - kFlat_per_m) / (kDeep_per_m - kFlat_per_m), 0.0, 1.0));
  }
  return shade;
}

std::vector<PictureVertex> bake_vertices(const TriangleSurface& surface, const SolidGrid& grid) {
  const std::vector<Vec3> normals = surface.vertex_normals();
  const std::vector<float> openness = bake_openness(surface, normals, grid), creases = bake_creases(surface, normals);
  std::vector<PictureVertex> vertices(surface.vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    put(vertices[i].position, surface.vertices[i]);
    put(vertices[i].normal, normals[i]);
    vertices[i].light[0] = openness[i] * creases[i];
  }
  return vertices;
}

PictureMesh bake_picture_mesh(const TriangleSurface& surface, const SolidGrid& grid) {
  PictureMesh mesh{bake_vertices(surface, grid), {}};
  mesh.indices.reserve(surface.triangles.size() * 3);
  for (const auto& triangle : surface.triangles)
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
