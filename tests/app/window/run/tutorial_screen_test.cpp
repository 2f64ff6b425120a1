// The first minute and free play as a person meets them, in the whole loop: what the mouse does moves the tutorial on,
// and nothing of either is kept.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/picture/gl/image.h"
#include "app/picture/scene/scope_optics.h"
#include "app/window/run/run_screen.h"
#include "app/window/run/tutorial.h"
#include "tests/app/window/pages/loop_bench.h"
#include "trainees/records/attempt_store.h"

namespace trocar::testing_support::tutorial_screen_test {
namespace {

using Kind = InputEvent::Kind;
using Step = Tutorial::Step;

class TutorialBench : public LoopBench {
 protected:
  /// Frames until it is so. @return whether it came.
  bool until(const std::function<bool()>& what, int frames = 1500) {
    for (int i = 0; i < frames; ++i) {
      if (what()) return true;
      turn();
    }
    return false;
  }
  void turn(const std::vector<InputEvent>& events = {}) {
    frame(events);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  bool runs() {
    return until(
        [this] { return model_->running() && model_->running()->ready() && model_->running()->newest().seen; });
  }
  const Tutorial* tutorial() const {
    const auto* run = dynamic_cast<const RunScreen*>(loop_->screen());
    return run ? run->tutorial() : nullptr;
  }
  bool at(Step step) const { return tutorial() && !tutorial()->over() && tutorial()->step() == step; }
  const RunMoment& now() { return model_->running()->newest(); }
  Screen::Stage stage() { return *const_cast<Screen*>(loop_->screen())->stage(*model_, width_, height_); }

  void pointer_by(double x, double y) { turn({pointer(Kind::kMouseMove, at_x_ += x, at_y_ += y)}); }
  /// The mouse goes where the place is seen. @return whether the tip came to it, seen from above.
  bool go_to(const std::function<Vec3()>& place_T, double within_m) {
    return until([&] {
      const Vec3 goal = place_T(), tip = now().record.stylus.X_TI.p;
      if ((goal - tip).head<2>().norm() < within_m) return true;
      const Screen::Stage seen = stage();
      const PixelRect part{0, 0, static_cast<int>(seen.width), static_cast<int>(seen.height)};
      const ScopeOptics optics(seen.view.camera, part);
      const auto from = optics.project(Vec3(tip.x(), tip.y(), goal.z())), to = optics.project(goal);
      if (!from || !to) return false;
      const Eigen::Vector2d way = 0.3 * (*to - *from);
      pointer_by(std::clamp(way.x(), -40.0, 40.0), std::clamp(way.y(), -40.0, 40.0));
      return false;
    });
  }
  void wheel(double notches) {
    InputEvent event = pointer(Kind::kWheel, at_x_, at_y_);
    event.wheel = notches;
    turn({event});
  }
  void key_goes(Kind kind, std::int32_t which) {
    InputEvent event;
    event.kind = kind;
    event.key = which;
    turn({event});
  }
  void button(Kind kind) { turn({pointer(kind, at_x_, at_y_)}); }
  void click() {
    button(Kind::kButtonDown);
    button(Kind::kButtonUp);
  }
  /// Holds the button until the force that counts is well in its band.
  bool press(const std::function<double()>& force_n) {
    button(Kind::kButtonDown);
    const bool there = until([&] { return force_n() > now().status.demand.band.low_n + 0.05; });
    button(Kind::kButtonUp);
    return there;
  }
  bool press_disc() {
    return go_to([this] { return now().status.demand.centre_T; }, 0.002) &&
           press([this] { return now().record.stylus.F_I_T.force.norm(); });
  }
  void keep_picture(const std::string& name) {
    if (const char* folder = std::getenv("TROCAR_PICTURES"))
      write_png(std::filesystem::path(folder) / (name + ".png"), loop_->picture());
  }
  std::size_t kept() {
    return AttemptStore(*std::make_unique<Database>(bench_.options().database, OpenMode::kExisting)).list().size();
  }

  double at_x_ = 400, at_y_ = 300;
};

/// Each step as a picture for the eye: TROCAR_PICTURES=folder, TROCAR_SIZE=800x600, TROCAR_LANGUAGE=de.
TEST_F(TutorialBench, EachStepIsDoneByTheMouseAndNothingIsKept) {
  const bool pictures = std::getenv("TROCAR_PICTURES") != nullptr;
  if (pictures && std::getenv("TROCAR_SIZE")) std::sscanf(std::getenv("TROCAR_SIZE"), "%dx%d", &width_, &height_);
  if (pictures && std::getenv("TROCAR_LANGUAGE")) {
    ModelOptions o = bench_.options();
    o.language = std::getenv("TROCAR_LANGUAGE");
    open(o);
  }
  ASSERT_EQ(model_->begin_play(Play::kTutorial), "");
  loop_->go(ScreenName::kRun);
  ASSERT_TRUE(runs());
  frame();
  for (int i = 0; i < 40; ++i) turn();
  ASSERT_TRUE(at(Step::kMove)) << "waiting does nothing";
  pointer_by(0, 0);
  const auto reached = [&](Step step, const char* name) {
    const bool there = until([&] { return at(step); });
    for (int i = 0; i < 6; ++i) turn();
    keep_picture(name);
    return there;
  };
  reached(Step::kMove, "1_move");
  ASSERT_TRUE(go_to([this] { return now().status.demand.centre_T; }, 0.003));
  ASSERT_TRUE(reached(Step::kOver, "2_over"));
  ASSERT_TRUE(go_to([this] { return now().status.demand.centre_T; }, 0.002));
  ASSERT_TRUE(reached(Step::kLower, "3_lower"));
  wheel(1);
  wheel(1);
  ASSERT_TRUE(reached(Step::kPress, "4_press"));
  ASSERT_TRUE(press_disc());
  ASSERT_TRUE(reached(Step::kKeep, "5_keep"));
  ASSERT_TRUE(reached(Step::kLetOff, "6_let_off"));
  click();
  ASSERT_TRUE(reached(Step::kLook, "7_look"));
  turn({key('V')});
  for (int i = 0; i < 8; ++i) pointer_by(15, 0);
  turn({key('V', Kind::kKeyUp)});
  ASSERT_TRUE(reached(Step::kLevel, "8_level"));
  turn(trocar::testing_support::press('H'));
  ASSERT_TRUE(reached(Step::kAgain, "9_again"));
  ASSERT_TRUE(press_disc());
  ASSERT_TRUE(reached(Step::kRaise, "10_raise"));
  ASSERT_TRUE(until([&] {
    wheel(-1);
    return at(Step::kGrip);
  }));
  ASSERT_TRUE(reached(Step::kGrip, "11_grip"));
  ASSERT_TRUE(press([this] { return now().record.stylus.grip_force_n; }));
  ASSERT_TRUE(reached(Step::kOpen, "12_open"));
  click();
  ASSERT_TRUE(until([this] { return loop_->here() == ScreenName::kStart; }));
  frame();
  keep_picture("13_start");
  EXPECT_TRUE(sees(model_->words()("That was all. The start page offers it again; F1 lists the keys.")));
  EXPECT_EQ(kept(), 0U);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(bench_.folder.path()))
    EXPECT_NE(entry.path().extension(), ".trec") << entry.path();
  EXPECT_FALSE(model_->result());
  EXPECT_TRUE(model_->past().empty());
}

TEST_F(TutorialBench, TheFirstStartOfAStationShowsItOnceAndEscSkipsIt) {
  bench_.folder.write("settings.toml", "version = 1\nsound = false\n");
  open(bench_.options());
  ASSERT_TRUE(until([this] { return loop_->here() == ScreenName::kRun; }));
  ASSERT_TRUE(runs());
  frame();
  EXPECT_TRUE(at(Step::kMove));
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
  EXPECT_EQ(model_->running(), nullptr);
  EXPECT_FALSE(loop_->menu_open());
  EXPECT_EQ(kept(), 0U);
  for (int i = 0; i < 60; ++i) frame();
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
  open(bench_.options());
  for (int i = 0; i < 60; ++i) frame();
  EXPECT_EQ(loop_->here(), ScreenName::kStart) << "the station remembers";
}

TEST_F(TutorialBench, WhoComesForAnExerciseIsNotTaught) {
  bench_.folder.write("settings.toml", "version = 1\nsound = false\n");
  ModelOptions given = bench_.options();
  given.exercise = "E02";
  open(given);
  EXPECT_FALSE(model_->tutorial_due());
  loop_->go(ScreenName::kStart);
  for (int i = 0; i < 60; ++i) frame();
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
}

TEST_F(TutorialBench, FreePlayHasAnOrganAndItsForceAndKeepsNothing) {
  ModelOptions free = bench_.options();
  free.play = Play::kFree;
  open(free);
  ASSERT_EQ(loop_->here(), ScreenName::kRun);
  ASSERT_TRUE(runs());
  pointer_by(0, 0);
  ASSERT_TRUE(go_to([this] { return model_->running()->scene().board.start_T; }, 0.004));
  ASSERT_TRUE(until([this] { return now().status.phase == Phase::kRun; }));
  const SceneView seen = stage().view;
  EXPECT_TRUE(seen.targets.empty());
  EXPECT_TRUE(seen.hud.steps.empty());
  EXPECT_TRUE(seen.hud.rows.empty());
  EXPECT_LT(seen.hud.elapsed_s, 0) << "no clock";
  ASSERT_EQ(seen.hud.bars.size(), 2U) << "of the tip and of the jaws";
  ASSERT_TRUE(go_to([this] { return model_->running()->scene().board.centre_T; }, 0.004));
  button(Kind::kButtonDown);
  EXPECT_TRUE(until([this] { return now().record.stylus.F_I_T.force.norm() > 0.2; }));
  button(Kind::kButtonUp);
  keep_picture("free");
  EXPECT_EQ(seen.hud.notices.back().text, "Grasper");
  key_goes(Kind::kKeyDown, 'F');
  EXPECT_TRUE(until([this] { return now().record.stylus.pedal; }));
  EXPECT_EQ(stage().view.hud.notices.front().text, "Pedal down");
  key_goes(Kind::kKeyUp, 'F');
  ASSERT_GT(now().record.stylus.F_I_T.force.norm(), 0.05) << "it still presses";
  tap('T');
  EXPECT_TRUE(until([this] { return sees("Let go and draw back before you change instruments."); }));
  EXPECT_EQ(now().record.stylus.instrument, 0);
  click();  // lets off
  ASSERT_TRUE(until([this] { return !now().record.stylus.contact; }));
  tap('T');
  EXPECT_TRUE(until([this] { return now().record.stylus.instrument == 1 && !now().record.stylus.pedal; }));
  EXPECT_EQ(stage().view.instrument, InstrumentKind::kScissors);
  EXPECT_EQ(stage().view.hud.notices.back().text, "Scissors");
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
  EXPECT_EQ(model_->running(), nullptr);
  EXPECT_EQ(kept(), 0U);
  EXPECT_TRUE(model_->past().empty());
}

TEST_F(TutorialBench, InFreePlayAFoldIsTakenByTheKeyOfTheJawsAndLetGo) {
  ModelOptions free = bench_.options();
  free.play = Play::kFree;
  open(free);
  ASSERT_TRUE(runs());
  pointer_by(0, 0);
  ASSERT_TRUE(go_to([this] { return model_->running()->scene().board.start_T; }, 0.004));
  ASSERT_TRUE(until([this] { return now().status.phase == Phase::kRun; }));
  ASSERT_TRUE(go_to([this] { return model_->running()->scene().board.centre_T; }, 0.004));
  EXPECT_TRUE(until([this] { return now().record.stylus.jaw_opening_m > 0.018; })) << "open at rest";
  for (int notch = 0; notch < 8; ++notch) wheel(1);  // 16 mm, from 8 mm above
  for (int i = 0; i < 30; ++i) turn();
  key_goes(Kind::kKeyDown, 'G');
  EXPECT_TRUE(until([this] { return now().tissue.held(); }));
  EXPECT_GT(stage().view.hud.bars.back().value_n, 0.1) << "the jaws' bar";
  keep_picture("fold");
  key_goes(Kind::kKeyUp, 'G');
  EXPECT_TRUE(until([this] { return !now().tissue.held(); }));
}

TEST_F(TutorialBench, ThePauseOffersTheStartPageAndAFreshBeginning) {
  ASSERT_EQ(model_->begin_play(Play::kTutorial), "");
  loop_->go(ScreenName::kRun);
  ASSERT_TRUE(runs());
  tap('P');
  frame();
  EXPECT_TRUE(sees("Nothing here is graded or kept."));
  tap(kKeyEscape);
  EXPECT_FALSE(model_->running()->paused()) << "Esc closes what lies on top";
  EXPECT_EQ(loop_->here(), ScreenName::kRun);
  tap('R');
  frame();
  tap(kKeyEnter);
  ASSERT_TRUE(runs());
  EXPECT_EQ(model_->playing(), Play::kTutorial);
  EXPECT_TRUE(at(Step::kMove));
}

TEST_F(TutorialBench, HelpScrollsToItsLastLineAndLeadsToTheTutorial) {
  width_ = 640;
  height_ = 400;
  tap(kKeyF1);
  frame();
  const auto bottom = [this](const std::string& text) {
    for (const DrawnText& t : loop_->texts())
      if (t.text == text) return t.y + t.height;
    return 1e9;
  };
  EXPECT_LT(bottom("Mouse"), height_) << "the mouse comes first";
  EXPECT_FALSE(sees("Fill the screen")) << "the last line, further down";
  const double unscrolled = bottom("Mouse");
  tap(kKeyDown);
  EXPECT_LT(bottom("Mouse"), unscrolled);
  const double before_wheel = bottom("Steering with keys");
  InputEvent wheel = pointer(Kind::kWheel, 320, 150);
  wheel.wheel = -1;
  frame({pointer(Kind::kMouseMove, 320, 150)});
  frame({wheel});
  frame();
  EXPECT_LT(bottom("Steering with keys"), before_wheel);
  for (int i = 0; i < 30; ++i) tap(kKeyPageDown);
  EXPECT_LT(bottom("Fill the screen"), height_ - 40) << "above the buttons";
  keep_picture("help_end");
  for (int i = 0; i < 60; ++i) tap(kKeyUp);
  EXPECT_LT(bottom("Mouse"), height_);
  EXPECT_GT(bottom("Mouse"), 0);
  tap(kKeyF6);
  ASSERT_TRUE(runs());
  frame();
  EXPECT_TRUE(at(Step::kMove));
}

TEST_F(TutorialBench, HelpOverAnAttemptDoesNotEndItForTheTutorial) {
  ASSERT_EQ(model_->begin_attempt(), "");
  loop_->go(ScreenName::kRun);
  ASSERT_TRUE(runs());
  tap(kKeyF1);
  frame();
  EXPECT_TRUE(sees("Close"));
  EXPECT_FALSE(sees("Tutorial"));
  AttemptRunner* const attempt = model_->running();
  tap(kKeyF6);
  EXPECT_EQ(model_->running(), attempt);
}

}  // namespace
}  // namespace trocar::testing_support::tutorial_screen_test
