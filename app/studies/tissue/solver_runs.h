// What solvers of tissue make of the same scene: error, time, energy.
//
// Ours is the soft solid on cubes; its peers are the corotational solid and XPBD, on tetrahedra. All are compiled with
// the same flags, work in floats on eight elements a vector, and hold the same in a step of 10 ms: thread CPU time of
// the solver alone. Thread: any.
#pragma once

#include <cstdint>

#include "app/studies/tissue/solver_scene.h"

namespace trocar {

enum class SolverKind : std::uint8_t { kOurs, kCorotational, kXpbd };
enum class SolverMesh : std::uint8_t { kCubes, kLattice, kFitted };

struct SolverChoice {
  SolverKind kind = SolverKind::kOurs;
  SolverMesh mesh = SolverMesh::kCubes;
  double cell_m = 0.010;
  int substeps = 1;  ///< of XPBD
};

struct SolverRun {
  SolverChoice choice;
  std::size_t nodes = 0, elements = 0;
  double step_ms = 0;        ///< median of thread CPU time
  double load_error = 0;     ///< of the load's displacement, over the right one; mean of the last half second
  double surface_error = 0;  ///< rms over the surface, over that of the right displacement
  double early = 0;          ///< the load's displacement at 0.1 s, over its mean of the last half second
  double energy_made = 0;    ///< most that the body holds beyond what the load has done, over the most that it did
};

/// The load grows for 0.1 s and stays till 1.5 s. The motion of every body is damped by 5 1/s, so that it does not
/// matter at the end how little a solver damps.
SolverRun run_ours(const SolverScene& scene, double cell_m, double step_s = 0.010);
/// @param choice of which the mesh is
SolverRun run_peer(const SolverScene& scene, const PeerMesh& mesh, const SolverChoice& choice);

/// A beam of 100 x 10 x 10 mm, 5 kPa, nu 0.45, four cubes across, one end held, drawn down at the other: at rest.
struct BeamRun {
  double over_timoshenko = 0;  ///< displacement of the end, over that of Timoshenko's beam
  double step_ms = 0;
};
/// @param choice its mesh and cell_m are not read: ours has cubes, a peer five tetrahedra to each
BeamRun run_beam(const SolverChoice& choice);

}  // namespace trocar
