#include "haptics/control/passivity.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr int kFreeTicks = 20;          // out of contact before credit is cleared
constexpr double kFadedShare = 0.2;     // of the stiffness while the debt is above fade_debt_j
constexpr double kDampingShare = 0.25;  // c of alpha_max = c m / (Td + T/2 + Tv)
constexpr double kStirTime = 0.05;      // s, mean speed that tells rest from motion
constexpr double kStill = 1e-12;        // m

}  // namespace

void PassivityController::reset() {
  energy_ = min_energy_ = budget_ = held_ = spring_ = missing_ = lost_ = damping_w_ = thesis_j_ = stir_m_s_ =
      at_rest_s_ = 0;
  free_ticks_ = 0;
  active_ = false;
}

double PassivityController::update(const ContactWork& work) {
  energy_ += work.absorbed_j;
  min_energy_ = std::min(min_energy_, energy_);
  const double v = work.speed_m_s;
  const double eaten =
      0.5 * p_.friction_left * (p_.viscous_n_s_per_m * v * v + p_.coulomb_n * std::abs(v)) * p_.period_s;
  const double income = work.absorbed_j + eaten;

  double spring = work.wanted_n;
  damping_w_ = 0;
  if (work.wanted_n <= 0) lost_ = 0;
  const double force = work.wanted_n > 0 ? apply_law(work, income, spring) : 0;
  const double held = work.wanted_n > 0 ? work.stored_j * spring / work.wanted_n : 0;
  budget_ = std::min(p_.credit_cap_j, budget_ + income - (held - held_));
  held_ = held;
  spring_ = spring;
  missing_ = work.wanted_n - spring;
  forget_in_free_space(work);

  active_ = work.wanted_n > 0 && (force != work.wanted_n || damping_w_ > 0);
  return force;
}

double PassivityController::apply_law(const ContactWork& work, double income_j, double& spring) {
  double lost = 0;
  switch (p_.law) {
    case PassivityLaw::kOff:
      return work.wanted_n;
    case PassivityLaw::kThesis:
      return thesis_force(work);
    case PassivityLaw::kReference:
      lost = damping(work);
      break;
    case PassivityLaw::kIncrement:
      spring = bounded(work);
      break;
    case PassivityLaw::kCap:
      spring = capped(work, kappa());
      break;
    case PassivityLaw::kBudgeted:
    case PassivityLaw::kDistributed:
      spring = std::max(affordable(work, income_j), bounded(work));
      spring = at_rest(work, std::min(spring, smooth(work)));
      lost = damping(work);
      break;
  }
  if (-budget_ > p_.fade_debt_j) spring = std::min(spring, kFadedShare * work.wanted_n);
  if (p_.law != PassivityLaw::kDistributed) return std::max(0.0, spring + lost);
  damping_w_ = std::max(lost, -spring) * work.speed_m_s;  // as little a pull as along the contact
  return spring;
}

double PassivityController::stiffness_of(const ContactWork& work) {
  if (work.stiffness > 0 || work.stored_j <= 0) return work.stiffness;
  return work.wanted_n * work.wanted_n / (2 * work.stored_j);
}

double PassivityController::smooth(const ContactWork& work) const {
  if (work.count_m <= 0 || work.stiffness <= 0 || work.stored_j <= 0) return work.wanted_n;
  const double depth_m = work.wanted_n / work.stiffness + work.beyond_m;
  return p_.texture_n / work.count_m * depth_m;
}

double PassivityController::capped(const ContactWork& work, double stiffness) {
  if (work.stored_j <= 0) return work.wanted_n;
  return work.wanted_n * std::min(1.0, stiffness / stiffness_of(work));
}

double PassivityController::at_rest(const ContactWork& work, double spring) {
  stir_m_s_ += (std::abs(work.dx_m) / p_.period_s - stir_m_s_) * p_.period_s / kStirTime;
  at_rest_s_ = stir_m_s_ < p_.rest_speed_m_s ? at_rest_s_ + p_.period_s : 0;
  if (at_rest_s_ < p_.rest_s) return spring;
  // Near rest a count that flickers moves the wanted force by k counts and the observed energy by as much as the law
  // weighs: the force follows neither faster than a press at the dead band would ask. What swings then swings against
  // a constant force, and the hand damps it.
  const double step = std::max(p_.rest_recovery_n_per_s, stiffness_of(work) * p_.dead_band_m_s) * p_.period_s;
  spring = std::min(std::clamp(spring, spring_ - step, spring_ + step), work.wanted_n);
  if (spring >= work.wanted_n) return spring;
  const double quiet = capped(work, p_.rest_stiffness_n_per_m);
  const double more = std::min(quiet, spring_ + p_.rest_recovery_n_per_s * p_.period_s);
  if (more <= spring) return spring;
  budget_ += work.stored_j / work.wanted_n * (more - spring);  // what the budget is not charged for
  return more;
}

double PassivityController::thesis_force(const ContactWork& work) {
  thesis_j_ += work.wanted_n * work.dx_m;
  const double v = work.dx_m / p_.period_s;
  if (thesis_j_ >= 0 || v == 0) return work.wanted_n;
  const double alpha = -thesis_j_ / (p_.period_s * v * v);
  thesis_j_ += alpha * v * v * p_.period_s;
  return work.wanted_n + alpha * v;
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
  const double eta = spring_ / work.dx_m;
  const double reach = std::abs(eta + kappa());
  const double beta = std::clamp((work.wanted_n - spring_) / work.dx_m, -eta - reach, -eta + reach);
  return std::max(0.0, spring_ + beta * work.dx_m);
}

double PassivityController::damping(const ContactWork& work) {
  const double v = work.speed_m_s, step = p_.damping_n_per_s * p_.period_s;
  double wanted = 0;
  if (budget_ < 0 && std::abs(v) > p_.dead_band_m_s) {
    const double alpha_max = kDampingShare * p_.effective_mass_kg / (p_.delay_s + p_.period_s / 2 + work.lag_s);
    wanted = std::min(alpha_max, -budget_ / (p_.period_s * v * v)) * v;
  }
  lost_ = std::clamp(wanted, lost_ - step, lost_ + step);
  if (lost_ * v < 0) lost_ = 0;  // it never outlasts the motion that it damps
  return lost_;
}

void PassivityController::forget_in_free_space(const ContactWork& work) {
  free_ticks_ = work.wanted_n > 0 ? 0 : free_ticks_ + 1;
  if (free_ticks_ > kFreeTicks + static_cast<int>(p_.delay_s / p_.period_s)) {
    budget_ = std::min(budget_, 0.0) * (1 - p_.period_s / p_.debt_decay_s);
  }
}

}  // namespace trocar
