#include "app/window/attempt/force_trace.h"

#include <algorithm>
#include <cmath>

#include "app/session/recording/recording_reader.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

constexpr double kSpeedOver_s = 0.02;

float finite(double value) { return std::isfinite(value) ? static_cast<float>(value) : 0.0F; }

double speed_at(const std::vector<TraceSample>& samples, std::size_t i, std::size_t half) {
  const TraceSample& a = samples[i < half ? 0 : i - half];
  const TraceSample& b = samples[std::min(i + half, samples.size() - 1)];
  return b.t_s > a.t_s ? (b.tip_T - a.tip_T).norm() / (b.t_s - a.t_s) : 0;
}

}  // namespace

ForceTrace force_trace(const Trace& trace, const std::vector<Event>& events) {
  ForceTrace out;
  if (trace.samples.empty()) return out;
  out.begin_s = trace.samples.front().t_s;
  out.end_s = trace.samples.back().t_s;
  if (const auto window = graded_window(trace, events)) {
    out.begin_s = std::clamp(window->first, out.begin_s, out.end_s);
    out.end_s = std::clamp(window->second, out.begin_s, out.end_s);
  }
  const auto half = static_cast<std::size_t>(std::max(1.0, kSpeedOver_s * trace.rate_hz / 2));
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    const TraceSample& sample = trace.samples[i];
    if (sample.t_s < out.begin_s || sample.t_s > out.end_s) continue;
    out.t_s.push_back(static_cast<float>(sample.t_s));
    out.tip_n.push_back(finite(sample.force_T.norm()));
    out.grip_n.push_back(finite(sample.grip_n));
    out.speed_mps.push_back(finite(speed_at(trace.samples, i, half)));
  }
  return out;
}

ForceTrace load_force_trace(const std::filesystem::path& recording) {
  const Recording read = read_recording(recording, Reading::kTolerant);
  return force_trace(rebuild_trace(read.ticks, read.rate_hz), read.events);
}

std::vector<ForceTrace::Column> ForceTrace::columns(const std::vector<float>& values, int count, double from_s,
                                                    double to_s) const {
  std::vector<Column> out(static_cast<std::size_t>(std::max(0, count)));
  if (out.empty() || to_s <= from_s || values.size() != t_s.size()) return out;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const double share = (t_s[i] - from_s) / (to_s - from_s);
    if (share < 0 || share > 1) continue;
    Column& column = out[std::min(out.size() - 1, static_cast<std::size_t>(share * count))];
    column.low = column.any ? std::min<double>(column.low, values[i]) : values[i];
    column.high = column.any ? std::max<double>(column.high, values[i]) : values[i];
    column.any = true;
  }
  return out;
}

double ForceTrace::at(const std::vector<float>& values, double when_s) const {
  const auto next = std::upper_bound(t_s.begin(), t_s.end(), static_cast<float>(when_s));
  if (next == t_s.begin() || values.size() != t_s.size()) return 0;
  return values[static_cast<std::size_t>(next - t_s.begin()) - 1];
}

}  // namespace trocar
