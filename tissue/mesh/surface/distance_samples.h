// Distances sampled on a surface, summed up: each sample stands for a share of the area.
#pragma once

#include <vector>

#include "tissue/mesh/surface/surface_check.h"

namespace trocar {

struct DistanceSample {
  double distance_m, area_m2;
};

SurfaceDistance weighted_by_area(std::vector<DistanceSample> samples);

}  // namespace trocar
