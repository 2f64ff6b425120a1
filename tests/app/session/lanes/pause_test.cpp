// A run that stands still: no lane is called, no period counts as missed, and the clock of the run has not gone on.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/session/lanes/pause_switch.h"
#include "app/session/lanes/threaded_executor.h"

namespace trocar::pause_test {
namespace {

using std::chrono::milliseconds;

class Ticking final : public Task {
 public:
  explicit Ticking(std::uint32_t period) : period_(period) {}
  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t) override { ++runs_; }
  bool finished() const override { return end_; }
  std::atomic<std::uint64_t> runs_{0};
  std::atomic<bool> end_{false};

 private:
  std::uint32_t period_;
};

TEST(PauseSwitch, AddsUpWhatItStoodAndIgnoresRepetition) {
  PauseSwitch pause;
  EXPECT_FALSE(pause.paused());
  pause.set(false);
  EXPECT_TRUE(pause.pauses().empty());
  for (int i = 0; i < 2; ++i) {
    pause.set(true);
    pause.set(true);
    EXPECT_TRUE(pause.paused());
    std::this_thread::sleep_for(milliseconds(5));
    pause.set(false);
    pause.set(false);
  }
  ASSERT_EQ(pause.pauses().size(), 2u);
  std::int64_t sum = 0;
  for (const PauseSwitch::Pause& p : pause.pauses()) sum += p.end_ns - p.begin_ns;
  EXPECT_EQ(pause.stood_ns(), sum);
  EXPECT_GE(sum, 10'000'000);
}

TEST(PauseSwitch, StandsAsLongAsAnybodyAsksForIt) {
  using Cause = PauseSwitch::Cause;
  PauseSwitch pause;
  pause.set(true, Cause::kBoard);
  pause.set(true);
  pause.set(false, Cause::kBoard);
  EXPECT_TRUE(pause.paused()) << "the person has not gone on";
  EXPECT_FALSE(pause.asked_by(Cause::kBoard));
  EXPECT_TRUE(pause.asked_by(Cause::kPerson));
  std::this_thread::sleep_for(milliseconds(5));
  ASSERT_EQ(pause.pauses().size(), 1u);
  EXPECT_GE(pause.pauses()[0].end_ns - pause.pauses()[0].begin_ns, 5'000'000) << "one that lasts counts until now";
  pause.set(false);
  EXPECT_FALSE(pause.paused());
  EXPECT_EQ(pause.pauses().size(), 1u) << "one pause, whoever asked";
}

struct Runs {
  std::uint64_t fast = 0, slow = 0;
};

/// Two lanes that are paused once and then end. @return calls during the second half of the pause.
Runs paused_run(PauseSwitch& pause, ThreadedExecutor& executor, Ticking& fast, Ticking& slow, milliseconds length) {
  Runs during;
  std::thread person([&] {
    while (slow.runs_ < 3) std::this_thread::sleep_for(milliseconds(1));
    pause.set(true);
    std::this_thread::sleep_for(length / 2);
    const Runs before{fast.runs_, slow.runs_};
    std::this_thread::sleep_for(length / 2);
    during = {fast.runs_ - before.fast, slow.runs_ - before.slow};
    const std::uint64_t from = slow.runs_;
    pause.set(false);
    while (slow.runs_ < from + 3) std::this_thread::sleep_for(milliseconds(1));
    fast.end_ = true;
  });
  executor.run();
  person.join();
  return during;
}

TEST(ThreadedExecutor, APauseStandsStillAndNothingIsMissed) {
  PauseSwitch pause;
  Ticking fast(1), slow(20);
  ThreadedExecutor executor(1000, &pause);
  executor.add_lane("fast", {&fast}, 0);
  executor.add_lane("slow", {&slow}, 0);
  const Runs during = paused_run(pause, executor, fast, slow, milliseconds(2000));
  EXPECT_EQ(during.fast, 0u);
  EXPECT_EQ(during.slow, 0u);
  const LaneReport& report = *executor.reports()[0];
  EXPECT_LT(report.missed, 1000u) << "2000 periods have passed on the wall";
  EXPECT_LT(report.longest_gap_ns, 1'000'000'000);
  EXPECT_NEAR(report.seconds, static_cast<double>(report.wakes + report.missed) * 1e-3, 0.05) << "the run's own clock";
  ASSERT_EQ(executor.pauses().size(), 1u);
  EXPECT_GE(executor.pauses()[0].seconds, 2.0);
  EXPECT_LT(executor.pauses()[0].at_s, report.seconds);
}

TEST(ThreadedExecutor, TheCallingThreadsLaneStandsStillTooAndCanStillBeInterrupted) {
  PauseSwitch pause;
  Ticking own(10);
  ThreadedExecutor executor(1000, &pause);
  executor.add_own_lane("own", {&own});
  pause.set(true);
  int asked = 0;
  executor.run([&] { return ++asked > 5; });
  EXPECT_EQ(own.runs_, 0u);
  EXPECT_EQ(executor.pauses().size(), 1u);
}

}  // namespace
}  // namespace trocar::pause_test
