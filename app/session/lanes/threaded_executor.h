// Runs the same tasks live: lanes, one thread each, paced by absolute times of CLOCK_MONOTONIC. The only place of a run
// that reads a clock.
//
// A lane wakes at each period of its first task and runs its tasks in order. After a late wake it never catches up with
// calls in a burst: the periods that passed are told to its tasks (Task::missed), which run once, and the next wake is
// the next boundary. The last lane may be the calling thread's (pictures belong to the thread that made their context).
// The run ends when a task has finished, `interrupted` says so, or a task throws; then each lane leaves its tasks when
// it sees the end, at its own next wake at the latest, all are joined, every task is stopped in its order, and what was
// thrown is thrown again. A PauseSwitch lets all lanes stand still
// (pause_switch.h). Threads: construct, add and run from one.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/session/lanes/pause_switch.h"
#include "app/session/lanes/task.h"
#include "app/session/lanes/timing.h"

namespace trocar {

/// What one lane did. Late: wake after the wished time; period: from wake to wake; cpu: of all its tasks in one wake.
struct LaneReport {
  std::string name;
  std::string policy;                   ///< that its thread really had: "SCHED_FIFO 80", "SCHED_OTHER"
  std::string refusal;                  ///< why the policy asked for was not given, else empty
  int processor = -1;                   ///< the only one that it may run on; -1: any
  std::int64_t period_us = 0;           ///< asked for
  std::uint64_t wakes = 0, missed = 0;  ///< calls, and periods that passed without one
  std::uint64_t overruns = 0;           ///< wakes whose tasks were still at work when the next period began
  double seconds = 0;                   ///< from the first wish to the end, pauses aside
  double awake_s = 0;                   ///< from the first wish to that of the last wake, pauses aside
  DurationCounts late, period, cpu;
  std::int64_t longest_gap_ns = 0;  ///< between two wakes

  /// Wakes a second, as they really came: what was missed is not among them. 0 with fewer than two.
  double rate_hz() const { return awake_s > 0 ? static_cast<double>(wakes - 1) / awake_s : 0; }
};

class ThreadedExecutor {
 public:
  /// @param pause outlives the executor; nullptr: it never stands still.
  explicit ThreadedExecutor(double rate_hz, PauseSwitch* pause = nullptr);
  ~ThreadedExecutor();

  /// @param tasks run in this order, at the period of the first; they outlive the executor. @param priority of
  /// SCHED_FIFO, 0: none.
  /// @param offset of its wakes, in loop periods: a lane half a period after another sees what that one has just done,
  /// as in lockstep.
  void add_lane(const std::string& name, std::vector<Task*> tasks, int priority, double offset = 0);
  /// The last lane added asks this before each wake: while it says no, all lanes stand still, as in a pause. It must
  /// not wait.
  void await(std::function<bool()> answers);
  /// The last lane added wakes when this returns true, which is when its board's own clock says so; false: there is no
  /// such clock, the lane sleeps as the others. Lateness is then against the wake before.
  void pace_by(std::function<bool()> board);
  /// The last lane added runs on that processor only. @param processor -1: on any.
  void pin(int processor);
  /// run() keeps the processors out of their idle states, where it may: power for promptness.
  void keep_awake() { keeps_awake_ = true; }
  /// A lane in the thread that calls run().
  void add_own_lane(const std::string& name, std::vector<Task*> tasks);

  /// @param interrupted asked about 50 times a second by the calling thread.
  void run(const std::function<bool()>& interrupted = {});

  /// Of all lanes, when run() has ended or thrown.
  std::vector<const LaneReport*> reports() const;
  bool memory_locked() const { return lock_refusal_.empty(); }
  const std::string& lock_refusal() const { return lock_refusal_; }
  bool processors_awake() const { return awake_; }  ///< were kept so
  /// When the run stood still and for how long; times of the run, in which pauses do not pass.
  struct Pause {
    double at_s = 0, seconds = 0;
  };
  std::vector<Pause> pauses() const;

 private:
  struct Lane;
  bool stood_still(Lane& lane, const std::function<bool()>& interrupted);
  void work(Lane& lane) noexcept;
  static void leave(Lane& lane) noexcept;
  void pace(Lane& lane, const std::function<bool()>& interrupted);
  void call(Lane& lane, std::uint64_t missed);
  void join();

  double rate_hz_;
  PauseSwitch* pause_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  Lane* own_ = nullptr;
  std::atomic<bool> stop_{false}, begun_{false};
  std::atomic<std::size_t> ready_{0};  ///< threads that have what they asked for
  std::int64_t start_ns_ = 0;
  std::string lock_refusal_;
  bool keeps_awake_ = false, awake_ = false;
};

}  // namespace trocar
