// Runs tasks in fixed order in simulated time: same input, same bytes, whatever the machine does.
//
// Within one tick the tasks run in the order in which they were added. Thread: one.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "app/session/lanes/real_time.h"
#include "app/session/lanes/task.h"

namespace trocar {

class LockstepExecutor {
 public:
  /// The task must outlive the executor.
  void add(Task& task) { tasks_.push_back(&task); }

  /// Runs ticks until a task has finished or `interrupted` (asked after each tick) says so, then stops all tasks.
  /// @return ticks run.
  std::uint64_t run(const std::function<bool()>& interrupted = {}) {
    const FlushDenormals flush;
    std::uint64_t tick = 0;
    try {
      do {
        for (Task* task : tasks_) {
          if (tick % task->period() == 0) task->run(tick);
        }
        ++tick;
      } while (!finished() && !(interrupted && interrupted()));
    } catch (...) {
      leave();
      throw;
    }
    leave();
    for (Task* task : tasks_) task->stop();
    return tick;
  }

 private:
  void leave() noexcept {
    for (Task* task : tasks_) task->leave();
  }
  bool finished() const {
    return std::any_of(tasks_.begin(), tasks_.end(), [](const Task* task) { return task->finished(); });
  }

  std::vector<Task*> tasks_;
};

}  // namespace trocar
