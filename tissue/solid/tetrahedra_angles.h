// Dihedral angles of tetrahedra: moves nodes until the flattest tetrahedra stand up.
//
// Optimisation-based smoothing (Freitag and Ollivier-Gooch 1997): a node goes where the smallest dihedral angle of the
// tetrahedra round it is largest, by a pattern search, and never makes it smaller. Any length unit. Deterministic.
// Thread: any.
#pragma once

#include "tissue/solid/tetrahedra.h"

namespace trocar {

/// Moves the nodes of tetrahedra with a dihedral angle under `wanted_deg`.
/// @param reach of each node: how far it may go from where it is; 0 keeps it
void improve_angles(TetrahedraMesh& mesh, const std::vector<double>& reach, double wanted_deg);

}  // namespace trocar
