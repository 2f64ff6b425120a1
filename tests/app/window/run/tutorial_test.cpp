#include "app/window/run/tutorial.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/picture/display/hud_layout.h"

namespace trocar::tutorial_test {
namespace {

using Step = Tutorial::Step;

/// What a person has done so far, as one moment.
struct Person {
  RunMoment moment;
  ScopeMove scope;
  Vec3 below_T = Vec3::Zero();
  Tutorial tutorial;

  Person() {
    moment.seen = true;
    moment.status.demand.radius_m = 0.004;
    moment.status.demand.band = {0.4, 0.8};
    moment.record.stylus.X_TI.p = Vec3(0.05, 0, 0.008);
  }
  StylusState& stylus() { return moment.record.stylus; }
  void force(double n) {
    stylus().contact = n > 0;
    stylus().F_I_T.force = Vec3(0, 0, n);
  }
  void pass(double s) {
    for (double t = 0; t < s; t += 0.05) tutorial.see({moment, below_T, scope}, 0.05);
  }
  void does(Step step) {
    DirectorStatus& status = moment.status;
    switch (step) {
      case Step::kMove:
        status.phase = Phase::kRun;
        break;
      case Step::kOver:
        stylus().X_TI.p = Vec3(0.001, 0, 0.008);
        break;
      case Step::kLower:
        stylus().X_TI.p.z() = 0.004;
        break;
      case Step::kPress:
        status.cue = Cue::kPress;
        force(0.5);
        break;
      case Step::kKeep:
        status.targets_done = 1;
        status.cue = Cue::kReach;
        break;
      case Step::kLetOff:
        force(0);
        break;
      case Step::kLook:
        scope.yaw_rad = 0.2;
        break;
      case Step::kLevel:
        scope = {};
        break;
      case Step::kAgain:
        status.targets_done = 2;
        status.cue = Cue::kGrip;
        status.demand.band = {0.7, 1.2};
        break;
      case Step::kRaise:
        stylus().X_TI.p.z() = 0.02;
        break;
      case Step::kGrip:
        stylus().grip_force_n = 0.9;
        break;
      case Step::kOpen:
        stylus().grip_force_n = 0;
        break;
    }
  }
  void up_to(Step step) {
    while (tutorial.step() < step) {
      does(tutorial.step());
      pass(2);
    }
  }
  std::string message(InputKind kind = InputKind::kMouse) const {
    return tutorial.says(Translator(), KeyMap(), kind).message;
  }
};

TEST(Tutorial, EachStepWaitsForItsDeedHoweverLong) {
  Person person;
  for (int i = 0; i < Tutorial::kSteps; ++i) {
    const auto step = static_cast<Step>(i);
    person.pass(120);
    ASSERT_FALSE(person.tutorial.over());
    ASSERT_EQ(person.tutorial.step(), step) << "time alone does nothing";
    person.does(step);
    person.pass(2);
  }
  EXPECT_TRUE(person.tutorial.over());
}

TEST(Tutorial, ADeedIsPraisedBeforeTheNextIsAskedFor) {
  Person person;
  person.does(Step::kMove);
  EXPECT_EQ(person.tutorial.see({person.moment, person.below_T, person.scope}, 0.05), Step::kMove);
  EXPECT_TRUE(person.tutorial.says(Translator(), KeyMap(), InputKind::kMouse).done);
  EXPECT_EQ(person.tutorial.step(), Step::kMove);
  person.pass(2);
  EXPECT_EQ(person.tutorial.step(), Step::kOver);
  EXPECT_FALSE(person.tutorial.says(Translator(), KeyMap(), InputKind::kMouse).done);
}

TEST(Tutorial, PassingOverTheDiscIsNotStayingOverIt) {
  Person person;
  person.up_to(Step::kOver);
  person.does(Step::kOver);
  person.pass(0.2);
  person.stylus().X_TI.p.x() = 0.05;
  person.pass(5);
  EXPECT_EQ(person.tutorial.step(), Step::kOver);
}

TEST(Tutorial, WhoLetsOffTooEarlyPressesAgain) {
  Person person;
  person.up_to(Step::kKeep);
  person.force(0);
  person.moment.status.cue = Cue::kReach;
  person.pass(1);
  EXPECT_EQ(person.tutorial.step(), Step::kPress);
  person.does(Step::kPress);
  person.pass(2);
  EXPECT_EQ(person.tutorial.step(), Step::kKeep);
}

TEST(Tutorial, WhoHasHeldTheDiscBeforeBeingAskedIsPraisedOnce) {
  Person person;
  person.up_to(Step::kOver);
  person.force(0.5);
  person.does(Step::kKeep);
  EXPECT_EQ(person.tutorial.see({person.moment, person.below_T, person.scope}, 0.05), Step::kKeep);
  person.pass(1.2);
  EXPECT_EQ(person.tutorial.step(), Step::kLetOff);
}

TEST(Tutorial, TooMuchForceAndAPlaceBesideTheDiscAreSaid) {
  Person person;
  person.up_to(Step::kPress);
  person.force(0.5);
  person.moment.status.cue = Cue::kReach;
  person.pass(0.1);
  EXPECT_EQ(person.message(), "Mouse: move the tip");
  person.force(1.2);
  person.pass(0.1);
  EXPECT_EQ(person.message(), "Left button, clicked: let off");
  EXPECT_EQ(person.tutorial.step(), Step::kPress);
}

TEST(Tutorial, ATipThatTheWheelHoldsDownIsDrawnBackByIt) {
  Person person;
  person.up_to(Step::kLetOff);
  person.force(0.2);  // less than the press: the click has taken that back
  person.pass(0.1);
  EXPECT_EQ(person.message(), "Wheel: deeper, back");
}

TEST(Tutorial, WordsAreThoseOfTheInputInHand) {
  Person person;
  for (const InputKind kind :
       {InputKind::kMouse, InputKind::kKeyboard, InputKind::kPad, InputKind::kSpaceMouse, InputKind::kDevice}) {
    Person each;
    for (int i = 0; i < Tutorial::kSteps; ++i) {
      each.up_to(static_cast<Step>(i));
      EXPECT_FALSE(each.message(kind).empty());
      EXPECT_FALSE(each.tutorial.says(Translator(), KeyMap(), kind).hint.empty());
    }
  }
  EXPECT_EQ(person.message(InputKind::kKeyboard), "Arrow keys: move the tip");
  person.up_to(Step::kLook);
  EXPECT_EQ(person.message(), "V, held, and the mouse: look round");
  EXPECT_EQ(person.message(InputKind::kPad), "X, held, and the left stick: look round");
}

TEST(Tutorial, TheListShowsWhatIsDoneAndWhatIsNow) {
  Person person;
  person.up_to(Step::kKeep);
  const auto list = person.tutorial.list(Translator());
  ASSERT_EQ(list.size(), 6U);
  EXPECT_EQ(list[1].state, HudStep::State::kDone);
  EXPECT_EQ(list[2].state, HudStep::State::kCurrent);
  EXPECT_EQ(list[3].state, HudStep::State::kOpen);
}

TEST(Tutorial, NothingThatIsSaidIsCut) {
  const std::filesystem::path folder = std::filesystem::path(TROCAR_SOURCE_DIR) / "assets/languages";
  FontSet fonts;
  for (const Language& language : languages(folder)) {
    const Translator w = language.code == "en" ? Translator() : Translator(folder, language.code);
    Person person;
    for (int i = 0; i < Tutorial::kSteps; ++i) {
      person.up_to(static_cast<Step>(i));
      for (const InputKind kind : {InputKind::kMouse, InputKind::kKeyboard, InputKind::kPad, InputKind::kSpaceMouse})
        for (const auto& [width, height, scale] :
             {std::tuple(800, 600, 1.0), {640, 400, 1.0}, {1280, 720, 1.0}, {1280, 720, 1.5}, {1920, 1080, 2.0}}) {
          const Tutorial::Said said = person.tutorial.says(w, KeyMap(), kind);
          Hud hud;
          hud.title = "-";
          hud.bars.resize(2);
          hud.toast = said.message;
          hud.toast_hint = said.hint;
          for (const HudText& text : layout_hud(hud, width, height, scale, fonts).texts)
            EXPECT_FALSE(text.text.ends_with("\u2026")) << language.code << " " << width << " " << text.text;
        }
    }
  }
}

}  // namespace
}  // namespace trocar::tutorial_test
