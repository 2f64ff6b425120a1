// A scene made by formula, for tests and previews that must not depend on an organ file: a liver-like lump with
// targets, an instrument in light contact and a filled head-up display.
//
// Frame T, metres, z up. The surface's highest region lies about the origin. Thread: any.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "app/picture/models/solid_noise.h"
#include "app/picture/scene/scene_view.h"

namespace trocar::testing_support {

/// Unit sphere from an icosahedron, subdivided; 20 * 4^levels triangles, outward.
inline TriangleSurface icosphere(int levels) {
  const double g = std::numbers::phi;
  TriangleSurface s;
  for (const Vec3& v :
       {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g),
        Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)})
    s.vertices.push_back(v.normalized());
  s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    TriangleSurface fine;
    fine.vertices = s.vertices;
    std::map<std::pair<int, int>, std::int32_t> middle;
    const auto mid = [&](int a, int b) {
      const auto [place, fresh] =
          middle.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(fine.vertices.size()));
      if (fresh)
        fine.vertices.push_back(
            (s.vertices[static_cast<std::size_t>(a)] + s.vertices[static_cast<std::size_t>(b)]).normalized());
      return place->second;
    };
    for (const auto& [a, b, c] : s.triangles) {
      const std::int32_t ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
      for (const auto& t : {std::array<std::int32_t, 3>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        fine.triangles.push_back(t);
    }
    s = std::move(fine);
  }
  return s;
}

/// Lumpy ellipsoid of about 5000 triangles whose top lies near z = 0.
/// @param half_axes m; @param lump relative height of the lumps.
inline TriangleSurface lumpy_ellipsoid(const Vec3& half_axes, double lump = 0.06) {
  TriangleSurface s = icosphere(4);
  for (Vec3& v : s.vertices) {
    const Vec3 d = v;
    const double swell = 1 + lump * gradient_noise(1.6 * d.x() + 9, 1.6 * d.y() + 5, 1.6 * d.z() + 3, 64) +
                         0.35 * lump * gradient_noise(4 * d.x() + 20, 4 * d.y() + 30, 4 * d.z() + 10, 64);
    v = half_axes.cwiseProduct(d) * swell - Vec3(0, 0, half_axes.z());
  }
  return s;
}

/// Surface point straight above or below (x, y) on the upper side, with its normal; z up.
inline std::pair<Vec3, Vec3> top_of(const TriangleSurface& s, double x, double y) {
  Vec3 best(x, y, -1e9), normal = Vec3::UnitZ();
  for (const auto& [ia, ib, ic] : s.triangles) {
    const Vec3 &a = s.vertices[static_cast<std::size_t>(ia)], &b = s.vertices[static_cast<std::size_t>(ib)],
               &c = s.vertices[static_cast<std::size_t>(ic)];
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (area <= 0) continue;  // faces down
    const double u = ((b.x() - x) * (c.y() - y) - (b.y() - y) * (c.x() - x)) / area;
    const double v = ((c.x() - x) * (a.y() - y) - (c.y() - y) * (a.x() - x)) / area;
    if (u < 0 || v < 0 || u + v > 1) continue;
    const double z = u * a.z() + v * b.z() + (1 - u - v) * c.z();
    if (z > best.z()) {
      best.z() = z;
      normal = (b - a).cross(c - a).normalized();
    }
  }
  return {best, normal};
}

/// Instrument pose: tip at a point, shaft coming from the given direction.
inline Pose instrument_pose(const Vec3& tip, const Vec3& shaft_from) {
  Pose X;
  const Vec3 z = -shaft_from.normalized();
  const Vec3 x = z.cross(Vec3::UnitZ()).normalized();
  X.R.col(0) = x;
  X.R.col(1) = z.cross(x);
  X.R.col(2) = z;
  X.p = tip;
  return X;
}

inline Hud sample_hud() {
  Hud hud;
  hud.trainee = "Trainee: T-expert";
  hud.title = "E02 Surface touch \u00b7 L1";
  hud.elapsed_s = 42.3;
  hud.limit_s = 120;
  hud.bars = {{"Tip force", 1.42, 2.31, 1.0, 2.0, 5.0, 6.0}, {"Grip force", 0.0, 0.6, 2.0, 4.0, 8.0, 10.0}};
  using S = HudStep::State;
  hud.steps = {{"Hold the start sphere", S::kDone},
               {"Touch five targets, 1 to 2 N for one second", S::kCurrent},
               {"Grip the block gently", S::kOpen},
               {"Return to the start", S::kOpen}};
  hud.rows = {{"Targets", "2 / 5", ""},
              {"Path length", "312", "mm"},
              {"Wrong places", "0", ""},
              {"Too much force", "1", "x"},
              {"Time in band", "78", "%"}};
  hud.device = {{"plant", "simulated", ""}, {"loop", "1000", "Hz"}, {"passivity", "ok", ""}};
  hud.credit = "Organ: synthetic liver-like shape made by formula, no patient data";
  return hud;
}

/// The whole scene. @param material "liver", "gallbladder" or anything else.
inline SceneView procedural_scene(const std::string& material = "liver") {
  SceneView view;
  const Vec3 half = material == "gallbladder" ? Vec3(0.022, 0.045, 0.018) : Vec3(0.095, 0.070, 0.045);
  view.organ = still_surface(lumpy_ellipsoid(half));
  view.material = material;
  using S = TargetMark::State;
  const double spread = material == "gallbladder" ? 0.45 : 1.0;
  const double places[5][2] = {{-0.030, 0.004}, {-0.010, 0.022}, {0.012, -0.012}, {0.030, 0.016}, {-0.004, -0.026}};
  const S states[5] = {S::kDone, S::kDone, S::kLit, S::kWaiting, S::kWaiting};
  for (int i = 0; i < 5; ++i) {
    const auto [point, normal] = top_of(*view.organ, spread * places[i][0], spread * places[i][1]);
    view.targets.push_back({point, normal, 0.004, states[i]});
  }
  const TargetMark& lit = view.targets[2];
  view.dimple_normal_T = lit.normal_T;
  view.dimple_depth_m = 0.0022;
  view.dimple_T = lit.centre_T - lit.normal_T * view.dimple_depth_m;
  view.X_TI = instrument_pose(*view.dimple_T, Vec3(0.62, -0.28, 0.75));
  view.jaw_opening_m = 0.002;
  view.camera.eye_T = Vec3(-0.012, -0.085, 0.072);
  view.camera.look_at_T = Vec3(0.0, 0.004, -0.006);
  view.hud = sample_hud();
  return view;
}

}  // namespace trocar::testing_support
