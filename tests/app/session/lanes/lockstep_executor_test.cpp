// The lockstep executor: fixed order, simulated time.
#include "app/session/lanes/lockstep_executor.h"

#include <gtest/gtest.h>

#include <string>

namespace trocar::lockstep_executor_test {
namespace {

/// Writes its letter into a log at every call, a capital one when it is stopped.
class LoggingTask final : public Task {
 public:
  LoggingTask(std::string& log, char letter, std::uint32_t period, int calls = 1000)
      : log_(log), letter_(letter), period_(period), left_(calls) {}
  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t) override { log_ += letter_, --left_; }
  bool finished() const override { return left_ <= 0; }
  void stop() override { log_ += static_cast<char>(letter_ - 'a' + 'A'); }

 private:
  std::string& log_;
  char letter_;
  std::uint32_t period_;
  int left_;
};

TEST(LockstepExecutor, CallsTasksInTheirOrderAtTheirPeriodAndStopsThemOnce) {
  std::string log;
  LoggingTask a(log, 'a', 1), b(log, 'b', 3), c(log, 'c', 1);
  LockstepExecutor executor;
  for (Task* task : std::initializer_list<Task*>{&a, &b, &c}) executor.add(*task);
  int asked = 0;
  EXPECT_EQ(executor.run([&] { return ++asked == 4; }), 4u);
  EXPECT_EQ(log, "abcacacabcABC");
}

TEST(LockstepExecutor, ATaskThatHasFinishedEndsTheRunWithItsTick) {
  std::string log;
  LoggingTask a(log, 'a', 2, 2), b(log, 'b', 1);
  LockstepExecutor executor;
  executor.add(a);
  executor.add(b);
  EXPECT_EQ(executor.run(), 3u);
  EXPECT_EQ(log, "abbabAB") << "all tasks of the last tick run";
}

}  // namespace
}  // namespace trocar::lockstep_executor_test
