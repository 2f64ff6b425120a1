// What the picture of a steered attempt shows beyond the attempt: scope, ghost, rim, guides, the left-handed layout.
#include "app/window/run/run_view.h"

#include <gtest/gtest.h>

#include <numbers>

#include "app/window/ui/hud_draw_list.h"

namespace trocar::run_view_test {
namespace {

constexpr PixelRect kPicture{0, 45, 960, 644};

Camera camera() {
  Camera camera;
  camera.eye_T = {0, -0.1, 0.1};
  camera.look_at_T = {0, 0, 0};
  return camera;
}

Eigen::Vector2d pixel(const Camera& of, const Vec3& point_T) {
  return ScopeOptics(of, kPicture).project(point_T).value();
}

TEST(MovedCamera, NothingMovedIsTheSameCamera) {
  const Camera moved = moved_camera(camera(), {});
  EXPECT_TRUE(moved.eye_T.isApprox(camera().eye_T, 1e-12));
  EXPECT_NEAR((moved.look_at_T - camera().look_at_T).norm(), 0, 1e-12);
}

TEST(MovedCamera, TurningRightMovesThingsLeftAndUpMovesThemDown) {
  const Eigen::Vector2d before = pixel(camera(), Vec3::Zero());
  Steering::ScopeMove right, up, in;
  right.yaw_rad = 0.05;
  up.pitch_rad = 0.05;
  in.depth_m = 0.02;
  EXPECT_LT(pixel(moved_camera(camera(), right), Vec3::Zero()).x(), before.x() - 10);
  EXPECT_GT(pixel(moved_camera(camera(), up), Vec3::Zero()).y(), before.y() + 10);
  const Vec3 aside(0.01, 0, 0);
  EXPECT_GT(pixel(moved_camera(camera(), in), aside).x(), pixel(camera(), aside).x()) << "nearer is larger";
  EXPECT_NEAR((moved_camera(camera(), in).eye_T - camera().eye_T).norm(), 0.02, 1e-12);
}

TEST(MovedCamera, TheScopeTurnsAboutItsPort) {
  Steering::ScopeMove far;
  far.yaw_rad = 0.3;
  far.pitch_rad = -0.2;
  const Camera moved = moved_camera(camera(), far);
  const Vec3 away = (camera().look_at_T - camera().eye_T).normalized(),
             now = (moved.look_at_T - moved.eye_T).normalized();
  const Vec3 port = camera().eye_T - 0.09 * away;
  EXPECT_NEAR((moved.eye_T - port).cross(now).norm(), 0, 1e-12) << "the line of sight still passes the port";
  EXPECT_NEAR((moved.eye_T - port).norm(), 0.09, 1e-12);
}

/// Points over a square of 80 mm, 2 mm apart, in the plane z = 0 of T.
SurfacePtr floor_T() {
  TriangleSurface floor;
  for (int i = -20; i <= 20; ++i)
    for (int k = -20; k <= 20; ++k) floor.vertices.push_back(0.002 * Vec3(i, k, 0));
  return still_surface(floor);
}

Pose far_away() { return {Mat3::Identity(), Vec3(1, 0, 0)}; }

TEST(ClearDepth, AScopeStopsBeforeWhatItWouldTouchAndNotBefore) {
  // The lens is 141 mm from the middle of the floor, looking down at 45 degrees.
  Steering::ScopeMove in;
  in.depth_m = 0.05;
  EXPECT_EQ(clear_depth(camera(), in, 0, {floor_T()}, far_away()), 0.05);
  EXPECT_EQ(clear_depth(camera(), in, 0, {}, far_away()), 0.05);
  TriangleSurface near = *floor_T();
  for (Vec3& vertex : near.vertices) vertex += Vec3(0, -0.06, 0.06);
  const double depth = clear_depth(camera(), in, 0, {still_surface(near)}, far_away());
  EXPECT_GT(depth, 0.035);
  EXPECT_LT(depth, 0.05);
  in.depth_m = depth;
  EXPECT_EQ(clear_depth(camera(), in, 0, {still_surface(near)}, far_away()), depth) << "there it may stay";
  const Vec3 eye = moved_camera(camera(), in).eye_T;
  for (const Vec3& vertex : near.vertices) EXPECT_GT((vertex - eye).norm(), 0.0029);
}

TEST(ClearDepth, ATiltedTipIsStoppedOnItsShaftNotOnItsLineOfSight) {
  Steering::ScopeMove in;
  in.depth_m = 0.05;
  TriangleSurface before_the_eye = *floor_T();
  const Vec3 sees = (camera().look_at_T - camera().eye_T).normalized();
  for (Vec3& vertex : before_the_eye.vertices) vertex = camera().eye_T + 0.04 * sees + 0.1 * vertex;
  const SurfacePtr speck = still_surface(before_the_eye);
  EXPECT_LT(clear_depth(camera(), in, 0, {speck}, far_away()), 0.04);
  EXPECT_EQ(clear_depth(camera(), in, std::numbers::pi / 6, {speck}, far_away()), 0.05) << "the shaft passes above it";
}

TEST(ClearDepth, TheInstrumentIsInTheWayToo) {
  Steering::ScopeMove in;
  in.depth_m = 0.05;
  const Vec3 sees = (camera().look_at_T - camera().eye_T).normalized();
  const Pose across{Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()).toRotationMatrix(),
                    Vec3(camera().eye_T + 0.03 * sees + Vec3(0.05, 0, 0))};  // its shaft lies along x
  EXPECT_NEAR(clear_depth(camera(), in, 0, {}, across), 0.027, 2e-3);
}

TEST(ClearDepth, WhatIsBehindThePortIsInNobodysWayAndAScopeIsDrawnBackSoFarAtMost) {
  Steering::ScopeMove in;
  in.depth_m = 0.01;
  const Vec3 sees = (camera().look_at_T - camera().eye_T).normalized();
  TriangleSurface one;
  one.vertices = {camera().eye_T - 0.1 * sees};
  EXPECT_EQ(clear_depth(camera(), in, 0, {still_surface(one)}, far_away()), 0.01);
  one.vertices = {camera().eye_T - 0.08 * sees};
  EXPECT_EQ(clear_depth(camera(), in, 0, {still_surface(one)}, far_away()), -ScopeHand::kMostDepth_m);
}

constexpr double kThirty = std::numbers::pi / 6;

Vec3 sight(const Camera& of) { return (of.look_at_T - of.eye_T).normalized(); }

TEST(MovedCamera, AThirtyDegreeScopeAtRestShowsTheSamePictureWithItsLevelTick) {
  const Camera tilted = moved_camera(camera(), {}, kThirty);
  EXPECT_NEAR((tilted.eye_T - camera().eye_T).norm(), 0, 1e-12);
  EXPECT_NEAR((tilted.look_at_T - camera().look_at_T).norm(), 0, 1e-12);
  EXPECT_NEAR(tilted.notch_rad, 0, 1e-12);
  ASSERT_TRUE(tilted.level_rad);
  EXPECT_NEAR(*tilted.level_rad, 0, 1e-12);
  EXPECT_FALSE(moved_camera(camera(), {}).level_rad) << "a straight scope at rest needs none";
}

TEST(MovedCamera, TheLightPostTurnsTheNotchAndOfAStraightScopeNothingElse) {
  Steering::ScopeMove post;
  post.post_rad = 0.7;
  const Camera turned = moved_camera(camera(), post);
  EXPECT_NEAR(turned.notch_rad, 0.7, 1e-12);
  EXPECT_NEAR((pixel(turned, {0.02, 0.01, 0}) - pixel(camera(), {0.02, 0.01, 0})).norm(), 0, 1e-6)
      << "the picture stays";
}

TEST(MovedCamera, TheLightPostTurnsAThirtyDegreeViewOnAConeAboutItsShaft) {
  Steering::ScopeMove post;
  post.post_rad = std::numbers::pi / 2;
  const Camera rest = moved_camera(camera(), {}, kThirty), turned = moved_camera(camera(), post, kThirty);
  EXPECT_NEAR((turned.eye_T - rest.eye_T).norm(), 0, 1e-12) << "the lens stays where it is";
  // Two rays of a cone of 30 degrees a quarter turn apart: cos = cos^2(30).
  EXPECT_NEAR(sight(rest).dot(sight(turned)), 0.75, 1e-12);
  EXPECT_LT(sight(turned).x(), -0.4) << "the post to the right looks to the left of the shaft";
  EXPECT_NEAR(turned.notch_rad, post.post_rad, 1e-12);
  EXPECT_LT(std::abs(*turned.level_rad), 0.2) << "the camera head is held: the horizon hardly tips";
  EXPECT_GT(std::abs(*turned.level_rad), 0.01) << "and the tick says by how much";
  post.post_rad = std::numbers::pi;
  EXPECT_NEAR(sight(rest).dot(sight(moved_camera(camera(), post, kThirty))), 0.5, 1e-12);
}

TEST(MovedCamera, NoPushOnAThirtyDegreeScopeTurnsItOverItsPort) {
  Steering::ScopeMove steep;
  steep.pitch_rad = -3;
  const Camera down = moved_camera(camera(), steep, 0);
  EXPECT_LT(sight(down).z(), -0.99);
  EXPECT_TRUE(down.level_rad) << "up can still be told";
}

TEST(Ghost, ShowsWhatTheSpringIsDrawnOutAndNothingAtRest) {
  SceneView view;
  HandIntent target;
  add_ghost(view, target);
  EXPECT_TRUE(view.objects.empty());
  target.X_TI.p = {0, 0, 0.002};
  add_ghost(view, target);
  ASSERT_EQ(view.objects.size(), 1u) << "a ring";
  EXPECT_EQ(view.objects[0].shape, SceneObject::Shape::kRing);
  EXPECT_TRUE(is_ghost(view.objects[0])) << "light passes through";
  EXPECT_TRUE(view.objects[0].X_TO.p.isApprox(target.X_TI.p));
  view.objects.clear();
  target.X_TI.p = {0.01, 0, 0};
  add_ghost(view, target);
  ASSERT_EQ(view.objects.size(), 2u) << "and a thread from the tip";
  const SceneObject& thread = view.objects[1];
  EXPECT_NEAR(thread.size_m.z(), 0.01, 1e-12);
  EXPECT_TRUE(Vec3(thread.X_TO.p - thread.X_TO.R * Vec3(0, 0, 0.005)).isZero(1e-12)) << "it begins at the tip";
}

TEST(Rim, AnArrowPointsToATipOutOfView) {
  EXPECT_FALSE(rim_angle(camera(), kPicture, Vec3::Zero()));
  const auto right = rim_angle(camera(), kPicture, {0.3, 0, 0}), left = rim_angle(camera(), kPicture, {-0.3, 0, 0});
  ASSERT_TRUE(right && left);
  EXPECT_NEAR(*right, 0, 0.3);
  EXPECT_NEAR(std::abs(*left), std::numbers::pi, 0.3);
  const auto up = rim_angle(camera(), kPicture, {0, 0.3, 0.2});
  ASSERT_TRUE(up);
  EXPECT_NEAR(*up, std::numbers::pi / 2, 0.3);
  EXPECT_TRUE(rim_angle(camera(), kPicture, {0.01, -0.25, 0.25})) << "behind the lens";
}

TEST(Rim, WhatTheFrameCutsOffAboveTheFieldIsOutOfViewToo) {
  // A point just inside the round field at 12 o'clock lies above the picture's edge: its radius is 0.64 of the height,
  // not 0.5.
  const ScopeOptics optics(camera(), kPicture);
  Vec3 point = Vec3::Zero();
  while (optics.project(point) && optics.project(point)->y() > kPicture.y - 20) point += 0.001 * optics.up();
  ASSERT_TRUE(optics.project(point));
  EXPECT_TRUE(rim_angle(camera(), kPicture, point));
}

TEST(Guides, WithoutThemOnlyTheLitTargetIsMarked) {
  SceneView view;
  for (const auto state : {TargetMark::State::kWaiting, TargetMark::State::kLit, TargetMark::State::kDone}) {
    TargetMark mark;
    mark.state = state;
    view.targets.push_back(mark);
  }
  const auto add = [&](SceneObject::Shape shape, SceneObject::Style style) {
    SceneObject object;
    object.shape = shape;
    object.style = style;
    view.objects.push_back(object);
  };
  using Shape = SceneObject::Shape;
  using Style = SceneObject::Style;
  add(Shape::kPen, Style::kGhostLit);
  add(Shape::kPen, Style::kGhost);
  add(Shape::kCylinder, Style::kGhostLit);
  add(Shape::kRing, Style::kLit);
  add(Shape::kSphere, Style::kGhostLit);
  hide_guides(view);
  ASSERT_EQ(view.targets.size(), 1u);
  EXPECT_EQ(view.targets[0].state, TargetMark::State::kLit);
  ASSERT_EQ(view.objects.size(), 3u);
  EXPECT_EQ(view.objects[0].shape, Shape::kPen);
  EXPECT_EQ(view.objects[1].shape, Shape::kRing) << "the ring to place a block in is the task, not a guide";
  EXPECT_EQ(view.objects[2].shape, Shape::kSphere) << "so is the start ball";
}

/// A display with everything that a run can show.
Hud full_hud() {
  Hud hud;
  hud.trainee = "Trainee: T-1";
  hud.title = "E02 Surface touch · L1 · direct";
  hud.limit_s = 120;
  hud.bars = {{.label = "Tip force",
               .value_n = 0.4,
               .peak_n = 0.9,
               .band_low_n = 0.4,
               .band_high_n = 0.8,
               .limit_n = 1.5,
               .full_scale_n = 2}};
  hud.dial = PoseDial{};
  hud.steps = {{"Rest at the start", HudStep::State::kDone}, {"Touch and hold each disc", HudStep::State::kCurrent}};
  hud.rows = {{"Discs held", "2 / 12", ""}};
  hud.device = {{"plant", "simulated", ""}};
  hud.notices = {{"Held near the port: draw back", HudNotice::Kind::kWarning}};
  hud.toast = "Press gently";
  hud.toast_hint = "Reach 0.4 to 0.8 N and hold.";
  hud.credit = "Organ: phantom-liver (synthetic)";
  return hud;
}

TEST(ColumnLeft, IsTheSameDisplayWithColumnAndPictureExchanged) {
  FontSet fonts;
  for (const double scale : {1.0, 1.5, 2.0}) {
    const HudLayout right = layout_hud(full_hud(), 1280, 720, scale, fonts), left = column_left(right);
    const PixelRect picture = hud_scene_window(full_hud(), 1280, 720, scale), moved = picture_right(picture, 1280);
    EXPECT_DOUBLE_EQ(left.column.x, 0);
    EXPECT_EQ(moved.x + moved.width, 1280);
    EXPECT_NEAR(moved.x, left.column.right(), 1);
    ASSERT_EQ(left.texts.size(), right.texts.size());
    int in_column = 0;
    for (std::size_t i = 0; i < left.texts.size(); ++i) {
      const HudBox& now = left.texts[i].box;
      const HudBox& was = right.texts[i].box;
      EXPECT_DOUBLE_EQ(now.y, was.y);
      EXPECT_GE(now.x, 0);
      EXPECT_LE(now.right(), 1280.5) << left.texts[i].text;
      if (was.y + 0.5 * was.height < right.column.y) {
        EXPECT_DOUBLE_EQ(now.x, was.x) << "the top bar stays";
      } else if (was.x >= right.column.x) {
        ++in_column;
        EXPECT_LE(now.right(), left.column.right() + 0.5);
      }
    }
    EXPECT_GT(in_column, 3);
  }
}

TEST(RimReach, TheArrowStaysClearOfTheMessageThatLiesInItsWay) {
  const PixelRect picture{0, 50, 960, 670};
  const double size = 26, down = -std::numbers::pi / 2;
  const HudBox toast{230, 640, 500, 66};
  const double free = rim_reach(picture, down, size, {});
  EXPECT_GT(picture.y + picture.height / 2 + free, toast.y) << "else the test says nothing";
  const double held = rim_reach(picture, down, size, {toast});
  EXPECT_LE(picture.y + picture.height / 2 + held, toast.y);
  EXPECT_GT(held, 0.6 * free) << "no further in than it must";
  EXPECT_EQ(rim_reach(picture, -down, size, {toast}), rim_reach(picture, -down, size, {}))
      << "upwards nothing is in the way";
  EXPECT_GE(rim_reach(picture, down, size, {{0, 0, 2000, 2000}}), 0) << "no way out: it is shown all the same";
}

}  // namespace
}  // namespace trocar::run_view_test
