#include "app/window/practice/practice_loop.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "app/window/practice/screen_table.h"
#include "tests/app/window/pages/loop_bench.h"
#include "trainees/live/live_stations.h"

namespace trocar::practice_loop_test {
namespace {

using testing_support::press;
using testing_support::typed;

class PracticeLoopTest : public testing_support::LoopBench {};

TEST_F(PracticeLoopTest, BeginsAtTheStartWithALitScene) {
  ASSERT_TRUE(model_->show_scene(60));
  frame();
  frame();
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
  EXPECT_TRUE(sees("Trocar"));
  const Image image = loop_->picture();
  long red = 0;
  for (int x = image.width / 2; x < image.width; ++x)
    for (int y = 0; y < image.height; ++y)
      red += image.pixel(x, y)[0] > 60 && image.pixel(x, y)[0] > image.pixel(x, y)[2] ? 1 : 0;
  EXPECT_GT(red, image.width * image.height / 20) << "the scope's picture is dark or missing";
}

TEST_F(PracticeLoopTest, ADeskThatLooksSeesTheScopeOfAnAttempt) {
  ASSERT_EQ(model_->begin_attempt(), "");
  loop_->go(ScreenName::kRun);
  const std::filesystem::path file = model_->database();
  std::string name;
  for (int i = 0; i < 600 && name.empty(); ++i) {
    frame();
    const LiveStations seen = look_at_stations(file);
    if (!seen.stations.empty()) name = seen.stations[0].picture;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_NE(name, "") << "no picture came";
  const auto jpeg = look_at_picture(file, name);
  ASSERT_TRUE(jpeg);
  EXPECT_GT(jpeg->size(), 2000u) << "an empty picture is smaller";
  if (const char* folder = std::getenv("TROCAR_PICTURES"))
    std::ofstream(std::filesystem::path(folder) / "desk_live.jpg", std::ios::binary) << *jpeg;
  model_->end_attempt();
}

TEST_F(PracticeLoopTest, MenuOpensAndClosesWithEscape) {
  frame();
  tap(kKeyEscape);
  EXPECT_TRUE(loop_->menu_open());
  EXPECT_TRUE(sees("Menu"));
  tap(kKeyEscape);
  EXPECT_FALSE(loop_->menu_open());
}

TEST_F(PracticeLoopTest, KeyboardAloneQuitsThroughTheMenu) {
  frame();
  tap(kKeyEscape);
  tab(5);  // Back, Start page, Settings, Fill the screen, Quit
  bool on = tap(kKeyEnter);
  on = on && frame();
  EXPECT_FALSE(on);
  EXPECT_EQ(loop_->here(), ScreenName::kQuit);
}

TEST_F(PracticeLoopTest, KeyboardAloneSignsIn) {
  frame();
  frame();
  tab(7);  // Try now, tutorial, free play, gallbladder, stitching, flap, code
  frame();
  frame();
  frame(typed("T-7"));
  frame();
  tap(kKeyEnter);
  frame();
  EXPECT_TRUE(model_->is_guest()) << "nobody has this code: it is asked about";
  tab(2);  // Back to the code, New trainee
  tap(kKeyEnter);
  frame();
  EXPECT_EQ(model_->trainee(), "T-7");
}

TEST_F(PracticeLoopTest, KeyboardAloneGoesToTheSettingsAndBack) {
  frame();
  tap(kKeyEscape);
  tab(3);
  tap(kKeyEnter);
  frame();
  EXPECT_EQ(loop_->here(), ScreenName::kSettings);
  EXPECT_TRUE(sees("Settings"));
  tap(kKeyEnter);
  frame();
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
}

TEST_F(PracticeLoopTest, PlusAndMinusChangeTheSize) {
  frame();
  tap('=');
  EXPECT_EQ(model_->scale(), 1.25);
  tap('-');
  tap('-');
  EXPECT_EQ(model_->scale(), 1);
}

TEST_F(PracticeLoopTest, HelpListsTheKeysAsTheyAreAndTheMetrics) {
  model_->settings().keys = {{"roll-left", "I"}};
  model_->settings_changed();
  width_ = 1280;
  height_ = 2400;  // all of it at once
  frame();
  tap(kKeyF1);
  EXPECT_TRUE(sees("Roll to the left"));
  EXPECT_TRUE(sees("I"));
  EXPECT_FALSE(sees("Q"));
  tap(kKeyF2);
  EXPECT_TRUE(sees("What is measured"));
  tap(kKeyF1);
  EXPECT_TRUE(sees("Trocar"));
}

TEST_F(PracticeLoopTest, PictureKeySavesAPictureAndSaysWhere) {
  const std::filesystem::path folder = bench_.folder.path() / "pictures";
  setenv("XDG_PICTURES_DIR", folder.c_str(), 1);
  frame();
  tap(kKeyF12);
  tap(kKeyF12);
  unsetenv("XDG_PICTURES_DIR");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()), 2);
  frame();
  bool said = false;
  for (const DrawnText& t : loop_->texts()) said |= t.text.find(folder.string()) != std::string::npos;
  EXPECT_TRUE(said);
}

TEST_F(PracticeLoopTest, APictureThatCannotBeSavedIsANotice) {
  setenv("XDG_PICTURES_DIR", "/proc/none", 1);
  frame();
  EXPECT_TRUE(tap(kKeyF12));
  unsetenv("XDG_PICTURES_DIR");
  bool said = false;
  for (const DrawnText& t : loop_->texts()) said |= t.text.find("No picture could be saved") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST_F(PracticeLoopTest, AnySizeOfWindowIsDrawn) {
  for (const auto& [width, height] : {std::pair{200, 100}, std::pair{1280, 720}, std::pair{0, 0}, std::pair{63, 900},
                                      std::pair{900, 48}, std::pair{3840, 2160}, std::pair{300, 1200}}) {
    width_ = width;
    height_ = height;
    EXPECT_TRUE(frame()) << width << " x " << height;
    EXPECT_TRUE(frame());
    if (width >= 64 && height >= 48) {
      EXPECT_EQ(loop_->picture().width, width);
    }
  }
}

TEST_F(PracticeLoopTest, F11AsksForTheWholeScreen) {
  frame();
  EXPECT_FALSE(loop_->fullscreen());
  tap(kKeyF11);
  EXPECT_TRUE(loop_->fullscreen());
}

TEST_F(PracticeLoopTest, AKeyIsChosenInTheSettings) {
  loop_->go(ScreenName::kSettings);
  height_ = 720;
  width_ = 1280;
  frame();
  frame();
  tab(11);  // language, size, scope, picture, PIN, sound, steered by, sensitivity, left-handed, inverted, then the
            // first key: "Tip to the left"
  tap(kKeyEnter);
  frame();
  ASSERT_TRUE(sees("press a key"));
  frame(press('U'));
  frame();
  EXPECT_EQ(model_->keys().key_of(Action::kLeft), 'U');
  EXPECT_FALSE(sees("press a key"));
}

TEST_F(PracticeLoopTest, QuittingDuringAnAttemptStoresItAsAborted) {
  frame();
  ASSERT_EQ(model_->begin_attempt(), "");
  tap(kKeyEscape);
  EXPECT_TRUE(model_->running()->paused());
  tap(kKeyEscape);
  EXPECT_FALSE(model_->running()->paused());
  loop_.reset();
  EXPECT_FALSE(model_->running());
  ASSERT_TRUE(model_->result());
  EXPECT_EQ(model_->result()->grade.status, AttemptStatus::kAborted);
}

TEST(ScreenTable, EveryNameHasAName) {
  EXPECT_STREQ(screen_name(ScreenName::kStart), "start");
  EXPECT_STREQ(screen_name(ScreenName::kQuit), "quit");
  EXPECT_TRUE(make_screen(ScreenName::kStart));
  EXPECT_TRUE(make_screen(ScreenName::kSettings));
  EXPECT_FALSE(make_screen(ScreenName::kQuit));
}

TEST_F(PracticeLoopTest, EnterOnTheBlueButtonOfTheMenuGoesBackWithoutTabbing) {
  frame();
  tap(kKeyEscape);
  ASSERT_TRUE(loop_->menu_open());
  tap(kKeyEnter);
  EXPECT_FALSE(loop_->menu_open());
  EXPECT_EQ(loop_->here(), ScreenName::kStart);
}

TEST_F(PracticeLoopTest, BackGoesThePathThatOneCame) {
  const auto back_from = [this](ScreenName here) {
    loop_->go(here);
    frame();
    frame();
    tap(kKeyEscape);
    EXPECT_FALSE(loop_->menu_open());
    return loop_->here();
  };
  loop_->go(ScreenName::kCurriculum);
  EXPECT_EQ(back_from(ScreenName::kProgress), ScreenName::kCurriculum);
  loop_->go(ScreenName::kBriefing);
  EXPECT_EQ(back_from(ScreenName::kProgress), ScreenName::kBriefing);
  EXPECT_EQ(back_from(ScreenName::kReplay), ScreenName::kBriefing);
  EXPECT_EQ(back_from(ScreenName::kSettings), ScreenName::kBriefing);
  loop_->go(ScreenName::kProgress);
  loop_->go(ScreenName::kReplay);
  loop_->go(ScreenName::kProgress);
  loop_->go(ScreenName::kBack);
  EXPECT_EQ(loop_->here(), ScreenName::kReplay) << "each page once on the way";
  loop_->go(ScreenName::kBack);
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing);
  loop_->go(ScreenName::kStart);
  loop_->go(ScreenName::kBack);
  EXPECT_EQ(loop_->here(), ScreenName::kStart) << "nothing lies before it";
}

TEST_F(PracticeLoopTest, ProgressGoesBackToTheDebriefItWasOpenedFrom) {
  ASSERT_EQ(model_->begin_attempt(), "");
  model_->end_attempt();
  loop_->go(ScreenName::kRun);
  loop_->go(ScreenName::kDebrief);
  frame();
  tap('M');
  frame();
  ASSERT_EQ(loop_->here(), ScreenName::kProgress);
  tap(kKeyEscape);
  EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
}

TEST_F(PracticeLoopTest, AKeyThatIsChosenDoesNotLeaveTheSettings) {
  loop_->go(ScreenName::kSettings);
  height_ = 720;
  width_ = 1280;
  for (const std::int32_t chosen : {std::int32_t{kKeyEscape}, std::int32_t{kKeyEnter}}) {
    frame();
    frame();
    tab(11);
    tap(kKeyEnter);
    frame();
    ASSERT_TRUE(sees("press a key"));
    frame(press(chosen));
    frame();
    EXPECT_EQ(loop_->here(), ScreenName::kSettings);
    loop_->go(ScreenName::kStart);
    frame();
    loop_->go(ScreenName::kSettings);
  }
}

TEST_F(PracticeLoopTest, AGuestIsLedWhereTheCourseLeads) {
  const PracticeModel::Advice next = model_->next();
  EXPECT_EQ(next.exercise_id, "surface-touch") << "guests begin with what is felt";
  frame();
  frame();
  tap(kKeyEnter);
  EXPECT_EQ(loop_->here(), ScreenName::kBriefing);
  EXPECT_EQ(model_->exercise_id, next.exercise_id);
  EXPECT_EQ(model_->level, next.level);
}

}  // namespace
}  // namespace trocar::practice_loop_test
