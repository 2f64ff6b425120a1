#include "haptics/control/parallel_passivity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trocar {

ParallelPassivity::ParallelPassivity(const ParallelParameters& parameters) : p_(parameters) {
  if (p_.delay_periods < 0 || p_.delay_periods > ParallelParameters::kMostDelay) {
    throw std::invalid_argument("parallel passivity: the delay must be 0 to 31 periods");
  }
  if (!(p_.period_s > 0) || !(p_.servo_lag_s >= 0) || !(p_.sensor_lag_s >= 0) || !(p_.hand_n_per_m > 0)) {
    throw std::invalid_argument("parallel passivity: period and hand stiffness must be positive, lags not negative");
  }
}

double ParallelPassivity::update(const ParallelWork& work) {
  if (p_.law == ParallelLaw::kThesis || p_.law == ParallelLaw::kMended) return thesis(work);
  observe(work);
  weigh(work.mass_kg);
  const bool yields = p_.law == ParallelLaw::kYield || p_.law == ParallelLaw::kBudgeted;
  const double v = work.wanted_m_s + (yields ? yielding(work) : 0);
  active_ = v != work.wanted_m_s || shown_kg_ > work.mass_kg;
  return v;
}

double ParallelPassivity::thesis(const ParallelWork& work) {
  const double f = work.force_n;
  w_ += f * work.wanted_m_s;
  double by_alpha = 0;
  if (w_ < 0 && f != 0) by_alpha = -w_ / (f * f);
  w_ += by_alpha * f * f;
  energy_ = p_.period_s * w_;
  min_energy_ = std::min(min_energy_, energy_);
  active_ = by_alpha > 0;
  return work.wanted_m_s + (p_.law == ParallelLaw::kMended ? 1 : -1) * f * by_alpha;
}

void ParallelPassivity::observe(const ParallelWork& work) {
  moved_ += (work.moved_m - moved_) * p_.period_s / (p_.period_s + p_.sensor_lag_s);
  const double given = 0.5 * (work.force_n + force_) * moved_;
  force_ = work.force_n;
  energy_ += given;
  min_energy_ = std::min(min_energy_, energy_);

  on_the_way_[head_] = work.stored_j;
  const std::size_t size = on_the_way_.size();
  const double late = on_the_way_[(head_ + size - static_cast<std::size_t>(p_.delay_periods)) % size];
  head_ = (head_ + 1) % size;
  const double lag = p_.servo_lag_s + p_.sensor_lag_s;
  const double more = (late - shown_j_) * p_.period_s / (p_.period_s + lag);
  shown_j_ += more;
  budget_ = std::min(p_.credit_cap_j, budget_ + given - more);
  if (budget_ < 0 && std::abs(work.force_n) < p_.dead_band_n) budget_ *= 1 - p_.period_s / p_.debt_decay_s;
}

double ParallelPassivity::yielding(const ParallelWork& work) {
  const double f = work.force_n, step = p_.yield_m_s2 * p_.period_s;
  double wanted = 0;
  if (in_debt() && std::abs(f) > p_.dead_band_n) {
    wanted = std::min(p_.most_yield(), -budget_ / (p_.period_s * f * f)) * f;
  }
  yielded_ = std::clamp(wanted, yielded_ - step, yielded_ + step);
  if (yielded_ * f < 0) yielded_ = 0;  // it never outlasts the push that it yields to
  return yielded_;
}

void ParallelPassivity::weigh(double asked_kg) {
  const double heavy = std::max(asked_kg, p_.least_mass_kg());
  if (p_.law == ParallelLaw::kHeavy) shown_kg_ = heavy;
  if (p_.law != ParallelLaw::kBudgeted) return;
  const double back = shown_kg_ - (heavy - asked_kg) * p_.period_s / p_.mass_return_s;
  const double due = asked_kg + (heavy - asked_kg) * std::clamp(-budget_ / p_.full_debt_j, 0.0, 1.0);
  shown_kg_ = std::max({asked_kg, due, back});
}

double ParallelPassivity::shown_mass_kg(double asked_kg) const { return std::max(asked_kg, shown_kg_); }

}  // namespace trocar
