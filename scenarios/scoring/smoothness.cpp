#include "scenarios/scoring/smoothness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/scoring/fourier.h"

namespace trocar {

std::optional<double> spectral_arc_length(const std::vector<double>& speed, double rate_hz, double cutoff_hz,
                                          double amplitude_threshold) {
  if (speed.size() < 2) return std::nullopt;
  const std::size_t size = next_power_of_two(speed.size()) * 16;  // zero padding by 2^4 as in the paper's code
  const auto spectrum = fourier_transform(speed, size);
  const double bin_hz = rate_hz / static_cast<double>(size);
  double largest = 0;
  for (const auto& value : spectrum) largest = std::max(largest, std::abs(value));
  if (!(largest > 0)) return std::nullopt;
  std::vector<double> magnitude;
  std::size_t first = size, last = 0;
  for (std::size_t k = 0; k < size / 2 && static_cast<double>(k) * bin_hz <= cutoff_hz; ++k) {
    magnitude.push_back(std::abs(spectrum[k]) / largest);
    if (magnitude[k] < amplitude_threshold) continue;
    first = std::min(first, k);
    last = k;
  }
  if (first >= last) return std::nullopt;
  const double step = 1 / static_cast<double>(last - first);
  double length = 0;
  for (std::size_t k = first; k < last; ++k) length += std::hypot(step, magnitude[k + 1] - magnitude[k]);
  return -length;
}

std::optional<double> dimensionless_jerk(const std::vector<double>& speed, double rate_hz) {
  if (speed.size() < 4) return std::nullopt;
  double peak = 0;
  for (const double value : speed) peak = std::max(peak, std::abs(value));
  if (!(peak > 0)) return std::nullopt;
  const double dt = 1 / rate_hz, duration = static_cast<double>(speed.size()) * dt;
  double sum = 0;
  for (std::size_t i = 2; i < speed.size(); ++i) {
    const double jerk = (speed[i] - 2 * speed[i - 1] + speed[i - 2]) / (dt * dt);
    sum += jerk * jerk * dt;
  }
  return -duration * duration * duration / (peak * peak) * sum;
}

std::optional<double> log_dimensionless_jerk(const std::vector<double>& speed, double rate_hz) {
  const auto jerk = dimensionless_jerk(speed, rate_hz);
  if (!jerk || *jerk == 0) return std::nullopt;
  return -std::log(std::abs(*jerk));
}

std::optional<double> normalised_squared_jerk(const std::vector<Vec3>& position, double rate_hz) {
  if (position.size() < 4) return std::nullopt;
  const double amplitude = (position.back() - position.front()).norm();
  if (!(amplitude > 0)) return std::nullopt;
  const double dt = 1 / rate_hz, duration = static_cast<double>(position.size() - 1) * dt;
  double sum = 0;
  for (std::size_t i = 3; i < position.size(); ++i) {
    const Vec3 jerk = (position[i] - 3 * position[i - 1] + 3 * position[i - 2] - position[i - 3]) / (dt * dt * dt);
    sum += jerk.squaredNorm() * dt;
  }
  return std::pow(duration, 5) / (amplitude * amplitude) * sum;
}

namespace {

/// Lowest value met from `peak` in direction `step` before something higher than the peak (or the end) comes.
double flank_minimum(const std::vector<double>& signal, std::size_t peak, int step) {
  double lowest = signal[peak];
  for (auto i = static_cast<std::ptrdiff_t>(peak) + step; i >= 0 && i < static_cast<std::ptrdiff_t>(signal.size());
       i += step) {
    const double value = signal[static_cast<std::size_t>(i)];
    if (value > signal[peak]) break;
    lowest = std::min(lowest, value);
  }
  return lowest;
}

}  // namespace

int count_peaks(const std::vector<double>& signal, double prominence) {
  int count = 0;
  std::size_t i = 1;
  while (i + 1 < signal.size()) {
    std::size_t plateau_end = i;
    while (plateau_end + 1 < signal.size() && signal[plateau_end + 1] == signal[i]) ++plateau_end;
    const bool falls = plateau_end + 1 < signal.size() && signal[plateau_end + 1] < signal[i];
    const bool top = signal[i] > signal[i - 1] && falls;
    if (top) {
      const double base = std::max(flank_minimum(signal, i, -1), flank_minimum(signal, plateau_end, 1));
      if (signal[i] - base >= prominence) ++count;
    }
    i = plateau_end + 1;
  }
  return count;
}

std::vector<std::pair<std::size_t, std::size_t>> runs(const std::vector<double>& signal, double level,
                                                      std::size_t min_samples, bool below) {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  std::size_t start = 0;
  bool inside = false;
  for (std::size_t i = 0; i <= signal.size(); ++i) {
    const bool now = i < signal.size() && (below ? signal[i] < level : signal[i] > level);
    if (now && !inside) start = i;
    if (!now && inside && i - start >= min_samples) result.emplace_back(start, i);
    inside = now;
  }
  return result;
}

std::optional<Tremor> tremor(const std::vector<Vec3>& position, double rate_hz, double low_hz, double high_hz) {
  if (static_cast<double>(position.size()) < rate_hz || rate_hz < 2 * high_hz) return std::nullopt;
  const std::size_t n = position.size() - 1, size = next_power_of_two(n);
  const double bin_hz = rate_hz / static_cast<double>(size);
  double band_power = 0, band_square = 0, power = 0, window_square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> velocity(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double window =
          0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
      if (axis == 0) window_square += window * window;
      velocity[i] = window * (position[i + 1][axis] - position[i][axis]) * rate_hz;
    }
    const auto spectrum = fourier_transform(velocity, size);
    for (std::size_t k = 1; k < size / 2; ++k) {
      const double f = static_cast<double>(k) * bin_hz, energy = std::norm(spectrum[k]);
      if (f >= 0.3) power += energy;
      if (f < low_hz || f > high_hz) continue;
      const double difference_gain = 2 * rate_hz * std::sin(std::numbers::pi * f / rate_hz);  // of x[i+1] - x[i]
      band_power += energy;
      band_square += energy / (difference_gain * difference_gain);
    }
  }
  if (!(power > 0)) return Tremor{};
  return Tremor{std::sqrt(2 * band_square / (static_cast<double>(size) * window_square)), band_power / power};
}

}  // namespace trocar
