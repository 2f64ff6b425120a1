#include "app/cli/device/device_lanes.h"

#include "app/session/lanes/real_time.h"

namespace trocar {

LaneReport run_device_lanes(const Backend& backend, double rate_hz, Task& loop, Task& shown,
                            const std::function<bool()>& interrupted) {
  constexpr int kLoopFifoPriority = 80;
  ThreadedExecutor executor(rate_hz);
  executor.add_lane("haptic", {&loop}, kLoopFifoPriority);
  executor.pace_by(backend.await_sync);
  executor.pin(isolated_processor());
  executor.keep_awake();
  executor.add_own_lane("shown", {&shown});
  executor.run(interrupted);
  return *executor.reports().front();
}

}  // namespace trocar
