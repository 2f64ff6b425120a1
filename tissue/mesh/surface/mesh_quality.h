// Shape of the triangles of a surface: angles and edge lengths, the figures that decide whether it deforms and contacts
// well.
//
// Pure geometry. Degrees and metres. Thread: any.
#pragma once

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct MeshQuality {
  double min_angle_deg = 0;   ///< smallest angle of all triangles
  double p01_angle_deg = 0;   ///< smallest angle of a triangle: its 1 %-quantile
  double share_above_15 = 0;  ///< triangles whose smallest angle is at least 15 degrees, 0..1
  double edge_min_m = 0;
  double edge_p05_m = 0;
  double edge_median_m = 0;
  double edge_p95_m = 0;
  double edge_max_m = 0;
};

MeshQuality mesh_quality(const TriangleSurface& surface);

/// Smallest angle of each triangle, degrees; 0 where it has no area.
std::vector<double> smallest_angles_deg(const TriangleSurface& surface);

}  // namespace trocar
