// What a run says of its sensor, and a live one of its pacing: in the result under device.force_sensor and
// device.realtime, and in words on stderr where something is missing.
//
// {"kernel", "kernel_realtime", "processors", "load", "memory_locked", "processors_awake", "lost_records", "lanes":
// {NAME: {"policy", "refused", "processor", "rate_hz", "wakes", "missed", "overruns", "longest_gap_ms", "late_us":
// {"p50","p90","p99","p99.9","p99.99","max","above_1ms"}, "period_us": {...}, "cpu_us": {...}}}, and only where the run
// stood still "pauses": [{"at_s", "seconds"}]; "clocks": {"program_s", "kernel_s", "worst", "slept_s"}}. "refused" and
// "processor" stand only where something was refused, or the lane was kept on one. The first lane, the loop's, has
// histograms too: "bins" in late_us and cpu_us, {lower end in us: how many}, each up to the next of 0, 1, 2, 3, 5, 7,
// 10, 15, 20, 30 ...; in period_us likewise by what the period was off, shorter ones with a minus ("off_bins"). "load"
// is that of the last minute. Thread: any, after the run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/session/lanes/clock_witness.h"
#include "app/session/lanes/force_sensor_task.h"
#include "app/session/lanes/threaded_executor.h"
#include "haptics/force_sensor/ati/wrench_stream.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// @param lost records that found a ring full. @param witnessed empty: no second clock could be read.
/// How many by the lower end of their bin, whole us, as above. @param nominal_us taken off first.
std::map<std::int64_t, std::uint64_t> histogram(const DurationCounts& counts, std::int64_t nominal_us = 0);
std::string realtime_json(const ThreadedExecutor& executor, std::uint64_t lost,
                          const std::optional<WitnessedTime>& witnessed);
/// Why a live run is no measurement: clocks that do not agree (clock_witness.h), more than kMostPauses pauses while its
/// clock ran; "" where nothing of it is told. @param realtime as realtime_json() wrote it
std::string pacing_fault(const std::string& realtime, const std::vector<Event>& events);
/// Who stops a run again and again has as long for each touch as he likes.
inline constexpr int kMostPauses = 3;

/// A real sensor of a run.
struct RealSensorLine {
  std::string words;  ///< as it was asked for: "net-ft:192.168.1.1"
  WrenchLink link;
};

/// {"rate_hz", "lag_s", "samples", "measured_rms_n", "residual_samples", "residual_rms_n", "residual_max_n"}; of a real
/// sensor also "sensor", "axes" ("theatre", or "sensor" where its own are not configured), "measured_rms_nm", "zero" {
/// "samples", "force_n", "moment_nm", in its own axes}, "link" {what WrenchLink counts} and "counts" {"per_n",
/// "per_nm", "from"}. What cannot be said, without a zero or without axes, is null.
std::string force_sensor_json(const ForceSensorTask& sensor, const std::optional<RealSensorLine>& line = {});
/// What was amiss with a real sensor, a line each: silent, its counts doubtful, its line lossy, taken
/// away, no zero, no axes.
std::vector<std::string> force_sensor_notes(const ForceSensorTask& sensor, const RealSensorLine& line);

/// Where the run stood still, as realtime_json() wrote it; none when it says nothing that can be read.
struct StoodStill {
  double at_s = 0, seconds = 0;  ///< loop time at which it began; how long it took
};
std::vector<StoodStill> pauses_of(const std::string& realtime);

/// What the operating system refused and what went missing, a line each; empty when all was as asked.
std::vector<std::string> realtime_notes(const ThreadedExecutor& executor, std::uint64_t lost);

}  // namespace trocar
