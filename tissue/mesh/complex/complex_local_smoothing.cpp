#include <algorithm>

#include "tissue/mesh/complex/complex_mesh.h"
#include "tissue/mesh/complex/complex_remesh.h"

namespace trocar {

void smooth_locally(LabelComplex& complex, const std::vector<std::int32_t>& triangles) {
  const ComplexMesh mesh(complex);
  std::vector<ComplexMesh::Index> near;
  for (const ComplexMesh::Index t : triangles)
    for (const ComplexMesh::Index corner : mesh.triangle(t)) {
      const auto round = mesh.neighbours(corner);
      near.insert(near.end(), round.begin(), round.end());
    }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (const ComplexMesh::Index v : near) {
    auto round = mesh.curve_neighbours(v);
    if (!round.empty() && round.size() != 2) continue;
    if (round.empty()) round = mesh.neighbours(v);
    Vec3 middle = Vec3::Zero();
    for (const ComplexMesh::Index other : round) middle += mesh.place(other) / static_cast<double>(round.size());
    complex.vertices[static_cast<std::size_t>(v)] = (mesh.place(v) + middle) / 2;
  }
}

}  // namespace trocar
