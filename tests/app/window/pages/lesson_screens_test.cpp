// Course, briefing and notch as a person meets them: what is said, by keyboard alone, at every scale.
#include <cmath>
#include <thread>

#include "app/window/pages/curriculum_screen.h"
#include "app/window/practice/screen_table.h"
#include "app/window/run/briefing_screen.h"
#include "app/window/ui/sparkline.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/window/pages/layout_check.h"
#include "tests/app/window/pages/loop_bench.h"

namespace trocar::lesson_screens_test {
namespace {

using testing_support::expect_laid_out;

AttemptSummary attempt(const std::string& level, int board, bool passed, double score) {
  AttemptSummary a;
  a.level = level;
  a.board = board;
  a.passed = passed;
  a.score = score;
  a.status = "done";
  return a;
}

class LessonScreens : public testing_support::LoopBench {
 protected:
  void window(int width, int height, double scale, const std::string& input = "auto") {
    width_ = width;
    height_ = height;
    ModelOptions options = bench_.options();
    options.input = input;
    options.scale = scale;
    open(options);
  }
  void go(ScreenName name, int frames = 3) {
    loop_->go(name);
    for (int i = 0; i < frames; ++i) frame();
  }
  bool sees_part(const std::string& part) const {
    for (const DrawnText& t : loop_->texts())
      if (t.text.find(part) != std::string::npos) return true;
    return false;
  }
};

TEST(ProgressShown, EachProgressHasAShapeAndWordsOfItsOwn) {
  const Translator w;
  const auto all = list_exercises(testing_support::source_assets().exercises);
  const Exercise& e = all.front();
  LevelProgress open, once, often, locked;
  once.attempts = once.passed = 1;
  often.attempts = 4;
  often.passed = 3;
  locked.unlocked = false;
  EXPECT_EQ(progress_mark(open), Mark::kOpen);
  EXPECT_EQ(progress_mark(once), Mark::kHalf);
  EXPECT_EQ(progress_mark(often), Mark::kTick);
  EXPECT_EQ(progress_mark(locked), Mark::kLock);
  EXPECT_EQ(progress_words(w, e, "L1", open), "L1: open");
  EXPECT_EQ(progress_words(w, e, "L1", once), "L1: passed once");
  EXPECT_EQ(progress_words(w, e, "L1", often), "L1: passed 3 x");
  EXPECT_EQ(progress_words(w, e, "L2", locked), "L2: needs L1 3 x");
}

TEST(ProgressShown, CurveRunsFromTheOldestAndLeavesOutWhatHasNoScore) {
  LevelProgress s;
  s.newest_first = {attempt("L1", 3, true, 90), attempt("L1", 2, false, 60), attempt("L1", 1, false, 40)};
  s.newest_first[1].score.reset();
  EXPECT_EQ(scores_oldest_first(s), (std::vector<double>{40, 90}));
  for (int i = 0; i < 40; ++i) s.newest_first.push_back(attempt("L1", i, false, 10));
  EXPECT_EQ(scores_oldest_first(s).size(), 30u);
  EXPECT_EQ(scores_oldest_first(s).back(), 90) << "the newest are kept";
}

TEST_F(LessonScreens, CourseIsWalkedByArrowsAndEnterOpensTheBriefing) {
  go(ScreenName::kCurriculum);
  EXPECT_EQ(model_->exercise_id, "reach-and-orient");
  for (int i = 0; i < 4; ++i) tap(kKeyDown);
  EXPECT_EQ(model_->exercise_id, "surface-touch");
  EXPECT_EQ(model_->level, "L1");
  tap(kKeyUp);
  EXPECT_EQ(model_->exercise_id + model_->level, "reach-and-orientexam");
  tap(kKeyEnd);
  EXPECT_EQ(model_->exercise_id + model_->level, "mini-cholecystectomyexam");
  tap(kKeyDown);
  EXPECT_EQ(model_->exercise_id + model_->level, "mini-cholecystectomyexam") << "nothing below the last";
  tap(kKeyHome);
  tap(kKeyEnter);
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing);
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kCurriculum);
  EXPECT_FALSE(loop_->menu_open());
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
}

TEST_F(LessonScreens, ChosenRowIsAlwaysSeenHoweverSmallTheWindow) {
  window(640, 360, 2);
  go(ScreenName::kCurriculum);
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(sees_part(model_->level + ":")) << model_->exercise_id << " " << model_->level;
    if (i % 4 == 0) {
      EXPECT_TRUE(sees(model_->exercise().number + " " + model_->exercise().title)) << i;
    }
    tap(kKeyDown);
  }
}

TEST_F(LessonScreens, LockedLevelSaysWhatItNeedsAndIsRefusedInPlace) {
  go(ScreenName::kCurriculum);
  tap(kKeyDown);
  EXPECT_TRUE(sees("L2: needs L1 3 x"));
  tap(kKeyEnter);
  ASSERT_EQ(loop_->here(), ScreenName::kBriefing);
  frame();
  EXPECT_TRUE(sees("L2 is locked: three passes in a row on three boards at L1 open it. So far: 0 of 3."));
  EXPECT_FALSE(sees("Start")) << "nothing bright that does nothing";
  tap(kKeyEnter);
  frame();
  EXPECT_EQ(model_->level, "L1") << "where it is opened";
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing);
  EXPECT_TRUE(sees("Start"));
  EXPECT_FALSE(sees_part("is locked"));
  EXPECT_EQ(model_->running(), nullptr);
}

TEST_F(LessonScreens, ExamWaitsForTheDeviceCheck) {
  go(ScreenName::kBriefing, 1);
  model_->level = "exam";
  frame();
  tap(kKeyEnter);
  EXPECT_EQ(model_->running(), nullptr);
  EXPECT_TRUE(sees_part("is locked"));
}

TEST_F(LessonScreens, ResultsOfTheDeviceCheckStandInTheBriefingOfWhoHoldsOne) {
  window(1280, 720, 1, "device");
  go(ScreenName::kBriefing, 1);
  loop_->settle(120);
  frame();
  for (const char* part : {"Weight left over: 0.", "Friction: 0.", "Passive contact: 0.", "checks passed"})
    EXPECT_TRUE(sees_part(part)) << part;
  EXPECT_FALSE(sees_part("waits"));
}

/// Nobody simulates a hand there: nothing is measured, and nothing is said of a simulated device.
TEST_F(LessonScreens, ARealDeviceIsNamedAndCheckedAsTheAttemptBegins) {
  ModelOptions options = bench_.options();
  options.input = "device";
  options.backend = kHostmot2Backend;
  width_ = 1280, height_ = 720;
  open(options);
  go(ScreenName::kStart, 1);
  EXPECT_TRUE(sees_part("Device: hostmot2, loop at 1000 Hz."));
  go(ScreenName::kBriefing);
  EXPECT_TRUE(sees("Device: hostmot2"));
  EXPECT_TRUE(sees_part("It is checked as each attempt begins"));
  EXPECT_FALSE(sees_part("simulated device"));
  expect_laid_out(loop_->texts(), width_, height_, "briefing of a real device");
}

TEST_F(LessonScreens, WithoutADeviceTheBriefingSaysWhatMovesWhat) {
  window(1280, 720, 1);
  go(ScreenName::kBriefing, 1);
  loop_->settle(120);
  frame();
  for (const char* said : {"How to move", "Mouse: move the tip", "Right button, held: lean the shaft"})
    EXPECT_TRUE(sees(said)) << said;
  model_->exercise_id = "surface-touch";
  frame();
  EXPECT_TRUE(sees("Left button, held: press, grip"));
  EXPECT_FALSE(sees_part("Device check"));
}

TEST_F(LessonScreens, EveryMeasureIsExplainedOneKeyAway) {
  window(1280, 720, 1);
  model_->exercise_id = "surface-touch";
  go(ScreenName::kBriefing);
  tap('M');
  frame();
  const auto measures = lesson_measures(model_->words(), find_level(model_->exercise(), "L1"), model_->at_pointer());
  for (const LessonMeasure& m : measures) {
    EXPECT_TRUE(sees(m.meaning)) << m.name;
    EXPECT_TRUE(sees(m.full)) << m.name;
    expect_laid_out(loop_->texts(), width_, height_, m.name);
    tap(kKeyDown);
  }
  tap('M');
  frame();
  EXPECT_TRUE(sees("Limits"));
}

TEST_F(LessonScreens, BriefingFitsItsPageForEveryExerciseAndLevel) {
  window(1280, 720, 1);
  loop_->go(ScreenName::kBriefing);
  loop_->settle(120);
  for (const Exercise& exercise : model_->exercises()) {
    for (const ExerciseLevel& level : exercise.levels) {
      model_->exercise_id = exercise.id;
      model_->level = level.name;
      for (int i = 0; i < 3; ++i) frame();
      const std::string where = exercise.id + " " + level.name;
      EXPECT_TRUE(loop_->scrolling().empty())
          << where << ": " << (loop_->scrolling().empty() ? "" : loop_->scrolling().front()) << " scrolls";
      expect_laid_out(loop_->texts(), width_, height_, where);
    }
  }
}

struct Size {
  int width, height;
  double scale;
};
void PrintTo(const Size& s, std::ostream* out) {
  *out << s.width << "x" << s.height << " at " << 100 * s.scale << " %";
}

class LessonLayout : public LessonScreens, public ::testing::WithParamInterface<Size> {};

TEST_P(LessonLayout, NothingIsCutAndNothingCollides) {
  window(GetParam().width, GetParam().height, GetParam().scale);
  for (const char* id : {"reach-and-orient", "surface-touch", "limited-grasp"}) {
    model_->exercise_id = id;
    for (const ScreenName name : {ScreenName::kCurriculum, ScreenName::kBriefing}) {
      go(name);
      expect_laid_out(loop_->texts(), width_, height_,
                      std::string(id) + (name == ScreenName::kBriefing ? " briefing" : " course"));
    }
    tap('M');
    frame();
    expect_laid_out(loop_->texts(), width_, height_, std::string(id) + " measures");
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, LessonLayout,
                         ::testing::Values(Size{1280, 720, 1}, Size{1280, 720, 1.5}, Size{1280, 720, 2},
                                           Size{1920, 1080, 1}, Size{800, 600, 1}));

TEST_F(LessonScreens, PageKeysReachTheEndOfALargeBriefing) {
  window(1280, 720, 2, "device");
  go(ScreenName::kBriefing);
  EXPECT_FALSE(loop_->scrolling().empty());
  EXPECT_FALSE(sees_part("Device check"));
  for (int i = 0; i < 8; ++i) tap(kKeyPageDown);
  EXPECT_TRUE(sees_part("Device check"));
  for (int i = 0; i < 8; ++i) tap(kKeyPageUp);
  EXPECT_TRUE(sees_part("E01"));
}

TEST_F(LessonScreens, CardGetsItsPicture) {
  window(1280, 720, 1);
  go(ScreenName::kCurriculum, 1);
  EXPECT_TRUE(sees("Picture is being made"));
  loop_->settle(60);
  frame();
  frame();
  EXPECT_TRUE(sees("Still scene"));
  const Image image = loop_->picture();
  double lit = 0;
  for (int y = 200; y < 440; ++y)
    for (int x = 460; x < 840; ++x) lit += image.pixel(x, y)[0] > 40 ? 1 : 0;
  EXPECT_GT(lit / (240 * 380), 0.2) << "a scene, not a black field";
}

TEST_F(LessonScreens, NotchIsEnteredFromTheCourseShowsTheDeviceAndIsLeftByEsc) {
  window(1280, 720, 1);
  go(ScreenName::kCurriculum);
  tap('N');
  ASSERT_EQ(loop_->here(), ScreenName::kNotch);
  loop_->settle(60);
  for (int i = 0; i < 4; ++i) frame();
  EXPECT_TRUE(sees("The notch"));
  EXPECT_TRUE(sees("20 N/m"));
  EXPECT_TRUE(sees("q6")) << "the device panel is open";
  expect_laid_out(loop_->texts(), width_, height_, "notch");
  tap('2');
  EXPECT_TRUE(sees("150 N/m"));
  tap(kKeyF3);
  frame();
  EXPECT_FALSE(sees("q6"));
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kCurriculum);
}

TEST_F(LessonScreens, WhereThereIsNoRoomBesideItThePanelWaitsForF3AndEscStillLeaves) {
  window(1280, 720, 2);
  go(ScreenName::kNotch);
  EXPECT_TRUE(sees("The notch"));
  EXPECT_FALSE(sees("q1"));
  tap(kKeyF3);
  frame();
  EXPECT_TRUE(sees("q1"));
  tap(kKeyF3);
  frame();
  EXPECT_FALSE(sees("q1"));
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kCurriculum);
}

TEST_F(LessonScreens, DevicePanelKeepsItsColumnsFromFrameToFrame) {
  window(1280, 720, 1);
  go(ScreenName::kNotch, 1);
  loop_->settle(60);
  frame();
  const auto right_edges = [this] {
    std::vector<int> out;
    for (const DrawnText& t : loop_->texts())
      if (t.text.find_first_of("+-") != std::string::npos && t.text.find('.') != std::string::npos && t.x > 700)
        out.push_back(static_cast<int>(std::lround(t.x + t.width)));
    return out;
  };
  const std::vector<int> first = right_edges();
  EXPECT_GT(first.size(), 40u);
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    frame();
    EXPECT_EQ(right_edges(), first);
  }
}

TEST_F(LessonScreens, WithoutADeviceF3ShowsNone) {
  ASSERT_EQ(model_->begin_attempt(), "");
  go(ScreenName::kRun);
  tap(kKeyF3);
  frame();
  EXPECT_FALSE(sees("q6"));
  EXPECT_TRUE(sees("There is no device to be shown."));
}

TEST_F(LessonScreens, DevicePanelLiesOverARunAndGoesAgain) {
  window(1280, 720, 1, "device");
  ASSERT_EQ(model_->begin_attempt(), "");
  go(ScreenName::kRun);
  EXPECT_FALSE(sees("q6"));
  tap(kKeyF3);
  frame();
  EXPECT_TRUE(sees("q6"));
  tap(kKeyF4);
  frame();
  EXPECT_TRUE(sees_part("Device numbers written to"));
  EXPECT_TRUE(std::filesystem::exists(bench_.folder.path() / "device-1.csv"));
  EXPECT_TRUE(sees_part("F3 closes, F4 copies"));
  tap('P');
  frame();
  EXPECT_TRUE(sees("Paused"));
  EXPECT_FALSE(sees("q6")) << "the panel lies over the dialog";
  EXPECT_TRUE(loop_->scrolling().empty()) << "the dialog has no room for its buttons";
  tap('P');
  model_->settings().keys = {{"device-panel", "F6"}};
  model_->settings_changed();
  frame();
  EXPECT_TRUE(sees_part("F6 closes, F4 copies"));
  tap(kKeyF6);
  frame();
  EXPECT_FALSE(sees("q6"));
}

TEST_F(LessonScreens, TinyWindowSaysOneThingWhateverRuns) {
  window(200, 100, 2);
  for (const ScreenName name : {ScreenName::kStart, ScreenName::kCurriculum, ScreenName::kSettings}) {
    go(name);
    ASSERT_EQ(loop_->texts().size(), 1U) << screen_name(name);
    EXPECT_TRUE(sees("Please make the window larger."));
    expect_laid_out(loop_->texts(), width_, height_, "tiny");
  }
}

TEST_F(LessonScreens, CourseAndBriefingSayAtOnePlaceWhoIsHere) {
  window(1280, 720, 1);
  const auto place = [this](const std::string& said) -> std::optional<DrawnText> {
    for (const DrawnText& t : loop_->texts())
      if (t.text == said) return t;
    return std::nullopt;
  };
  for (const std::string said : {"Guest", "Signed in as T-7"}) {
    if (said != "Guest") {
      ASSERT_EQ(model_->sign_in("T-7"), "");
    }
    go(ScreenName::kCurriculum);
    const auto course = place(said);
    go(ScreenName::kBriefing);
    const auto briefing = place(said);
    ASSERT_TRUE(course && briefing) << said;
    EXPECT_NEAR(course->x + course->width, briefing->x + briefing->width, 1);
    EXPECT_NEAR(course->y, briefing->y, 1);
    EXPECT_GT(course->x, width_ / 2);
    expect_laid_out(loop_->texts(), width_, height_, "briefing");
  }
}

}  // namespace
}  // namespace trocar::lesson_screens_test
