// How a live attempt kept its pace: the receipt of its haptic loop (RunReport::realtime, docs/architecture.md), read
// for people, drawn, and what it says against a score.
//
// A receipt may come from another station or an older program: what is missing or of another type is left out.
// Microseconds where a name says so. Thread: any.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// One measure of every tick. Percentiles are upper bounds to a microsecond.
struct PacingSpread {
  double p50_us = 0, p90_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
  /// How many by the lower end of the bin, us; of periods by what they were off. Empty: not recorded.
  std::map<std::int64_t, std::uint64_t> bins = {};
};

/// Receipt of the haptic loop.
struct Pacing {
  std::string scheduler = {}, refused = {};  ///< that its thread had; why not the one asked for, "" where it had that
  std::string kernel = {};
  bool kernel_realtime = false, memory_locked = false;
  std::optional<bool> processors_awake = {};  ///< kept out of idle states; none: not recorded
  std::int64_t processors = 0;
  std::optional<std::int64_t> processor = {};  ///< on which it was kept
  std::optional<double> load = {};             ///< mean of the last minute
  double rate_hz = 0, longest_gap_ms = 0;
  std::uint64_t wakes = 0, missed = 0, overruns = 0;
  PacingSpread late = {}, period = {}, work = {};
};

/// @return empty in lockstep, and where it says nothing of a haptic loop.
std::optional<Pacing> parse_pacing(const std::string& realtime);

/// Its lines: name and value.
std::vector<std::pair<std::string, std::string>> pacing_facts(const Pacing& pacing);

/// Histograms of lateness, period and work, side by side, as a whole <svg> element; "" where none were recorded.
/// @param rate_hz that the loop should have: a dashed line stands at one period.
std::string pacing_plot_svg(const Pacing& pacing, double rate_hz);

/// What stands beside a score whose loop the system gave no real-time priority: the device's forces may have come late.
/// @return "" in lockstep, with the priority, and where nothing was felt anyway.
std::string soft_real_time(const RunReport& device);

}  // namespace trocar
