#include "scenarios/scoring/trace_filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

/// y = (b0 x0 + b1 x1 + b2 x2 - a1 y1 - a2 y2), transposed direct form II.
struct Biquad {
  double b0, b1, b2, a1, a2;

  static Biquad butterworth(double rate_hz, double cutoff_hz) {
    const double k = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
    const double norm = 1 / (1 + std::numbers::sqrt2 * k + k * k);
    const double b0 = k * k * norm;
    return {b0, 2 * b0, b0, 2 * (k * k - 1) * norm, (1 - std::numbers::sqrt2 * k + k * k) * norm};
  }

  void run(std::vector<double>& x) const {
    double s1 = (1 - b0) * x.front(), s2 = (b2 - a2) * x.front();  // steady state at the first value
    for (double& value : x) {
      const double in = value;
      value = b0 * in + s1;
      s1 = b1 * in - a1 * value + s2;
      s2 = b2 * in - a2 * value;
    }
  }
};

}  // namespace

std::vector<double> low_pass(const std::vector<double>& signal, double rate_hz, double cutoff_hz) {
  if (signal.size() < 2 || cutoff_hz >= 0.45 * rate_hz) return signal;
  const std::size_t n = signal.size();
  const std::size_t pad = std::min(n - 1, static_cast<std::size_t>(std::ceil(3 * rate_hz / cutoff_hz)));
  std::vector<double> x(n + 2 * pad);
  for (std::size_t i = 0; i < pad; ++i) {
    x[i] = 2 * signal.front() - signal[pad - i];
    x[pad + n + i] = 2 * signal.back() - signal[n - 2 - i];
  }
  std::copy(signal.begin(), signal.end(), x.begin() + static_cast<std::ptrdiff_t>(pad));
  const Biquad filter = Biquad::butterworth(rate_hz, cutoff_hz);
  filter.run(x);
  std::reverse(x.begin(), x.end());
  filter.run(x);
  std::reverse(x.begin(), x.end());
  const auto first = x.begin() + static_cast<std::ptrdiff_t>(pad);
  return {first, first + static_cast<std::ptrdiff_t>(n)};
}

std::vector<double> resample(const std::vector<double>& times, const std::vector<double>& values, double rate_hz) {
  assert(times.size() == values.size());
  if (times.empty()) return {};
  const double span = times.back() - times.front();
  const auto count = static_cast<std::size_t>(std::floor(span * rate_hz + 1e-6)) + 1;
  std::vector<double> result(count);
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = times.front() + static_cast<double>(k) / rate_hz;
    while (i + 2 < times.size() && times[i + 1] <= t) ++i;
    if (times.size() == 1) {
      result[k] = values.front();
      continue;
    }
    const double share = std::clamp((t - times[i]) / (times[i + 1] - times[i]), 0.0, 1.0);
    result[k] = values[i] + share * (values[i + 1] - values[i]);
  }
  return result;
}

SmoothPath smooth_path(const Trace& trace, double cutoff_hz) {
  SmoothPath path;
  path.rate_hz = std::min(kMetricRateHz, trace.rate_hz);
  if (trace.samples.size() < 2) return path;
  std::vector<double> times, uniform_times;
  for (const TraceSample& sample : trace.samples) times.push_back(sample.t_s);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const TraceSample& sample : trace.samples) values.push_back(sample.tip_T[axis]);
    const std::vector<double> filtered = low_pass(resample(times, values, trace.rate_hz), trace.rate_hz, cutoff_hz);
    uniform_times.resize(filtered.size());
    for (std::size_t i = 0; i < filtered.size(); ++i) uniform_times[i] = static_cast<double>(i) / trace.rate_hz;
    const std::vector<double> coarse = resample(uniform_times, filtered, path.rate_hz);
    path.position.resize(coarse.size());
    for (std::size_t i = 0; i < coarse.size(); ++i) path.position[i][axis] = coarse[i];
  }
  const std::size_t n = path.position.size();
  for (std::size_t i = 0; i < n && n > 1; ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, n - 1);
    path.velocity.push_back((path.position[after] - path.position[before]) *
                            (path.rate_hz / static_cast<double>(after - before)));
    path.speed.push_back(path.velocity.back().norm());
  }
  return path;
}

}  // namespace trocar
