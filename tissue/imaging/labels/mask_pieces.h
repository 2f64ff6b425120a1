// The pieces of a mask that hang together over voxel faces, in time and memory that do not depend on how many there
// are.
//
// A window of values over noise gives millions of pieces; every voxel is visited a fixed number of times all the same.
// Masks hold 0 and 1, i fastest. Same input, same bytes. Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "tissue/imaging/labels/itk_region.h"
#include "tissue/progress.h"

namespace trocar {

/// Keeps the largest piece, of several equal ones the first. @returns sizes of all pieces, largest first
std::vector<std::size_t> keep_largest(std::vector<std::uint8_t>& mask, const RegionShape& shape,
                                      const Progress& progress = {});

/// Background that does not reach the block's border joins the mask. @returns voxels filled
std::size_t fill_holes(std::vector<std::uint8_t>& mask, const RegionShape& shape, const Progress& progress = {});

/// Tunnels through a mask of one piece without cavities: 1 - (voxels - faces between them + squares of four - blocks of
/// eight), its Euler number as a complex of voxel centres (Kong and Rosenfeld 1989). A ball has none, a ring one, a
/// sponge thousands.
std::int64_t tunnels_of(const std::vector<std::uint8_t>& mask, const RegionShape& shape);

}  // namespace trocar
