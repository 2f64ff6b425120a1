#include "app/studies/device/velocity_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

#include "haptics/control/channel_velocity.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kQuantum = 0.208e-3, kPeriod = 1e-3;  // m, s
constexpr double kSkip = 0.05;                         // s that every estimator has to begin
constexpr int kMostLag = 20;                           // periods

struct Motion {
  const char *name, *file;
  double seconds;
  std::function<double(double)> position;  ///< m
};

std::array<Motion, 3> motions() {
  const double tremor = 2 * std::numbers::pi * 12;
  return {{{"reach at 0.45 m/s", "reach", 0.35, [](double t) { return 0.045 * minimum_jerk((t - 0.1) / 0.1875); }},
           {"creep at 10 mm/s", "creep", 0.6, [](double t) { return 0.01 * t; }},
           {"12 Hz, 2 mm", "tremor", 0.6, [tremor](double t) { return 2e-3 * std::sin(tremor * t); }}}};
}

double speed(const Motion& m, double t) { return (m.position(t + 1e-6) - m.position(t - 1e-6)) / 2e-6; }

std::int64_t count_at(const Motion& m, double t) {
  return static_cast<std::int64_t>(std::floor(m.position(t) / kQuantum));
}

/// As DaqSample: since the last edge before t. @param before the answer one period earlier.
std::uint16_t edge_age_us(const Motion& m, double t, int before) {
  const std::int64_t now = count_at(m, t);
  for (int us = 1; us <= kPeriod * 1e6; ++us) {
    if (count_at(m, t - us * 1e-6) != now) return static_cast<std::uint16_t>(us);
  }
  return static_cast<std::uint16_t>(std::min(65535, before + static_cast<int>(kPeriod * 1e6)));
}

std::vector<double> estimate(VelocityMethod method, const Motion& m) {
  ChannelVelocity channel(method, kQuantum, kPeriod);
  std::vector<double> v;
  std::uint16_t age_us = 65535;
  for (int k = 0; k * kPeriod < m.seconds; ++k) {
    age_us = edge_age_us(m, k * kPeriod, age_us);
    v.push_back(channel.update(count_at(m, k * kPeriod), 1, age_us));
  }
  return v;
}

/// RMS difference from the true speed `shift` periods ago.
double error(const std::vector<double>& v, const Motion& m, int shift) {
  double sum = 0;
  int n = 0;
  for (std::size_t k = static_cast<std::size_t>(kSkip / kPeriod); k < v.size(); ++k, ++n) {
    const double e = v[k] - speed(m, (static_cast<double>(k) - shift) * kPeriod);
    sum += e * e;
  }
  return std::sqrt(sum / n);
}

double roughness(const std::vector<double>& v) {
  double sum = 0;
  const std::size_t from = static_cast<std::size_t>(kSkip / kPeriod);
  for (std::size_t k = from + 1; k < v.size(); ++k) sum += (v[k] - v[k - 1]) * (v[k] - v[k - 1]);
  return std::sqrt(sum / static_cast<double>(v.size() - from - 1));
}

int lag(const std::vector<double>& v, const Motion& m) {
  int best = 0;
  for (int shift = 1; shift <= kMostLag; ++shift) {
    if (error(v, m, shift) < error(v, m, best)) best = shift;
  }
  return best;
}

}  // namespace

StudyResult velocity_study(const StudyRequest&) {
  StudyResult study{"velocity", "none: the estimators alone, counts of 0.208 mm, 1 kHz", {}, {}};
  std::ostringstream table;
  table << "motion,estimator,rms_error_m_s,rms_step_m_s,lag_ms\n" << std::setprecision(4);
  double blend = 0, backward = 0, edges = 0;
  for (const Motion& m : motions()) {
    StudyCurves curves{std::string("velocity_") + m.file,
                       std::string("Speed by estimator: ") + m.name,
                       "time, s",
                       "speed, m/s",
                       {},
                       {}};
    std::vector<double> truth;
    for (int k = 0; k * kPeriod < m.seconds; ++k) {
      curves.x.push_back(k * kPeriod);
      truth.push_back(speed(m, k * kPeriod));
    }
    curves.series.push_back({"true", truth});
    for (const VelocityMethodName& known : kVelocityMethods) {
      const std::vector<double> v = estimate(known.method, m);
      const double wrong = error(v, m, 0);
      table << m.name << ',' << known.name << ',' << wrong << ',' << roughness(v) << ',' << lag(v, m) << '\n';
      if (known.method == VelocityMethod::kBlend) blend = wrong;
      if (known.method == VelocityMethod::kBackward) backward = wrong;
      if (known.method == VelocityMethod::kEdges) edges = wrong;
      if (known.method != VelocityMethod::kBackward && known.method != VelocityMethod::kLowPass)
        curves.series.push_back({known.name, v});
    }
    study.cases.push_back({std::string(m.name) + ": error of the blend", "m/s", blend, backward,
                           "<= 0.4 x backward difference", blend <= 0.4 * backward,
                           "RMS against the true speed; beside it that of the backward difference of (4.17)."});
    study.cases.push_back({std::string(m.name) + ": error with edge times", "m/s", edges, blend, "reported", true,
                           "The same of a board that tells when each counter last moved; beside it the blend."});
    study.curves.push_back(curves);
  }
  study.files.push_back({"velocity_table.csv", table.str()});
  return study;
}

}  // namespace trocar
