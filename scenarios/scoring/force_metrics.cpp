#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "scenarios/scoring/band_time.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/trace_filter.h"

namespace trocar {
namespace {

constexpr double kGripRise = 0.5;        // s after the first touch in which a grip below the band does not count
constexpr double kGripThreshold = 0.05;  // N: the jaws hold something

using Samples = std::vector<TraceSample>;
using Value = std::optional<double>;

/// Time that each sample stands for: half of the way to its neighbours on both sides.
std::vector<double> weights(const Samples& samples) {
  std::vector<double> result(samples.size(), 0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double half = (samples[i].t_s - samples[i - 1].t_s) / 2;
    result[i] += half;
    result[i - 1] += half;
  }
  return result;
}

/// The time in which the force is judged: it opens when the force first reaches the band's lower edge after the
/// first touch, or rise_s after that touch, whichever is sooner, and closes when the hold is complete.
/// @param take is given window, sample, the time that it stands for, and its reading.
template <typename Reading, typename Take>
void each_judged(const Samples& samples, const std::vector<BandWindow>& windows, double rise_s, Reading reading,
                 Take take) {
  const std::vector<double> weight = weights(samples);
  for (const BandWindow& window : windows) {
    bool open = false;
    auto it = std::lower_bound(samples.begin(), samples.end(), window.from_s,
                               [](const TraceSample& sample, double t) { return sample.t_s < t; });
    for (; it != samples.end() && it->t_s <= window.to_s; ++it) {
      const double value = reading(*it);
      open = open || value >= window.band.low_n || it->t_s >= window.from_s + rise_s;
      if (open) take(window, *it, weight[static_cast<std::size_t>(it - samples.begin())], value);
    }
  }
}

/// All windows together.
template <typename Reading>
Value in_band_share(const Samples& samples, const std::vector<BandWindow>& windows, double rise_s, Reading reading) {
  double inside = 0, total = 0;
  each_judged(samples, windows, rise_s, reading,
              [&](const BandWindow& window, const TraceSample&, double w, double value) {
                total += w;
                if (value >= window.band.low_n && value <= window.band.high_n) inside += w;
              });
  return total > 0 ? Value(inside / total) : std::nullopt;
}

/// From the first `opening` event of each object to its `closing` event, or to the end. @param bands by object; the
/// first stands for all that have none of their own.
std::vector<BandWindow> windows_between(const std::vector<Event>& events, EventType opening, EventType closing,
                                        double end, const std::vector<ObjectBand>& bands) {
  std::vector<BandWindow> windows;
  std::vector<std::int32_t> seen;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    if (event.type != opening || std::find(seen.begin(), seen.end(), event.object) != seen.end()) continue;
    seen.push_back(event.object);
    const auto closed = std::find_if(events.begin() + static_cast<std::ptrdiff_t>(i), events.end(),
                                     [&](const Event& e) { return e.type == closing && e.object == event.object; });
    const auto index = static_cast<std::size_t>(std::max(0, event.object));
    windows.push_back({event.object, event.t_s, closed == events.end() ? end : closed->t_s,
                       index < bands.size() ? bands[index] : bands.front()});
  }
  return windows;
}

double force_of(const TraceSample& sample) { return sample.force_T.norm(); }

/// Volume of the ellipsoid whose half axes are the standard deviations of the force cloud along its principal axes.
Value force_volume(const std::vector<Vec3>& forces) {
  if (forces.size() < 4) return std::nullopt;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& force : forces) mean += force;
  mean /= static_cast<double>(forces.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& force : forces) covariance += (force - mean) * (force - mean).transpose();
  covariance /= static_cast<double>(forces.size() - 1);
  const Vec3 variances = Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
  return 4.0 / 3.0 * M_PI * std::sqrt(variances.cwiseMax(0.0).prod());
}

void add_size_metrics(const Samples& samples, const ScoringContext& context, MetricSink& sink) {
  const std::vector<double> weight = weights(samples);
  std::vector<Vec3> cloud;
  double time = 0, sum = 0, squares = 0, soft_time = 0, above = 0, pressed = 0, largest = 0, impulse = 0,
         largest_impulse = 0, running = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double force = force_of(samples[i]), w = weight[i];
    largest = std::max(largest, force);
    impulse += force * w;
    running = samples[i].contact ? running + force * w : 0;
    largest_impulse = std::max(largest_impulse, running);
    if (!samples[i].contact) continue;
    cloud.push_back(samples[i].force_T);
    time += w;
    sum += force * w;
    squares += force * force * w;
    if (force <= context.soft_force_n) continue;
    soft_time += w;
    above += (force - context.soft_force_n) * w;
    pressed += force * w;
  }
  const auto value = [&](double x) { return time > 0 ? Value(x) : std::nullopt; };
  const double mean = time > 0 ? sum / time : 0, mean_square = time > 0 ? squares / time : 0;
  sink.push_back({"contact_time_s", samples.empty() ? std::nullopt : Value(time), "s"});
  sink.push_back({"force_max_n", value(largest), "N"});
  sink.push_back({"force_mean_n", value(mean), "N"});
  sink.push_back({"force_rms_n", value(std::sqrt(mean_square)), "N"});
  sink.push_back({"force_sd_n", value(std::sqrt(std::max(0.0, mean_square - mean * mean))), "N"});
  sink.push_back({"impulse_ns", value(impulse), "N s"});
  sink.push_back({"impulse_max_ns", value(largest_impulse), "N s"});
  sink.push_back({"force_volume_n3", force_volume(cloud), "N^3"});
  sink.push_back({"soft_force_share", value(time > 0 ? soft_time / time : 0), "1"});
  sink.push_back({"soft_impulse_ns", value(above), "N s"});
  sink.push_back({"pressed_impulse_ns", value(pressed), "N s"});
}

void add_rate_metric(const Trace& trace, MetricSink& sink) {
  std::vector<double> times, forces;
  for (const TraceSample& sample : trace.samples) {
    times.push_back(sample.t_s);
    forces.push_back(force_of(sample));
  }
  const bool touched =
      std::any_of(trace.samples.begin(), trace.samples.end(), [](const TraceSample& s) { return s.contact; });
  Value steepest;
  if (touched && times.size() > 2) {
    const auto smooth = low_pass(resample(times, forces, trace.rate_hz), trace.rate_hz, kForceCutoffHz);
    steepest = 0;
    for (std::size_t i = 2; i < smooth.size(); ++i)
      steepest = std::max(*steepest, std::abs(smooth[i] - smooth[i - 2]) * trace.rate_hz / 2);
  }
  sink.push_back({"force_rate_max_n_per_s", steepest, "N/s"});
}

void add_grip_metrics(const Samples& samples, const std::vector<Event>& events, const ScoringContext& context,
                      MetricSink& sink) {
  const std::vector<double> weight = weights(samples);
  double time = 0, sum = 0, largest = 0;
  int grasps = 0;
  bool holding = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double grip = samples[i].grip_n;
    largest = std::max(largest, grip);
    if (!holding && grip > 2 * kGripThreshold) {
      holding = true;
      ++grasps;
    } else if (holding && grip < kGripThreshold) {
      holding = false;
    }
    if (grip <= kGripThreshold) continue;
    time += weight[i];
    sum += grip * weight[i];
  }
  const double end = samples.empty() ? 0 : samples.back().t_s;
  const auto windows = windows_between(events, event_type::kGripTouched, event_type::kGripHeld, end,
                                       {{context.grip_low_n, context.grip_high_n}});
  sink.push_back({"grip_max_n", time > 0 ? Value(largest) : std::nullopt, "N"});
  sink.push_back({"grip_mean_n", time > 0 ? Value(sum / time) : std::nullopt, "N"});
  sink.push_back({"grip_in_band_share",
                  in_band_share(samples, windows, kGripRise, [](const TraceSample& sample) { return sample.grip_n; }),
                  "1"});
  sink.push_back({"regrasps", grasps > 0 ? Value(grasps - 1) : std::nullopt, "1"});
}

/// What the hand was to feel and what it was given. Undefined where the recording does not say.
void add_rendered_metrics(const Samples& samples, const ScoringContext& context, MetricSink& sink) {
  const std::vector<double> weight = weights(samples);
  const auto add = [&](const char* largest_name, const char* mean_name, double TraceSample::*force) {
    double time = 0, sum = 0, largest = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!samples[i].contact) continue;
      time += weight[i];
      sum += samples[i].*force * weight[i];
      largest = std::max(largest, samples[i].*force);
    }
    const bool known = time > 0 && std::isfinite(sum);
    sink.push_back({largest_name, known ? Value(largest) : std::nullopt, "N"});
    sink.push_back({mean_name, known ? Value(sum / time) : std::nullopt, "N"});
  };
  add("commanded_max_n", "commanded_mean_n", &TraceSample::commanded_n);
  add("delivered_max_n", "delivered_mean_n", &TraceSample::rendered_n);
  sink.push_back({"room_share", context.room_share, "1"});
}

void add_honesty_metrics(const Samples& samples, MetricSink& sink) {
  double contact = 0, saturated = 0, passive = 0;
  for (const TraceSample& sample : samples) {
    if (!sample.contact) continue;
    contact += 1;
    saturated += sample.saturated ? 1 : 0;
    passive += sample.passivity_active ? 1 : 0;
  }
  sink.push_back({"saturated_contact_share", contact > 0 ? Value(saturated / contact) : std::nullopt, "1"});
  sink.push_back({"passivity_active_share", contact > 0 ? Value(passive / contact) : std::nullopt, "1"});
}

}  // namespace

void add_force_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                       MetricSink& sink) {
  const double end = trace.samples.empty() ? 0 : trace.samples.back().t_s;
  add_size_metrics(trace.samples, context, sink);
  add_rate_metric(trace, sink);
  std::vector<ObjectBand> bands = context.object_bands;
  if (bands.empty()) bands.push_back({context.band_low_n, context.band_high_n});
  const auto windows = windows_between(events, event_type::kTargetTouched, event_type::kTargetHeld, end, bands);
  BandTimes of_objects{FrozenTimes(events, end)};
  double judged_s = 0, hard_s = 0;
  each_judged(trace.samples, windows, context.rise_s, force_of,
              [&](const BandWindow& window, const TraceSample& sample, double w, double value) {
                of_objects.add(window, sample.t_s, w, value);
                judged_s += w;
                if (value > context.hard_force_n) hard_s += w;
              });
  sink.push_back({"in_band_share", in_band_share(trace.samples, windows, context.rise_s, force_of), "1"});
  sink.push_back({"object_in_band_share", of_objects.mean_share(context.counted_hold_s), "1"});
  sink.push_back({"hard_force_share", judged_s > 0 ? Value(hard_s / judged_s) : std::nullopt, "1"});
  add_grip_metrics(trace.samples, events, context, sink);
  add_rendered_metrics(trace.samples, context, sink);
  add_honesty_metrics(trace.samples, sink);
}

}  // namespace trocar
