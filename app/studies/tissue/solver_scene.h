// One organ under one load, for solvers to be set side by side: what presses, what holds, what is right.
//
// An ellipsoid of 200 x 150 x 80 mm, 5 kPa, nu 0.45, on the bed of soft_organ.h, pressed in the middle of its top by a
// tent of pressure of 20 mm. So little that every law is Hooke's: 0.2 N sink 1 mm, and 0.2 % of that is the law's own
// curve. Load, bed and displacements are those of the vertices of one fine surface, embedded in every solver's mesh.
// What is right comes from ten-node tetrahedra (quadratic_reference.h). Frame as the ellipsoid's, SI. Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "app/studies/tissue/peer_body.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/solid/soft_solid.h"

namespace trocar {

enum class StiffPart : std::uint8_t {
  kNone,
  kNodule,  ///< a ball of 30 mm, 50 times as stiff, its middle 25 mm below the load
  kLayer,   ///< 15 to 25 mm below the load, from side to side, 100 times as stiff
};

struct SolverSceneOptions {
  StiffPart stiff = StiffPart::kNone;
  double force_n = 0.2;
  int rows = 60;               ///< of the surface's triangles, from pole to pole
  double reference_m = 0.006;  ///< cells of the reference's mesh
};

struct SolverScene {
  SolverSceneOptions options;
  TriangleSurface surface;
  std::vector<double> force_n, bed_n_per_m;  ///< of each vertex; the force down
  std::vector<Vec3> displacement_m;          ///< of each vertex: right
  double pressed_m = 0;                      ///< of the load, by its work: right
  int reference_nodes = 0;
};

/// @throws std::runtime_error when the reference is not found
SolverScene make_scene(const SolverSceneOptions& options);

/// Tetrahedra with the surface in them.
struct PeerMesh {
  PeerBody body;
  std::vector<NodeShares> surface;  ///< of each vertex
};
/// They fit the organ and its parts (tetrahedra_mesher.h).
PeerMesh fitted_mesh(const SolverScene& scene, double cell_m);
/// Five to each cube of the soft solid's lattice, filled as those. A cube with soft and stiff in it has the geometric
/// mean.
PeerMesh lattice_mesh(const SolverScene& scene, double edge_m);

/// The soft solid on that lattice.
struct SoftMesh {
  SoftSolid solid;
  std::vector<NodeShares> surface;
};
SoftMesh soft_mesh(const SolverScene& scene, const SoftSolidOptions& options);

}  // namespace trocar
