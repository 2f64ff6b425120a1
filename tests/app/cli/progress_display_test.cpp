#include "app/cli/progress_display.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <sstream>

namespace trocar::progress_display_test {
namespace {

TEST(ProgressDisplay, WithoutATerminalPrintsStagesAndQuarters) {
  std::ostringstream err;
  {
    ProgressDisplay display(err, false, std::chrono::milliseconds(0));
    for (int n = 0; n <= 100; ++n) display.show("reading", n / 100.0);
    display.show("meshing", -1);
    display.show("meshing", -1);
  }
  EXPECT_EQ(err.str(), "reading\nreading: 25 %\nreading: 50 %\nreading: 75 %\nreading: 100 %\nmeshing\n");
}

TEST(ProgressDisplay, WorkOfAMomentPrintsNothing) {
  std::ostringstream err;
  ProgressDisplay display(err, false, std::chrono::hours(1));
  for (int n = 0; n <= 100; ++n) display.show("reading", n / 100.0);
  EXPECT_EQ(err.str(), "");
}

TEST(ProgressDisplay, OnATerminalOneLineIsDrawnOverAndWiped) {
  std::ostringstream err;
  {
    ProgressDisplay display(err, true);
    display.show("reading", 0.5);
    EXPECT_EQ(err.str(), "\r[############            ] reading");
    display.clear();
    display.show("fit", 1.0);
  }
  const std::string text = err.str();
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_EQ(text.back(), '\r');
}

TEST(ProgressDisplay, TheDetailStandsBehindItsStageAndIsNoStageOfItsOwn) {
  std::ostringstream err;
  {
    ProgressDisplay display(err, false, std::chrono::milliseconds(0));
    display.show("pictures", 0, "1 of 4");
    for (int n = 1; n <= 4; ++n) display.show("pictures", n / 4.0, std::to_string(n) + " of 4");
  }
  EXPECT_EQ(err.str(),
            "pictures: 1 of 4\npictures: 25 %, 1 of 4\npictures: 50 %, 2 of 4\npictures: 75 %, 3 of 4\npictures: 100 "
            "%, 4 of 4\n");
  std::ostringstream line;
  ProgressDisplay display(line, true);
  display.show("pictures", 0.5, "2 of 4");
  EXPECT_EQ(line.str(), "\r[############            ] pictures: 2 of 4");
}

TEST(ProgressDisplay, ThePaceSaysHowFarHowFastAndHowLongStill) {
  EXPECT_EQ(pace_words(1, 900, 0), "1 of 900") << "nothing is known yet";
  EXPECT_EQ(pace_words(101, 901, 4), "101 of 901, 25 a second, 32 s left");
  EXPECT_EQ(pace_words(11, 901, 4), "11 of 901, 2.5 a second, 6 min left");
  EXPECT_EQ(pace_words(901, 901, 36), "901 of 901, 25 a second, 0 s left");
}

TEST(ProgressDisplay, AnInterruptBecomesAnExceptionAtTheNextStep) {
  std::ostringstream err;
  ProgressDisplay display(err, false);
  display.show("reading", 0);
  ::kill(::getpid(), SIGINT);
  EXPECT_THROW(display.show("reading", 0.1), Interrupted);
}

}  // namespace
}  // namespace trocar::progress_display_test
