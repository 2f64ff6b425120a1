// Static linear elasticity with ten-node tetrahedra: what the lattice's indentation stiffness is measured against.
//
// Zienkiewicz & Taylor, The Finite Element Method, vol. 1: complete quadratic displacement, straight edges, four
// Gauss points (exact where Young's modulus is constant in the element); conjugate gradients. It
// shares no code with the solver it judges. Right-handed frame of the mesh, SI. Thread: any, not
// the tick.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "tissue/solid/tetrahedra.h"

namespace trocar {

struct QuadraticMesh {
  Eigen::Matrix3Xd nodes;                     ///< m; corners first, as the tetrahedra name them, then edges' middles
  std::vector<std::array<int, 10>> elements;  ///< corners 0..3, middles of 01 12 02 03 13 23
  std::vector<std::array<int, 6>> boundary;   ///< faces of one element only: corners, middles of 01 12 02; outwards
};

/// A box cut at the given planes, six tetrahedra a cell about its diagonal from the least to the greatest corner
/// (Kuhn).
/// @param planes along x, y, z, m, rising, two or more each
TetrahedraMesh box_tetrahedra(const std::array<std::vector<double>, 3>& planes);

/// Gives straight-edged tetrahedra (of a box, or of an organ) the nodes in the middles of their edges.
/// @throws std::invalid_argument for a tetrahedron without volume
QuadraticMesh quadratic_mesh(const TetrahedraMesh& mesh);

/// One component of one node's displacement, prescribed.
struct HeldComponent {
  int node = 0, axis = 0;
  double value_m = 0;
};

struct QuadraticProblem {
  const QuadraticMesh& mesh;
  std::function<double(const Eigen::Vector3d& x_m)> young_pa;  ///< asked at Gauss points
  double poisson = 0.45;                                       ///< 0 .. 0.495
  std::vector<HeldComponent> held = {};
  Eigen::Matrix3Xd forces_n = {};  ///< on the nodes, as many columns; empty for none
  std::vector<int> bedded = {};    ///< boundary faces on springs to where they stand
  double bed_n_per_m3 = 0;         ///< of those springs, per area, the same in all directions
};

struct QuadraticSolution {
  Eigen::Matrix3Xd displacements_m, reactions_n;  ///< on the nodes; reactions are zero where nothing is held
  int iterations = 0;
};

/// Solves to a relative residual of 1e-9.
/// @throws std::runtime_error when that is not reached: too little is held, or the modulus is not positive
QuadraticSolution solve(const QuadraticProblem& problem);

/// Forces on the nodes that do the same work as a traction (N/m2, on the whole boundary, zero where it does not act).
Eigen::Matrix3Xd traction_forces(const QuadraticMesh& mesh,
                                 const std::function<Eigen::Vector3d(const Eigen::Vector3d& x_m)>& traction);

}  // namespace trocar
