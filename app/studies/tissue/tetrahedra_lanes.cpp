#include "app/studies/tissue/tetrahedra_lanes.h"

#include <cstring>

#include <Eigen/LU>

namespace trocar {

std::vector<TetrahedraGroup> grouped(const PeerBody& body, std::span<const std::int32_t> order) {
  std::vector<TetrahedraGroup> groups(order.size() / kLanes);
  if (!groups.empty()) std::memset(groups.data(), 0, groups.size() * sizeof groups.front());
  for (std::size_t at = 0; at < order.size(); ++at) {
    TetrahedraGroup& group = groups[at / kLanes];
    const std::size_t l = at % kLanes;
    for (auto& corner : group.node) corner[l] = static_cast<std::int32_t>(body.mesh.nodes.size());
    if (order[at] < 0) continue;
    const auto t = static_cast<std::size_t>(order[at]);
    for (std::size_t a = 0; a < kTetrahedronCorners; ++a) group.node[a][l] = body.mesh.tetrahedra[t][a];
    const Mat3 inverse = edges_of(body.mesh, t).inverse();
    for (int i = 0; i < kAxes; ++i)
      for (int k = 0; k < kAxes; ++k) group.inverse[i][k][l] = static_cast<float>(inverse(i, k));
    const TissueSolid& material = body.material(t);
    const double mu = material.young_pa / (2 * (1 + material.poisson));
    group.volume[l] = static_cast<float>(body.volume_m3(t));
    group.mu[l] = static_cast<float>(mu);
    group.lambda[l] = static_cast<float>(2 * mu * material.poisson / (1 - 2 * material.poisson));
  }
  return groups;
}

}  // namespace trocar
