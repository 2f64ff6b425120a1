#include "tissue/mesh/surface/cap_planes.h"

#include <cmath>

#include "tissue/imaging/labels/smooth_field.h"

namespace trocar {

std::vector<CapPlane> cap_planes(const LabelMask& mask, const Eigen::Affine3d& to_ras) {
  std::vector<CapPlane> caps;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const std::size_t side : {0U, 1U}) {
      const auto n = static_cast<std::size_t>(axis);
      if (!mask.cut[n][side]) continue;
      Vec3 place = Vec3::Zero();
      place[axis] = side == 0 ? kSmoothingMargin - 0.5 : mask.size[n] - kSmoothingMargin - 0.5;
      const Vec3 along = to_ras.linear().inverse().transpose().col(axis).normalized() * (side == 0 ? -1 : 1);
      caps.push_back({along, along.dot(to_ras * place)});
    }
  return caps;
}

CapKeeper::CapKeeper(const std::vector<CapPlane>& planes, const std::vector<Vec3>& vertices) : planes_(planes) {
  constexpr double kOnCapM = 2e-5;
  for (const CapPlane& plane : planes) {
    auto& flat = on_plane_.emplace_back();
    for (const Vec3& vertex : vertices) flat.push_back(std::abs(plane.normal.dot(vertex) - plane.offset_m) < kOnCapM);
  }
}

void CapKeeper::apply(std::vector<Vec3>& vertices) const {
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = kept(v, vertices[v]);
}

Vec3 CapKeeper::kept(std::size_t vertex, Vec3 place) const {
  for (std::size_t n = 0; n < planes_.size(); ++n) {
    const double beyond = planes_[n].normal.dot(place) - planes_[n].offset_m;
    if (beyond > 0 || on_plane_[n][vertex]) place -= beyond * planes_[n].normal;
  }
  return place;
}

}  // namespace trocar
