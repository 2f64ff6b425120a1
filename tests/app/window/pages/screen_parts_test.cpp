// Small parts of screens: button rows, the curve of scores, the picture on a card, the notch's arrow, the device panel.
#include <cmath>
#include <fstream>

#include "app/window/device/device_panel.h"
#include "app/window/lessons/lesson_picture.h"
#include "app/window/lessons/lesson_words.h"
#include "app/window/lessons/notch_screen.h"
#include "app/window/run/first_run_hints.h"
#include "app/window/ui/button_row.h"
#include "app/window/ui/sparkline.h"
#include "app/window/ui/theme.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/window/pages/practice_bench.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::screen_parts_test {
namespace {

using testing_support::press;
using testing_support::source_assets;
using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

Scene board_of(const std::string& exercise) {
  AttemptSetup setup;
  setup.exercise = find_exercise(exercise, source_assets().exercises);
  return build_scene(setup, source_assets(), {"simulated", setup.rate_hz, 16});
}

class ScreenParts : public testing_support::UiBench {
 protected:
  bool scrolls(double width, double spare) {
    frame([&](Ui& ui) {
      ui.begin_strip("row", {0, 0, width, button_rows_height(ui, kButtons, width) + spare});
      button_rows(ui, kButtons);
      ui.end_panel();
    });
    return !scrolling_.empty();
  }
  const std::vector<RowButton> kButtons{
      {"go", "Start the attempt", "Enter", true}, {"all", "Measures", "M"}, {"back", "Course", "Esc"}};
  testing_support::PracticeBench bench_;
};

TEST_F(ScreenParts, HeightOfButtonRowsIsWhatTheyNeed) {
  for (const double scale : {1.0, 1.5, 2.0}) {
    scale_ = scale;
    for (const double width : {260.0, 420.0, 600.0, 1200.0}) {
      EXPECT_FALSE(scrolls(width, 0)) << width << " px at " << scale;
      EXPECT_TRUE(scrolls(width, -6 * scale)) << width << " px at " << scale << ": taller than its buttons";
    }
  }
}

TEST_F(ScreenParts, ButtonsThatDoNotFitBeginANewRowAndAnswerToTheirKeys) {
  scrolls(1200, 0);
  EXPECT_NEAR(text("Measures")->y, text("Course")->y, 0.5);
  scrolls(260, 0);
  EXPECT_GT(text("Measures")->y, text("Start the attempt")->y + 20);
  for (const DrawnText& t : texts_) EXPECT_FALSE(t.shortened) << t.text;
  std::string chosen;
  const Draw draw = [&](Ui& ui) {
    ui.begin_panel("row", {0, 0, 1200, 90});
    chosen = button_rows(ui, kButtons);
    ui.end_panel();
  };
  frame(draw);
  EXPECT_EQ(chosen, "");
  frame(draw, press('M'));
  EXPECT_EQ(chosen, "all");
  frame(draw, press(kKeyEnter));
  EXPECT_EQ(chosen, "go");
}

TEST_F(ScreenParts, CurveOfScoresFillsTheDotsThatPassed) {
  const Area area{100, 100, 300, 200};
  double left = 0, top = 0, bottom = 0;
  const auto paint = [&](const std::vector<double>& scores) {
    frame([&](Ui& ui) {
      left = area.x + ui.text_width("100") + ui.px(16);
      top = area.y + ui.line_height() / 2;
      bottom = area.y + area.height - ui.line_height() / 2;
      paint_sparkline(ui, words_, area, scores, 75);
    });
    return target_->read();
  };
  const auto colour = [&](const Image& image, double score, int below) {
    const auto* p =
        image.pixel(static_cast<int>(left), static_cast<int>(bottom - (bottom - top) * score / 100) + below);
    return Rgb{p[0], p[1], p[2]};
  };
  EXPECT_EQ(colour(paint({75}), 75, 3), okabe_ito::kGreen) << "at the line is passed";
  EXPECT_EQ(colour(paint({50}), 50, 0), (Rgb{0, 0, 0})) << "an open ring";
  EXPECT_GT(colour(paint({50}), 50, 3).r, 100);
  EXPECT_EQ(colour(paint({140}), 100, 2), okabe_ito::kGreen) << "no higher than the top";
  ASSERT_TRUE(text("75") && text("0") && text("100"));
  EXPECT_NEAR(text("75")->y - text("100")->y, (text("0")->y - text("100")->y) / 4, 1);
}

TEST(LessonView, LightsOneTargetAfterTheOtherOverTheBoard) {
  const Scene scene = board_of("reach-and-orient");
  const int count = static_cast<int>(scene.board.targets.size());
  for (int i = 0; i <= count; ++i) {
    const SceneView view = lesson_view(scene, 3 * i + 0.1);
    std::vector<Vec3> lit;
    for (const SceneObject& o : view.objects)
      if (o.shape == Shape::kPen && o.style == Style::kGhostLit) lit.push_back(o.X_TO.p);
    ASSERT_EQ(lit.size(), 1u) << i;
    EXPECT_EQ(lit[0], scene.board.targets[static_cast<std::size_t>(i % count)].centre_T);
    const Vec3 off = view.X_TI.p - scene.board.centre_T;
    EXPECT_LE(std::abs(off.x()), 0.22 * scene.setup.exercise.layout.region_x_m + 1e-12);
    EXPECT_NEAR(off.z(), 0.03, 0.006 + 1e-12) << "over the board";
    EXPECT_EQ(view.jaw_opening_m, 0) << "a probe";
    EXPECT_TRUE(view.hud.title.empty() && view.hud.bars.empty());
  }
  EXPECT_EQ(lesson_view(scene, 4.2).X_TI.p, lesson_view(scene, 4.2).X_TI.p);
  const SceneView grasp = lesson_view(board_of("limited-grasp"), 1);
  EXPECT_NEAR(grasp.jaw_opening_m, 0.018, 1e-12) << "jaws move";
}

TEST(LessonPictureMade, FollowsTheChoiceAndDoesWithoutWhatCannotBeMade) {
  const testing_support::PracticeBench bench;
  const auto model = bench.model();
  LessonPicture picture;
  EXPECT_EQ(picture.caption(model->words()), "");
  EXPECT_FALSE(picture.view(*model, 0));
  picture.settle(*model, 120);
  EXPECT_TRUE(picture.view(*model, 0));
  EXPECT_EQ(picture.caption(model->words()), "Still scene");
  model->exercise_id = "surface-touch";
  model->organ = "no-such-organ";
  EXPECT_FALSE(picture.view(*model, 0)) << "never the picture of another exercise";
  picture.settle(*model, 120);
  EXPECT_FALSE(picture.view(*model, 0));
  EXPECT_EQ(picture.caption(model->words()), "");
  model->exercise_id = "limited-grasp";
  picture.settle(*model, 120);
  const auto view = picture.view(*model, 0);
  ASSERT_TRUE(view);
  EXPECT_GT(view->jaw_opening_m, 0) << "a grasper";
}

TEST(LessonSaid, TimesBandsAndSharesAreWrittenAsPeopleReadThem) {
  const Translator w;
  const Exercise touch = find_exercise("surface-touch", source_assets().exercises);
  ExerciseLevel level = find_level(touch, "L1");
  for (const auto& [seconds, said] : {std::pair{65.0, "1:05"}, std::pair{59.6, "1:00"}, std::pair{600.0, "10:00"}}) {
    level.time_limit_s = seconds;
    EXPECT_EQ(lesson_limits(w, touch, level)[0].value, said + std::string(" min at most"));
  }
  EXPECT_EQ(lesson_steps(w, touch, level)[2].text, "Press it with 0.4 to 0.8 N.");
  level.bands = {{0.25, 0.5}, {1, 1.2}};
  EXPECT_EQ(lesson_steps(w, touch, level)[2].text, "Press it with the force that its message names.");
  EXPECT_EQ(lesson_limits(w, touch, level)[1].value, "0.25 to 0.5 N or 1 to 1.2 N");
  level.rubric.subscores = {
      {.name = "place", .metric = "tremor_rms_m", .weight = 0.125, .full_at = 0.0015, .zero_at = 0.01},
      {.name = "other", .metric = "no_such", .weight = 0.875, .full_at = 1, .zero_at = 0}};
  const auto measures = lesson_measures(w, level);
  EXPECT_EQ(measures[0].weight, "12.5 %");
  EXPECT_EQ(measures[0].full, "1.5 mm");
  EXPECT_EQ(measures[1].full, "1.00");
  EXPECT_EQ(measures[1].meaning, "");
  const Translator german(source_assets().assets / "languages", "de");
  EXPECT_NE(lesson_limits(german, touch, level)[1].value.find("1,2 N"), std::string::npos);
}

TEST(NotchPicture, TouchedWallIsLitAndTheWallsStandWhereTheyAreFelt) {
  const Notch notch;
  const Scene scene = notch_scene(source_assets(), 1, notch);
  RunMoment moment;
  StylusState& stylus = moment.record.stylus;
  const Vec3 normals[] = {Vec3::UnitX(), -Vec3::UnitX(), -Vec3::UnitY()};
  for (std::size_t wall = 0; wall < 3; ++wall) {
    stylus.contact_normal_T = normals[wall];
    for (const bool touching : {false, true}) {
      stylus.contact = touching;
      const SceneView view = notch_view(scene, notch, moment);
      ASSERT_EQ(view.objects.size(), 9u) << "walls, axes with their ends, no arrow";
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(view.objects[i].style == Style::kLit, touching && i == wall) << i;
      const SceneObject& shown = view.objects[wall];
      const double inner = shown.X_TO.p.dot(normals[wall]) + 0.5 * shown.size_m.cwiseProduct(normals[wall]).norm();
      EXPECT_NEAR(inner, wall == 2 ? -notch.back_m : -notch.half_width_m, 1e-12);
      EXPECT_GT(view.shaft_length_m, 0.1) << "a shaft is seen though only its tip touches";
    }
  }
}

TEST(NotchPicture, ArrowIsTheForceOnTheTip) {
  const Scene scene = notch_scene(source_assets(), 1);
  RunMoment moment;
  StylusState& stylus = moment.record.stylus;
  stylus.X_TI.p = {0.004, -0.003, 0.002};
  using Case = std::pair<Vec3, double>;
  for (const auto& [force, length] :
       {Case{{0.5, 0, 0}, 0.03}, Case{{0, 0, -0.25}, 0.015}, Case{{0, -20, 0}, kLongestArrow_m}}) {
    stylus.F_I_T.force = force;
    const SceneView view = notch_view(scene, {}, moment);
    ASSERT_EQ(view.objects.size(), 13u);
    const SceneObject& rod = view.objects[9];
    EXPECT_NEAR(rod.size_m.z(), length, 1e-12);
    EXPECT_NEAR((rod.X_TO.R.col(2) - force.normalized()).norm(), 0, 1e-12);
    EXPECT_NEAR((rod.X_TO.p - 0.5 * length * force.normalized() - stylus.X_TI.p).norm(), 0, 1e-12)
        << "it begins at the tip";
    EXPECT_NEAR(rod.X_TO.R.determinant(), 1, 1e-12);
  }
  stylus.F_I_T.force = {0.005, 0, 0};
  EXPECT_EQ(notch_view(scene, {}, moment).objects.size(), 9u) << "nothing to see of so little";
  const Shape ends[] = {Shape::kSphere, Shape::kBox, Shape::kRing};
  const SceneView view = notch_view(scene, {}, moment);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(view.objects[static_cast<std::size_t>(4 + 2 * i)].shape, ends[i]) << "axes differ in shape";
}

TEST_F(ScreenParts, DevicePanelIsRefreshedTenTimesASecondAndF4WritesWhatItShows) {
  const auto model = bench_.model();
  DevicePanel panel;
  TickRecord record;
  record.det_a = 0.5;
  const auto pass = [&](double dt_s, const std::vector<InputEvent>& events = {}) {
    frame([&](Ui& ui) { panel.frame(ui, *model, record, {}, dt_s, device_panel_area(ui, false)); }, events);
    return panel.reading().det_a;
  };
  pass(1);
  EXPECT_TRUE(texts_.empty()) << "closed";
  panel.open = true;
  EXPECT_EQ(pass(0.04), 0.5);
  EXPECT_TRUE(text("+0.500"));
  record.det_a = 0.25;
  EXPECT_EQ(pass(0.04), 0.5);
  EXPECT_EQ(pass(0.04), 0.5) << "readable numbers do not change with every frame";
  EXPECT_EQ(pass(0.04), 0.25);
  record.det_a = 0.125;
  pass(0.01, press(kKeyF4));
  std::ifstream in(bench_.folder.path() / "device-1.csv");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), device_csv(panel.reading()))
      << "what is seen, not what is newer";
  EXPECT_EQ(panel.reading().det_a, 0.25);
}

TEST_F(ScreenParts, DevicePanelStandsAtTheEdgeThatIsAskedForAndInTheWindow) {
  frame([&](Ui& ui) {
    const Area left = device_panel_area(ui, false), right = device_panel_area(ui, true);
    EXPECT_NEAR(left.x, ui.width() - right.x - right.width, 1e-9);
    EXPECT_LT(left.x + left.width, right.x) << "at 1280 px";
  });
  width_ = 480;
  frame([&](Ui& ui) { EXPECT_LE(device_panel_area(ui, true).x + device_panel_area(ui, true).width, 480); });
}

TEST(FirstRunHintsOfOtherInputs, SpaceMouseAndKeysTickOnlyWhatTheyDid) {
  FirstRunHints hints;
  hints.begin(true);
  const auto done = [&] {
    std::string out;
    for (const FirstRunHints::Hint& mark : hints.marks(Translator(), KeyMap(), InputKind::kSpaceMouse))
      out += mark.done ? '1' : '0';
    return out;
  };
  InputEvent space_mouse;
  space_mouse.kind = InputEvent::Kind::kSpaceMouse;
  space_mouse.axis = {0.2, 0.2, 0.3, 1, 1, 1};
  hints.saw(space_mouse, KeyMap());
  EXPECT_EQ(done(), "0000") << "touched, turned, not pushed";
  space_mouse.axis[2] = -0.5;
  hints.saw(space_mouse, KeyMap());
  EXPECT_EQ(done(), "0100");
  space_mouse.axis = {0.3, -0.3};
  hints.saw(space_mouse, KeyMap());
  EXPECT_EQ(done(), "1100");
  hints.saw(testing_support::key(KeyMap().key_of(Action::kAct), InputEvent::Kind::kKeyUp), KeyMap());
  EXPECT_EQ(done(), "1100") << "letting a key go does nothing";
  space_mouse.buttons = 1;
  hints.saw(space_mouse, KeyMap());
  hints.pass(0.5);
  EXPECT_EQ(done(), "1110");
  hints.begin(true);
  EXPECT_EQ(done(), "0000");
  EXPECT_TRUE(hints.speaks());
}

}  // namespace
}  // namespace trocar::screen_parts_test
