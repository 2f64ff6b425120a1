// Ways to keep a loop at 1 kHz, each run for a while in this process or beside it, all measured alike.
//
// Ours is a live attempt as `trocar run --realtime` makes it: same threads, same work, the simulated device. Beside it
// its wait alone (no work), cyclictest of rt-tests, and what two peers do, written anew from reading them (AMBF's busy
// wait; OpenSurgSim's sleep to 2 ms before the time and yields, which at 1 ms never sleeps), as ordinary threads with
// 0.1 ms of work. Thread: the caller's; a live attempt starts its own.
#pragma once

#include <string>
#include <vector>

#include "app/session/lanes/threaded_executor.h"

namespace trocar {

struct PatternRun {
  std::string name, scheduler, refused;
  double awake_s = 0;  ///< from the first time that was asked for to that of the last wake, of all slices
  std::uint64_t missed = 0;
  std::int64_t longest_gap_ns = 0;
  DurationCounts late = {}, period = {}, work = {};  ///< period and work: empty where not told

  /// Wakes a second; 0 where periods are not told.
  double rate_hz() const { return awake_s > 0 ? static_cast<double>(period.count()) / awake_s : 0; }
  /// Another slice of the same pattern.
  void add(const PatternRun& slice);
};

PatternRun pattern_of(const std::string& name, const LaneReport& report);

/// Times at which a loop woke, ns, as a run of that pattern: late is against the wake before.
PatternRun pattern_of_wakes(const std::string& name, const std::vector<std::int64_t>& wakes_ns, std::int64_t period_ns);

PatternRun live_attempt(double seconds);
PatternRun wait_alone(double seconds);
PatternRun busy_wait(double seconds);
PatternRun sleep_and_yield(double seconds);

/// cyclictest of Debian's rt-tests, with SCHED_FIFO where it gets it, else without. `refused` says why it did not run.
PatternRun cyclictest(double seconds);
/// What `cyclictest -q -h` printed, into a run. @return false where there is no histogram in it.
bool read_cyclictest(const std::string& text, PatternRun& run);

/// Processes that do nothing but compute, while it lives; they end with this process whatever ends it.
class BusyProcesses {
 public:
  explicit BusyProcesses(int count);
  ~BusyProcesses();
  BusyProcesses(const BusyProcesses&) = delete;
  BusyProcesses& operator=(const BusyProcesses&) = delete;

 private:
  std::vector<int> processes_;
};

}  // namespace trocar
