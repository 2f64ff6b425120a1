#include "app/studies/admittance/admittance_device.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kFrictionSpeed = 1e-3;  // m/s over which Coulomb friction turns
constexpr double kIntegralShare = 4;     // the PI's corner lies at w / 4

}  // namespace

void AdmittanceDevice::step(double wanted_m_s, double intent_m, double dt) {
  const double w = 2 * std::numbers::pi * p_.servo_hz;
  force_ = std::clamp(hand_.grip_stiffness * (hand_x_ - x_) + hand_.grip_damping * (hand_v_ - v_), -hand_.force_limit_n,
                      hand_.force_limit_n);
  const double asked = p_.slide_kg * w * (wanted_m_s - v_ + w / kIntegralShare * lost_way_);
  const double drive = std::clamp(asked, -p_.drive_limit_n, p_.drive_limit_n);
  lost_way_ += dt * (wanted_m_s - v_);  // also in saturation: the drive makes up for the way that it lost
  const double friction = p_.viscous_n_s_per_m * v_ + p_.coulomb_n * std::tanh(v_ / kFrictionSpeed);
  v_ += dt * (force_ + drive - friction) / p_.slide_kg;
  const double arm = hand_.arm_stiffness * (intent_m - hand_x_) - hand_.arm_damping * hand_v_;
  hand_v_ += dt * (arm - force_) / hand_.hand_mass;
  x_ += dt * v_;
  hand_x_ += dt * hand_v_;
  given_j_ += force_ * v_ * dt;
  sensed_ += (force_ - sensed_) * dt / (p_.sensor_lag_s + dt);
}

double AdmittanceDevice::encoder_m() const { return p_.count_m * std::floor(x_ / p_.count_m); }

double AdmittanceDevice::measured_n() {
  return p_.sensor_step_n * std::round((sensed_ + p_.sensor_noise_n * noise_.normal()) / p_.sensor_step_n);
}

}  // namespace trocar
