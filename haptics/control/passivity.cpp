#include "haptics/control/passivity.h"

#include <cmath>

namespace trocar {
namespace {

constexpr double kStirTime = 0.05;   // s, mean speed that tells rest from motion
constexpr double kStill = 1e-12;     // m
constexpr double kTipViscous = 0.3;  // N s/m, of increment bounding [assumed, reference 3.4]

double stiffness_of(const ContactWork& work) {
  if (work.stiffness > 0 || work.stored_j <= 0) return work.stiffness;
  return work.wanted_n * work.wanted_n / (2 * work.stored_j);
}

}  // namespace

void PassivityController::reset() {
  absorbed_ = energy_ = min_energy_ = budget_ = force_ = stir_m_s_ = 0;
  active_ = false;
}

double PassivityController::update(const ContactWork& work) {
  observe(work);
  double force = 0;
  if (work.wanted_n > 0) {
    switch (p_.law) {
      case PassivityLaw::kOff:
        force = work.wanted_n;
        break;
      case PassivityLaw::kIncrement:
        force = increment_bounded(work);
        break;
      case PassivityLaw::kBudgeted:
        force = recover(work, stiffness_of(work), bound(work));
        break;
    }
  }
  force_ = force;
  active_ = force != work.wanted_n;
  return force;
}

void PassivityController::observe(const ContactWork& work) {
  absorbed_ += work.absorbed_j;
  energy_ += work.absorbed_j + work.friction_j;
  min_energy_ = std::min(min_energy_, energy_);
  budget_ += work.absorbed_j + work.friction_j;
  budget_ = std::min(budget_, work.wanted_n > 0 ? work.stored_j + p_.credit_cap_j : 0);
  stir_m_s_ += (std::abs(work.dx_m) / p_.period_s - stir_m_s_) * p_.period_s / kStirTime;
  const bool rests = work.wanted_n > 0 && stir_m_s_ < p_.rest_speed_m_s;
  if (rests && budget_ < 0) budget_ = std::min(0.0, budget_ + p_.forgiven_w * p_.period_s);
}

double PassivityController::bound(const ContactWork& work) const {
  const double v = work.speed_m_s, in = std::max(0.0, v);
  const double ahead = budget_ + force_ * v * p_.delay_s + 0.5 * p_.effective_mass_kg * in * in + p_.loan_j;
  const double kappa = p_.leaves_alone(stiffness_of(work)) ? std::max(p_.kappa(), stiffness_of(work)) : p_.kappa();
  return std::sqrt(2 * kappa * std::max(0.0, ahead));
}

double PassivityController::recover(const ContactWork& work, double stiffness, double most) const {
  const double local = std::min(p_.kappa(), stiffness), law_step = p_.law_n_per_s * p_.period_s;
  const double along = force_ + local * work.dx_m;
  double step = law_step;
  if (!p_.leaves_alone(stiffness)) {
    const double surplus_m = (work.wanted_n - force_) / stiffness;
    const double pressing = p_.pressing_n_per_m * p_.finest_hold_s / p_.hold_s();
    step = p_.period_s * (std::min(p_.recovery_n_per_s, local * std::abs(surplus_m) / p_.recovery_s) +
                          pressing * std::max(0.0, work.speed_m_s - p_.pressing_m_s));
  }
  const double drifted = std::min(most, along + std::clamp(work.wanted_n - along, -step, step));
  const double force = std::clamp(drifted, std::min(force_, along) - law_step, std::max(force_, along) + law_step);
  return std::clamp(force, 0.0, work.wanted_n);
}

double PassivityController::increment_bounded(const ContactWork& work) const {
  if (std::abs(work.dx_m) < kStill) return std::min(force_, work.wanted_n);  // at rest it may only fall
  const double eta = force_ / work.dx_m, reach = std::abs(eta + kTipViscous / p_.hold_s());
  const double beta = std::clamp((work.wanted_n - force_) / work.dx_m, -eta - reach, -eta + reach);
  return std::max(0.0, force_ + beta * work.dx_m);
}

}  // namespace trocar
