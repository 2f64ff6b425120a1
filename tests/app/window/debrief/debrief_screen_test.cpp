// T5 and T6 with a model behind them: a stored attempt is shown, watched, compared with one's past, exported.
#include "app/window/debrief/debrief_screen.h"

#include <fstream>
#include <thread>

#include "app/window/pages/progress_screen.h"
#include "tests/app/session/recording/recording_samples.h"
#include "tests/app/window/pages/page_bench.h"
#include "tests/app/window/pages/practice_bench.h"

namespace trocar::debrief_screen_test {
namespace {

using testing_support::graded;
using testing_support::heavy_run;
using testing_support::press;

class DeskPagesTest : public testing_support::PageBench {
 protected:
  void SetUp() override {
    PageBench::SetUp();
    if (!IsSkipped()) model_ = bench_.model();
  }
  /// Stored as if it had been done now. @return its uuid.
  std::string store(const AttemptResult& result, const std::string& trainee, bool recorded = true) {
    std::filesystem::path file;
    if (recorded)
      file = bench_.folder.write("run" + std::to_string(boards_ + 1) + ".trec", small_recording(6, 1000, 3));
    return testing_support::stored(bench_.options().database, result, touch_, trainee, ++boards_, file);
  }
  std::optional<ScreenName> show(Screen& screen, const std::vector<InputEvent>& events = {}) {
    std::optional<ScreenName> to;
    frame([&](Ui& ui) { to = screen.frame(ui, *model_, 0.02); }, events);
    return to;
  }
  void show_until(Screen& screen, const std::string& said) {
    for (int i = 0; i < 200 && !says(said); ++i) {
      show(screen);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  testing_support::PracticeBench bench_;
  const Exercise touch_ = testing_support::shipped_exercise("surface-touch");
  std::unique_ptr<PracticeModel> model_;
  int boards_ = 0;
};

TEST_F(DeskPagesTest, WithoutAResultItGoesToTheStart) {
  DebriefScreen screen;
  EXPECT_EQ(show(screen), ScreenName::kStart);
}

TEST_F(DeskPagesTest, AStoredAttemptIsShownWithItsForcesAndWatchedFromTheChosenMoment) {
  ASSERT_EQ(model_->sign_in("T-1"), "");
  ASSERT_TRUE(model_->open_result(store(heavy_run(touch_), "T-1")));
  DebriefScreen screen;
  show(screen);
  EXPECT_TRUE(text("NOT YET")) << "at once, before the forces have been read";
  show_until(screen, "Force at the tip, N");
  EXPECT_TRUE(text("Force at the tip, N"));
  expect_clear("a stored attempt");
  EXPECT_EQ(show(screen, press('W')), ScreenName::kReplay);
  EXPECT_EQ(model_->replay_file, model_->recording());
  EXPECT_TRUE(model_->replay_beside.empty());
  EXPECT_EQ(show(screen, press('M')), ScreenName::kProgress);
  EXPECT_EQ(show(screen, press('N')), ScreenName::kBriefing);
}

TEST_F(DeskPagesTest, OnlyOnesOwnAttemptsByTheSameInputAreCompared) {
  ASSERT_EQ(model_->sign_in("T-1"), "");
  AttemptResult by_device = graded(touch_, "L1", {{"time_s", 33}});
  by_device.hand = "device";
  store(by_device, "T-1");
  store(graded(touch_, "L1", {{"time_s", 31}}), "T-2");
  store(graded(touch_, "L1", {{"time_s", 71.25}}), "T-1");
  ASSERT_TRUE(model_->open_result(store(heavy_run(touch_), "T-1")));
  DebriefScreen screen;
  show(screen);
  show(screen);
  EXPECT_TRUE(text("71.2 s") || text("71.3 s"));
  EXPECT_FALSE(says("33.0 s"));
  EXPECT_FALSE(says("31.0 s"));
}

TEST_F(DeskPagesTest, WithoutARecordingItSaysSoAndOffersNoReplay) {
  ASSERT_TRUE(model_->open_result(store(heavy_run(touch_), "guest", false)));
  DebriefScreen screen;
  show(screen);
  show(screen);
  EXPECT_TRUE(says("Nothing was recorded"));
  EXPECT_FALSE(says("Watch from"));
  EXPECT_EQ(show(screen, press('W')), std::nullopt);
  EXPECT_TRUE(says("this one is kept as a guest's"));
  EXPECT_EQ(show(screen, press('I')), ScreenName::kStart);
}

TEST_F(DeskPagesTest, ADamagedRecordingIsNamedNotDrawn) {
  const std::string uuid = store(heavy_run(touch_), "guest");
  bench_.folder.write("run1.trec", "not a recording");
  ASSERT_TRUE(model_->open_result(uuid));
  DebriefScreen screen;
  show_until(screen, "The recording cannot be read");
  EXPECT_TRUE(says("The recording cannot be read"));
}

TEST_F(DeskPagesTest, ProgressShowsOpensAndExports) {
  ASSERT_EQ(model_->sign_in("T-1"), "");
  store(graded(touch_, "L1"), "T-1");
  store(heavy_run(touch_), "T-1");
  store(graded(touch_, "L1"), "T-2");
  ProgressScreen screen;
  show(screen);
  show(screen);
  EXPECT_TRUE(says("T-1: 2 attempts")) << "not those of T-2";
  show(screen, press('X'));
  const auto folder = bench_.folder / "exports";
  ASSERT_TRUE(std::filesystem::is_directory(folder));
  const auto file = std::filesystem::directory_iterator(folder)->path();
  EXPECT_NE(model_->notice.find(file.string()), std::string::npos) << model_->notice;
  std::ifstream in(file);
  int lines = 0;
  for (std::string line; std::getline(in, line);) ++lines;
  EXPECT_EQ(lines, 3) << "heads and two attempts";
  for (int i = 0; i < 10 && !says("Open attempt"); ++i) {
    show(screen, press(kKeyTab));
    show(screen, press(kKeyLeft));
    show(screen);
  }
  EXPECT_EQ(show(screen, press('O')), ScreenName::kDebrief);
  ASSERT_TRUE(model_->result());
  ProgressScreen fresh;
  layer_ = std::make_unique<UiLayer>(*context_, 1);  // nothing has the focus
  show(fresh);
  EXPECT_EQ(show(fresh, press(kKeyEnter)), ScreenName::kBack);
  EXPECT_EQ(show(fresh, press(kKeyEscape)), ScreenName::kBack);
  EXPECT_TRUE(fresh.takes_escape());
}

TEST_F(DeskPagesTest, AnUnknownAttemptIsANotice) {
  EXPECT_FALSE(model_->open_result("no-such"));
  EXPECT_FALSE(model_->notice.empty());
  EXPECT_FALSE(model_->result());
}

}  // namespace
}  // namespace trocar::debrief_screen_test
