// The run screen as a person meets it: steering, pause, start again, the end. Frames are drawn in memory; the attempt
// runs live, so tests wait for what must come and never for a time.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/picture/gl/image.h"
#include "app/session/grading/realtime_report.h"
#include "app/window/practice/latency_bench.h"
#include "tests/app/window/pages/loop_bench.h"
#include "trainees/records/attempt_store.h"

namespace trocar::testing_support::run_screen_test {
namespace {

class RunScreenBench : public LoopBench {
 protected:
  void begin() {
    ASSERT_EQ(model_->begin_attempt(), "");
    loop_->go(ScreenName::kRun);
  }
  /// Frames until it is so. @return whether it came.
  bool until(const std::function<bool()>& what) {
    for (int i = 0; i < 4000; ++i) {
      if (what()) return true;
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  bool ready() {
    return until(
        [this] { return model_->running() && model_->running()->ready() && model_->running()->newest().seen; });
  }
  /// On a button's text. @return false when the program shall end.
  bool click(const std::string& said) {
    frame();
    const auto at =
        std::find_if(loop_->texts().begin(), loop_->texts().end(), [&](const DrawnText& t) { return t.text == said; });
    if (at == loop_->texts().end()) throw std::runtime_error("nowhere: " + said);
    const double x = at->x + 4, y = at->y + at->height / 2;
    bool on = true;
    for (const auto kind : {InputEvent::Kind::kMouseMove, InputEvent::Kind::kButtonDown, InputEvent::Kind::kButtonUp})
      on = frame({pointer(kind, x, y)}) && on;
    return frame() && on;
  }
  void keep_picture(const std::string& name) {
    if (const char* folder = std::getenv("TROCAR_PICTURES"))
      write_png(std::filesystem::path(folder) / (name + ".png"), loop_->picture());
  }
  /// Into the organ until it is felt: the ring stands off the tip.
  void press_picture() {
    ModelOptions touch = bench_.options();
    touch.exercise = "surface-touch";
    width_ = 640;
    height_ = 360;
    open(touch);
    InputEvent wheel = pointer(InputEvent::Kind::kWheel, 300, 160);
    wheel.wheel = 1;
    begin();
    ASSERT_TRUE(ready());
    frame({pointer(InputEvent::Kind::kMouseMove, 400, 600)});
    for (int i = 0; i < 25; ++i) frame({pointer(InputEvent::Kind::kMouseMove, 400, 600 - 16.0 * i)});
    for (int i = 0; i < 30 && model_->running()->newest().record.stylus.F_I_T.force.norm() < 0.4; ++i) {
      frame({wheel});
      for (int wait = 0; wait < 3; ++wait) frame();
    }
    keep_picture("run_press");
  }
  Vec3 tip() { return model_->running()->newest().record.stylus.X_TI.p; }
};

TEST_F(RunScreenBench, TheMouseMovesTheInstrumentAndTheHintIsTicked) {
  begin();
  ASSERT_TRUE(ready());
  frame();
  frame();
  EXPECT_TRUE(sees("Mouse: move the tip"));
  const Vec3 before = tip();
  for (int i = 0; i < 40; ++i) frame({pointer(InputEvent::Kind::kMouseMove, 200 + 4.0 * i, 240 - 2.0 * i)});
  EXPECT_TRUE(until([&] { return (tip() - before).norm() > 0.005; }));
  InputEvent wheel = pointer(InputEvent::Kind::kWheel, 380, 160);
  wheel.wheel = -2;
  frame({wheel});
  InputEvent press = pointer(InputEvent::Kind::kButtonDown, 380, 160),
             release = pointer(InputEvent::Kind::kButtonUp, 380, 160);
  frame({press});
  for (int i = 0; i < 10; ++i) frame();  // held
  frame({release});
  frame({press});  // clicked
  frame({release});
  for (int i = 0; i < 60; ++i) frame();  // 3 s of the window's time
  EXPECT_FALSE(sees("Mouse: move the tip")) << "all done: the coach falls silent";
}

TEST_F(RunScreenBench, PStandsStillAndGoesOn) {
  begin();
  ASSERT_TRUE(ready());
  tap('P');
  EXPECT_TRUE(model_->running()->paused());
  frame();
  EXPECT_TRUE(sees("Paused"));
  tap('P');
  EXPECT_FALSE(model_->running()->paused());
  frame();
  EXPECT_FALSE(sees("Paused"));
}

TEST_F(RunScreenBench, AWindowThatNobodyLooksAtPauses) {
  begin();
  ASSERT_TRUE(ready());
  frame({key(0, InputEvent::Kind::kFocusLost)});
  frame();
  EXPECT_TRUE(model_->running()->paused());
  frame({key(0, InputEvent::Kind::kFocusLost)});
  tap('P');
  frame();
  EXPECT_FALSE(model_->running()->paused()) << "continuing holds";
}

TEST_F(RunScreenBench, EnterAndEscGoOnFromThePauseWithoutTabbing) {
  begin();
  ASSERT_TRUE(ready());
  for (const std::int32_t go_on : {std::int32_t{kKeyEnter}, std::int32_t{kKeyEscape}}) {
    tap('P');
    frame();
    ASSERT_TRUE(sees("Paused"));
    tap(go_on);
    frame();
    EXPECT_FALSE(model_->running()->paused());
    EXPECT_FALSE(loop_->menu_open());
    EXPECT_FALSE(sees("Paused"));
  }
  tap('P');
  frame();
  tab(3);  // Continue, Start again, Leave
  tap(kKeyEnter);
  frame();
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing) << "all of the box by keys alone";
  EXPECT_EQ(model_->running(), nullptr);
}

TEST_F(RunScreenBench, RAsksAndEscTakesItBack) {
  begin();
  ASSERT_TRUE(ready());
  AttemptRunner* first = model_->running();
  tap('R');
  frame();
  EXPECT_TRUE(sees("Start again?"));
  EXPECT_FALSE(sees("Paused"));
  tap(kKeyEscape);
  frame();
  EXPECT_EQ(model_->running(), first);
  EXPECT_FALSE(first->paused());
  tap('P');
  frame();
  EXPECT_TRUE(sees("Paused")) << "the question is forgotten";
}

TEST_F(RunScreenBench, MMarksNothingBeforeTheClockBegins) {
  begin();
  ASSERT_TRUE(ready());
  tap('M');
  frame();
  EXPECT_TRUE(sees("Nothing is marked before the clock begins."));
}

TEST_F(RunScreenBench, RThenEnterBeginsAnewAndTheOldOneIsKeptAsAborted) {
  begin();
  ASSERT_TRUE(ready());
  tap('R');
  EXPECT_TRUE(model_->running()->paused()) << "not without asking";
  frame();
  tap(kKeyEnter);
  ASSERT_NE(model_->running(), nullptr);
  ASSERT_TRUE(ready()) << "a fresh one runs";
  EXPECT_FALSE(model_->running()->paused());
  Database database(bench_.options().database, OpenMode::kExisting);
  const auto attempts = AttemptStore(database).list();
  ASSERT_EQ(attempts.size(), 2u);
  EXPECT_EQ(attempts[0].status, "running");
  EXPECT_EQ(attempts[1].status, "aborted");
}

TEST_F(RunScreenBench, TheEndGivesItsResultToTheDesk) {
  begin();
  ASSERT_TRUE(ready());
  model_->running()->abort();
  ASSERT_TRUE(until([this] { return model_->running() == nullptr; }));
  ASSERT_TRUE(model_->result());
  EXPECT_EQ(model_->result()->grade.status, AttemptStatus::kAborted);
}

TEST_F(RunScreenBench, ALostContextOfAttemptsLeadsAway) {
  loop_->go(ScreenName::kRun);
  EXPECT_TRUE(frame()) << "no attempt runs: nothing to show, nothing breaks";
}

TEST_F(RunScreenBench, TheLightPostTurnsAThirtyDegreeViewAndTheDialFollowsThePicture) {
  ModelOptions thirty = bench_.options();
  thirty.exercise = "reach-and-orient";
  thirty.scope = "30";
  open(thirty);
  begin();
  ASSERT_TRUE(ready());
  const auto seen = [this] { return const_cast<Screen*>(loop_->screen())->stage(*model_, width_, height_)->view; };
  const Camera before = seen().camera;
  EXPECT_TRUE(before.level_rad);
  frame({key('D')});
  for (int i = 0; i < 15; ++i) frame();
  frame({key('D', InputEvent::Kind::kKeyUp)});
  const SceneView turned = seen();
  EXPECT_GT(turned.camera.notch_rad, 0.4);
  EXPECT_GT((turned.camera.look_at_T - before.look_at_T).norm(), 0.01);
  if (turned.hud.dial) {
    const Vec3 offset = turned.hud.dial->offset_C;
    EXPECT_NEAR(offset.norm(), turned.hud.dial->position_error_m, 1e-9);
  }
  tap('H');
  for (int i = 0; i < 30; ++i) frame();
  EXPECT_NEAR(seen().camera.notch_rad, 0, 1e-9) << "as at the start";
  EXPECT_NEAR((seen().camera.look_at_T - before.look_at_T).norm(), 0, 1e-9);
}

TEST_F(RunScreenBench, ALostContextPausesTheAttemptAndANewOneShowsItAgain) {
  begin();
  ASSERT_TRUE(ready());
  frame();
  AttemptRunner* const attempt = model_->running();
  const Vec3 before = tip();
  loop_->lose_pictures();
  context_ = std::make_unique<HeadlessContext>();
  EXPECT_TRUE(frame({key('Q')})) << "nothing to draw on, nothing breaks";
  loop_->take_up(*context_);
  frame();
  frame();
  EXPECT_EQ(model_->running(), attempt) << "the same attempt";
  EXPECT_TRUE(attempt->paused());
  EXPECT_TRUE(sees("Paused"));
  EXPECT_NEAR((tip() - before).norm(), 0, 0.002);
  const Image image = loop_->picture();
  EXPECT_GT(std::count_if(image.rgb.begin(), image.rgb.end(), [](std::uint8_t v) { return v > 60; }),
            image.width * image.height / 20);
  tap('P');
  EXPECT_FALSE(attempt->paused()) << "and on it goes";
}

TEST_F(RunScreenBench, LatencyIsMeasuredOnTheWholePath) {
  loop_.reset();
  model_.reset();
  const PictureLatency l = measure_picture_latency(source_assets(), 3, 640, 360);
  EXPECT_GT(l.frames, 2);
  EXPECT_GT(l.events, 0);
  EXPECT_LE(l.events, l.frames);
  EXPECT_GE(l.median_s, l.frame_median_s * 0.5) << "no picture shows an event before it is drawn";
  EXPECT_GE(l.longest_s, l.p95_s);
  std::printf("%s: frame %.1f ms, event to picture %.1f ms median, %.1f ms 95 %%, bar %.1f ms\n", l.renderer.c_str(),
              1e3 * l.frame_median_s, 1e3 * l.median_s, 1e3 * l.p95_s, 1e3 * l.bar_s());
}

/// Pictures for the eye: TROCAR_PICTURES=folder.
TEST_F(RunScreenBench, PictureOfPressing) {
  if (!std::getenv("TROCAR_PICTURES")) GTEST_SKIP() << "only for the eye";
  press_picture();
}

TEST_F(RunScreenBench, PicturesOfIt) {
  if (!std::getenv("TROCAR_PICTURES")) GTEST_SKIP() << "only for the eye";
  width_ = 1280;
  height_ = 720;
  begin();
  ASSERT_TRUE(ready());
  for (int i = 0; i < 10; ++i) frame({pointer(InputEvent::Kind::kMouseMove, 600 + 3.0 * i, 400 - 18.0 * i)});
  keep_picture("run_first");
  InputEvent wheel = pointer(InputEvent::Kind::kWheel, 380, 160);
  wheel.wheel = 3;
  for (int i = 0; i < 8; ++i) frame({wheel});
  keep_picture("run_deeper");
  tap('P');
  frame();
  keep_picture("run_paused");
  tap('P');
  model_->settings().left_handed = true;
  for (int i = 0; i < 3; ++i) frame();
  keep_picture("run_left");
  model_->settings().scale = 2;
  for (int i = 0; i < 3; ++i) frame();
  keep_picture("run_double");
  model_->settings().scale = 1;
  for (int i = 0; i < 12; ++i) frame({pointer(InputEvent::Kind::kMouseMove, 600 + 60.0 * i, 100)});
  for (int i = 0; i < 12; ++i) frame();
  keep_picture("run_rim");
}

TEST_F(RunScreenBench, ABoardThatStopsAnsweringPausesTheAttemptAndItGoesOnWhenItAnswersAgain) {
  begin();
  ASSERT_TRUE(ready());
  AttemptRunner* run = model_->running();
  Vec3 rests = tip();
  ASSERT_TRUE(until([&] {  // the tip has gone to the height of the start ball
    const bool still = frame() && (tip() - std::exchange(rests, tip())).norm() < 1e-4;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return still;
  }));
  ASSERT_TRUE(run->plug(false));
  ASSERT_TRUE(until([&] { return sees("The device does not answer"); }));
  EXPECT_TRUE(run->paused());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // a step that was under way ends
  const double stands_at = run->newest().t_s;
  const Vec3 held = tip();
  tap('P');  // as long as it is out, going on does not help
  for (int i = 0; i < 20; ++i) {
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(run->newest().t_s, stands_at) << "the clock stands";
  EXPECT_TRUE(sees("The device does not answer"));
  run->plug(true);
  ASSERT_TRUE(until([&] { return sees("Paused"); })) << "nothing moves before the person says so";
  EXPECT_EQ(run->newest().t_s, stands_at);
  tap('P');
  ASSERT_TRUE(until([&] { return run->newest().t_s > stands_at + 0.3; }));
  EXPECT_EQ(model_->running(), run) << "the same attempt";
  EXPECT_FALSE(run->finished());
  EXPECT_LT((tip() - held).norm(), 0.01) << "state kept";
  ASSERT_TRUE(model_->end_attempt());
  EXPECT_EQ(model_->result()->grade.status, AttemptStatus::kAborted) << "no fault: " << model_->result()->device.fault;
  EXPECT_EQ(pauses_of(model_->result()->device.realtime).size(), 1u) << "noted";
}

TEST_F(RunScreenBench, AnExamHasNoPauseForACableEither) {
  ModelOptions exam = bench_.options();
  exam.hand = "expert";
  exam.level = "exam";
  open(exam);
  ASSERT_EQ(model_->begin_attempt(), "");
  EXPECT_FALSE(model_->running()->plug(false));
  EXPECT_TRUE(model_->running()->board_answers());
}

TEST_F(RunScreenBench, AnExamIsLeftByNoWayThatDoesNotAsk) {
  ModelOptions exam = bench_.options();
  exam.hand = "expert";
  exam.level = "exam";
  width_ = 1280;
  height_ = 720;
  open(exam);
  begin();
  frame();
  AttemptRunner* run = model_->running();
  EXPECT_FALSE(loop_->close()) << "the window's cross";
  frame();
  ASSERT_TRUE(sees("Leave the exam?"));
  EXPECT_FALSE(run->paused()) << "the clock runs on";
  tap(kKeyEscape);
  EXPECT_FALSE(sees("Leave the exam?"));
  for (const char* way : {"Leave this attempt", "Start page", "Settings", "Quit"}) {
    tap(kKeyEscape);
    click(way);
    ASSERT_TRUE(sees("Leave the exam?")) << way;
    click("Go on with the exam");
    EXPECT_FALSE(sees("Leave the exam?")) << way;
  }
  tap('P');
  frame();
  ASSERT_TRUE(sees("The exam goes on"));
  click("Leave this attempt");
  ASSERT_TRUE(sees("Leave the exam?"));
  tap(kKeyEscape);
  EXPECT_EQ(model_->running(), run);
  EXPECT_FALSE(run->finished());
  EXPECT_FALSE(loop_->close());
  EXPECT_FALSE(click("Leave the exam")) << "said once more, the program ends";
  EXPECT_FALSE(model_->running());
  EXPECT_EQ(model_->result()->grade.status, AttemptStatus::kAborted);
}

TEST_F(RunScreenBench, TheWindowClosesWithoutAskingOutsideAnExam) { EXPECT_TRUE(loop_->close()); }

}  // namespace
}  // namespace trocar::testing_support::run_screen_test
