// Gives every organ of a complex the volume that it should enclose.
//
// The free faces of an organ move along their normals; what two organs share stays, unless an organ has hardly any free
// faces: then its neighbours give way. Vertices of curves and corners never move. Metres. Thread: any.
#pragma once

#include "tissue/mesh/complex/label_complex.h"
#include "tissue/mesh/surface/cap_planes.h"

namespace trocar {

/// @param targets_m3 of region 1, 2, ...
/// @param most_m largest step; six are made
void correct_volumes(LabelComplex& complex, const std::vector<double>& targets_m3, double most_m,
                     const CapKeeper& caps);

}  // namespace trocar
