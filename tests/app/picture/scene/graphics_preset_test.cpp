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

TEST(PresetWatch, StepsDownAfterTwentySlowPicturesInARow) {
  PresetWatch watch;
  for (int i = 1; i < PresetWatch::kInARow; ++i) ASSERT_FALSE(watch.picture(0.15, Preset::kFull)) << i;
  EXPECT_EQ(watch.picture(0.15, Preset::kFull), Preset::kSoft);
  for (int i = 1; i < PresetWatch::kInARow; ++i)
    ASSERT_FALSE(watch.picture(0.15, Preset::kSoft)) << "it counts anew: " << i;
  EXPECT_EQ(watch.picture(0.15, Preset::kSoft), Preset::kLow);
}

TEST(PresetWatch, AQuickPictureInBetweenAndAStandstillKeepThePreset) {
  PresetWatch watch;
  for (int i = 0; i < 200; ++i) ASSERT_FALSE(watch.picture(i % 19 == 0 ? 0.05 : 0.15, Preset::kSoft)) << i;
  PresetWatch slept;
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(slept.picture(3, Preset::kSoft)) << "a hidden window";
}

TEST(PresetWatch, BelowLowThereIsNothing) {
  PresetWatch watch;
  for (int i = 0; i < 100; ++i) ASSERT_FALSE(watch.picture(0.5, Preset::kLow));
}

TEST(PresetNames, GoBothWays) {
  for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull})
    EXPECT_EQ(preset_named(preset_name(preset)), preset);
  EXPECT_FALSE(preset_named("ultra"));
  EXPECT_FALSE(preset_named(""));
}

TEST(PresetTraits, RicherCostsMore) {
  const PresetTraits &low = traits_of(Preset::kLow), &soft = traits_of(Preset::kSoft), &full = traits_of(Preset::kFull);
  EXPECT_EQ(low.shadow_px, 0);
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

TEST_F(PresetPicture, LowThrowsNoShadow) {
  SceneView view = scene();
  view.targets.clear();
  view.dimple_T.reset();
  const auto share = [&](Preset preset) {
    Renderer renderer = make_renderer(with(preset));
    SceneView near = view, away = view;
    near.X_TI.p += Vec3(0, 0, 0.02);  // beyond the reach of the darkening under the shaft
    away.X_TI.p += Vec3(0.3, 0, 0.3);
    return changed(renderer.render(near, kWidth, kHeight), renderer.render(away, kWidth, kHeight), 12);
  };
  EXPECT_GT(share(Preset::kSoft),
            1.15 * share(Preset::kLow));  // the instrument's own pixels, and those of its shadow
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
