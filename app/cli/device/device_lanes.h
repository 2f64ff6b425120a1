// A real device looked at by a command: its loop at its rate in a lane of its own, as a run has it, and what is shown
// of it in the calling thread.
//
// A late loop never catches up in a burst (threaded_executor.h). Thread: the caller's.
#pragma once

#include <functional>

#include "app/session/lanes/threaded_executor.h"
#include "haptics/device/backend.h"

namespace trocar {

/// Until one of the two is finished. @return what the loop's lane did.
LaneReport run_device_lanes(const Backend& backend, double rate_hz, Task& loop, Task& shown,
                            const std::function<bool()>& interrupted);

}  // namespace trocar
