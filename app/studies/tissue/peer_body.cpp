#include "app/studies/tissue/peer_body.h"

#include <Eigen/LU>

namespace trocar {

Mat3 edges_of(const TetrahedraMesh& mesh, std::size_t tetrahedron) {
  const auto& corners = mesh.tetrahedra[tetrahedron];
  Mat3 out;
  for (std::size_t a = 1; a < corners.size(); ++a)
    out.col(static_cast<Eigen::Index>(a) - 1) =
        mesh.nodes[static_cast<std::size_t>(corners[a])] - mesh.nodes[static_cast<std::size_t>(corners[0])];
  return out;
}

double PeerBody::volume_m3(std::size_t tetrahedron) const {
  return share[tetrahedron] * edges_of(mesh, tetrahedron).determinant() / 6;
}

void split_cube(const std::array<std::int32_t, 8>& corners, bool odd, std::int32_t label, TetrahedraMesh& mesh) {
  static constexpr std::array<std::array<std::array<std::size_t, 4>, 5>, 2> kParts{
      {{{{0, 3, 6, 5}, {1, 0, 5, 3}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 5, 6}}},
       {{{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 1, 7, 2}, {5, 1, 4, 7}, {6, 2, 7, 4}}}}};
  for (const auto& part : kParts[odd ? 1 : 0]) {
    mesh.tetrahedra.push_back({corners[part[0]], corners[part[1]], corners[part[2]], corners[part[3]]});
    mesh.labels.push_back(label);
  }
}

std::vector<float> masses(const PeerBody& body) {
  std::vector<double> sum(body.mesh.nodes.size() + 1, 0);
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t)
    for (const std::int32_t node : body.mesh.tetrahedra[t])
      sum[static_cast<std::size_t>(node)] += body.material(t).density_kg_m3 * body.volume_m3(t) / 4;
  return {sum.begin(), sum.end()};
}

}  // namespace trocar
