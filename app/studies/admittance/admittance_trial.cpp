#include "app/studies/admittance/admittance_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kTrialPeriod = 1e-3, kSubstep = 50e-6;  // s
constexpr int kSubsteps = 20;
constexpr double kTrialWall = 0.060, kPastWall = 0.020;  // m, and how far beyond the hand aims
constexpr double kPeakOfJerk = 1.875;                    // peak over mean speed of a minimum-jerk reach
constexpr double kFaultSpeed = 2.0, kFaultForce = 39;
constexpr double kBand = 0.1;                   // N
constexpr int kHalfWindow = 25, kFitHalf = 15;  // periods
constexpr double kEndWindow = 0.3;              // s

/// The environment: where it is, how fast, and what it holds.
struct VirtualMass {
  double x = 0, v = 0;

  void step(const AdmittanceCase& c, double force_n, double mass_kg) {
    const double depth = x - kTrialWall;
    const double b = 2 * c.wall_damping * std::sqrt(c.wall_n_per_m * c.mass_kg);
    const double wall = depth > 0 ? std::max(0.0, c.wall_n_per_m * depth + b * v) : 0;
    v += kTrialPeriod / mass_kg * (force_n - wall);
  }
  double stored_j(const AdmittanceCase& c, double mass_kg) const {
    const double depth = std::max(0.0, x - kTrialWall);
    return 0.5 * mass_kg * v * v + 0.5 * c.wall_n_per_m * depth * depth;
  }
};

ParallelParameters law_of(const AdmittanceCase& c, ParallelLaw law, const AdmittanceDeviceParameters& device) {
  ParallelParameters p;
  p.law = law;
  p.period_s = kTrialPeriod;
  p.delay_periods = c.delay_periods;
  p.servo_lag_s = 1 / (2 * std::numbers::pi * device.servo_hz);
  p.sensor_lag_s = device.sensor_lag_s;
  return p;
}

class Loop {
 public:
  Loop(const AdmittanceCase& c, ParallelLaw law)
      : c_(c), device_(device_of(c), c.hand, c.noise_seed), law_(law_of(c, law, device_of(c))), mass_(c.mass_kg) {}

  /// One period: latch, environment, law, command on its way.
  void tick(double intent_m) {
    const double x = device_.encoder_m(), f = device_.measured_n();
    const double mass = law_.shown_mass_kg(c_.mass_kg);
    if (mass > mass_) mass_v_.v *= std::sqrt(mass_ / mass);  // heavier at equal kinetic energy
    mass_ = mass;
    mass_v_.step(c_, f, mass);
    const double v = law_.update({mass_v_.v, f, x - last_x_, mass_v_.stored_j(c_, mass), c_.mass_kg});
    last_x_ = x;
    mass_v_.x += kTrialPeriod * v;
    commands_[head_ % commands_.size()] = v;
    const std::size_t due = head_++ - static_cast<std::size_t>(c_.delay_periods);
    const double drive = head_ > static_cast<std::size_t>(c_.delay_periods) ? commands_[due % commands_.size()] : 0;
    for (int i = 0; i < kSubsteps; ++i) device_.step(drive, intent_m, kSubstep);
  }

  const AdmittanceDevice& device() const { return device_; }
  const ParallelPassivity& law() const { return law_; }

 private:
  static AdmittanceDeviceParameters device_of(const AdmittanceCase& c) {
    AdmittanceDeviceParameters p;
    p.servo_hz = c.servo_hz;
    return p;
  }

  AdmittanceCase c_;
  AdmittanceDevice device_;
  ParallelPassivity law_;
  VirtualMass mass_v_;
  double mass_, last_x_ = 0;
  std::array<double, ParallelParameters::kMostDelay + 1> commands_{};
  std::size_t head_ = 0;
};

/// Fit of force = m a + c v over the free way; both sides through the same mean, so neither lags the other.
void fit_free_way(const AdmittanceTrace& trace, AdmittanceOutcome& out) {
  double aa = 0, av = 0, vv = 0, fa = 0, fv = 0;
  for (std::size_t i = kFitHalf; i + kFitHalf < trace.t.size() && trace.position_m[i + kFitHalf] < kTrialWall; ++i) {
    double f = 0;
    for (std::size_t j = i - kFitHalf; j < i + kFitHalf; ++j) f += trace.force_n[j];
    f /= 2 * kFitHalf;
    const double a = (trace.speed_m_s[i + kFitHalf] - trace.speed_m_s[i - kFitHalf]) / (2 * kFitHalf * kTrialPeriod);
    const double v = (trace.position_m[i + kFitHalf] - trace.position_m[i - kFitHalf]) / (2 * kFitHalf * kTrialPeriod);
    aa += a * a, av += a * v, vv += v * v, fa += f * a, fv += f * v;
  }
  const double det = aa * vv - av * av;
  if (det <= 1e-12 * aa * vv) return;
  out.felt_mass_kg = (fa * vv - fv * av) / det;
  out.drag_n_s_per_m = (fv * aa - fa * av) / det;
}

void judge(AdmittanceOutcome& out, double from_s) {
  const std::vector<double>& force = out.trace.force_n;
  const int n = static_cast<int>(force.size());
  double depth = 0, pressed = 0;
  int counted = 0;
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int first = std::max(0, i - kHalfWindow), last = std::min(n, i + kHalfWindow + 1);
    double mean = 0;
    for (int j = first; j < last; ++j) mean += force[static_cast<std::size_t>(j)];
    mean /= last - first;
    const double since = out.trace.t[at] - from_s;
    if (since >= 0 && std::abs(force[at] - mean) >= kBand) out.settled_s = since;
    out.least_j = std::min(out.least_j, out.trace.given_j[at]);
    out.observer_gap_j = std::max(out.observer_gap_j, std::abs(out.trace.given_j[at] - out.trace.observed_j[at]));
    if (since <= kAdmittanceWatched - kEndWindow) continue;
    depth += out.trace.position_m[at] - kTrialWall;
    pressed += force[at];
    ++counted;
  }
  if (counted > 0) out.depth_m = depth / counted;
  if (depth > 0) out.shown_n_per_m = pressed / depth;
}

}  // namespace

bool AdmittanceOutcome::stable() const { return !faulted && settled_s <= kAdmittanceSettle; }

AdmittanceOutcome press(const AdmittanceCase& c, ParallelLaw law) {
  Loop loop(c, law);
  AdmittanceOutcome out;
  const double reach_s = kPeakOfJerk * (kTrialWall + kPastWall) / c.speed_m_s;
  double touched_s = -1;
  int acted = 0;
  for (int k = 0;; ++k) {
    const double t = k * kTrialPeriod;
    const double from = touched_s >= 0 ? touched_s : reach_s;
    if (t > from + kAdmittanceWatched) break;
    loop.tick((kTrialWall + kPastWall) * minimum_jerk(t / reach_s));
    const AdmittanceDevice& device = loop.device();
    if (touched_s < 0 && device.position_m() > kTrialWall) touched_s = t;
    out.trace.t.push_back(t);
    out.trace.position_m.push_back(device.position_m());
    out.trace.speed_m_s.push_back(device.speed_m_s());
    out.trace.force_n.push_back(device.force_n());
    out.trace.given_j.push_back(device.given_j());
    out.trace.observed_j.push_back(loop.law().energy_j());
    acted += loop.law().active();
    out.faulted = std::abs(device.speed_m_s()) > kFaultSpeed || std::abs(device.force_n()) > kFaultForce;
    if (out.faulted) break;
  }
  judge(out, touched_s >= 0 ? touched_s : reach_s);
  fit_free_way(out.trace, out);
  out.active_share = static_cast<double>(acted) / static_cast<double>(out.trace.t.size());
  return out;
}

}  // namespace trocar
