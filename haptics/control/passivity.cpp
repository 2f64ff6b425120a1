#include "haptics/control/passivity.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr int kFreeTicks = 20;          // out of contact before credit is cleared
constexpr double kFadedShare = 0.2;     // of the stiffness while the debt is above fade_debt_j
constexpr double kDampingShare = 0.25;  // c of alpha_max = c m / (Td + T/2 + Tv)
constexpr double kStill = 1e-12;        // m

}  // namespace

void PassivityController::reset() {
  energy_ = min_energy_ = budget_ = held_ = spring_ = missing_ = 0;
  free_ticks_ = 0;
  active_ = false;
}

double PassivityController::update(const ContactWork& work) {
  energy_ += work.absorbed_j;
  min_energy_ = std::min(min_energy_, energy_);
  const double v = work.speed_m_s;
  const double eaten = 0.5 * p_.friction_left * (p_.viscous_n_s_per_m * v * v + p_.coulomb_n * std::abs(v)) * p_.period_s;
  const double income = work.absorbed_j + eaten;

  double spring = work.wanted_n;
  double lost = 0;
  if (p_.law == PassivityLaw::kBudgeted && work.wanted_n > 0) {
    spring = std::max(affordable(work, income), bounded(work));
    if (-budget_ > p_.fade_debt_j) spring = std::min(spring, kFadedShare * work.wanted_n);
    lost = damping(v);
  }
  const double held = work.wanted_n > 0 ? work.stored_j * spring / work.wanted_n : 0;
  budget_ = std::min(p_.credit_cap_j, budget_ + income - (held - held_));
  held_ = held;
  spring_ = spring;
  missing_ = work.wanted_n - spring;
  forget_in_free_space(work);

  const double force = std::max(0.0, spring + lost);
  active_ = work.wanted_n > 0 && force != work.wanted_n;
  return force;
}

void PassivityController::delivered(double scale) {
  if (scale >= 1) return;
  budget_ = std::min(p_.credit_cap_j, budget_ + (1 - scale) * held_);
  held_ *= scale;
  missing_ += (1 - scale) * spring_;
  spring_ *= scale;
}

double PassivityController::affordable(const ContactWork& work, double income_j) const {
  if (work.stored_j <= 0) return work.wanted_n;
  const double payable = std::max(0.0, budget_ + income_j + held_);
  const double still_missing = std::max(0.0, missing_ - p_.recovery_n_per_s * p_.period_s);
  return std::min(work.wanted_n * std::min(1.0, payable / work.stored_j), work.wanted_n - still_missing);
}

double PassivityController::bounded(const ContactWork& work) const {
  if (std::abs(work.dx_m) < kStill) return std::min(spring_, work.wanted_n);  // at rest it may only fall
  const double kappa = p_.viscous_n_s_per_m / (p_.period_s / 2 + p_.delay_s);
  const double eta = spring_ / work.dx_m;
  const double reach = std::abs(eta + kappa);
  const double beta = std::clamp((work.wanted_n - spring_) / work.dx_m, -eta - reach, -eta + reach);
  return std::max(0.0, spring_ + beta * work.dx_m);
}

double PassivityController::damping(double speed_m_s) const {
  if (budget_ >= 0 || std::abs(speed_m_s) <= p_.dead_band_m_s) return 0;
  const double alpha_max = kDampingShare * p_.effective_mass_kg / (p_.delay_s + p_.period_s / 2 + p_.velocity_lag_s);
  return std::min(alpha_max, -budget_ / (p_.period_s * speed_m_s * speed_m_s)) * speed_m_s;
}

void PassivityController::forget_in_free_space(const ContactWork& work) {
  free_ticks_ = work.wanted_n > 0 ? 0 : free_ticks_ + 1;
  if (free_ticks_ > kFreeTicks + static_cast<int>(p_.delay_s / p_.period_s)) {
    budget_ = std::min(budget_, 0.0) * (1 - p_.period_s / p_.debt_decay_s);
  }
}

}  // namespace trocar
