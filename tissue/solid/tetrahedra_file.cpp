#include <sstream>

#include "tissue/solid/tetrahedra.h"

namespace trocar {
namespace {

std::ostringstream plain_text() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  return out;
}

}  // namespace

std::string gmsh_text(const TetrahedraMesh& mesh) {
  constexpr int kTetrahedron = 4;
  auto out = plain_text();
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.nodes.size() << '\n';
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    out << n + 1 << ' ' << mesh.nodes[n].x() << ' ' << mesh.nodes[n].y() << ' ' << mesh.nodes[n].z() << '\n';
  out << "$EndNodes\n$Elements\n" << mesh.tetrahedra.size() << '\n';
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    out << t + 1 << ' ' << kTetrahedron << " 2 " << mesh.labels[t] << ' ' << mesh.labels[t];
    for (const auto node : mesh.tetrahedra[t]) out << ' ' << node + 1;
    out << '\n';
  }
  out << "$EndElements\n";
  return out.str();
}

}  // namespace trocar
