// The threaded executor. What is asserted does not depend on how punctual the machine is: counts that must agree,
// order, the way it ends. Wall-clock figures are reported by live runs, never judged here.
#include "app/session/lanes/threaded_executor.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

#include "app/session/lanes/real_time.h"
#include "haptics/exchange/latest.h"
#include "haptics/exchange/ring.h"

namespace trocar::threaded_executor_test {
namespace {

/// Counts its calls and what it is told; ends the run after `calls`.
class Counting : public Task {
 public:
  explicit Counting(std::uint32_t period, std::uint64_t calls = ~std::uint64_t{0}) : period_(period), calls_(calls) {}
  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    in_order_ = in_order_ && tick == runs_;
    ++runs_;
  }
  void missed(std::uint64_t periods) override { missed_ += periods; }
  bool finished() const override { return runs_ >= calls_; }
  void stop() override { ++stops_; }

  std::uint64_t runs_ = 0, missed_ = 0;
  int stops_ = 0;
  bool in_order_ = true;

 private:
  std::uint32_t period_;
  std::uint64_t calls_;
};

TEST(ThreadedExecutor, EveryPeriodIsEitherACallOrToldAsMissed) {
  Counting fast(1, 300), slow(10);
  ThreadedExecutor executor(1000);
  executor.add_lane("fast", {&fast}, 0);
  executor.add_lane("slow", {&slow}, 0);
  executor.run();
  EXPECT_EQ(fast.runs_, 300u);
  EXPECT_TRUE(fast.in_order_ && slow.in_order_) << "calls are counted from 0 without a gap";
  const LaneReport& report = *executor.reports()[0];
  EXPECT_EQ(report.wakes, fast.runs_);
  EXPECT_EQ(report.missed, fast.missed_);
  EXPECT_EQ(report.late.count(), fast.runs_);
  EXPECT_GE(report.seconds, 0.2989) << "never faster than the clock";
  EXPECT_EQ(fast.stops_ + slow.stops_, 2) << "each is stopped once";
}

/// Takes longer than its period, once.
class Stalling final : public Counting {
 public:
  using Counting::Counting;
  void run(std::uint64_t tick) override {
    Counting::run(tick);
    if (tick == 5) std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
};

TEST(ThreadedExecutor, AfterAStallItDoesNotCatchUpInABurst) {
  Stalling task(1, 10);
  ThreadedExecutor executor(1000);
  executor.add_lane("stalling", {&task}, 0);
  executor.run();
  EXPECT_EQ(task.runs_, 10u);
  EXPECT_GE(task.missed_, 29u) << "the periods of the stall are told, not called";
  EXPECT_GE(executor.reports()[0]->overruns, 1u);
  EXPECT_GE(executor.reports()[0]->longest_gap_ns, 30'000'000);
}

/// Throws at its third call.
class Throwing final : public Counting {
 public:
  using Counting::Counting;
  void run(std::uint64_t tick) override {
    Counting::run(tick);
    if (tick == 2) throw std::runtime_error("disk full");
  }
};

TEST(ThreadedExecutor, WhatATaskThrowsEndsTheRunAndIsThrownAgainWhenAllAreStopped) {
  Throwing bad(1);
  Counting good(1);
  ThreadedExecutor executor(1000);
  executor.add_lane("good", {&good}, 0);
  executor.add_lane("bad", {&bad}, 0);
  EXPECT_THROW(executor.run(), std::runtime_error);
  EXPECT_EQ(bad.runs_, 3u);
  EXPECT_EQ(bad.stops_ + good.stops_, 2);
}

TEST(ThreadedExecutor, AnInterruptEndsIt) {
  Counting task(1);
  ThreadedExecutor executor(1000);
  executor.add_lane("task", {&task}, 0);
  int asked = 0;
  executor.run([&] { return ++asked == 3; });
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(task.stops_, 1);
}

/// Remembers in which thread it ran.
class Where final : public Counting {
 public:
  using Counting::Counting;
  void run(std::uint64_t tick) override {
    Counting::run(tick);
    thread_ = std::this_thread::get_id();
    flushes_ = (_mm_getcsr() & 0x8040u) == 0x8040u;
  }
  std::thread::id thread_;
  bool flushes_ = false;
};

TEST(ThreadedExecutor, TheOwnLaneRunsInTheCallingThreadTheOthersInTheirs) {
  Where own(1, 5), other(1);
  ThreadedExecutor executor(1000);
  executor.add_lane("other", {&other}, 0);
  executor.add_own_lane("own", {&own});
  executor.run();
  EXPECT_EQ(own.thread_, std::this_thread::get_id());
  EXPECT_TRUE(other.runs_ == 0 || other.thread_ != own.thread_);
  EXPECT_TRUE(own.flushes_) << "denormals are flushed in every lane";
  EXPECT_EQ(_mm_getcsr() & 0x8040u, 0u) << "and not after it";
}

/// Writes a counter into both exchanges; its partner checks that it never goes back.
class Writer final : public Counting {
 public:
  Writer(Latest<std::uint64_t>& latest, Ring<std::uint64_t, 4096>& ring)
      : Counting(1, 400), latest_(latest), ring_(ring) {}
  void run(std::uint64_t tick) override {
    Counting::run(tick);
    latest_.write(runs_);
    ring_.push(runs_);
  }

 private:
  Latest<std::uint64_t>& latest_;
  Ring<std::uint64_t, 4096>& ring_;
};

class Reader final : public Counting {
 public:
  Reader(Latest<std::uint64_t>& latest, Ring<std::uint64_t, 4096>& ring) : Counting(3), latest_(latest), ring_(ring) {}
  void run(std::uint64_t tick) override {
    Counting::run(tick);
    const std::uint64_t now = latest_.read();
    orderly_ = orderly_ && now >= seen_;
    seen_ = now;
    drain();
  }
  void stop() override { drain(); }
  void drain() {
    for (std::uint64_t value; ring_.pop(value); ++popped_) orderly_ = orderly_ && value == popped_ + 1;
  }
  std::uint64_t seen_ = 0, popped_ = 0;
  bool orderly_ = true;

 private:
  Latest<std::uint64_t>& latest_;
  Ring<std::uint64_t, 4096>& ring_;
};

TEST(ThreadedExecutor, TasksSpeakThroughLatestAndRing) {
  Latest<std::uint64_t> latest;
  Ring<std::uint64_t, 4096> ring;
  Writer writer(latest, ring);
  Reader reader(latest, ring);
  ThreadedExecutor executor(1000);
  executor.add_lane("writer", {&writer}, 0);
  executor.add_lane("reader", {&reader}, 0);
  executor.run();
  EXPECT_TRUE(reader.orderly_);
  EXPECT_EQ(reader.popped_, 400u) << "the rest is there when all lanes have ended";
}

TEST(RealTime, WhatIsRefusedHasAReason) {
  std::string refusal;
  int policy = -1;
  std::thread([&] {
    refusal = become_real_time(10);
    policy = sched_getscheduler(0);
  }).join();
  EXPECT_EQ(refusal.empty(), policy == SCHED_FIFO) << refusal;
  const MemoryLock lock;
  EXPECT_EQ(lock.held(), lock.refusal().empty());
}

TEST(FlushDenormals, FlushesWhileItLives) {
  volatile double tiny = 1e-308;
  {
    const FlushDenormals flush;
    EXPECT_EQ(tiny / 16, 0.0);
  }
  EXPECT_GT(tiny / 16, 0.0);
}

}  // namespace
}  // namespace trocar::threaded_executor_test
