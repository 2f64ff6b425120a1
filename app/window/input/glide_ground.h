// What a steered tip glides over: the height of the ground under every place, and how far above it the tip stays.
//
// A hand without force feedback has two directions on a screen. Over a ground they move the tip's foot, the point
// straight below it, to what lies under the pointer; the height is then a matter of its own. Frame T, m. Thread: the
// window's.
#pragma once

#include <functional>
#include <optional>

#include "app/picture/scene/scene_view.h"

namespace trocar {

struct GlideGround {
  int number = 0;                                        ///< another number: another ground, to which the tip goes over
  std::function<double(double x_m, double y_m)> height;  ///< of what is pointed at, m, everywhere
  double clearance_m = 0;                                ///< where the tip stays over it until a person says otherwise
  std::optional<Vec3> centre_T = {};                     ///< to which the foot settles while the hand rests
  std::optional<double> level_z_m = {};  ///< the clearance is over this instead: things stand on a board
  double aside = 1;                      ///< of a movement sideways: less where it would push what stands there
  double settle_m_per_s = 0.08;          ///< to that height: slower where tissue is pressed or lifted on the way
};

/// First point of the ground on the line of sight through a point; none within reach: nothing.
std::optional<Vec3> seen_ground(const GlideGround& ground, const Camera& camera, const Vec3& through_T);

}  // namespace trocar
