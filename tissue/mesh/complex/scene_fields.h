// Smooths the common outline of organs that lie against each other, before their fields are compared.
//
// Labels flicker beside a contact between touching and a voxel's gap. Taken as they are, one contact comes out as many
// islands with ragged rims, whose triangles are thin and cut each other. So where two organs are near, the sum of all
// organs' fields becomes that of broader ones: their common outline is smoothed, slits close. Each organ keeps its
// share of the sum, so the interface between two organs stays where the labels put it, and a thin organ that lies on a
// thick one does not melt away. Thread: any.
#pragma once

#include "tissue/mesh/complex/label_complex.h"

namespace trocar {

/// @param broad field of each organ from a broader Gaussian, on the same samples as its own
/// @param size of the common grid
void close_slits(std::vector<RegionField>& fields, const std::vector<ScalarField>& broad,
                 const std::array<int, 3>& size);

}  // namespace trocar
