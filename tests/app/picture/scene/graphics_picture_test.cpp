// Golden pictures by property: what must be seen is seen, where the optics say it is.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/picture/display/hud_layout.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_picture_test {
namespace {

using testing_support::changed;
using testing_support::mean_at;
using testing_support::Pixel;
using testing_support::procedural_scene;

constexpr int kWidth = 960, kHeight = 540;

class PictureTest : public testing_support::HeadlessFixture {
 protected:
  static SceneView bare(const std::string& material = "liver") {
    SceneView view = procedural_scene(material);
    view.hud = Hud{};
    view.dimple_T.reset();
    view.X_TI.p += Vec3(0.2, 0, 0.2);  // out of the way
    return view;
  }
};

template <typename Wanted>
int count_near(const Image& image, const Eigen::Vector2d& at, int half, const Wanted& wanted) {
  int n = 0;
  for (int y = std::max(0, static_cast<int>(at.y()) - half);
       y <= std::min(image.height - 1, static_cast<int>(at.y()) + half); ++y)
    for (int x = std::max(0, static_cast<int>(at.x()) - half);
         x <= std::min(image.width - 1, static_cast<int>(at.x()) + half); ++x)
      n += wanted(image.pixel(x, y));
  return n;
}

bool yellow(const std::uint8_t* p) { return p[0] > 140 && p[1] > 120 && p[2] < 0.62 * p[1] && p[0] < 1.35 * p[1]; }
bool green(const std::uint8_t* p) { return p[1] > 1.25 * p[0] && p[1] > 60; }
bool blue(const std::uint8_t* p) { return p[2] > 1.12 * p[0] && p[2] > 70; }

TEST_F(PictureTest, SameSceneSameBytesAlsoFromASecondRenderer) {
  RenderOptions with_grain;
  Renderer first = make_renderer(with_grain);
  const SceneView view = procedural_scene();
  const Image a = first.render(view, kWidth, kHeight);
  const Image b = first.render(view, kWidth, kHeight);
  EXPECT_EQ(a.rgb, b.rgb);
  Renderer second = make_renderer(with_grain);
  EXPECT_EQ(a.rgb, second.render(view, kWidth, kHeight).rgb);
}

TEST_F(PictureTest, EarlierFramesLeaveNoTrace) {
  Renderer renderer = make_renderer();
  const SceneView wanted = procedural_scene("liver");
  const Image fresh = renderer.render(wanted, kWidth, kHeight);
  SceneView other = procedural_scene("gallbladder");
  other.jaw_opening_m = 0.012;
  renderer.render(other, 640, 480);
  EXPECT_EQ(renderer.render(wanted, kWidth, kHeight).rgb, fresh.rgb);
}

TEST_F(PictureTest, TargetsShowTheirStateWhereTheOpticsPutThem) {
  SceneView view = bare();
  Renderer renderer = make_renderer();
  const Image image = renderer.render(view, kWidth, kHeight);
  const ScopeOptics optics(view.camera, hud_scene_window(view.hud, kWidth, kHeight, 1));
  for (const TargetMark& mark : view.targets) {
    const auto at = optics.project(mark.centre_T);
    ASSERT_TRUE(at);
    const int half = mark.state == TargetMark::State::kLit ? 28 : 13;
    const int y = count_near(image, *at, half, yellow), g = count_near(image, *at, half, green),
              b = count_near(image, *at, half, blue);
    if (mark.state == TargetMark::State::kLit) {
      EXPECT_GT(y, 120) << g << " " << b;
    }
    if (mark.state == TargetMark::State::kDone) {
      EXPECT_GT(g, 60) << y << " " << b;
    }
    if (mark.state == TargetMark::State::kWaiting) {
      EXPECT_GE(b, 8) << y << " " << g;  // the farthest one is 30 x 8 px, seen obliquely
      EXPECT_LT(y + g, b);
    }
  }
}

TEST_F(PictureTest, StatesDifferInShapeNotOnlyInColour) {
  Renderer renderer = make_renderer();
  SceneView view = bare();
  view.targets.resize(1);
  view.camera.look_at_T = view.targets[0].centre_T;
  view.camera.eye_T = view.targets[0].centre_T + 0.06 * view.targets[0].normal_T + Vec3(0, -0.01, 0);
  const auto painted = [&](TargetMark::State state) {
    view.targets[0].state = state;
    return renderer.render(view, kWidth, kHeight);
  };
  SceneView without = view;
  without.targets.clear();
  const Image tissue = renderer.render(without, kWidth, kHeight);
  const ScopeOptics optics(view.camera, {0, 0, kWidth, kHeight});
  const auto at = [&](double radii) {  // on the surface's tangent, along the picture's horizontal
    return *optics.project(view.targets[0].centre_T + radii * view.targets[0].radius_m * optics.right());
  };
  const auto covers = [&](const Image& image, double radii) {
    const Pixel a = mean_at(image, at(radii), 1), b = mean_at(tissue, at(radii), 1);
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) > 40;
  };
  const Image waiting = painted(TargetMark::State::kWaiting), lit = painted(TargetMark::State::kLit),
              done = painted(TargetMark::State::kDone);
  EXPECT_FALSE(covers(waiting, 0));  // a ring: the tissue shows through
  EXPECT_FALSE(covers(waiting, 0.5));
  EXPECT_TRUE(covers(lit, 0));  // a dot in the middle, free between
  EXPECT_FALSE(covers(lit, 0.5));
  EXPECT_TRUE(covers(lit, 0.9));
  EXPECT_TRUE(covers(done, 0.5));  // filled
  EXPECT_FALSE(covers(done, 1.35));
  EXPECT_FALSE(covers(waiting, 1.35));
  EXPECT_GT(changed(lit, tissue, 24), 1.3 * changed(waiting, tissue, 24));  // the outer ring
}

TEST_F(PictureTest, LitTargetPulsesWithTime) {
  Renderer renderer = make_renderer();
  SceneView view = bare();
  view.hud.elapsed_s = 0.25;
  const Image wide = renderer.render(view, kWidth, kHeight);
  view.hud.elapsed_s = 0.75;
  EXPECT_GT(changed(wide, renderer.render(view, kWidth, kHeight), 20), 100);
}

TEST_F(PictureTest, InstrumentMovesThePixelsAroundIt) {
  Renderer renderer = make_renderer();
  SceneView view = procedural_scene();
  const Image before = renderer.render(view, kWidth, kHeight);
  view.X_TI.p += Vec3(0.003, 0, 0);
  const Image after = renderer.render(view, kWidth, kHeight);
  EXPECT_GT(changed(before, after, 16), 800);
  const PixelRect window = hud_scene_window(view.hud, kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = window.width; x < kWidth; ++x) ASSERT_EQ(before.pixel(x, y)[0], after.pixel(x, y)[0]);
}

TEST_F(PictureTest, JawsOpenInThePicture) {
  Renderer renderer = make_renderer();
  SceneView view = procedural_scene();
  view.X_TI.p += Vec3(0, 0, 0.02);
  view.jaw_opening_m = 0;
  const Image closed = renderer.render(view, kWidth, kHeight);
  view.jaw_opening_m = 0.012;
  EXPECT_GT(changed(closed, renderer.render(view, kWidth, kHeight), 24), 400);
}

TEST_F(PictureTest, ShadowTellsTheDistanceToTheTissue) {
  Renderer renderer = make_renderer();
  SceneView view = bare();
  const TargetMark spot = view.targets[2];
  view.targets.clear();
  const Image free = renderer.render(view, kWidth, kHeight);
  const auto darkened = [&](double gap) {
    view.X_TI = testing_support::instrument_pose(spot.centre_T + gap * spot.normal_T, Vec3(0.62, -0.28, 0.75));
    const Image image = renderer.render(view, kWidth, kHeight);
    const ScopeOptics optics(view.camera, hud_scene_window(view.hud, kWidth, kHeight, 1));
    // Tissue 4 mm to the left of the spot, where the instrument itself does not cover it.
    const auto at = optics.project(spot.centre_T + Vec3(-0.0035, 0, 0));
    return mean_at(free, *at, 2)[0] - mean_at(image, *at, 2)[0];
  };
  const double touching = darkened(0.0), near = darkened(0.004), far = darkened(0.030);
  EXPECT_GT(touching, near);
  EXPECT_GT(near, far);
  EXPECT_GT(touching, 15);
}

TEST_F(PictureTest, PressingWhitensTheTissueUnderTheTip) {
  Renderer renderer = make_renderer();
  SceneView view = bare();
  const TargetMark spot = view.targets[2];
  view.targets.clear();
  const Image rest = renderer.render(view, kWidth, kHeight);
  const auto press = [&](double depth_m) {
    view.dimple_normal_T = spot.normal_T;
    view.dimple_depth_m = depth_m;
    view.dimple_T = spot.centre_T - depth_m * spot.normal_T;
  };
  press(0.0015);
  const Image pressed = renderer.render(view, kWidth, kHeight);
  const ScopeOptics optics(view.camera, hud_scene_window(view.hud, kWidth, kHeight, 1));
  const auto at = optics.project(spot.centre_T - 0.0015 * spot.normal_T);
  const Pixel a = mean_at(rest, *at, 3), b = mean_at(pressed, *at, 3);
  EXPECT_GT(b[1], a[1] + 12);                 // blood pressed out: green and blue rise
  EXPECT_GT(b[1] / b[0], 1.2 * a[1] / a[0]);  // paler, not only brighter
  press(0.003);
  const Image deeper = renderer.render(view, kWidth, kHeight);
  EXPECT_GT(changed(rest, deeper, 10), changed(rest, pressed, 10));
}

TEST_F(PictureTest, FieldIsRoundAndBlackOutside) {
  Renderer renderer = make_renderer();
  const SceneView view = bare();
  const Image image = renderer.render(view, kWidth, kHeight);
  const ScopeOptics optics(view.camera, {0, 0, kWidth, kHeight});
  for (const double angle : {0.0, 0.3, 2.9, 3.4, 6.0}) {
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d centre(optics.circle_x(), optics.circle_y());
    const auto outside = mean_at(image, centre + (optics.circle_radius() + 6) * direction, 1);
    EXPECT_LT(outside[0] + outside[1] + outside[2], 3) << angle;
  }
  EXPECT_GT(mean_at(image, {kWidth / 2.0, kHeight / 2.0}, 20)[0], 80);
}

TEST_F(PictureTest, TissueLooksAreToldApart) {
  Renderer renderer = make_renderer();
  const auto look = [&](const std::string& material) {
    SceneView view = bare();
    view.material = material;
    view.targets.clear();
    return mean_at(renderer.render(view, kWidth, kHeight), {kWidth / 2.0, kHeight / 2.0}, 40);
  };
  const Pixel liver = look("liver"), gallbladder = look("gallbladder"), other = look("stomach"),
              spleen = look("spleen");
  EXPECT_GT(liver[0], 1.6 * liver[1]);              // red-brown
  EXPECT_LT(gallbladder[0], 1.4 * gallbladder[1]);  // pale, greenish
  EXPECT_GT(std::abs(other[1] - liver[1]), 8);
  EXPECT_GT(spleen[2], 1.3 * liver[2]);  // purple beside the liver's brown
}

TEST_F(PictureTest, SoftPresetShowsTheSameSceneCheaper) {
  const SceneView view = procedural_scene();
  const Image full = make_renderer().render(view, kWidth, kHeight);
  RenderOptions soft{.text_scale = 1, .scene_scale = 0.5, .grain = false};
  const Image half = make_renderer(soft).render(view, kWidth, kHeight);
  double difference = 0;
  for (std::size_t i = 0; i < full.rgb.size(); ++i) difference += std::abs(full.rgb[i] - half.rgb[i]);
  EXPECT_LT(difference / static_cast<double>(full.rgb.size()), 6);
}

TEST_F(PictureTest, SceneWithoutAnOrganStillDraws) {
  Renderer renderer = make_renderer();
  SceneView view = procedural_scene();
  view.organ.reset();
  EXPECT_EQ(renderer.render(view, kWidth, kHeight).width, kWidth);
}

TEST_F(PictureTest, RefusesNonsense) {
  Renderer renderer = make_renderer();
  SceneView view = procedural_scene();
  EXPECT_THROW(renderer.render(view, 100, 100), std::invalid_argument);
  view.camera.eye_T.x() = std::nan("");
  EXPECT_THROW(renderer.render(view, kWidth, kHeight), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::graphics_picture_test
