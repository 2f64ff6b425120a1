// Ctrl-C and SIGTERM as a question.
#include "app/session/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

namespace trocar::interrupt_test {
namespace {

TEST(InterruptWatch, SaysWhenASignalHasComeAndGoesOnSayingSo) {
  for (const int signal : {SIGINT, SIGTERM}) {
    InterruptWatch watch;
    EXPECT_FALSE(watch.seen());
    ::kill(::getpid(), signal);
    EXPECT_TRUE(watch.seen());
    EXPECT_TRUE(watch.seen());
  }
}

TEST(InterruptWatch, ThreadsStartedUnderItDoNotDieOfIt) {
  InterruptWatch watch;
  std::thread([] { ::raise(SIGTERM); }).join();  // to that very thread: pending there, fetched by nobody, harmless
  ::kill(::getpid(), SIGINT);
  EXPECT_TRUE(watch.seen());
}

TEST(InterruptWatch, OneThatComesTooLateDoesNotKillTheProgram) {
  {
    InterruptWatch watch;
    ::kill(::getpid(), SIGTERM);
  }
  sigset_t mask;
  ASSERT_EQ(::pthread_sigmask(SIG_SETMASK, nullptr, &mask), 0);
  EXPECT_EQ(::sigismember(&mask, SIGTERM), 0) << "the mask is what it was";
}

}  // namespace
}  // namespace trocar::interrupt_test
