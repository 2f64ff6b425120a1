#include "haptics/control/passivity.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr int kFreeTicks = 20;         // out of contact before credit is cleared
constexpr double kFadedShare = 0.2;    // of the stiffness while the debt is above fade_debt_j
constexpr double kDampingShare = 0.25; // c of alpha_max = c m / (Td + T/2 + Tv)
constexpr double kStill = 1e-12;       // m

}  // namespace

void PassivityController::reset() {
  energy_ = min_energy_ = budget_ = stored_ = force_ = 0;
  free_ticks_ = 0;
  active_ = false;
}

void PassivityController::settle_budget(const ContactWork& work) {
  energy_ += work.absorbed_j;
  min_energy_ = std::min(min_energy_, energy_);
  const double v = work.speed_m_s;
  const double eaten = 0.5 * (p_.viscous_n_s_per_m * v * v + p_.coulomb_n * std::abs(v)) * p_.period_s;
  budget_ = std::min(p_.credit_cap_j, budget_ + work.absorbed_j + eaten - (work.stored_j - stored_));
  stored_ = work.stored_j;

  free_ticks_ = work.wanted_n > 0 ? 0 : free_ticks_ + 1;
  if (free_ticks_ > kFreeTicks + static_cast<int>(p_.delay_s / p_.period_s)) {
    budget_ = std::min(budget_, 0.0) * (1 - p_.period_s / p_.debt_decay_s);
  }
}

double PassivityController::bounded(const ContactWork& work) const {
  double force = force_;
  if (std::abs(work.dx_m) < kStill) {
    force = std::min(force_, work.wanted_n);  // at rest it may only fall
  } else {
    const double kappa = p_.viscous_n_s_per_m / (p_.period_s / 2 + p_.delay_s);
    const double eta = force_ / work.dx_m;
    const double reach = std::abs(eta + kappa);
    const double beta = std::clamp((work.wanted_n - force_) / work.dx_m, -eta - reach, -eta + reach);
    force = force_ + beta * work.dx_m;
  }
  const double v = work.speed_m_s;
  if (std::abs(v) > p_.dead_band_m_s) {
    const double alpha_max =
        kDampingShare * p_.effective_mass_kg / (p_.delay_s + p_.period_s / 2 + p_.velocity_lag_s);
    force += std::min(alpha_max, -budget_ / (p_.period_s * v * v)) * v;
  }
  return force;
}

double PassivityController::update(const ContactWork& work) {
  settle_budget(work);
  double force = work.wanted_n;
  if (p_.law == PassivityLaw::kBudgeted && work.wanted_n > 0) {
    if (budget_ < 0) {
      force = bounded(work);
      if (-budget_ > p_.fade_debt_j) force = std::min(force, kFadedShare * work.wanted_n);
    } else if (active_) {
      force = std::min(work.wanted_n, force_ + p_.recovery_n_per_s * p_.period_s);
    }
  }
  force = std::max(0.0, force);
  active_ = work.wanted_n > 0 && force != work.wanted_n;
  force_ = force;
  return force;
}

}  // namespace trocar
