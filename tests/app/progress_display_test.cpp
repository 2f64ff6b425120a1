#include "app/progress_display.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <sstream>

namespace trocar {
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

TEST(ProgressDisplay, AnInterruptBecomesAnExceptionAtTheNextStep) {
  std::ostringstream err;
  ProgressDisplay display(err, false);
  display.show("reading", 0);
  ::kill(::getpid(), SIGINT);
  EXPECT_THROW(display.show("reading", 0.1), Interrupted);
}

}  // namespace
}  // namespace trocar
