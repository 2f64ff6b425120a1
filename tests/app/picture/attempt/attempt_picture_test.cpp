// From a moment of a session to what a picture of it shows; and numbered frames at their rate.
#include "app/picture/attempt/attempt_picture.h"

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::attempt_picture_test {
namespace {

const Scene& scene() {
  static const Scene built = [] {
    const AssetRoots assets = find_assets();
    AttemptSetup setup;
    setup.exercise = find_exercise("surface-touch", assets.exercises);
    setup.organ = "phantom-liver";
    setup.hand = "expert";
    setup.board = 2;
    return build_scene(setup, assets, {"simulated", 1000, 16});
  }();
  return built;
}

/// A director at its beginning and a tick that tests may edit.
struct Moment {
  Director director{scene().setup.exercise, scene().level, scene().board};
  TickRecord record;
  SessionView at(double t_s) const { return {scene(), record, director, t_s}; }
  SceneView seen(const std::string& trainee = "T-1") const { return attempt_view(at(0), trainee); }
};

const HudRow& row(const std::vector<HudRow>& rows, const std::string& name) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const HudRow& one) { return one.name == name; });
  if (found == rows.end()) throw std::runtime_error("no row " + name);
  return *found;
}

TEST(AttemptView, ShowsEveryTargetOfTheBoardWhereItLies) {
  const SceneView view = Moment().seen();
  ASSERT_EQ(view.targets.size(), scene().board.targets.size());
  for (std::size_t i = 0; i < view.targets.size(); ++i) {
    EXPECT_EQ(view.targets[i].centre_T, scene().board.targets[i].centre_T);
    EXPECT_EQ(view.targets[i].radius_m, scene().board.targets[i].radius_m);
    EXPECT_EQ(view.targets[i].state, TargetMark::State::kWaiting) << "nothing is lit before the start";
  }
}

TEST(AttemptView, ShowsTheInstrumentOfTheTick) {
  Moment moment;
  moment.record.stylus.X_TI.p = Vec3(0.01, -0.02, 0.03);
  moment.record.stylus.jaw_opening_m = 0.012;
  const SceneView view = moment.seen();
  EXPECT_EQ(view.X_TI.p, moment.record.stylus.X_TI.p);
  EXPECT_EQ(view.jaw_opening_m, 0.012);
  EXPECT_EQ(view.shaft_radius_m, scene().loop.tool.radius_m);
  EXPECT_EQ(view.material, scene().organ.material);
}

TEST(AttemptView, DentsTheTissueOnlyWhileTouching) {
  Moment moment;
  moment.record.stylus.X_TI.p = Vec3(0.01, 0, 0.002);
  moment.record.stylus.depth_m = 0.004;
  EXPECT_FALSE(moment.seen().dimple_T);
  moment.record.stylus.contact = true;
  ASSERT_TRUE(moment.seen().dimple_T);
  EXPECT_LT((*moment.seen().dimple_T - Vec3(0.01, 0, 0.002 - scene().loop.tool.radius_m)).norm(), 1e-12);
  EXPECT_EQ(moment.seen().dimple_depth_m, 0.004);
}

TEST(AttemptView, ForceBarsCarryTheBandOfTheLevel) {
  Moment moment;
  moment.record.stylus.F_I_T.force = Vec3(0.3, 0, 0.4);
  moment.record.stylus.grip_force_n = 1.25;
  const Hud hud = moment.seen().hud;
  ASSERT_EQ(hud.bars.size(), 2u);
  EXPECT_NEAR(hud.bars[0].value_n, 0.5, 1e-15);
  EXPECT_EQ(hud.bars[0].band_low_n, scene().level.band_low_n);
  EXPECT_EQ(hud.bars[0].band_high_n, scene().level.band_high_n);
  EXPECT_EQ(hud.bars[0].limit_n, scene().setup.exercise.hard_force_n);
  EXPECT_GT(hud.bars[0].full_scale_n, hud.bars[0].limit_n);
  EXPECT_EQ(hud.bars[1].value_n, 1.25);
}

TEST(AttemptView, ALevelThatHidesTheForceKeepsItsPlaceButNotItsValue) {
  Scene hidden = scene();
  hidden.level.force_display = "after";
  const Moment moment;
  const SceneView view = attempt_view({hidden, moment.record, moment.director, 0}, "");
  ASSERT_EQ(view.hud.bars.size(), 2u);
  for (const ForceBar& bar : view.hud.bars) {
    EXPECT_TRUE(bar.hidden) << bar.label;
    EXPECT_EQ(bar.hidden_note, "shown after the run");
  }
  EXPECT_TRUE(view.hud.notices.empty());
}

TEST(AttemptView, TheHudNamesTraineeExerciseDeviceAndOrgan) {
  Moment moment;
  moment.record.winding_c = 41.6;
  const Hud hud = moment.seen("T-7").hud;
  EXPECT_EQ(hud.trainee, "Trainee: T-7");
  EXPECT_EQ(moment.seen("").hud.trainee, "Guest");
  EXPECT_EQ(hud.title, "E02 Surface touch · L1 · direct");
  EXPECT_EQ(row(hud.rows, "Discs held").value, "0 / 12");
  EXPECT_EQ(row(hud.device, "loop").value, "1000");
  EXPECT_EQ(row(hud.device, "passivity").value, "ok");
  EXPECT_EQ(row(hud.device, "motor heat").value, "42");
  EXPECT_NE(hud.credit.find("(synthetic)"), std::string::npos) << hud.credit;
  moment.record.stylus.passivity_active = true;
  EXPECT_EQ(row(moment.seen().hud.device, "passivity").value, "acting");
}

TEST(AttemptView, TheFirstStepIsCurrentAtTheBeginning) {
  const Hud hud = Moment().seen().hud;
  ASSERT_EQ(hud.steps.size(), 3u);
  EXPECT_EQ(hud.steps[0].state, HudStep::State::kCurrent);
  EXPECT_EQ(hud.steps[1].state, HudStep::State::kOpen);
  EXPECT_EQ(hud.steps[2].state, HudStep::State::kOpen);
}

TEST(AttemptView, TheCameraLooksDownOnTheBoardFromTheTraineesSide) {
  const Camera camera = Moment().seen().camera;
  EXPECT_LT((camera.look_at_T - scene().board.centre_T).norm(), 0.02);
  EXPECT_GT(camera.eye_T.z(), scene().board.centre_T.z() + 0.03);
  EXPECT_LT(camera.eye_T.y(), scene().board.centre_T.y() - 0.03);
}

class Frames : public ::testing::Test {
 protected:
  void SetUp() override {
    void* egl = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!egl) GTEST_SKIP() << "NO PICTURE IS TESTED HERE: libEGL.so.1 is not installed";
    dlclose(egl);
  }
  test::TemporaryFolder folder_;
};

TEST_F(Frames, AreWrittenAtTheirRateAndNumberedFromOne) {
  AttemptPainter painter(find_assets(), "T-1", 320, 240);
  FrameWriter writer(painter, folder_ / "deep" / "frames", 4);
  const Moment moment;
  for (int i = 0; i <= 100; ++i) writer.observe(moment.at(0.01 * i));
  EXPECT_EQ(writer.written(), 5) << "at 0, 0.25, 0.5, 0.75 and 1 s";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "deep" / "frames" / "frame_00001.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "deep" / "frames" / "frame_00005.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deep" / "frames" / "frame_00006.png"));
}

TEST_F(Frames, APaintedMomentIsAPictureOfTheSizeAskedFor) {
  AttemptPainter painter(find_assets(), "T-1", 320, 240);
  const Image image = painter.paint(Moment().at(0));
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 240);
  const auto [low, high] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  EXPECT_GT(*high - *low, 60) << "not one flat colour";
}

TEST_F(Frames, AFolderThatCannotBeMadeIsTheMachinesFault) {
  AttemptPainter painter(find_assets(), "T-1", 320, 240);
  folder_.write("file", "");
  EXPECT_THROW(FrameWriter(painter, folder_ / "file" / "frames", 4), EnvironmentError);
}

}  // namespace
}  // namespace trocar::attempt_picture_test
