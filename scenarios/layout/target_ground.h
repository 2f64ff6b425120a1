// Ground for the discs of a board: which points of a placed organ may carry one.
//
// Frame T, m. Thread: one.
#pragma once

#include <span>

#include "scenarios/exercise.h"
#include "scenarios/layout/height_field.h"
#include "scenarios/layout/shaft_room.h"

namespace trocar {

struct TargetGround {
  const HeightField& field;
  const TargetLayout& layout;            ///< slope and relief
  double centre_z = 0;                   ///< height of the region's centre
  const ShaftRoom* room = nullptr;       ///< none: only the tip is asked for
  std::span<const Vec3> strands_T = {};  ///< places of strands and ducts that open jaws are not to have between them

  /// Flat enough, the surface goes on all round it, the instrument has room behind its tip, and no strand is near.
  bool carries(const SurfacePoint& point) const;
  /// The same whatever the instrument meets.
  bool is_even(const SurfacePoint& point) const;
};

/// What a raster over the region's inside, where centres of discs may lie, finds.
struct GroundArea {
  double even_m2 = 0;  ///< that could carry discs but for the shaft
  double free_m2 = 0;  ///< and where the shaft has room
};
GroundArea ground_area(const TargetGround& ground);

/// The closest that discs may ever lie: their wrong-place rims touch.
double closest_spacing(const TargetLayout& layout);

}  // namespace trocar
