// T5: what a person sees and does on the debrief, at every scale.
#include "app/window/debrief/debrief_page.h"

#include "tests/app/window/pages/page_bench.h"

namespace trocar::debrief_page_test {
namespace {

using testing_support::event;
using testing_support::good_run;
using testing_support::graded;
using testing_support::heavy_run;
using testing_support::press;
using testing_support::shipped_exercise;
using testing_support::some_past;

class DebriefPageTest : public testing_support::PageBench {
 protected:
  void show(const DebriefContent& content, const std::vector<InputEvent>& events = {}) {
    frame([&](Ui& ui) { choice_ = page_.draw(ui, content); }, events);
  }
  void settle(const DebriefContent& content) {
    for (int i = 0; i < 3; ++i) show(content);
  }
  DebriefContent touch(AttemptResult (*run)(const Exercise&) = heavy_run, bool with_past = true) {
    const AttemptResult result = run(touch_);
    return content_of(result, touch_, with_past ? some_past(result) : DebriefPast{});
  }
  const Exercise touch_ = shipped_exercise("surface-touch");
  DebriefPage page_;
  DebriefChoice choice_ = DebriefChoice::kNone;
};

TEST_F(DebriefPageTest, LeadsWithVerdictReasonAndScore) {
  settle(touch());
  picture("debrief-not-yet");
  ASSERT_TRUE(text("NOT YET"));
  ASSERT_TRUE(text("Excess force: 4; a pass needs at most 3."));
  EXPECT_LT(text("NOT YET")->y, text("Excess force: 4; a pass needs at most 3.")->y);
  for (const DrawnText& t : texts_) EXPECT_GE(t.y, text("NOT YET")->y - 25) << t.text;
  EXPECT_TRUE(says("of 100 points"));
  EXPECT_TRUE(text("pass 75"));
}

TEST_F(DebriefPageTest, NothingScrollsAtTheSmallestUsualWindow) {
  for (const auto run : {heavy_run, good_run}) {
    DebriefContent content = touch(run);
    content.guest = run == heavy_run;
    settle(content);
    EXPECT_TRUE(scrolling_.empty()) << scrolling_.front();
    expect_clear("debrief");
  }
  picture("debrief-pass");
}

TEST_F(DebriefPageTest, AReasonOfTwoLinesHasRoom) {
  DebriefContent content = touch();
  for (int i = 0; i < 3; ++i) content.facts.reason += " " + content.facts.reason.substr(0, 40);
  settle(content);
  EXPECT_TRUE(scrolling_.empty()) << scrolling_.front();
  expect_clear("long reason");
}

TEST_F(DebriefPageTest, WhileTheForcesAreReadThePageStandsWithoutThem) {
  DebriefContent content = touch();
  content.plots.trace = nullptr;
  content.plots_note = "Reading the forces...";
  settle(content);
  EXPECT_TRUE(text("Reading the forces..."));
  EXPECT_TRUE(text("NOT YET"));
  EXPECT_FALSE(page_.chosen_s());
  content.plots.trace = &trace_;
  settle(content);
  EXPECT_TRUE(page_.chosen_s()) << "then the cursor stands at the worst moment";
}

TEST_F(DebriefPageTest, WithoutAReplayItsKeyDoesNothing) {
  DebriefContent content = touch();
  content.can_watch = content.can_compare = false;
  settle(content);
  for (const char key : {'W', 'S', 'I'}) {
    show(content, press(key));
    EXPECT_EQ(choice_, DebriefChoice::kNone) << key;
  }
}

TEST(ForceLinesOf, AreThoseOfTheExercise) {
  const Exercise touch = shipped_exercise("surface-touch"), reach = shipped_exercise("reach-and-orient"),
                 grasp = shipped_exercise("limited-grasp");
  EXPECT_EQ(force_lines(touch, "L1").tip, (std::vector<WantedForce>{{0.4, 0.8}}));
  EXPECT_EQ(force_lines(touch, "L3").tip.size(), 3u);
  EXPECT_EQ(force_lines(touch, "L1").tip_hard_n, 1.5);
  EXPECT_EQ(force_lines(touch, "L1").grip_hard_n, 2.5);
  EXPECT_TRUE(force_lines(touch, "no such level").tip.empty());
  EXPECT_TRUE(force_lines(reach, "L1").speed);
  EXPECT_TRUE(force_lines(grasp, "L1").grip.empty()) << "blocks want different grips";
}

TEST(PlotEvents, LieWithinTheTraceAndTheWorstIsTheFirstOfItsKind) {
  const Translator w;
  ForceTrace trace;
  trace.begin_s = 2;
  trace.end_s = 20;
  const std::vector<Event> events{event(1, "WRONG_PLACE", Severity::kMinor),
                                  event(3, "TARGET_HELD"),
                                  event(4, "TARGET_LIT"),
                                  event(5, "WRONG_PLACE", Severity::kMinor),
                                  event(7, "EXCESS_FORCE", Severity::kMajor),
                                  event(9, "EXCESS_FORCE", Severity::kMajor),
                                  event(21, "CRITICAL_FORCE", Severity::kCritical)};
  const auto shown = plot_events(w, events, trace);
  ASSERT_EQ(shown.size(), 4u);
  EXPECT_EQ(shown[0].text, "Target held");
  EXPECT_EQ(worst_moment(shown), 7);
  EXPECT_FALSE(worst_moment({shown[0]})) << "nothing went wrong";
  EXPECT_FALSE(worst_moment({}));
}

TEST_F(DebriefPageTest, GroupsStandInTheOrderSafetyToTime) {
  settle(touch());
  double above = 0;
  for (const char* group : {"Safety", "Accuracy", "Motion", "Time"}) {
    const auto at = std::find_if(texts_.begin(), texts_.end(), [&](const DrawnText& t) { return t.text == group; });
    ASSERT_NE(at, texts_.end()) << group;
    EXPECT_GT(at->y, above);
    above = at->y;
  }
}

TEST_F(DebriefPageTest, WithoutAPastThereAreNoEmptyColumns) {
  settle(touch(heavy_run, false));
  EXPECT_FALSE(text("Median"));
  EXPECT_FALSE(text("Expert"));
  settle(touch());
  EXPECT_TRUE(text("Median"));
  EXPECT_TRUE(text("Expert"));
}

TEST_F(DebriefPageTest, OneKeyExplainsEveryPartInTurn) {
  const DebriefContent content = touch();
  settle(content);
  for (std::size_t i = 0; i < content.facts.rows.size(); ++i) {
    show(content, press('E'));
    show(content);
    EXPECT_EQ(page_.explained_row(), static_cast<int>(i));
    for (const std::string& sentence : content.explained[i]) EXPECT_TRUE(says(sentence)) << sentence;
    expect_clear("explained");
    EXPECT_TRUE(scrolling_.empty()) << "row " << i;
    if (i == 0) picture("debrief-explained");
  }
  show(content, press('E'));
  EXPECT_EQ(page_.explained_row(), -1);
}

TEST_F(DebriefPageTest, KeysChooseWhatComesNext) {
  const DebriefContent bad = touch();
  settle(bad);
  for (const auto& [key, wanted] : {std::pair{static_cast<std::int32_t>('R'), DebriefChoice::kRetry},
                                    {'N', DebriefChoice::kNext},
                                    {'W', DebriefChoice::kWatch},
                                    {'S', DebriefChoice::kCompare},
                                    {'M', DebriefChoice::kProgress},
                                    {kKeyEnter, DebriefChoice::kRetry}}) {
    show(bad, press(key));
    EXPECT_EQ(choice_, wanted) << key;
    show(bad);
    EXPECT_EQ(choice_, DebriefChoice::kNone);
  }
  const DebriefContent good = touch(good_run);
  settle(good);
  show(good, press(kKeyEnter));
  EXPECT_EQ(choice_, DebriefChoice::kNext) << "after a pass the way goes on";
}

TEST_F(DebriefPageTest, CursorBeginsAtTheWorstMomentAndKeysMoveIt) {
  const DebriefContent content = touch();
  settle(content);
  const auto too_hard = std::find_if(content.plots.events.begin(), content.plots.events.end(),
                                     [](const PlotEvent& e) { return e.severity == Severity::kMajor; });
  ASSERT_TRUE(page_.chosen_s());
  EXPECT_DOUBLE_EQ(*page_.chosen_s(), too_hard->t_s);
  EXPECT_TRUE(says("Watch from 10 s")) << "three seconds before it";
  for (int i = 0; i < 20 && *page_.chosen_s() == too_hard->t_s; ++i) {
    show(content, press(kKeyTab));
    show(content, press(kKeyRight));
  }
  EXPECT_NEAR(*page_.chosen_s(), too_hard->t_s + 0.5, 1e-9) << "reached by Tab, moved by an arrow";
  show(content, press(kKeyPageUp));
  EXPECT_NEAR(*page_.chosen_s(), too_hard->t_s - 4.5, 1e-9);
}

TEST_F(DebriefPageTest, ClickInThePlotWatchesFromThere) {
  using Kind = InputEvent::Kind;
  const DebriefContent content = touch();
  settle(content);
  const DrawnText title = *text("Force at the tip, N");
  const double x = 0.87 * width_, y = title.y + 60;
  show(content, {testing_support::pointer(Kind::kMouseMove, x, y)});
  show(content, {testing_support::pointer(Kind::kButtonDown, x, y)});
  EXPECT_EQ(choice_, DebriefChoice::kWatch);
  EXPECT_GT(*page_.chosen_s(), content.plots.trace->begin_s + 20);
  EXPECT_LT(*page_.chosen_s(), content.plots.trace->end_s);
}

TEST_F(DebriefPageTest, DeviceStopStandsForItselfWithoutAnyScore) {
  AttemptResult result = graded(touch_, "L1");
  result.grade = {};
  result.grade.status = AttemptStatus::kFault;
  result.device.fault = "encoder-jump";
  DebriefContent content = content_of(result, touch_);
  settle(content);
  picture("debrief-fault");
  EXPECT_TRUE(text("DEVICE STOPPED"));
  EXPECT_FALSE(says("of 100"));
  EXPECT_FALSE(text("Safety"));
  EXPECT_TRUE(scrolling_.empty());
  expect_clear("fault");
}

class DebriefLanguages : public DebriefPageTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(DebriefLanguages, NothingIsCutNothingCollidesNothingScrolls) {
  words_ = Translator(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "languages", GetParam());
  for (const double scale : {1.0, 1.5, 2.0}) {
    scale_ = scale;
    height_ = scale > 1 ? 3000 : 720;  // so that nothing is below the edge, where it would not be looked at
    for (const auto run : {heavy_run, good_run}) {
      page_ = {};
      const DebriefContent content = touch(run);
      settle(content);
      expect_clear(GetParam() + " at " + std::to_string(scale));
      EXPECT_TRUE(scale > 1 || scrolling_.empty()) << scrolling_.front();
    }
    picture("debrief-" + GetParam() + "-" + std::to_string(static_cast<int>(100 * scale)));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogues, DebriefLanguages, ::testing::Values("fr", "de"));

struct Case {
  int width, height;
  double scale;
};

class DebriefLayout : public DebriefPageTest, public ::testing::WithParamInterface<Case> {};

TEST_P(DebriefLayout, NothingIsCutAndNothingCollides) {
  width_ = GetParam().width;
  height_ = GetParam().height;
  scale_ = GetParam().scale;
  const std::string at =
      std::to_string(width_) + "x" + std::to_string(height_) + "-" + std::to_string(static_cast<int>(100 * scale_));
  const Exercise grasp = shipped_exercise("limited-grasp"), reach = shipped_exercise("reach-and-orient");
  AttemptResult crushed =
      graded(grasp, "L1", {{"crushed", 3}, {"object_grip_window_share", 0.41}, {"objects_done_share", 0.5}});
  crushed.events = {event(2, "START"), event(30.2, "CRUSH", Severity::kCritical, 1.9, "N"), event(58, "DONE")};
  testing_support::put_caps(crushed, grasp, 3, 6);
  AttemptResult reached = graded(reach, "exam", {{"time_s", 80}, {"angle_error_deg", 5.2}});
  reached.events = testing_support::pressing_events();
  DebriefContent guest = content_of(crushed, grasp, some_past(crushed));
  guest.guest = true;
  int n = 0;
  for (const DebriefContent& content : {touch(), guest, content_of(reached, reach)}) {
    page_ = {};
    for (const int explain : {0, 1}) {
      if (explain) show(content, press('E'));
      settle(content);
      expect_clear(at + " " + std::to_string(n));
      picture("debrief-" + at + "-" + std::to_string(n++));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, DebriefLayout,
                         ::testing::Values(Case{1280, 720, 1}, Case{1280, 720, 1.5}, Case{1280, 720, 2},
                                           Case{1920, 1080, 1}, Case{800, 600, 1}));

}  // namespace
}  // namespace trocar::debrief_page_test
