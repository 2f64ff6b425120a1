// Shapes of the show scene as distance functions: what lies under the liver where a gallbladder is taken out.
//
// Frame T, m, z up, scope from -y. Negative inside. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/picture/models/implicit_surface.h"

namespace trocar {

struct ShowOrgan {
  std::string material;
  Distance distance;
  Eigen::AlignedBox3d box;  ///< the shape lies within
  double cell_m;            ///< grid that shows its form
};

/// Gallbladder first. @param seed of lumps and lobes.
std::vector<ShowOrgan> show_anatomy(std::uint64_t seed);

}  // namespace trocar
