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
};

}  // namespace trocar
