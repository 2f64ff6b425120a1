// What the first page and the settings do when a person uses them, by keys and pointer.
#include "tests/app/window/pages/loop_bench.h"
#include "trainees/records/accounts.h"

namespace trocar::start_settings_test {
namespace {

using testing_support::pointer;
using testing_support::press;
using testing_support::typed;
using Kind = InputEvent::Kind;

class PageTest : public testing_support::LoopBench {
 protected:
  void SetUp() override {
    LoopBench::SetUp();
    if (IsSkipped()) return;
    width_ = 1280;
    height_ = 720;
  }
  const DrawnText* text(const std::string& said) const {
    for (const DrawnText& t : loop_->texts())
      if (t.text == said) return &t;
    return nullptr;
  }
  /// Into its field, after the guest's button.
  void type_code(const std::string& code) {
    for (int i = 0; i < 2; ++i) frame();
    tab(7);
    for (int i = 0; i < 2; ++i) frame();
    frame(typed(code));
    frame();
  }
  /// Clicks on a text that is seen, as a person does.
  void click(const std::string& said) {
    frame();
    const DrawnText* t = text(said);
    ASSERT_TRUE(t) << "not on the page: " << said;
    const double x = t->x + 4, y = t->y + t->height / 2;
    frame({pointer(Kind::kMouseMove, x, y)});
    frame({pointer(Kind::kButtonDown, x, y)});
    frame({pointer(Kind::kButtonUp, x, y)});
    frame();
  }
};

TEST_F(PageTest, TryNowChoosesTheExerciseThatIsFelt) {
  model_->exercise_id = "limited-grasp";
  model_->level = "L2";
  click("Try now as a guest");
  EXPECT_EQ(model_->exercise_id, "surface-touch");
  EXPECT_EQ(model_->level, "L1");
}

TEST_F(PageTest, SigningInWithoutACodeSaysWhatIsMissing) {
  frame();
  // The heading says "Sign in" too; the button is the lower one.
  const DrawnText* button = nullptr;
  for (const DrawnText& t : loop_->texts())
    if (t.text == "Sign in" && (!button || t.y > button->y)) button = &t;
  ASSERT_TRUE(button);
  const double x = button->x + 3, y = button->y + 5;
  frame({pointer(Kind::kMouseMove, x, y)});
  frame({pointer(Kind::kButtonDown, x, y)});
  frame({pointer(Kind::kButtonUp, x, y)});
  frame();
  EXPECT_TRUE(sees("Type your code first."));
  EXPECT_TRUE(model_->is_guest());
}

TEST_F(PageTest, ATraineeSeesWhatComesNextAndCanSignOut) {
  ASSERT_EQ(model_->sign_in("T-4"), "");
  frame();
  EXPECT_TRUE(sees("Signed in as T-4"));
  EXPECT_TRUE(sees("Not tried yet."));
  click("Sign out");
  EXPECT_TRUE(model_->is_guest());
  frame();
  EXPECT_TRUE(sees("Try now as a guest"));
}

TEST_F(PageTest, ATypedCodeThatNobodyHasIsAskedAboutFirst) {
  type_code("T-77");
  tap(kKeyEnter);
  frame();
  EXPECT_TRUE(sees("Nobody has the code T-77"));
  EXPECT_TRUE(model_->is_guest());
  tap(kKeyEnter);  // goes back: a slip and two times Enter make nobody
  frame();
  EXPECT_TRUE(sees("Your code"));
  EXPECT_EQ(model_->code_asks("T-77"), PracticeModel::CodeAsks::kNew);
  tap(kKeyEnter);  // the blue button: sign in with what still stands there
  click("New trainee T-77");
  EXPECT_EQ(model_->trainee(), "T-77");
}

TEST_F(PageTest, AStationThatAsksForThePinHasAFieldForIt) {
  ASSERT_EQ(model_->sign_in("T-4"), "");
  model_->sign_out();
  {
    Database database(bench_.options().database, OpenMode::kExisting);
    AccountStore(database).add("ann", "Ann", Role::kTrainee, "T-4", "580274", "");
  }
  model_->settings().ask_pin = true;
  type_code("T-4");
  tap(kKeyEnter);
  frame();
  ASSERT_TRUE(sees("Sign in as T-4"));
  frame();  // its field has the focus
  frame(typed("580274"));
  frame();
  EXPECT_FALSE(sees("580274")) << "nobody reads it over a shoulder";
  tap(kKeyEnter);
  EXPECT_EQ(model_->trainee(), "T-4");
}

TEST_F(PageTest, TheScenesOriginIsSaid) {
  ASSERT_TRUE(model_->show_scene(60));
  frame();
  frame();
  bool said = false;
  for (const DrawnText& t : loop_->texts()) said |= t.text.find("synthetic") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST_F(PageTest, TheSceneBreathes) {
  ASSERT_TRUE(model_->show_scene(60));
  for (int i = 0; i < 3; ++i) frame();
  const Image before = loop_->picture();
  for (int i = 0; i < 20; ++i) loop_->frame(64, 48, 0.05, {});
  frame();
  const Image after = loop_->picture();
  long moved = 0;
  for (std::size_t i = 0; i < before.rgb.size(); i += 3) moved += std::abs(before.rgb[i] - after.rgb[i]) > 24 ? 1 : 0;
  EXPECT_GT(moved, 500) << "a second later it is the same picture";
}

TEST_F(PageTest, SwitchesOfTheSettingsAreKept) {
  loop_->go(ScreenName::kSettings);
  frame();
  ASSERT_TRUE(sees("Left-handed"));
  const DrawnText label = *text("Left-handed");
  const double x = label.x - 20, y = label.y + label.height / 2;
  frame({pointer(Kind::kMouseMove, x, y)});
  frame({pointer(Kind::kButtonDown, x, y)});
  frame({pointer(Kind::kButtonUp, x, y)});
  frame();
  EXPECT_TRUE(model_->settings().left_handed);
  EXPECT_TRUE(load_settings(bench_.options().settings).left_handed) << "on the disk";
}

TEST_F(PageTest, ARowOfTheKeysWaitsForAKeyAndEscapeLeavesIt) {
  loop_->go(ScreenName::kSettings);
  click("Tip up");
  EXPECT_TRUE(sees("press a key"));
  frame(press(kKeyEscape));
  frame();
  EXPECT_FALSE(sees("press a key"));
  EXPECT_FALSE(loop_->menu_open()) << "the key was asked for, not the menu";
  EXPECT_EQ(model_->keys().key_of(Action::kUp), KeyMap().key_of(Action::kUp));
}

TEST_F(PageTest, AKeyThatMustStayIsRefusedInWords) {
  loop_->go(ScreenName::kSettings);
  click("Tip up");
  frame(press(kKeyF1));
  frame();
  bool said = false;
  for (const DrawnText& t : loop_->texts())
    said |= t.text.find("F1") != std::string::npos && t.text.find("keys:") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST_F(PageTest, ANoticeStaysForAWhileAndGoes) {
  frame();
  model_->notice = "The disk is nearly full.";
  frame();
  EXPECT_TRUE(sees("The disk is nearly full."));
  EXPECT_TRUE(model_->notice.empty()) << "taken over";
  for (int i = 0; i < 62; ++i) loop_->frame(640, 360, 0.1, {});
  EXPECT_FALSE(sees("The disk is nearly full."));
}

TEST_F(PageTest, MenuLeavesAnAttemptAsAborted) {
  frame();
  ASSERT_EQ(model_->begin_attempt(), "");
  tap(kKeyEscape);
  ASSERT_TRUE(sees("Leave this attempt"));
  click("Leave this attempt");
  EXPECT_FALSE(model_->running());
  ASSERT_TRUE(model_->result());
  EXPECT_EQ(model_->result()->grade.status, AttemptStatus::kAborted);
}

}  // namespace
}  // namespace trocar::start_settings_test
