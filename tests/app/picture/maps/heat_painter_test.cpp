// What a pixel shows, and what is painted there: a board and a sphere whose geometry is known.
#include "app/picture/maps/heat_painter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/picture/maps/colour_scale.h"

namespace trocar::heat_painter_test {
namespace {

SceneObject board(double side, double top_z) {
  SceneObject out;
  out.shape = SceneObject::Shape::kBoard;
  out.size_m = {side, side, 0.004};
  out.X_TO.p = {0, 0, top_z};
  return out;
}

Camera from(const Vec3& eye, const Vec3& at = Vec3::Zero()) {
  Camera out;
  out.eye_T = eye;
  out.look_at_T = at;
  out.up_T = Vec3::UnitY();
  return out;
}

TriangleSurface sphere(double radius) {
  TriangleSurface out;
  constexpr int kRings = 40, kParts = 80;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j <= kParts; ++j) {
      const double a = std::numbers::pi * i / kRings, b = 2 * std::numbers::pi * j / kParts;
      out.vertices.push_back(radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kParts; ++j) {
      const int a = i * (kParts + 1) + j;
      out.triangles.push_back({a, a + kParts + 1, a + 1});
      out.triangles.push_back({a + 1, a + kParts + 1, a + kParts + 2});
    }
  return out;
}

TEST(SeenPlaces, APixelsPlaceIsProjectedBackOntoIt) {
  SceneView view;
  view.objects = {board(0.1, 0)};
  const Camera camera = from({0.02, -0.09, 0.12});
  SeenPlaces seen(camera, 320, 180);
  seen.add(view);
  const ScopeOptics optics(camera, {0, 0, 320, 180});
  int boards = 0;
  for (int y = 0; y < 180; y += 3)
    for (int x = 0; x < 320; x += 3) {
      if (seen.what(x, y) != SeenPlaces::What::kBoard) continue;
      ++boards;
      EXPECT_NEAR(seen.place_T(x, y).z(), 0, 1e-9);
      const auto back = optics.project(seen.place_T(x, y));
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x(), x + 0.5, 0.35);
      EXPECT_NEAR(back->y(), y + 0.5, 0.35);
    }
  EXPECT_GT(boards, 1000);
}

TEST(SeenPlaces, WhatLiesInFrontHidesWhatLiesBehind) {
  SceneView view;
  view.organ = still_surface(sphere(0.02));
  view.objects = {board(0.1, -0.03)};
  SeenPlaces seen(from({0, 0, 0.12}), 320, 180);
  seen.add(view);
  EXPECT_EQ(seen.what(160, 90), SeenPlaces::What::kOrgan);
  EXPECT_NEAR(seen.place_T(160, 90).z(), 0.02, 3e-4) << "the near side";
  EXPECT_EQ(seen.what(160, 48), SeenPlaces::What::kBoard);
  EXPECT_EQ(seen.what(1, 1), SeenPlaces::What::kNothing) << "outside the round field";
}

/// 4 s over one place of a board, 1 s over another.
Trace two_places() {
  Trace trace;
  TraceSample a, b;
  a.tip_T = {0.02, 0, 0.01};
  b.tip_T = {-0.02, 0, 0.01};
  trace.samples.assign(4000, a);
  trace.samples.insert(trace.samples.end(), 1000, b);
  return trace;
}

TEST(HeatPainter, PaintsTheSharesOfTheTopWhereTheyWereAndLeavesTheRestGrey) {
  SceneView view;
  view.objects = {board(0.1, 0)};
  view.camera = from({0, 0, 0.12});
  const HeatFields fields(two_places(), HeatOf::kTime);
  const double top = heat_top(fields, view, {view.camera});
  EXPECT_NEAR(top, 4, 1e-9);
  Image picture(640, 360);
  std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{0});
  paint_heat(picture, view, fields, top);
  const ScopeOptics optics(view.camera, {0, 0, 640, 360});
  const auto colour_at = [&](const Vec3& place) {
    const auto at = optics.project(place);
    const std::uint8_t* p = picture.pixel(static_cast<int>(at->x()), static_cast<int>(at->y()));
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  const auto painted = [](double share) {
    const auto c = viridis(share);
    return std::array<int, 3>{int(std::lround(0.86 * c[0])), int(std::lround(0.86 * c[1])),
                              int(std::lround(0.86 * c[2]))};
  };
  EXPECT_EQ(colour_at({0.02, 0, 0}), painted(1));
  EXPECT_EQ(colour_at({-0.02, 0, 0}), painted(0.25));
  EXPECT_EQ(colour_at({0, 0.02, 0}), (std::array<int, 3>{0, 0, 0}));
}

TEST(HeatPainter, NothingToShowIsAGreyPictureWithItsScale) {
  SceneView view;
  view.objects = {board(0.1, 0)};
  view.camera = from({0, 0, 0.12});
  const HeatFields fields(two_places(), HeatOf::kForce);
  EXPECT_EQ(heat_top(fields, view, {view.camera}), 0);
  Image picture(640, 360);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = static_cast<std::uint8_t>(i * 37);
  paint_heat(picture, view, fields, 0);
  for (int x = 0; x < 640; x += 7) {
    const std::uint8_t* p = picture.pixel(x, 100);
    EXPECT_TRUE(p[0] == p[1] && p[1] == p[2]) << x;
  }
}

TEST(OverviewCamera, SeesTheWholeBoardAndTheWholeOrgan) {
  SceneView view;
  view.camera = from({0, 0, 0.02});
  EXPECT_EQ(overview_camera(view).eye_T, view.camera.eye_T) << "nothing to look over";
  view.objects = {board(0.1, -0.05)};
  view.organ = still_surface(sphere(0.05));
  const Camera camera = overview_camera(view);
  const ScopeOptics optics(camera, {0, 0, 640, 360});
  for (const Vec3& corner : board_face(view.objects[0]).vertices) {
    const auto at = optics.project(corner);
    ASSERT_TRUE(at);
    EXPECT_TRUE(at->y() >= 0 && at->y() <= 360) << at->transpose();
  }
}

TEST(BareScene, HasNoInstrumentNoGhostsNoDisplay) {
  SceneView view;
  SceneObject ghost;
  ghost.style = SceneObject::Style::kGhostLit;
  view.objects = {ghost, board(0.1, 0)};
  view.hud.title = "x";
  const SceneView bare = bare_scene(view);
  EXPECT_EQ(bare.objects.size(), 1u);
  EXPECT_TRUE(bare.hud.title.empty());
  EXPECT_GT((bare.X_TI.p - view.X_TI.p).norm(), 1);
}

}  // namespace
}  // namespace trocar::heat_painter_test
