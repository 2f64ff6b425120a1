#include "tissue/thin/rod_on_solid.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace trocar {
namespace {

constexpr double kLeastAnchorStiffness = 1e-3;  // N/m: a load without stiffness is a long spring

}  // namespace

RodAnchor anchor_on(const SoftSolid& solid, const NodeShares& place, double stiffness_n_per_m, const Mat3& rotation) {
  RodAnchor anchor;
  for (std::size_t i = 0; i < place.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(place.node[i]);
    anchor.position += static_cast<double>(place.share[i]) * solid.position()[node].cast<double>();
    anchor.velocity += static_cast<double>(place.share[i]) * solid.velocity()[node].cast<double>();
  }
  anchor.rotation = rotation;
  anchor.stiffness_n_per_m = stiffness_n_per_m;
  return anchor;
}

std::array<SoftSpring, 3> load_springs(const AnchorLoad& load, const NodeShares& place) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(load.stiffness);
  std::array<SoftSpring, 3> springs;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    SoftSpring& spring = springs[i];
    spring.place = place;
    spring.direction = axes.eigenvectors().col(axis);
    spring.stiffness_n_per_m = std::max(axes.eigenvalues()[axis], kLeastAnchorStiffness);
    spring.stretch_m =
        -spring.direction.dot(load.force) / spring.stiffness_n_per_m - spring.direction.dot(load.expected_way);
  }
  return springs;
}

}  // namespace trocar
