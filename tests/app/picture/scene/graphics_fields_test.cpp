// Every mark of a laparoscopic view, looked for in the pixels: fields of the tissue, smoke, lens, light, glints, notch.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "app/picture/scene/scope_optics.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_fields_test {
namespace {

using testing_support::changed;
using testing_support::mean_at;
using testing_support::Pixel;
using testing_support::procedural_scene;
using testing_support::top_of;

constexpr int kWidth = 640, kHeight = 360;

/// Mean absolute step between neighbouring pixels in a square: rough texture has much of it, a liquid little.
double roughness(const Image& image, const Eigen::Vector2d& at, int half) {
  double sum = 0;
  int n = 0;
  for (int y = static_cast<int>(at.y()) - half; y < static_cast<int>(at.y()) + half; ++y)
    for (int x = static_cast<int>(at.x()) - half; x < static_cast<int>(at.x()) + half; ++x, ++n)
      sum += std::abs(image.pixel(x, y)[0] - image.pixel(x + 1, y)[0]) +
             std::abs(image.pixel(x, y)[0] - image.pixel(x, y + 1)[0]);
  return sum / n;
}

double brightness(const Pixel& p) { return (p[0] + p[1] + p[2]) / 3; }

class FieldsTest : public testing_support::HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    view_ = procedural_scene();
    view_.hud = Hud{};
    view_.dimple_T.reset();
    view_.targets.clear();
    view_.X_TI.p += Vec3(0.3, 0, 0.3);
    renderer_.emplace(make_renderer());
    plain_ = draw();
  }
  Image draw() { return renderer_->render(view_, kWidth, kHeight); }
  Eigen::Vector2d pixel(const Vec3& at) const {
    return *ScopeOptics(view_.camera, {0, 0, kWidth, kHeight}).project(at);
  }
  Vec3 spot(double x, double y) const { return top_of(*view_.organ, x, y).first; }
  Image marked(TissueMarkKind kind, const Vec3& at, double radius_m = 0.007, double strength = 1) {
    view_.marks = {{kind, at, radius_m, strength}};
    return draw();
  }

  SceneView view_;
  std::optional<Renderer> renderer_;
  Image plain_;
};

TEST_F(FieldsTest, BloodIsDarkRedAndSmooth) {
  const Vec3 at = spot(0.006, -0.014);
  const Image image = marked(TissueMarkKind::kBlood, at);
  const Pixel before = mean_at(plain_, pixel(at), 8), after = mean_at(image, pixel(at), 8);
  EXPECT_LT(brightness(after), 0.85 * brightness(before));
  EXPECT_GT(after[0] / after[1], 1.3 * before[0] / before[1]);
  EXPECT_LT(roughness(image, pixel(at), 8), 0.7 * roughness(plain_, pixel(at), 8));
}

TEST_F(FieldsTest, CharIsBlackInTheMiddleWithABrownRim) {
  const Vec3 at = spot(0.0, 0.0);
  const Image image = marked(TissueMarkKind::kChar, at, 0.008);
  const Pixel core = mean_at(image, pixel(at), 3), before = mean_at(plain_, pixel(at), 3);
  EXPECT_LT(brightness(core), 0.35 * brightness(before));
  EXPECT_LT(core[0] - core[2], 40);  // grey, not red
  const auto rim = pixel(spot(0.0095, 0.0));
  EXPECT_GT(mean_at(image, rim, 2)[1], mean_at(plain_, rim, 2)[1]);  // singed pale beyond the crust
}

TEST_F(FieldsTest, WhiteningIsPaleAndFollowsItsStrength) {
  const Vec3 at = spot(0.0, 0.0);
  const Pixel before = mean_at(plain_, pixel(at), 4);
  const Pixel half = mean_at(marked(TissueMarkKind::kWhitening, at, 0.008, 0.4), pixel(at), 4);
  const Pixel full = mean_at(marked(TissueMarkKind::kWhitening, at, 0.008, 1), pixel(at), 4);
  EXPECT_GT(full[1], 1.5 * before[1]);
  EXPECT_LT(full[0] / full[1], 0.75 * before[0] / before[1]);
  EXPECT_GT(half[1], before[1]);
  EXPECT_LT(half[1], full[1]);
}

TEST_F(FieldsTest, WetTissueIsDarkerAsideAndGlossierFacingTheLamp) {
  const auto levels = [&](const Image& from, const Vec3& at) {
    std::vector<int> out;
    for (int y = -12; y <= 12; ++y)
      for (int x = -12; x <= 12; ++x)
        out.push_back(from.pixel(static_cast<int>(pixel(at).x()) + x, static_cast<int>(pixel(at).y()) + y)[1]);
    std::sort(out.begin(), out.end());
    return out;
  };
  const Vec3 facing = spot(0.0, -0.03), aside = spot(0.040, 0.030);
  const std::vector<int> dry = levels(plain_, facing),
                         wet = levels(marked(TissueMarkKind::kWet, facing, 0.014), facing);
  EXPECT_GT(wet[wet.size() * 97 / 100], dry[dry.size() * 97 / 100]);
  const std::vector<int> dull = levels(plain_, aside), dark = levels(marked(TissueMarkKind::kWet, aside, 0.014), aside);
  EXPECT_LT(dark[dark.size() / 4], dull[dull.size() / 4]);
}

TEST_F(FieldsTest, AMarkChangesNothingBeyondItsReach) {
  const Vec3 at = spot(0.0, 0.0);
  const Image image = marked(TissueMarkKind::kBlood, at, 0.004);
  const Eigen::Vector2d centre = pixel(at);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if ((Eigen::Vector2d(x, y) - centre).norm() > 90) {
        ASSERT_LE(std::abs(image.pixel(x, y)[0] - plain_.pixel(x, y)[0]), 3) << x << " " << y;
      }
}

TEST_F(FieldsTest, MarksOfNoStrengthAndClearAirLeaveThePictureAlone) {
  EXPECT_LE(changed(marked(TissueMarkKind::kBlood, spot(0, 0), 0.006, 0), plain_, 2), 0);
  view_.marks.clear();
  view_.lens.wipe = 0.5;  // nothing on the lens to wipe
  EXPECT_EQ(draw().rgb, plain_.rgb);
}

TEST_F(FieldsTest, MoreMarksThanThereIsRoomForAreDrawnAsFarAsItGoes) {
  for (int i = 0; i < 3 * kMaxTissueMarks; ++i)
    view_.marks.push_back({TissueMarkKind::kBlood, spot(0.0005 * i, 0), 0.003, 1});
  EXPECT_GT(changed(draw(), plain_, 20), 200);
}

TEST_F(FieldsTest, SmokePalesTheFarMoreThanTheNear) {
  const Eigen::Vector2d near(kWidth / 2.0, 0.85 * kHeight), far(kWidth / 2.0, 0.10 * kHeight);
  view_.smoke_per_m = 6;
  const Image image = draw();
  const auto lost_contrast = [&](const Eigen::Vector2d& at) {
    const Pixel before = mean_at(plain_, at, 12), after = mean_at(image, at, 12);
    return (before[0] - before[2]) - (after[0] - after[2]);  // red tissue turns grey
  };
  const double far_share = lost_contrast(far) / (mean_at(plain_, far, 12)[0] - mean_at(plain_, far, 12)[2]);
  const double near_share = lost_contrast(near) / (mean_at(plain_, near, 12)[0] - mean_at(plain_, near, 12)[2]);
  EXPECT_GT(far_share, 1.2 * near_share);
  EXPECT_GT(near_share, 0.1);
  EXPECT_GT(brightness(mean_at(image, far, 12)), brightness(mean_at(plain_, far, 12)) + 10);
  view_.smoke_per_m = 12;
  EXPECT_GT(mean_at(draw(), far, 12)[2], mean_at(image, far, 12)[2]);
}

TEST_F(FieldsTest, FogBlursAndAWipeClearsFromTheLeft) {
  view_.lens.fog = 0.9;
  const Image fogged = draw();
  const Eigen::Vector2d left(0.42 * kWidth, 0.80 * kHeight), right(0.62 * kWidth, 0.80 * kHeight);
  for (const auto& at : {left, right}) EXPECT_LT(roughness(fogged, at, 14), 0.6 * roughness(plain_, at, 14));
  view_.lens.wipe = 0.5;
  const Image half = draw();
  EXPECT_GT(roughness(half, left, 14), 0.75 * roughness(plain_, left, 14));
  EXPECT_LT(roughness(half, right, 14), 0.6 * roughness(plain_, right, 14));
  view_.lens.wipe = 1;
  EXPECT_LE(changed(draw(), plain_, 2), 0);
}

TEST_F(FieldsTest, BloodOnTheLensReddensAndHides) {
  view_.lens.blood = 1;
  const Image image = draw();
  double red = 0, others = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    red += image.rgb[i];
    others += 0.5 * (image.rgb[i + 1] + image.rgb[i + 2]);
  }
  double red_before = 0, others_before = 0;
  for (std::size_t i = 0; i < plain_.rgb.size(); i += 3) {
    red_before += plain_.rgb[i];
    others_before += 0.5 * (plain_.rgb[i + 1] + plain_.rgb[i + 2]);
  }
  EXPECT_LT(red + 2 * others, 0.85 * (red_before + 2 * others_before));
  EXPECT_GT(red / others, 1.2 * red_before / others_before);
}

TEST_F(FieldsTest, LightFallsOffWithDepthAndTowardsTheRim) {
  const double middle = brightness(mean_at(plain_, {kWidth / 2.0, 0.6 * kHeight}, 16));
  EXPECT_LT(brightness(mean_at(plain_, {kWidth / 2.0, 0.05 * kHeight}, 8)), 0.75 * middle);
  EXPECT_LT(brightness(mean_at(plain_, {0.18 * kWidth, 0.6 * kHeight}, 8)), 0.75 * middle);
}

TEST_F(FieldsTest, GlintsMoveWithTheScopeThoughTheTissueStays) {
  // The same point of tissue is looked up in two pictures: albedo would stay, glints do not.
  const auto glints = [&](const Image& image) {
    std::vector<double> out;
    for (double x = -0.012; x <= 0.012; x += 0.0006)
      for (double y = -0.034; y <= -0.018; y += 0.0008) {
        const Eigen::Vector2d at = pixel(spot(x, y));
        const std::uint8_t* p = image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()));
        out.push_back(std::min(p[1], p[2]));
      }
    return out;
  };
  const std::vector<double> before = glints(plain_);
  view_.camera.eye_T += Vec3(0.018, 0, 0);
  const std::vector<double> after = glints(draw());
  int bright = 0, gone = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    bright += before[i] > 120;
    gone += before[i] > 120 && after[i] < 0.65 * before[i];
  }
  EXPECT_GT(bright, 15);
  EXPECT_GT(gone, bright / 4);
}

TEST_F(FieldsTest, TheNotchTurnsWithTheScopeAndTheTickShowsUp) {
  view_.camera.notch_rad = std::numbers::pi / 2;  // at 3 o'clock, where the frame shows the rim
  const Image image = draw();
  const ScopeOptics optics(view_.camera, {0, 0, kWidth, kHeight});
  const Eigen::Vector2d at(optics.circle_x() + 0.985 * optics.circle_radius(), optics.circle_y());
  EXPECT_EQ(mean_at(image, at, 0)[0], 0);
  EXPECT_GT(mean_at(plain_, at, 0)[0], 0);
  EXPECT_GT(mean_at(image, {kWidth / 2.0, 2}, 0)[0], 0);  // no longer at 12 o'clock
  view_.camera.notch_rad = 0;
  view_.camera.level_rad = -std::numbers::pi / 2;
  const Image level = draw();
  const Eigen::Vector2d tick(optics.circle_x() - 0.982 * optics.circle_radius(), optics.circle_y());
  EXPECT_GT(brightness(mean_at(level, tick, 0)), 110);
  EXPECT_LT(changed(level, plain_, 8), 40);
}

TEST_F(FieldsTest, BreathMovesTheOrganInThePicture) {
  view_.breath_T = Vec3(0, 0, 0.003);
  EXPECT_GT(changed(draw(), plain_, 12), 3000);
}

TEST_F(FieldsTest, ASecondInstrumentIsDrawnWhereItIs) {
  InstrumentView second;
  second.X_TI = testing_support::instrument_pose(spot(-0.02, 0.0) + Vec3(0, 0, 0.006), Vec3(-0.62, -0.28, 0.75));
  view_.more_instruments.push_back(second);
  const Image image = draw();
  const Eigen::Vector2d neck = pixel(second.X_TI * Vec3(0, 0, -0.035));
  EXPECT_LT(brightness(mean_at(image, neck, 1)), 70);  // the black sheath
  EXPECT_GT(changed(image, plain_, 16), 1500);
}

TEST_F(FieldsTest, GrainIsTheSameForTheSameMomentAndOffWhenAsked) {
  EXPECT_EQ(draw().rgb, plain_.rgb);
  RenderOptions grainy;
  renderer_->set_options(grainy);
  const Image a = draw(), b = draw();
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_GT(changed(a, plain_, 0), 20000);
  view_.hud.elapsed_s += 0.02;
  EXPECT_GT(changed(a, draw(), 0), 20000);
}

}  // namespace
}  // namespace trocar::graphics_fields_test
