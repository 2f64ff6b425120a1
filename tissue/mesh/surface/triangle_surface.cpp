#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

std::vector<Vec3> TriangleSurface::vertex_normals() const {
  std::vector<Vec3> normals(vertices.size(), Vec3::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 doubled_area = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
    for (const auto index : {a, b, c}) normals[index] += doubled_area;
  }
  for (Vec3& normal : normals) {
    const double length = normal.norm();
    if (length > 0) normal /= length;
  }
  return normals;
}

double TriangleSurface::volume_m3() const {
  double six_volumes = 0;
  for (const auto& [a, b, c] : triangles) six_volumes += vertices[a].dot(vertices[b].cross(vertices[c]));
  return six_volumes / 6;
}

Eigen::AlignedBox3d TriangleSurface::bounds() const {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : vertices) box.extend(vertex);
  return box;
}

TriangleSurface TriangleSurface::transformed(const Pose& X) const {
  TriangleSurface moved = *this;
  for (Vec3& vertex : moved.vertices) vertex = X * vertex;
  return moved;
}

}  // namespace trocar
