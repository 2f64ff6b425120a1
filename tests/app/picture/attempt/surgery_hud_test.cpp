// What the display says while an organ that gives way is worked on, and that it asks nothing where nothing is asked.
#include "app/picture/attempt/surgery_hud.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/picture/attempt/attempt_picture.h"
#include "scenarios/files/exercise_loader.h"
#include "tissue/mesh/surface/cut_tracing.h"
#include "tissue/thin/duct_system.h"
#include "tissue/tissue_world.h"

namespace trocar::surgery_hud_test {
namespace {

Scene built(const std::filesystem::path& exercise) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = load_exercise(assets.exercises / exercise);
  setup.organ = "phantom-liver";
  setup.hand = "expert";
  Scene scene = build_scene(setup, assets, {"simulated", 1000, 16});
  scene.soft = std::make_shared<SoftSetup>();
  return scene;
}

class FreePlay : public testing::Test {
 protected:
  static const Scene& scene() {
    static const Scene free = built("ungraded/free-play.toml");
    return free;
  }
  Hud hud() const { return attempt_view({scene(), record_, director_, 0, &frame_}, "").hud; }
  std::string value(const std::string& name) const {
    const std::vector<HudRow> rows = hud().rows;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const HudRow& row) { return row.name == name; });
    return found == rows.end() ? "no row" : found->value + found->unit;
  }
  bool notices(const std::string& text) const {
    const std::vector<HudNotice> all = hud().notices;
    return std::any_of(all.begin(), all.begin() + std::min<std::ptrdiff_t>(2, std::ssize(all)),
                       [&](const HudNotice& notice) { return notice.text == text; });
  }
  /// Of the exercise's instruments.
  void take(InstrumentKind kind) {
    const auto& all = scene().setup.exercise.instruments;
    record_.stylus.instrument = static_cast<int>(std::find(all.begin(), all.end(), kind) - all.begin());
  }
  Director director_{scene().setup.exercise, scene().level, scene().board};
  TickRecord record_;
  TissueFrame frame_;
};

TEST_F(FreePlay, AsksNothing) {
  EXPECT_TRUE(plays_freely(scene()));
  EXPECT_TRUE(hud().steps.empty());
  EXPECT_EQ(value("Discs held"), "no row");
}

TEST_F(FreePlay, TellsWhatWasDoneAndHowTheOrganStands) {
  take(InstrumentKind::kHook);
  record_.stylus.pedal = true;
  EXPECT_EQ(value("Tissue"), "-");
  frame_.surgery = {.cuts = 3, .tears = 1, .clips = 2, .wounds = 4};
  frame_.surgery.blood_ml = 12.34;
  frame_.surgery.blood_ml_per_min = 3.21;
  frame_.surgery.sucked_ml = 5;
  frame_.surgery.contact_c = 97.6;
  EXPECT_EQ(value("Instrument"), "Hook");
  EXPECT_EQ(value("Pedal"), "down");
  EXPECT_EQ(value("Cuts"), "3");
  EXPECT_EQ(value("Tears"), "1");
  EXPECT_EQ(value("Clips set"), "2");
  EXPECT_EQ(value("Blood lost"), "12.3mL");
  EXPECT_EQ(value("Bleeding now"), "3.2mL/min");
  EXPECT_EQ(value("Sucked off"), "5.0mL");
  EXPECT_EQ(value("Tissue"), "98°C");
}

TEST_F(FreePlay, ARefusalIsSaidWithItsReasonForAMoment) {
  take(InstrumentKind::kScissors);
  frame_.t_s = 10;
  frame_.surgery.refusals = 1;
  frame_.surgery.refusal = static_cast<std::int32_t>(CutRefusal::kThrough);
  frame_.surgery.refused_s = 9;
  const std::string said = "Not cut: the cut would go through the organ";
  EXPECT_TRUE(notices(said));
  frame_.t_s = 14;
  EXPECT_FALSE(notices(said));
  frame_.t_s = 10;
  take(InstrumentKind::kClipApplier);
  frame_.surgery.refusal = static_cast<std::int32_t>(CutRefusal::kNoWound);
  EXPECT_TRUE(notices("No clip set: no wound between the jaws"));
  take(InstrumentKind::kHook);
  EXPECT_FALSE(notices("Not cut: no wound between the jaws")) << "a hook is not closed";
}

TEST_F(FreePlay, AClipThatWasPulledOffIsSaidWhateverIsInHand) {
  frame_.t_s = 10;
  frame_.surgery.refusal = kClipCameOff;
  frame_.surgery.refused_s = 9;
  for (const InstrumentKind kind : {InstrumentKind::kGrasper, InstrumentKind::kHook, InstrumentKind::kClipApplier}) {
    take(kind);
    EXPECT_TRUE(notices("A clip was pulled off."));
  }
  frame_.t_s = 14;
  EXPECT_FALSE(notices("A clip was pulled off."));
}

TEST_F(FreePlay, FastBleedingIsNoticed) {
  frame_.surgery.blood_ml_per_min = 4.9;
  EXPECT_FALSE(notices("Bleeding: 5 mL/min"));
  frame_.surgery.blood_ml_per_min = 11.6;
  EXPECT_TRUE(notices("Bleeding: 12 mL/min"));
}

TEST_F(FreePlay, ClipsAndDropsAreSeenWhereTheyAre) {
  frame_.clip_count = 1;
  frame_.clip[0].p = Vec3(0.01, 0.02, 0.03);
  frame_.drop_count = 2;
  frame_.drop[1] = {Vec3(0, 0, 0.05), 0.0015};
  const SceneView view = attempt_view({scene(), record_, director_, 0, &frame_}, "");
  const auto count = [&](SceneObject::Shape shape, const Vec3& place) {
    return std::count_if(view.objects.begin(), view.objects.end(), [&](const SceneObject& object) {
      return object.shape == shape && object.X_TO.p == place && object.style == SceneObject::Style::kSolid;
    });
  };
  EXPECT_EQ(count(SceneObject::Shape::kClip, frame_.clip[0].p), 1);
  EXPECT_EQ(count(SceneObject::Shape::kSphere, frame_.drop[1].place_T), 1);
}

TEST(SurgeryHud, StitchingTellsWhatIsSewn) {
  const Scene scene = built("ungraded/stitching.toml");
  const Director director(scene.setup.exercise, scene.level, scene.board);
  const TickRecord record;
  TissueFrame frame;
  const auto value = [&](const char* name) {
    for (const HudRow& row : attempt_view({scene, record, director, 0, &frame}, "").hud.rows)
      if (row.name == name) return row.value + row.unit;
    return std::string("no such row");
  };
  EXPECT_EQ(value("Instrument"), "Needle driver");
  EXPECT_EQ(value("Knot"), "-");
  EXPECT_EQ(value("Pull on the needle"), "-");
  frame.suture = {.needles = 1, .punctures = 3, .stitches = 2, .throws = 2, .knot = 2, .held = true, .pull_n = 1.26};
  EXPECT_EQ(value("Punctures"), "3");
  EXPECT_EQ(value("Stitches"), "2");
  EXPECT_EQ(value("Throws"), "2");
  EXPECT_EQ(value("Knot"), "square knot");
  EXPECT_EQ(value("Pull on the needle"), "1.3N");
}

TEST(SurgeryHud, AnExerciseKeepsItsStepsAndRows) {
  const Scene scene = built("surface-touch.toml");
  EXPECT_FALSE(plays_freely(scene));
  const Director director(scene.setup.exercise, scene.level, scene.board);
  const TickRecord record;
  TissueFrame frame;
  frame.surgery.blood_ml_per_min = 20;
  const Hud hud = attempt_view({scene, record, director, 0, &frame}, "").hud;
  EXPECT_EQ(hud.steps.size(), 3U);
  EXPECT_EQ(hud.rows.front().name, "Discs held");
  ASSERT_FALSE(hud.notices.empty());
  EXPECT_EQ(hud.notices.front().text, "Bleeding: 20 mL/min") << "but blood is blood";
}

}  // namespace
}  // namespace trocar::surgery_hud_test
