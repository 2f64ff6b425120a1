// What the peers of the soft solid compute on: linear tetrahedra with shares of tissue.
//
// Frame of the mesh, SI. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tissue/solid/tetrahedra.h"
#include "tissue/solid/tissue_material.h"

namespace trocar {

/// Columns: the edges from the first corner.
Mat3 edges_of(const TetrahedraMesh& mesh, std::size_t tetrahedron);

struct PeerBody {
  TetrahedraMesh mesh;                 ///< labels are indices into the materials
  std::vector<double> share;           ///< of each tetrahedron that is tissue
  std::vector<TissueSolid> materials;  ///< elasticity and density alone

  const TissueSolid& material(std::size_t tetrahedron) const {
    return materials[static_cast<std::size_t>(mesh.labels[tetrahedron])];
  }
  double volume_m3(std::size_t tetrahedron) const;  ///< of tissue
};

/// Adds the five tetrahedra of a cube: one amid four corners' own. In every second cube the other way, so that faces
/// meet. @param corners bits 1 = +x, 2 = +y, 4 = +z
void split_cube(const std::array<std::int32_t, 8>& corners, bool odd, std::int32_t label, TetrahedraMesh& mesh);
/// Lumped masses, kg, and one more without.
std::vector<float> masses(const PeerBody& body);

}  // namespace trocar
