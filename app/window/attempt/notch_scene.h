// The notch of the thesis (figure 3.40): three virtual walls at the left, the right and the back of the stylus, open in
// front and above.
//
// Walls are springs of 20 N/m as in section 3.7; 150 N/m is what the passivity law of chapter 4 makes possible. The
// notch stands round the middle of the work space, where the device is good; the instrument is the stylus itself, seen
// as a shaft that comes from the front; only its tip touches. Frame T (x right, y away from the trainee, z up), m.
// Pure. Thread: any.
#pragma once

#include "app/session/setup/scene.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct Notch {
  double half_width_m = 0.020;  ///< from the middle to the left and right walls
  double back_m = 0.020;        ///< to the back wall
  double front_m = 0.026;       ///< to where the side walls end
  double half_height_m = 0.024;
  double thickness_m = 0.020;  ///< of the walls: more than the hand may push into them
  double reach_m = 0.034;      ///< how far from the middle the hand may lead the tip
};

inline constexpr double kThesisWall_n_per_m = 20;  ///< section 3.7
inline constexpr double kFirmWall_n_per_m = 150;   ///< section 4.3

enum class NotchWall : std::uint8_t { kNone, kLeft, kRight, kBack };

/// Closed, 28 triangles.
TriangleSurface notch_surface(const Notch& notch);

/// Which wall's inner side has this normal (of the contact); kNone for others: edges, front ends.
NotchWall notch_wall(const Vec3& normal_T);

/// Device, map and tool of the notch scene; nothing is graded. @throws InputError.
Scene notch_scene(const AssetRoots& assets, std::int64_t seed, const Notch& notch = {});

}  // namespace trocar
