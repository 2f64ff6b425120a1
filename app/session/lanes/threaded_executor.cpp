#include "app/session/lanes/threaded_executor.h"

#include <time.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <thread>

#include "app/session/lanes/real_time.h"

namespace trocar {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kWatchPeriod = 20'000'000;  // ns: how often an idle calling thread looks for the end
constexpr std::int64_t kPauseLook = 2'000'000;     // ns: how soon a lane sees that a pause is over
constexpr std::int64_t kReadyLook = 200'000;       // ns: how soon a beginning is seen
constexpr std::int64_t kSettle = 5'000'000;        // ns from there to the first period

std::int64_t now_ns(clockid_t clock) {
  timespec now;
  ::clock_gettime(clock, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

void sleep_until(std::int64_t at_ns) {
  const timespec at{at_ns / kSecond, at_ns % kSecond};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

}  // namespace

struct ThreadedExecutor::Lane {
  std::vector<Task*> tasks;
  int priority = 0;
  std::int64_t period_ns = 0, offset_ns = 0;
  std::int64_t wished_ns = 0, last_ns = 0;  // next wake, and when the one before was
  std::int64_t served_ns = 0;               // wished time of the one before
  std::int64_t stood_ns = 0;                // pauses that the wished times have been moved by
  std::function<bool()> answers;            // of the board that its tasks read; empty: always there
  std::function<bool()> board;              // waits for the board's clock; empty: there is none
  int processor = -1;
  LaneReport report;
  std::thread thread;
  std::exception_ptr thrown;
};

ThreadedExecutor::ThreadedExecutor(double rate_hz, PauseSwitch* pause) : rate_hz_(rate_hz), pause_(pause) {}
ThreadedExecutor::~ThreadedExecutor() { join(); }

void ThreadedExecutor::add_lane(const std::string& name, std::vector<Task*> tasks, int priority, double offset) {
  auto lane = std::make_unique<Lane>();
  lane->tasks = std::move(tasks);
  lane->priority = priority;
  lane->period_ns = std::llround(lane->tasks.front()->period() / rate_hz_ * 1e9);
  lane->offset_ns = std::llround(offset / rate_hz_ * 1e9);
  lane->report.name = name;
  lane->report.period_us = std::llround(static_cast<double>(lane->period_ns) * 1e-3);
  lanes_.push_back(std::move(lane));
}

void ThreadedExecutor::await(std::function<bool()> answers) { lanes_.back()->answers = std::move(answers); }

void ThreadedExecutor::pace_by(std::function<bool()> board) { lanes_.back()->board = std::move(board); }
void ThreadedExecutor::pin(int processor) { lanes_.back()->processor = processor; }

void ThreadedExecutor::add_own_lane(const std::string& name, std::vector<Task*> tasks) {
  add_lane(name, std::move(tasks), 0);
  own_ = lanes_.back().get();
}

void ThreadedExecutor::run(const std::function<bool()>& interrupted) {
  const MemoryLock lock;
  lock_refusal_ = lock.refusal();
  std::optional<ProcessorsAwake> processors;
  if (keeps_awake_) processors.emplace();
  awake_ = processors && processors->held();
  std::size_t threads = 0;
  for (auto& lane : lanes_) {
    if (lane.get() == own_) continue;
    lane->thread = std::thread([this, &lane = *lane] { work(lane); });
    ++threads;
  }
  // On a busy machine a new thread may wait long for its first turn: no period is missed before all have had it.
  while (ready_.load() < threads && !stop_.load()) sleep_until(now_ns(CLOCK_MONOTONIC) + kReadyLook);
  start_ns_ = now_ns(CLOCK_MONOTONIC) + kSettle;
  begun_.store(true);
  if (own_) {
    try {
      pace(*own_, interrupted);
    } catch (...) {
      own_->thrown = std::current_exception();
      stop_.store(true);
    }
    leave(*own_);
  } else {
    while (!stop_.load() && !(interrupted && interrupted())) sleep_until(now_ns(CLOCK_MONOTONIC) + kWatchPeriod);
  }
  join();
  for (auto& lane : lanes_) {
    for (Task* task : lane->tasks) {
      try {
        task->stop();
      } catch (...) {  // all tasks are stopped whatever one of them says; the first reason is the news
        if (!lane->thrown) lane->thrown = std::current_exception();
      }
    }
  }
  for (auto& lane : lanes_) {
    if (lane->thrown) std::rethrow_exception(lane->thrown);
  }
}

void ThreadedExecutor::join() {
  stop_.store(true);
  for (auto& lane : lanes_) {
    if (lane->thread.joinable()) lane->thread.join();
  }
}

void ThreadedExecutor::work(Lane& lane) noexcept {
  try {
    lane.report.refusal = become_real_time(lane.priority);
    if (lane.processor >= 0 && stay_on(lane.processor).empty()) lane.report.processor = lane.processor;
    ready_.fetch_add(1);
    while (!begun_.load() && !stop_.load()) sleep_until(now_ns(CLOCK_MONOTONIC) + kReadyLook);
    pace(lane, {});
  } catch (...) {
    lane.thrown = std::current_exception();
    stop_.store(true);
  }
  leave(lane);
}

void ThreadedExecutor::leave(Lane& lane) noexcept {
  for (Task* task : lane.tasks) task->leave();
}

/// Waits out a pause. @return true when there was one since the lane last asked: its wished times now lie later.
bool ThreadedExecutor::stood_still(Lane& lane, const std::function<bool()>& interrupted) {
  if (!pause_) return false;
  const auto look = [&] {
    if (!lane.answers) return;
    const bool silent = !lane.answers();
    if (silent != pause_->asked_by(PauseSwitch::Cause::kBoard)) pause_->set(silent, PauseSwitch::Cause::kBoard);
  };
  look();
  while (pause_->paused() && !stop_.load()) {
    sleep_until(now_ns(CLOCK_MONOTONIC) + kPauseLook);
    look();
    if (interrupted && interrupted()) stop_.store(true);
  }
  const std::int64_t since = pause_->stood_ns() - lane.stood_ns;
  lane.stood_ns += since;
  lane.wished_ns += since;
  lane.last_ns += since;
  lane.served_ns += since;
  return since > 0;
}

void ThreadedExecutor::pace(Lane& lane, const std::function<bool()>& interrupted) {
  const FlushDenormals flush;
  LaneReport& report = lane.report;
  report.policy = thread_policy();
  lane.wished_ns = start_ns_ + lane.offset_ns;
  lane.last_ns = lane.wished_ns - lane.period_ns;
  for (; !stop_.load(std::memory_order_relaxed); lane.wished_ns += lane.period_ns) {
    bool by_board = false;
    do {
      by_board = lane.board && lane.board();
      if (!by_board) sleep_until(lane.wished_ns);
    } while (stood_still(lane, interrupted));
    if (stop_.load(std::memory_order_relaxed)) break;
    const std::int64_t woken = now_ns(CLOCK_MONOTONIC);
    report.late.add(woken - lane.wished_ns);
    const bool first = report.wakes == 0;
    if (!first) report.period.add(woken - lane.last_ns);
    const std::int64_t missed = std::max<std::int64_t>(0, (woken - lane.wished_ns) / lane.period_ns);
    lane.wished_ns = by_board ? woken : lane.wished_ns + missed * lane.period_ns;
    report.awake_s +=
        1e-9 * static_cast<double>(lane.wished_ns - (first ? start_ns_ + lane.offset_ns : lane.served_ns));
    lane.served_ns = lane.wished_ns;
    report.missed += static_cast<std::uint64_t>(missed);
    report.longest_gap_ns = std::max(report.longest_gap_ns, woken - lane.last_ns);
    lane.last_ns = woken;
    call(lane, static_cast<std::uint64_t>(missed));
    if (now_ns(CLOCK_MONOTONIC) > lane.wished_ns + lane.period_ns) ++report.overruns;
    if (interrupted && interrupted()) stop_.store(true);
  }
  report.seconds = static_cast<double>(now_ns(CLOCK_MONOTONIC) - start_ns_ - lane.stood_ns) * 1e-9;
}

std::vector<ThreadedExecutor::Pause> ThreadedExecutor::pauses() const {
  std::vector<Pause> out;
  std::int64_t stood = 0;
  for (const PauseSwitch::Pause& pause : pause_ ? pause_->pauses() : std::vector<PauseSwitch::Pause>{}) {
    const std::int64_t took = pause.end_ns - pause.begin_ns;
    out.push_back({static_cast<double>(pause.begin_ns - start_ns_ - stood) * 1e-9, static_cast<double>(took) * 1e-9});
    stood += took;
  }
  return out;
}

void ThreadedExecutor::call(Lane& lane, std::uint64_t missed) {
  const std::int64_t before = now_ns(CLOCK_THREAD_CPUTIME_ID);
  for (Task* task : lane.tasks) {
    if (missed > 0) task->missed(missed);
    task->run(lane.report.wakes);
    if (task->finished()) stop_.store(true);
  }
  lane.report.cpu.add(now_ns(CLOCK_THREAD_CPUTIME_ID) - before);
  ++lane.report.wakes;
}

std::vector<const LaneReport*> ThreadedExecutor::reports() const {
  std::vector<const LaneReport*> reports;
  for (const auto& lane : lanes_) reports.push_back(&lane->report);
  return reports;
}

}  // namespace trocar
