// Where a rod lies between two jaws or blades.
//
// Frame I of the instrument: z towards the tips (z = 0), x the hinge axis, jaws meet in y = 0. The space between them
// is |x| <= width / 2, |y| <= opening / 2, -length <= z <= 0. Thread: pure functions, any.
#pragma once

#include <vector>

#include "haptics/contact/tool_shape.h"
#include "tissue/thin/elastic_rod.h"

namespace trocar {

struct JawSpace {
  double length_m = 0.020, width_m = 0.005, opening_m = 0;
};

/// The axis of a rod passes through the middle plane x = 0 of the jaws.
struct RodCrossing {
  double arc_m = 0;
  Vec3 point_I = Vec3::Zero();
  double angle_rad = 0;      ///< between rod and the plane's normal, 0 straight across .. pi / 2
  double half_width_m = 0;   ///< of the rod squeezed flat, along z
  double share_between = 0;  ///< of its flat width that lies between base and tips, 0..1
  double tip_beyond_m = 0;   ///< how far the tips stand out beyond its far wall, < 0: they do not reach it
};

/// Of those whose flat width lies between the jaws at least in part, by arc.
std::vector<RodCrossing> rod_crossings(const ElasticRod& rod, const Pose& X_TI, const JawSpace& jaws);

/// Arcs of the axis within the space, its radius and `reach_m` beyond, about `spacing_m` apart, ascending.
std::vector<double> arcs_between(const ElasticRod& rod, const Pose& X_TI, const JawSpace& jaws, double reach_m,
                                 double spacing_m);

/// Length of the axis, as it is now, within the same space, m.
double length_between(const ElasticRod& rod, const Pose& X_TI, const JawSpace& jaws, double reach_m);

/// Whether the rod, looked at about every `spacing_m`, reaches into one of the tool's capsules.
bool overlaps(const ElasticRod& rod, const Pose& X_TI, const ToolCapsules& tool, double spacing_m);

/// Angle of a direction of T in the rod's material frame, from d1 towards d2, rad.
double angle_in_rod(const ElasticRod& rod, double arc_m, const Vec3& direction_T);

}  // namespace trocar
