#include "tissue/interaction/circulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

/// Of a beat, mean 0, from -0.5 to 0.5.
double pulse_shape(double phase) {
  constexpr double kHeight = 2.598076211353316;  // 3 sqrt(3) / 2, of sin x + sin 2x / 2
  const double x = 2 * std::numbers::pi * phase;
  return (std::sin(x) + std::sin(2 * x) / 2) / kHeight;
}

}  // namespace

void Circulation::step(double step_s, double lost_m3) {
  lost_share_ = std::clamp(lost_m3 / options_.blood_m3, 0.0, 1.0);
  phase_ += heart_hz() * step_s;
  phase_ -= std::floor(phase_);
}

void Circulation::reset() { lost_share_ = phase_ = 0; }

double Circulation::strength() const {
  const double beyond = lost_share_ - options_.tolerated_share;
  return std::clamp(1 - beyond / (options_.fatal_share - options_.tolerated_share), 0.0, 1.0);
}

double Circulation::heart_hz() const {
  const double share = std::min(lost_share_ / options_.fastest_heart_share, 1.0);
  return options_.heart_hz + share * (options_.fastest_heart_hz - options_.heart_hz);
}

double Circulation::mean_arterial_pa() const {
  const double outside = options_.pneumoperitoneum_pa;
  return outside + strength() * (options_.mean_arterial_pa - outside);
}

BloodPressures Circulation::pressures() const {
  const double outside = options_.pneumoperitoneum_pa;
  const auto driven = [&](double full) { return outside + strength() * (full - outside); };
  return {driven(options_.mean_arterial_pa + options_.pulse_pressure_pa * pulse_shape(phase_)),
          driven(options_.portal_pa), driven(options_.venous_pa), outside};
}

}  // namespace trocar
