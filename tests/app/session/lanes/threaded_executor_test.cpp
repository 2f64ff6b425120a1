// The threaded executor. What is asserted does not depend on how punctual the machine is: counts that must agree,
// order, the way it ends. Wall-clock figures are reported by live runs, never judged here.
#include "app/session/lanes/threaded_executor.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <xmmintrin.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "app/session/lanes/lockstep_executor.h"
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

/// Remembers in which thread it ran, and what that thread had.
class Where final : public Counting {
 public:
  using Counting::Counting;
  void run(std::uint64_t tick) override {
    Counting::run(tick);
    thread_ = std::this_thread::get_id();
    flushes_ = (_mm_getcsr() & 0x8040u) == 0x8040u;
    policy_ = sched_getscheduler(0);
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) processors_ = CPU_COUNT(&allowed);
    processor_ = sched_getcpu();
    slack_ns_ = prctl(PR_GET_TIMERSLACK);
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (word == "VmLck:") status >> locked_kib_;
  }
  std::thread::id thread_;
  bool flushes_ = false;
  int policy_ = -1, processors_ = 0, processor_ = -1, slack_ns_ = 0;
  long locked_kib_ = 0;
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
  EXPECT_TRUE(other.runs_ == 0 || other.flushes_) << "in its own thread too";
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

TEST(RealTime, ALaneHasWhatItsReportSays) {
  Where task(1, 20);
  ThreadedExecutor executor(1000);
  executor.add_lane("haptic", {&task}, 80);
  executor.pin(sched_getcpu());
  executor.keep_awake();
  executor.run();
  EXPECT_EQ(executor.processors_awake(), ProcessorsAwake().held());
  const LaneReport& report = *executor.reports().front();
  EXPECT_EQ(report.policy, task.policy_ == SCHED_FIFO ? "SCHED_FIFO 80" : "SCHED_OTHER");
  EXPECT_EQ(report.refusal.empty(), task.policy_ == SCHED_FIFO) << "given, or the reason why not";
  EXPECT_EQ(task.processors_, 1) << "kept on one";
  EXPECT_EQ(report.processor, task.processor_);
  EXPECT_EQ(task.slack_ns_, task.policy_ == SCHED_FIFO ? task.slack_ns_ : 1)
      << "least timer slack, which needs no right";
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these lock nothing and say that they did
  EXPECT_EQ(executor.memory_locked(), task.locked_kib_ > 1024) << task.locked_kib_ << " KiB while it runs";
#endif
  Where after(1, 1);
  after.run(0);
  EXPECT_LE(after.locked_kib_, 64) << "and not after it";
}

TEST(RealTime, ALaneWithoutASetProcessorMayRunOnAny) {
  Where task(1, 3);
  ThreadedExecutor executor(1000);
  executor.add_lane("haptic", {&task}, 0);
  executor.pin(-1);
  executor.run();
  cpu_set_t allowed;
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  EXPECT_EQ(task.processors_, CPU_COUNT(&allowed));
  EXPECT_EQ(executor.reports().front()->processor, -1);
}

TEST(RealTime, TheFirstProcessorOfAList) {
  EXPECT_EQ(first_processor("2-3,6"), 2);
  EXPECT_EQ(first_processor("11"), 11);
  for (const char* none : {"", "x", "-1", "(null)"}) EXPECT_EQ(first_processor(none), -1) << none;
  EXPECT_NE(stay_on(-1), "");
  EXPECT_NE(stay_on(100'000), "");
}

/// Page faults of this thread that needed no disk, while it uses that much of its stack.
template <std::size_t kBytes>
[[gnu::noinline]] long faults_over_stack() {
  rusage before{}, now{};
  getrusage(RUSAGE_THREAD, &before);
  std::array<volatile char, kBytes> room;
  for (std::size_t i = 0; i < kBytes; i += 1024) room[i] = 1;
  getrusage(RUSAGE_THREAD, &now);
  return now.ru_minflt - before.ru_minflt;
}

/// On a stack whose pages nobody has touched, as a thread that ended may have left them.
long faults_in_thread(bool prepare) {
  constexpr std::size_t kBytes = 2 * 1024 * 1024;
  struct Asked {
    bool prepare;
    long faults;
  } asked{prepare, -1};
  void* stack = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack, kBytes);
  pthread_t thread{};
  const auto work = [](void* given) -> void* {
    auto* a = static_cast<Asked*>(given);
    if (a->prepare) become_real_time(0);
    a->faults = faults_over_stack<200 * 1024>();
    return nullptr;
  };
  EXPECT_EQ(pthread_create(&thread, &attributes, work, &asked), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  munmap(stack, kBytes);
  return asked.faults;
}

TEST(RealTime, TheStackIsThereBeforeTheFirstTick) {
  const long bare = faults_in_thread(false), prepared = faults_in_thread(true);
  EXPECT_GE(bare, 10) << "else this test sees nothing";
  EXPECT_LE(prepared, 2);
}

TEST(RealTime, ALaneThatItsBoardPacesWakesWhenTheBoardSaysSo) {
  Counting task(1, 30);
  ThreadedExecutor executor(1000);
  executor.add_lane("haptic", {&task}, 0);
  int asked = 0;
  executor.pace_by([&] {
    if (++asked > 20) return false;  // the board falls silent
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    return true;
  });
  executor.run();
  const LaneReport& report = *executor.reports().front();
  EXPECT_EQ(task.runs_, 30u) << "each of the board's twenty, then by the clock";
  EXPECT_EQ(asked, 30);
  EXPECT_GE(report.awake_s, 19 * 3e-3) << "at the board's third of the rate";
  EXPECT_GE(task.missed_, 19u * 2) << "periods that went by between are told, not made up for";
}

TEST(RealTime, TheRateIsThatOfTheWakesThatCame) {
  Stalling task(1, 10);
  ThreadedExecutor executor(1000);
  executor.add_lane("stalling", {&task}, 0);
  executor.run();
  const LaneReport& report = *executor.reports().front();
  EXPECT_LE(report.rate_hz(), 9 / 0.038) << "what was missed is not counted";
  EXPECT_FALSE(executor.processors_awake()) << "not asked for";
  EXPECT_NEAR(report.rate_hz(), 9e3 / static_cast<double>(9 + report.missed), 1e-6)
      << "a late wake is no longer period";
  EXPECT_EQ(report.period.count(), 9u);
  EXPECT_LE(report.period.max_ns(), report.longest_gap_ns);
  EXPECT_EQ(LaneReport{}.rate_hz(), 0);
}

/// A tick's work of 0.3 ms: a sleep of a whole period after it would come ever later.
TEST(RealTime, SleepsAreToAbsoluteTimes) {
  class Working final : public Counting {
   public:
    Working() : Counting(1, 60) {}
    void run(std::uint64_t tick) override {
      Counting::run(tick);
      const auto now = std::chrono::steady_clock::now();
      if (tick == 0) first_ = now;
      const double phase = std::fmod(std::chrono::duration<double>(now - first_).count() * 1e3, 1.0);
      drifted_ += phase > 0.25 && phase < 0.75 ? 1 : 0;
      while (std::chrono::steady_clock::now() < now + std::chrono::microseconds(300)) {
      }
    }
    std::chrono::steady_clock::time_point first_;
    int drifted_ = 0;
  };
  int drifted = 60;
  for (int attempt = 0; attempt < 5 && drifted > 15; ++attempt) {  // a busy machine may be late, not five times over
    Working task;
    ThreadedExecutor executor(1000);
    executor.add_lane("working", {&task}, 80);
    executor.run();
    drifted = task.drifted_;
  }
  EXPECT_LE(drifted, 15) << "about half of them where the phase goes round";
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

TEST(FlushDenormals, LockstepFlushesToo) {
  Where task(1, 1);
  LockstepExecutor executor;
  executor.add(task);
  executor.run();
  EXPECT_TRUE(task.flushes_) << "else live and lockstep would not agree to the bit";
  EXPECT_EQ(_mm_getcsr() & 0x8040u, 0u);
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
