// What a run says of its sensor, and a live one of its pacing: in the result under device.force_sensor and
// device.realtime, and in words on stderr where something is missing.
//
// {"kernel_realtime", "memory_locked", "lost_records", "lanes": {NAME: {"policy", "rate_hz", "wakes", "missed",
// "overruns",
//  "longest_gap_ms", "late_us": {"p50","p99","p99.9","p99.99","max","above_1ms"}, "cpu_us": {...}}}, and only where the
//  run
// stood still "pauses": [{"at_s", "seconds"}]}. Thread: any, after the run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/session/lanes/force_sensor_task.h"
#include "app/session/lanes/threaded_executor.h"

namespace trocar {

/// @param lost records that found a ring full.
std::string realtime_json(const ThreadedExecutor& executor, std::uint64_t lost);

/// {"rate_hz", "lag_s", "samples", "measured_rms_n", "residual_samples", "residual_rms_n", "residual_max_n"}.
std::string force_sensor_json(const ForceSensorTask& sensor);

/// Where the run stood still, as realtime_json() wrote it; none when it says nothing that can be read.
struct StoodStill {
  double at_s = 0, seconds = 0;  ///< loop time at which it began; how long it took
};
std::vector<StoodStill> pauses_of(const std::string& realtime);

/// What the operating system refused and what went missing, a line each; empty when all was as asked.
std::vector<std::string> realtime_notes(const ThreadedExecutor& executor, std::uint64_t lost);

}  // namespace trocar
