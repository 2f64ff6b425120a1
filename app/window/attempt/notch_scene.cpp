#include "app/window/attempt/notch_scene.h"

#include <array>

#include "haptics/kinematics/device_geometry.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar {
namespace {

constexpr double kAlong = 0.9;  // cosine: a contact's normal is a wall's

constexpr double kTipOnly_m = 1e-3;

/// The shaft comes from the front and a little from above, so that it leaves the slot where that is open.
Mat3 shaft_in_theatre() {
  const Vec3 z = Vec3(-0.05, 1, -0.30).normalized(), y = (Vec3::UnitZ() - z.z() * z).normalized();
  return (Mat3() << y.cross(z), y, z).finished();
}

}  // namespace

TriangleSurface notch_surface(const Notch& n) {
  const double a = n.half_width_m, o = a + n.thickness_m, b = n.back_m, c = b + n.thickness_m, f = -n.front_m;
  // Counter-clockwise from above: left arm, round the slot, right arm, back.
  const std::array<Eigen::Vector2d, 8> outline{{{-o, f}, {-a, f}, {-a, b}, {a, b}, {a, f}, {o, f}, {o, c}, {-o, c}}};
  constexpr std::array<std::array<std::int32_t, 4>, 3> kQuads{{{0, 1, 2, 7}, {7, 2, 3, 6}, {3, 4, 5, 6}}};
  TriangleSurface surface;
  for (const double z : {-n.half_height_m, n.half_height_m})
    for (const Eigen::Vector2d& p : outline) surface.vertices.emplace_back(p.x(), p.y(), z);
  for (const auto& q : kQuads) {
    for (const auto& [i, j, k] : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
      surface.triangles.push_back({i + 8, j + 8, k + 8});
      surface.triangles.push_back({k, j, i});
    }
  }
  for (std::int32_t i = 0; i < 8; ++i) {
    const std::int32_t j = (i + 1) % 8;
    surface.triangles.push_back({i, j, j + 8});
    surface.triangles.push_back({i, j + 8, i + 8});
  }
  return surface;
}

NotchWall notch_wall(const Vec3& normal_T) {
  if (normal_T.x() > kAlong) return NotchWall::kLeft;
  if (normal_T.x() < -kAlong) return NotchWall::kRight;
  return normal_T.y() < -kAlong ? NotchWall::kBack : NotchWall::kNone;
}

Scene notch_scene(const AssetRoots& assets, std::int64_t seed, const Notch& notch) {
  AttemptSetup setup;
  setup.exercise =
      find_exercise("reach-and-orient", assets.exercises);  // its place in the theatre; its pens are not used
  setup.level = setup.exercise.levels.front().name;
  setup.seed = seed;
  setup.weak_too = true;  // the notch has a force scale of its own
  setup.realtime = true;
  setup.pace = kSimulatedLivePace;
  Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
  scene.board = {};
  scene.organ_T = still_surface(notch_surface(notch));
  scene.loop.map.force_scale = 1;
  scene.loop.tool.shaft_length_m =
      kTipOnly_m;  // what touches is the cursor, as in the thesis: a ball, so forces without moments
  scene.loop.map.X_SI.R = (scene.loop.map.X_TW.R * home_pose().R).transpose() * shaft_in_theatre();
  return scene;
}

}  // namespace trocar
