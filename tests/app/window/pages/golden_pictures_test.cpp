// Pictures as they were when a person last looked at them: scope's views in each preset, and the screens.
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "app/picture/models/show_scene.h"
#include "tests/app/window/pages/loop_bench.h"
#include "tests/support/golden_picture.h"
#include "tests/support/procedural_scene.h"

namespace trocar::testing_support::golden_pictures_test {
namespace {

namespace fs = std::filesystem;

class GoldenScope : public HeadlessFixture {
 protected:
  static constexpr int kWidth = 640, kHeight = 360;
  static RenderOptions with(Preset preset) {
    return {.text_scale = 1, .scene_scale = 1, .grain = false, .preset = preset};
  }
  Image picture(const SceneView& view, Preset preset) {
    return make_renderer(with(preset)).render(view, kWidth, kHeight);
  }
  static SceneView organ() {
    SceneView view = procedural_scene();
    view.hud = Hud{};
    return view;
  }
};

TEST_F(GoldenScope, Board) {
  for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull})
    expect_golden(picture(show_scene("board"), preset), "board-" + preset_name(preset));
}

TEST_F(GoldenScope, Abdomen) {
  const SceneView abdomen = show_scene("abdomen");
  for (const Preset preset : {Preset::kLow, Preset::kSoft, Preset::kFull})
    expect_golden(picture(abdomen, preset), "abdomen-" + preset_name(preset));
  expect_golden(picture(with_fields(abdomen, "blood"), Preset::kSoft), "abdomen-blood");
  expect_golden(picture(with_fields(abdomen, "smoke"), Preset::kSoft), "abdomen-smoke");
  expect_golden(picture(with_fields(abdomen, "fog"), Preset::kSoft), "abdomen-fog");
  expect_golden(picture(with_fields(abdomen, "thirty-degree"), Preset::kSoft), "abdomen-thirty-degree");
}

TEST_F(GoldenScope, OneOrganWithTargetsAndADent) { expect_golden(picture(organ(), Preset::kSoft), "organ-soft"); }

TEST_F(GoldenScope, AMissingInstrumentIsSeen) {
  for (SceneView view : {show_scene("board"), show_scene("abdomen")}) {
    const BlockColours before = block_colours(picture(view, Preset::kSoft));
    view.X_TI.p += Vec3(1, 0, 1);
    const BlockDifference d = block_difference(before, block_colours(picture(view, Preset::kSoft)));
    std::printf("without its instrument: mean %.4f, worst block %.4f\n", d.mean, d.worst);
    EXPECT_FALSE(alike(d)) << "mean " << d.mean << ", worst block " << d.worst;
    EXPECT_GT(d.worst, 1.5 * kGoldenWorst);
  }
}

/// Shaders of the source with one passage changed.
class OtherAssets {
 public:
  OtherAssets(const fs::path& folder, const std::string& file, const std::string& passage, const std::string& instead)
      : root(folder) {
    const fs::path source = fs::path(TROCAR_SOURCE_DIR) / "assets", changed = root / "shaders" / file;
    fs::create_directories(root);
    fs::copy(source / "shaders", root / "shaders", fs::copy_options::recursive);
    std::ifstream in(changed);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto at = text.find(passage);
    EXPECT_NE(at, std::string::npos) << file << " has changed: choose another passage";
    if (at != std::string::npos) text.replace(at, passage.size(), instead);
    std::ofstream(changed) << text;
  }
  const fs::path root;
};

TEST_F(GoldenScope, AnotherLightIsSeen) {
  const test::TemporaryFolder folder;
  const OtherAssets dimmer(folder / "dimmer", "lighting.glsl", "float plain = lamp.w", "float plain = 0.85 * lamp.w");
  const OtherAssets shadeless(folder / "shadeless", "lighting.glsl", "return 0.30 + 0.70 * sum", "return 1.0");
  const SceneView view = organ(), abdomen = show_scene("abdomen");
  const auto seen = [&](const OtherAssets& other, const SceneView& of) {
    Renderer renderer(*context_, other.root, with(Preset::kSoft));
    const BlockDifference d = block_difference(block_colours(picture(of, Preset::kSoft)),
                                               block_colours(renderer.render(of, kWidth, kHeight)));
    std::printf("%s: mean %.4f, worst block %.4f\n", other.root.filename().c_str(), d.mean, d.worst);
    return d;
  };
  EXPECT_GT(seen(dimmer, view).mean, 1.5 * kGoldenMean);
  EXPECT_GT(seen(dimmer, abdomen).mean, 1.5 * kGoldenMean);
  EXPECT_FALSE(alike(seen(shadeless, abdomen))) << "no shadow is thrown any more";
}

TEST(GoldenBlocks, AreOklabOfWhatIsKnown) {
  const std::uint8_t white[] = {255, 255, 255}, red[] = {255, 0, 0}, black[] = {0, 0, 0};
  EXPECT_NEAR((oklab(white) - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-3);
  EXPECT_NEAR((oklab(red) - Eigen::Vector3d(0.628, 0.225, 0.126)).norm(), 0, 1e-3);
  EXPECT_EQ(oklab(black).norm(), 0);
  Image half(160, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 80; x < 160; ++x) std::fill_n(half.pixel(x, y), 3, std::uint8_t{255});
  EXPECT_NEAR(block_colours(half)[7].x(), 0, 1e-9);
  EXPECT_NEAR(block_colours(half)[8].x(), 1, 1e-3);
  EXPECT_NEAR(block_difference(block_colours(half), block_colours(Image(160, 90))).mean, 0.5, 1e-3);
}

class GoldenScreens : public LoopBench {
 protected:
  void SetUp() override {
    LoopBench::SetUp();
    width_ = 1280;
    height_ = 720;
  }
  Image screen(ScreenName name) {
    loop_->go(name);
    frame();
    loop_->settle(60);
    for (int i = 0; i < 3; ++i) frame();
    return loop_->picture();
  }
};

TEST_F(GoldenScreens, StartAndBriefing) {
  ASSERT_TRUE(model_->show_scene(60));
  expect_golden(screen(ScreenName::kStart), "screen-start");
  expect_golden(screen(ScreenName::kBriefing), "screen-briefing");
}

TEST_F(GoldenScreens, RunAsAPersonTakesHold) {
  ModelOptions touch = bench_.options();
  touch.exercise = "surface-touch";
  open(touch);
  ASSERT_EQ(model_->begin_attempt(), "");
  loop_->go(ScreenName::kRun);
  width_ = 320, height_ = 180;  // quick frames while the device homes
  const auto frames_until = [&](const auto& so) {
    for (int i = 0; i < 4000 && !so(); ++i) {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return so();
  };
  ASSERT_TRUE(frames_until([&] { return model_->running()->ready() && model_->running()->newest().seen; }));
  // The tip comes in from the port to where it is first held: seen once it rests there, not on its way.
  const double came_s = model_->running()->newest().t_s;
  ASSERT_TRUE(frames_until([&] { return model_->running()->newest().t_s > came_s + 2; }));
  model_->running()->pause(true);  // it looks the same however long the picture takes
  width_ = 1280, height_ = 720;
  for (int i = 0; i < 3; ++i) frame();
  expect_golden(loop_->picture(), "screen-run");
}

}  // namespace
}  // namespace trocar::testing_support::golden_pictures_test
