// A task of the running program: called with the loop tick, every period() ticks. Executors differ only in what drives
// them: simulated time in fixed order (lockstep), or threads.
#pragma once

#include <cstdint>

namespace trocar {

class Task {
 public:
  virtual ~Task() = default;
  /// Loop ticks between two calls, >= 1.
  virtual std::uint32_t period() const = 0;
  /// @param tick loop tick of the call, counted from 0.
  virtual void run(std::uint64_t tick) = 0;
  /// Live only, before the run() that follows them: periods of this task that passed without a call.
  virtual void missed(std::uint64_t /*periods*/) {}
  /// Asked after each run(): true ends the whole run.
  virtual bool finished() const { return false; }
  /// Once, right after the last run() and in its thread, whether it ended well or not: what may not wait for the other
  /// tasks.
  virtual void leave() noexcept {}
  /// Once, when no task runs any more.
  virtual void stop() {}
};

}  // namespace trocar
