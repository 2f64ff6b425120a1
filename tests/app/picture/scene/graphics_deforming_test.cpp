// An organ that deforms: the picture follows its vertices, and what sticks to the tissue goes along.
#include <cmath>
#include <optional>
#include <vector>

#include "app/picture/maps/seen_places.h"
#include "app/picture/scene/scope_optics.h"
#include "app/picture/scene/tissue_painter.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"
#include "tissue/mesh/surface/cut_tracing.h"
#include "tissue/mesh/surface/groove.h"

namespace trocar::graphics_deforming_test {
namespace {

using testing_support::changed;
using testing_support::distance;
using testing_support::mean_at;
using testing_support::Pixel;
using testing_support::top_of;

constexpr int kWidth = 640, kHeight = 360;

double brightness(const Pixel& p) { return (p[0] + p[1] + p[2]) / 3; }

/// A broad dent of 12 mm, and everything 4 mm to the side.
Vec3 pressed(const Vec3& rest) {
  const double r2 = rest.head<2>().squaredNorm();
  return rest + Vec3(0.004, 0, -0.012 * std::exp(-r2 / (2 * 0.02 * 0.02)));
}

std::vector<Vec3> all_of(const SurfacePtr& surface, Vec3 (*moved)(const Vec3&)) {
  std::vector<Vec3> out;
  for (const Vec3& v : surface->vertices) out.push_back(moved(v));
  return out;
}

class Deforming : public testing_support::HeadlessFixture {
 protected:
  void SetUp() override {
    HeadlessFixture::SetUp();
    if (IsSkipped()) return;
    view_ = testing_support::procedural_scene();
    view_.hud = Hud{};
    view_.dimple_T.reset();
    view_.targets.clear();
    view_.X_TI.p += Vec3(0.3, 0, 0.3);
    rest_ = view_.organ;
    renderer_.emplace(make_renderer());
  }
  Image draw() { return renderer_->render(view_, kWidth, kHeight); }
  void move(Vec3 (*moved)(const Vec3&)) { view_.organ = moved_surface(rest_, all_of(rest_, moved)); }
  Eigen::Vector2d pixel(const Vec3& at) const {
    return *ScopeOptics(view_.camera, {0, 0, kWidth, kHeight}).project(at);
  }
  Vec3 spot(double x, double y) const { return top_of(*rest_, x, y).first; }
  /// Mean difference over the pixels that show the organ well inside its outline.
  double differs(const Image& a, const Image& b) const {
    constexpr int kEdge = 3;
    SeenPlaces seen(view_.camera, kWidth, kHeight);
    seen.add(view_);
    const auto organ = [&](int x, int y) { return seen.what(x, y) == SeenPlaces::What::kOrgan; };
    double sum = 0;
    int n = 0;
    for (int y = kEdge; y < kHeight - kEdge; ++y)
      for (int x = kEdge; x < kWidth - kEdge; ++x) {
        if (!organ(x - kEdge, y) || !organ(x + kEdge, y) || !organ(x, y - kEdge) || !organ(x, y + kEdge)) continue;
        sum += distance(mean_at(a, {x, y}, 0), mean_at(b, {x, y}, 0)) / 3;
        ++n;
      }
    EXPECT_GT(n, 20000);
    return sum / n;
  }
  /// Middle of the pixels in which two pictures differ.
  static Eigen::Vector2d middle_of_change(const Image& a, const Image& b) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int n = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        if (distance(mean_at(a, {x, y}, 0), mean_at(b, {x, y}, 0)) > 60) {
          sum += Eigen::Vector2d(x + 0.5, y + 0.5);
          ++n;
        }
    EXPECT_GT(n, 30);
    return sum / n;
  }

  SceneView view_;
  SurfacePtr rest_;
  std::optional<Renderer> renderer_;
};

TEST_F(Deforming, AnOrganThatHasMovedNowhereLooksAsAtRest) {
  const Image still = draw();
  move(pressed);
  draw();
  move([](const Vec3& p) { return p; });
  EXPECT_LE(changed(draw(), still, 2), 20) << "another program may round a few pixels otherwise";
}

TEST_F(Deforming, TextureGoesAlongWithTheTissue) {
  const auto aside = [](const Vec3& p) -> Vec3 { return p + Vec3(0.006, 0.003, 0.002); };
  const Image before = draw();
  move(aside);
  view_.camera.eye_T = aside(view_.camera.eye_T);
  view_.camera.look_at_T = aside(view_.camera.look_at_T);
  const Image along = draw();
  view_.organ = still_surface(*view_.organ);  // an organ that has always been here has its texture here
  const Image other = draw();
  EXPECT_LT(differs(along, before), 0.8);
  EXPECT_GT(differs(other, before), 5);
}

TEST_F(Deforming, ABentOrganIsShadedLikeOneThatWasBuiltBent) {
  move(pressed);
  const Image moved = draw();
  view_.organ = still_surface(*view_.organ);
  const Image built = draw();
  for (double y = -0.03; y <= 0.031; y += 0.012)
    for (double x = -0.036; x <= 0.037; x += 0.012) {  // squares wider than the texture, which lies elsewhere
      const Eigen::Vector2d at = pixel(pressed(spot(x, y)));
      const double a = brightness(mean_at(moved, at, 14)), b = brightness(mean_at(built, at, 14));
      EXPECT_NEAR(a, b, 0.16 * b + 2) << x << " " << y;
    }
}

TEST_F(Deforming, WhatAnOrganIsLiftedOffHasItsLightBack) {
  const auto ball = [](const Vec3& centre) {
    TriangleSurface s = testing_support::icosphere(4);
    for (Vec3& v : s.vertices) v = centre + 0.02 * v;
    return still_surface(s);
  };
  rest_ = view_.organ = ball({0.0205, 0, 0});
  view_.adjacent = {{ball({-0.0205, 0, 0}), "liver"}};
  view_.camera.eye_T = Vec3(0, 0, 0.1);
  view_.camera.look_at_T = Vec3::Zero();
  view_.camera.up_T = Vec3::UnitY();
  const auto cleft = [&] {  // of the one that stays, on the flank towards the other
    return brightness(mean_at(draw(), pixel(Vec3(-0.0205, 0, 0) + 0.02 * Vec3(0.94, 0, 0.34)), 2));
  };
  const double at_rest = cleft();
  move([](const Vec3& p) -> Vec3 { return p + Vec3(0.0001, 0, 0); });
  EXPECT_NEAR(cleft(), at_rest, 0.05 * at_rest);
  move([](const Vec3& p) -> Vec3 { return p + Vec3(0.06, 0, 0); });
  const double lifted = cleft();
  EXPECT_GT(lifted, 1.15 * at_rest);
  view_.organ = still_surface(*view_.organ);
  EXPECT_NEAR(lifted, cleft(), 0.02 * lifted) << "as if it had never lain there";
  view_.organ = rest_;
  EXPECT_NEAR(cleft(), at_rest, 0.02 * at_rest);
}

TEST_F(Deforming, MarksAndTargetsStayOnTheirPlaceOfTheTissue) {
  const Vec3 place = spot(0.004, 0.010);
  const Vec3 now = pressed(place);
  move(pressed);
  const Image plain = draw();
  view_.marks = {{TissueMarkKind::kChar, place, 0.004, 1}};
  EXPECT_LT((middle_of_change(plain, draw()) - pixel(now)).norm(), 3);
  view_.marks.clear();
  view_.targets = {{place, Vec3::UnitZ(), 0.003, TargetMark::State::kDone}};
  EXPECT_LT((middle_of_change(plain, draw()) - pixel(now)).norm(), 3);
}

TEST_F(Deforming, TheTipDentsTheSurfaceWhereItIsNow) {
  move(pressed);
  const Image plain = draw();
  const auto [at, normal] = top_of(*view_.organ, 0.01, 0.012);
  view_.dimple_normal_T = normal;
  view_.dimple_depth_m = 0.0028;
  view_.dimple_T = at - view_.dimple_depth_m * normal;
  const Image dented = draw();
  EXPECT_LT((middle_of_change(plain, dented) - pixel(at)).norm(), 12);
  EXPECT_GT(mean_at(dented, pixel(at), 2)[1], 1.2 * mean_at(plain, pixel(at), 2)[1]) << "pressed pale";
}

/// Pressed in with its whole length the instrument lies on the tissue that it dents, not in it.
TEST_F(Deforming, TheShaftDentsTheSurfaceToo) {
  move(pressed);
  const auto [at, normal] = top_of(*view_.organ, -0.01, 0.012);
  const Vec3 shaft = Vec3(1, 0, 0.05).normalized(), tip = at - 0.004 * normal;
  view_.X_TI.p = tip;
  view_.X_TI.R.col(2) = -shaft;
  view_.X_TI.R.col(0) = normal.cross(view_.X_TI.R.col(2)).normalized();
  view_.X_TI.R.col(1) = view_.X_TI.R.col(2).cross(view_.X_TI.R.col(0));
  const auto hidden = [&](bool dented) {
    view_.dimple_T = dented ? std::optional<Vec3>(tip - view_.shaft_radius_m * normal) : std::nullopt;
    view_.dimple_normal_T = normal;
    view_.dimple_depth_m = 0.012;
    const Image image = draw();
    int red = 0;  // of places along the shaft that show tissue
    for (int mm = 2; mm <= 30; ++mm) {
      const Pixel seen = mean_at(image, pixel(tip + 0.001 * mm * shaft), 1);
      red += seen[0] > 1.6 * seen[2] ? 1 : 0;
    }
    return red;
  };
  EXPECT_GT(hidden(false), 8);
  EXPECT_EQ(hidden(true), 0);
}

/// The organ with a cut of 24 mm, 7 mm deep, that runs away from the scope; its walls known as such or not.
SurfacePtr cut_open(const SurfaceSnapshot& rest, const Vec3& middle, bool known, float blood) {
  const Vec3 half(0, 0.012, 0);
  const TracedCut traced = trace_cut(rest, track_blade(middle - half, middle + half, -Vec3::UnitZ(), 0.007, 0.008));
  EXPECT_EQ(traced.refusal, CutRefusal::kNone) << refusal_words(traced.refusal);
  const Groove groove = cut_groove(rest, traced.cut);
  auto cut = std::make_shared<SurfaceSnapshot>();
  static_cast<TriangleSurface&>(*cut) = groove.surface;
  if (known) cut->inside.assign(cut->triangles.size(), false);
  for (const std::int32_t wall : groove.walls)
    if (known) cut->inside[static_cast<std::size_t>(wall)] = true;
  std::vector<SurfaceField> fields;
  if (blood > 0) fields.push_back({"blood", std::vector<float>(cut->vertices.size(), blood)});
  return moved_surface(cut, cut->vertices, std::move(fields));
}

TEST_F(Deforming, ACutIsAnOpenWoundAlsoUnderAFilmOfBlood) {
  const Vec3 middle = spot(0.002, 0.004);
  const auto seen = [&](bool known, float blood) {
    view_.organ = cut_open(*rest_, middle, known, blood);
    return draw();
  };
  const Eigen::Vector2d there = pixel(middle - Vec3(0, 0, 0.001)), beside = pixel(middle + Vec3(0.007, 0, 0));
  for (const float blood : {0.0F, 0.4F}) {
    const Image skin = seen(false, blood), open = seen(true, blood);
    EXPECT_LT(brightness(mean_at(open, there, 2)), 0.75 * brightness(mean_at(skin, there, 2))) << blood;
    EXPECT_LT(brightness(mean_at(open, there, 2)), 0.6 * brightness(mean_at(open, beside, 4))) << blood;
    EXPECT_NEAR(brightness(mean_at(open, beside, 4)), brightness(mean_at(skin, beside, 4)),
                0.15 * brightness(mean_at(skin, beside, 4)))
        << "the outside is no wound";
  }
}

TEST_F(Deforming, FieldsAreSeenWhereTheyAreAndNowhereElse) {
  const auto with = [&](const char* name) {
    std::vector<float> value;
    for (const Vec3& v : rest_->vertices) value.push_back(v.x() > 0.012 ? 1.0F : 0.0F);
    view_.organ = moved_surface(rest_, rest_->vertices, {{name, std::move(value)}});
    return draw();
  };
  move([](const Vec3& p) { return p; });
  const Image plain = draw();
  const Image blood = with("blood"), burnt = with("char"), white = with("whitening"), wet = with("wet");
  const Image other = with("temperature");
  const Eigen::Vector2d there = pixel(spot(0.032, -0.004)), elsewhere = pixel(spot(-0.02, -0.004));
  const Pixel before = mean_at(plain, there, 10);
  const auto after = [&](const Image& image) { return mean_at(image, there, 10); };
  EXPECT_LT(brightness(after(blood)), 0.85 * brightness(before));
  EXPECT_GT(after(blood)[0] / after(blood)[1], 1.3 * before[0] / before[1]);
  EXPECT_LT(brightness(after(burnt)), 0.35 * brightness(before));
  EXPECT_GT(after(white)[1], 1.5 * before[1]);
  EXPECT_GT(changed(wet, plain, 8), 3000);
  for (const Image& image : {blood, burnt, white, wet})
    EXPECT_EQ(distance(mean_at(image, elsewhere, 10), mean_at(plain, elsewhere, 10)), 0);
  EXPECT_EQ(other.rgb, plain.rgb) << "a field that has no look";
}

TEST_F(Deforming, OnlyOtherTrianglesAreBuiltAnew) {
  TissuePainter painter;
  const PresetTraits& traits = traits_of(Preset::kSoft);
  painter.prepare(view_, traits);
  const int built = painter.version();
  move(pressed);
  painter.prepare(view_, traits);
  EXPECT_EQ(painter.version(), built + 1) << "from now on its shadow is one that moves";
  for (int i = 0; i < 3; ++i) {
    move([](const Vec3& p) -> Vec3 { return 1.1 * p; });
    painter.prepare(view_, traits);
  }
  EXPECT_EQ(painter.version(), built + 1);
  view_.organ = still_surface(*rest_);
  painter.prepare(view_, traits);
  EXPECT_GT(painter.version(), built + 1);
}

TEST_F(Deforming, ACutOrganLooksTheSameWhateverWasThereBefore) {
  TriangleSurface ball = testing_support::icosphere(3);
  for (Vec3& v : ball.vertices) v = Vec3(0.06, 0.02, 0.01) + 0.015 * v;
  view_.adjacent = {{still_surface(ball), "stomach"}};
  draw();
  move(pressed);
  draw();
  TriangleSurface cut = *rest_;
  cut.triangles.resize(cut.triangles.size() - 40);
  const SurfacePtr rest_of_cut = still_surface(cut);
  view_.organ = moved_surface(rest_of_cut, all_of(rest_of_cut, pressed));
  EXPECT_EQ(draw().rgb, make_renderer().render(view_, kWidth, kHeight).rgb);
}

}  // namespace
}  // namespace trocar::graphics_deforming_test
