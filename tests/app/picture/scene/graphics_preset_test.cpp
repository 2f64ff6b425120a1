// Presets: which one a machine gets, and what each does to the picture.
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "app/picture/scene/preset.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_preset_test {
namespace {

using testing_support::changed;
using testing_support::procedural_scene;

std::function<double(Preset)> machine(double low, double soft, double full, std::vector<Preset>* tried = nullptr) {
  return [=](Preset preset) {
    if (tried) tried->push_back(preset);
    return std::map<Preset, double>{{Preset::kLow, low}, {Preset::kSoft, soft}, {Preset::kFull, full}}.at(preset);
  };
}

TEST(ChoosePreset, TakesTheRichestThatIsQuickEnough) {
  EXPECT_EQ(choose_preset(Preset::kFull, 0.04, machine(0.001, 0.002, 0.01)), Preset::kFull);
  EXPECT_EQ(choose_preset(Preset::kFull, 0.04, machine(0.01, 0.03, 0.2)), Preset::kSoft);
  EXPECT_EQ(choose_preset(Preset::kFull, 0.04, machine(0.03, 0.09, 0.2)), Preset::kLow);
}

TEST(ChoosePreset, LowIsTheLastResortHoweverSlow) {
  EXPECT_EQ(choose_preset(Preset::kFull, 0.04, machine(5, 6, 7)), Preset::kLow);
}

TEST(ChoosePreset, NeverTriesRicherThanItMayAndStopsAtTheFirstThatFits) {
  std::vector<Preset> tried;
  EXPECT_EQ(choose_preset(Preset::kSoft, 0.04, machine(0.001, 0.002, 0.003, &tried)), Preset::kSoft);
  EXPECT_EQ(tried, std::vector<Preset>{Preset::kSoft});
  tried.clear();
  choose_preset(Preset::kFull, 0.04, machine(0.01, 0.05, 0.1, &tried));
  EXPECT_EQ(tried, (std::vector<Preset>{Preset::kFull, Preset::kSoft}));  // the last one is not worth timing
}

/// A machine on which a picture of a step takes `whole_s` times what the step draws; half of it always.
double picture_s(const PictureThrift::Step& step, double whole_s) {
  return whole_s * (0.5 + 0.5 * step.size * step.size * (step.preset == Preset::kLow ? 0.6 : 1));
}

/// @return how often what is drawn changed.
int draw_for(PictureThrift& thrift, double seconds, double whole_s) {
  int changes = 0;
  for (double t = 0; t < seconds;) {
    const double dt_s = picture_s(thrift.now(), whole_s);
    t += dt_s;
    changes += thrift.picture(dt_s) ? 1 : 0;
  }
  return changes;
}

TEST(PictureThrift, DrawsLessUntilTwentyPicturesASecondAreThere) {
  PictureThrift thrift(Preset::kSoft, Preset::kSoft);
  EXPECT_EQ(draw_for(thrift, 60, 0.040), 0) << "quick enough";
  draw_for(thrift, 6, 0.075);
  EXPECT_LT(picture_s(thrift.now(), 0.075), 0.05);
  EXPECT_LT(thrift.now().size, 1) << "size gives way";
  draw_for(thrift, 30, 0.3);
  EXPECT_EQ(thrift.now().preset, Preset::kLow) << "nothing is plainer";
  EXPECT_GT(traits_of(Preset::kLow).shadow_px, 0) << "and depth is read from its shadows still";
}

TEST(PictureThrift, ClimbsWhereThereIsTimeAndDoesNotFlicker) {
  PictureThrift thrift(Preset::kSoft, Preset::kSoft);
  draw_for(thrift, 20, 0.2);
  EXPECT_EQ(thrift.now().preset, Preset::kLow);
  draw_for(thrift, 120, 0.015);
  EXPECT_EQ(thrift.now().preset, Preset::kSoft);
  EXPECT_EQ(thrift.now().size, 1) << "no richer than it was allowed";
  // A machine on which one step is quick enough to climb from and the next too slow: tried ever more rarely.
  PictureThrift torn(Preset::kSoft, Preset::kSoft);
  int changes = 0;
  for (double t = 0; t < 600;) {
    const double dt_s = torn.now().size < 1 ? 0.018 : 0.06;
    t += dt_s;
    changes += torn.picture(dt_s) ? 1 : 0;
  }
  EXPECT_LT(changes, 16) << "in ten minutes";
}

TEST(PictureThrift, OneSlowPictureAndAStandstillSayNothing) {
  PictureThrift thrift(Preset::kSoft, Preset::kSoft);
  for (int i = 0; i < 300; ++i) ASSERT_FALSE(thrift.picture(i % 3 == 0 ? 0.2 : 0.03)) << i;
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(thrift.picture(3)) << "a hidden window";
}

TEST(PresetNames, GoBothWays) {
  for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull})
    EXPECT_EQ(preset_named(preset_name(preset)), preset);
  EXPECT_FALSE(preset_named("ultra"));
  EXPECT_FALSE(preset_named(""));
}

TEST(PresetTraits, RicherCostsMore) {
  const PresetTraits &low = traits_of(Preset::kLow), &soft = traits_of(Preset::kSoft), &full = traits_of(Preset::kFull);
  EXPECT_LT(low.shadow_px, soft.shadow_px);
  EXPECT_GT(low.shadow_px, 0);
  EXPECT_FALSE(low.glow);
  EXPECT_EQ(soft.shadow_px, 512);
  EXPECT_LT(soft.scale, full.scale);
  EXPECT_LT(soft.organ_triangles, full.organ_triangles);
}

class PresetPicture : public testing_support::HeadlessFixture {
 protected:
  static constexpr int kWidth = 640, kHeight = 360;
  static SceneView scene() {
    SceneView view = procedural_scene();
    view.hud = Hud{};
    return view;
  }
  static RenderOptions with(Preset preset) {
    RenderOptions options;
    options.grain = false;
    options.preset = preset;
    return options;
  }
};

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

/// Mean step from pixel to pixel: what fine texture and glints are made of.
double roughness(const Image& image) {
  double sum = 0;
  for (std::size_t i = 3; i < image.rgb.size(); ++i) sum += std::abs(image.rgb[i] - image.rgb[i - 3]);
  return sum / static_cast<double>(image.rgb.size());
}

TEST_F(PresetPicture, AllShowTheSameSceneInTheSameRoundField) {
  const SceneView view = scene();
  Renderer renderer = make_renderer(with(Preset::kFull));
  const Image full = renderer.render(view, kWidth, kHeight);
  for (const Preset preset : {Preset::kSoft, Preset::kLow}) {
    renderer.set_options(with(preset));
    const Image other = renderer.render(view, kWidth, kHeight);
    EXPECT_LT(mean_difference(full, other), preset == Preset::kSoft ? 9 : 30) << preset_name(preset);
    EXPECT_GT(mean_difference(full, other), 0.5);
    EXPECT_EQ(other.pixel(2, kHeight / 2)[0], 0);
    EXPECT_GT(roughness(full), roughness(other));
  }
}

TEST_F(PresetPicture, ChangedAtRunTimeEqualsChosenAtTheStart) {
  const SceneView view = scene();
  Renderer changing = make_renderer(with(Preset::kFull));
  changing.render(view, kWidth, kHeight);
  changing.set_options(with(Preset::kSoft));
  EXPECT_EQ(changing.options().preset, Preset::kSoft);
  const Image after = changing.render(view, kWidth, kHeight);
  EXPECT_EQ(after.rgb, make_renderer(with(Preset::kSoft)).render(view, kWidth, kHeight).rgb);
}

TEST_F(PresetPicture, EachThrowsTheInstrumentsShadow) {
  SceneView view = scene();
  view.targets.clear();
  view.dimple_T.reset();
  const auto share = [&](Preset preset) {
    Renderer renderer = make_renderer(with(preset));
    SceneView near = view, away = view;
    near.X_TI.p += Vec3(0, 0, 0.02);  // beyond the reach of the darkening under the shaft
    away.X_TI.p += Vec3(0.3, 0, 0.3);
    return 1.0 * changed(renderer.render(near, kWidth, kHeight), renderer.render(away, kWidth, kHeight), 12);
  };
  // The instrument's own pixels, and those of its shadow.
  EXPECT_NEAR(share(Preset::kSoft) / share(Preset::kLow), 1, 0.1);
}

TEST_F(PresetPicture, EachDrawsEveryField) {
  SceneView view = scene();
  view.smoke_per_m = 6;
  view.lens = {.fog = 0.4, .blood = 0.4, .wipe = 0.3};
  view.marks.push_back({TissueMarkKind::kBlood, view.targets[3].centre_T, 0.006, 1});
  for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull})
    EXPECT_NO_THROW(make_renderer(with(preset)).render(view, kWidth, kHeight)) << preset_name(preset);
}

TEST_F(PresetPicture, MeasuringChoosesOneOfThem) {
  const Preset chosen = measure_preset(*context_, std::string(TROCAR_SOURCE_DIR) + "/assets", 320, 240);
  EXPECT_TRUE(chosen != Preset::kFull || !context_->info().software);
}

}  // namespace
}  // namespace trocar::graphics_preset_test
