// The centrelines of a tubular label (aorta, portal vein, ducts) as a graph of points with radii.
//
// Paths of least cost through the label, cost 1 / (distance to the wall)^2 a unit of length, from the farthest voxel to
// what is already in the tree, until no voxel is left uncovered (the TEASAR scheme of Sato et al. 2000). RAS, metres.
// Same input, same graph. Thread: any, not the tick.
#pragma once

#include <array>
#include <vector>

#include "haptics/quantities.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/progress.h"

namespace trocar {

struct VesselNode {
  Vec3 place_m;
  double radius_m =
      0;  ///< of about the largest ball round the place that stays inside the label, to a third of a voxel
};

struct VesselGraph {
  std::vector<VesselNode> nodes;
  std::vector<std::array<std::int32_t, 2>> edges;  ///< from the node nearer to the root
  double length_m = 0;                             ///< of all edges
  std::size_t parts = 0;                           ///< trees: one for each part of the label of at least 8 voxels
  std::size_t ends() const;                        ///< nodes of one edge
  std::size_t branchings() const;                  ///< nodes of three and more edges
};

/// @throws InputError when the label is absent or has no part of 8 voxels
VesselGraph vessel_graph(const LabelVolume& volume, int label, const Progress& progress = {});

}  // namespace trocar
