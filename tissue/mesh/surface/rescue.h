// Rescue of scans that are not closed or not manifold: holes filled, or the whole wrapped. Only on request, every step
// measured.
//
// Holes: CGAL triangulate_refine_and_fair_hole (Liepa 2003). Wrap: CGAL alpha_wrap_3 (Portaneri et al. 2022), which
// encloses the input at a distance, the offset; the wrap is then pulled back by that distance as far as it does not cut
// itself. Metres. Thread: any, not the tick. Deterministic.
#pragma once

#include <string>
#include <vector>

#include "tissue/mesh/surface/surface_check.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct FilledHole {
  std::size_t edges = 0;
  double span_m = 0;   ///< diagonal of the bounding box of its rim
  double area_m2 = 0;  ///< of the patch
};

/// @param surface edges of one or two triangles only
/// @param widest_m holes with a larger span are refused
/// @param file name for messages
/// @throws InputError naming the holes that are too wide, or saying that the rims cannot be followed or filled
TriangleSurface holes_filled(const TriangleSurface& surface, double widest_m, std::vector<FilledHole>& holes,
                             const std::string& file);

struct WrapFacts {
  double volume_outside_m3 = 0;  ///< of the wrap as it was laid, one offset outside
  double volume_m3 = 0;          ///< after it was pulled back
  double pulled_back = 0;        ///< share of the offset that was taken back, 0..1
  SurfaceDistance to_input;      ///< of the result's points from the input
  SurfaceDistance
      from_input;  ///< of the input's points from the result: what the wrap passed over, or what lies within
};

/// @param soup any triangles
/// @param alpha_m gaps narrower than about this are closed over
/// @param offset_m above 0
/// @throws InputError when alpha or offset is too small for the size of the surface, or nothing is enclosed
TriangleSurface shrink_wrapped(const TriangleSurface& soup, double alpha_m, double offset_m, WrapFacts& facts,
                               const std::string& file);

}  // namespace trocar
