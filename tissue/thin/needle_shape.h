// The shape of a curved suture needle: an arc of a circle of round wire, tapering to a point.
//
// Frame N: origin in the circle's middle, the arc in the plane z = 0, x towards the swage, where the thread leaves.
// A place on it is an arc: metres from the swage, the length at the tip. Thread: pure functions, any.
#pragma once

#include <algorithm>
#include <numbers>

#include "haptics/quantities.h"
#include "tissue/surface_snapshot.h"

namespace trocar {

struct NeedleShape {
  double length_m = 0.026;        ///< along the arc: "26 mm, 1/2 circle", as packs of 3-0 name it
  double circle = 0.5;            ///< share of a whole circle: 1/2, 3/8
  double wire_radius_m = 0.0003;  ///< unchecked
  double taper_m = 0.006;         ///< of the point; unchecked
  double tip_radius_m = 0.00005;  ///< unchecked
  double density_kg_m3 = 7900;    ///< of steel

  double radius_m() const { return length_m / (2 * std::numbers::pi * circle); }
  double mass_kg() const { return density_kg_m3 * std::numbers::pi * wire_radius_m * wire_radius_m * length_m; }
  Vec3 place(double arc_m) const;
  Vec3 tangent(double arc_m) const;  ///< unit, towards the tip
  /// Of the wire there: less in the point.
  double radius_at(double arc_m) const;
};

/// A place beside the needle, as the needle sees it.
struct BesideNeedle {
  double arc_m = 0;      ///< of the nearest place of the whole circle: below 0 behind the swage, beyond length ahead
  double outward_m = 0;  ///< from the axis, away from the middle of the circle
  double across_m = 0;   ///< from the plane of the circle
};
BesideNeedle beside_needle(const NeedleShape& shape, const Vec3& place_N);

/// A closed tube for pictures, in frame N.
TriangleSurface needle_tube(const NeedleShape& shape, int sides = 8, int rings = 24);
/// The same where the needle is.
SurfacePtr needle_surface(const SurfacePtr& tube_N, const Pose& X_TN);

}  // namespace trocar
