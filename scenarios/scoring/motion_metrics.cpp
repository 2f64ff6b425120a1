#include <algorithm>
#include <cmath>

#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/smoothness.h"
#include "scenarios/scoring/trace_filter.h"

namespace trocar {
namespace {

constexpr double kPeakProminence = 0.005;  // m/s
constexpr double kIdleSpeed = 0.005;       // m/s, for at least kIdleTime
constexpr double kIdleTime = 0.5;          // s
constexpr double kMovementSpeed = 0.010;   // m/s, for at least kMovementTime
constexpr double kMovementTime = 0.5;      // s
constexpr double kAngleRateHz = 10;        // angular path: below this noise dominates

std::size_t samples_of(double seconds, double rate_hz) {
  return static_cast<std::size_t>(std::ceil(seconds * rate_hz - 1e-9));
}

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void add_path_metrics(const SmoothPath& path, const ScoringContext& context, MetricSink& sink) {
  Vec3 along = Vec3::Zero();
  double length = 0;
  for (std::size_t i = 1; i < path.position.size(); ++i) {
    const Vec3 step = path.position[i] - path.position[i - 1];
    length += step.norm();
    along += step.cwiseAbs();
  }
  const bool known = path.position.size() > 1;
  const auto value = [&](double x) { return known ? std::optional<double>(x) : std::nullopt; };
  const double ideal = ideal_path_length(context);
  const bool comparable = known && ideal > 0 && length > 0;
  sink.push_back({"path_m", value(length), "m"});
  sink.push_back({"path_x_m", value(along.x()), "m"});
  sink.push_back({"path_y_m", value(along.y()), "m"});
  sink.push_back({"path_z_m", value(along.z()), "m"});
  sink.push_back({"ideal_path_m", ideal > 0 ? std::optional<double>(ideal) : std::nullopt, "m"});
  sink.push_back({"economy", comparable ? std::optional<double>(ideal / length) : std::nullopt, "1"});
  sink.push_back({"path_ratio", comparable ? std::optional<double>(length / ideal) : std::nullopt, "1"});
}

/// Sum of the absolute motion along the shaft, and the angle that the shaft sweeps, both from the 10 Hz trace.
void add_shaft_metrics(const Trace& trace, const SmoothPath& path, MetricSink& sink) {
  if (path.position.size() < 2) {
    sink.push_back({"depth_path_m", std::nullopt, "m"});
    sink.push_back({"angular_path_deg", std::nullopt, "deg"});
    return;
  }
  double depth = 0;
  const double ratio = trace.rate_hz / path.rate_hz;
  for (std::size_t i = 1; i < path.position.size(); ++i) {
    const auto index = std::min(trace.samples.size() - 1, static_cast<std::size_t>(static_cast<double>(i) * ratio));
    depth += std::abs((path.position[i] - path.position[i - 1]).dot(trace.samples[index].shaft_T));
  }
  double swept = 0, next_time = trace.samples.front().t_s;
  Vec3 previous = trace.samples.front().shaft_T.normalized();
  for (const TraceSample& sample : trace.samples) {
    if (sample.t_s + 1e-9 < next_time) continue;
    const Vec3 shaft = sample.shaft_T.normalized();
    swept += std::atan2(previous.cross(shaft).norm(), previous.dot(shaft));
    previous = shaft;
    next_time += 1 / kAngleRateHz;
  }
  sink.push_back({"depth_path_m", depth, "m"});
  sink.push_back({"angular_path_deg", swept * 180 / M_PI, "deg"});
}

void add_speed_metrics(const SmoothPath& path, double duration_s, MetricSink& sink) {
  const auto mean_speed = mean(path.speed);
  const bool known = mean_speed.has_value() && duration_s > 0;
  const auto idle_runs = runs(path.speed, kIdleSpeed, samples_of(kIdleTime, path.rate_hz), true);
  double idle = 0;
  for (const auto& [first, last] : idle_runs) idle += static_cast<double>(last - first);
  const int peaks = count_peaks(path.speed, kPeakProminence);
  const auto value = [&](double x) { return known ? std::optional<double>(x) : std::nullopt; };
  sink.push_back({"speed_mean_mps", mean_speed, "m/s"});
  sink.push_back({"speed_max_mps", value(known ? *std::max_element(path.speed.begin(), path.speed.end()) : 0), "m/s"});
  sink.push_back({"speed_peaks", value(peaks), "1"});
  sink.push_back({"speed_peak_rate_hz", value(peaks / std::max(duration_s, 1e-9)), "1/s"});
  sink.push_back({"idle_share", value(idle / static_cast<double>(std::max<std::size_t>(1, path.speed.size()))), "1"});
}

/// Smoothness is averaged over movements: over the whole trial it would only be a clock.
void add_smoothness_metrics(const Trace& trace, const SmoothPath& path, MetricSink& sink) {
  const SmoothPath slow = smooth_path(trace, kJerkCutoffHz);
  std::vector<double> arcs, jerks, normalised;
  const auto movements = runs(path.speed, kMovementSpeed, samples_of(kMovementTime, path.rate_hz));
  for (const auto& [first, last] : movements) {
    const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(last);
    const std::vector<double> speed(path.speed.begin() + from, path.speed.begin() + to);
    const std::vector<double> slow_speed(slow.speed.begin() + from, slow.speed.begin() + to);
    const std::vector<Vec3> position(slow.position.begin() + from, slow.position.begin() + to);
    if (const auto arc = spectral_arc_length(speed, path.rate_hz)) arcs.push_back(*arc);
    if (const auto jerk = log_dimensionless_jerk(slow_speed, path.rate_hz)) jerks.push_back(*jerk);
    if (const auto jerk = normalised_squared_jerk(position, path.rate_hz)) normalised.push_back(std::sqrt(0.5 * *jerk));
  }
  const bool known = path.speed.size() > 1;
  sink.push_back(
      {"movements", known ? std::optional<double>(static_cast<double>(movements.size())) : std::nullopt, "1"});
  sink.push_back({"sparc", mean(arcs), "1"});
  sink.push_back({"ldlj", mean(jerks), "1"});
  sink.push_back({"normalised_jerk", mean(normalised), "1"});
}

void add_tremor_metrics(const Trace& trace, MetricSink& sink) {
  std::vector<double> times;
  for (const TraceSample& sample : trace.samples) times.push_back(sample.t_s);
  std::vector<Vec3> position;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const TraceSample& sample : trace.samples) values.push_back(sample.tip_T[axis]);
    const std::vector<double> uniform = resample(times, values, trace.rate_hz);
    position.resize(uniform.size());
    for (std::size_t i = 0; i < uniform.size(); ++i) position[i][axis] = uniform[i];
  }
  const auto result = tremor(position, trace.rate_hz);
  sink.push_back({"tremor_rms_m", result ? std::optional<double>(result->rms_m) : std::nullopt, "m"});
  sink.push_back({"tremor_share", result ? std::optional<double>(result->power_share) : std::nullopt, "1"});
}

}  // namespace

double ideal_path_length(const ScoringContext& context) {
  double length = 0;
  const Vec3 lift = context.approach_T.normalized() * context.retract_height_m;
  for (std::size_t i = 1; i < context.waypoints.size(); ++i) {
    const bool from_surface = i > 1;
    const Vec3 from = context.waypoints[i - 1] + (from_surface ? lift : Vec3(Vec3::Zero()));
    length += (from_surface ? lift.norm() : 0) + (context.waypoints[i] + lift - from).norm() + lift.norm();
  }
  return length;
}

void add_motion_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                        MetricSink& sink) {
  const auto window = graded_window(trace, events);
  const double duration = window ? window->second - window->first : 0;
  const SmoothPath path = smooth_path(trace, kMotionCutoffHz);
  sink.push_back({"time_s", window ? std::optional<double>(duration) : std::nullopt, "s"});
  add_path_metrics(path, context, sink);
  add_shaft_metrics(trace, path, sink);
  add_speed_metrics(path, duration, sink);
  add_smoothness_metrics(trace, path, sink);
  add_tremor_metrics(trace, sink);
}

}  // namespace trocar
