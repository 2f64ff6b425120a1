// Passivity of an admittance device: force in, velocity out, the two-port parallel form (thesis 4.20 to 4.24).
//
// The hand's force f is measured, the virtual environment answers with a velocity v2, the device makes v1. What the
// hand gives is f v1; the controller is a conductance 1/alpha beside the environment, so the device yields to the
// force:
//   v1(n) = v2(n) + f(n) / alpha(n)
// (Hannaford and Ryu 2002.) Forms, of which those that follow kThesis are our own:
//   kThesis   as printed: W(n) = f v2 + sum(f v2 + f^2/alpha) (4.22), 1/alpha = -W/f^2 (4.23), v1 = v2 - f/alpha (4.24)
//   kMended   the same with the sign that (4.22) counts on, v1 = v2 + f/alpha
//   kYield    exact observer: the energy E(n) = E(n-1) + 1/2 (f(n) + f(n-1)) dx(n) over the way really made, dx passed
//             through the force sensor's own lag so that both are of one moment. Budget, J:
//               B(n) = min(cap, B(n-1) + E(n) - E(n-1) - (S - S_before)),  S what the environment holds as shown:
//               passed
//             through loop delay and lags. In debt 1/alpha = min(c / (k_hand lag), -B / (T f^2)), nothing where |f|
//             lies in the dead band, v1 - v2 changing by no more than yield_m_s2.
//   kHeavy    no smaller virtual mass than M_min = heavy k_hand lag^2 is shown (dual of the stiffness cap)
//   kBudgeted kYield, and in debt a greater mass as well: M_min from full_debt_j on, less before, from which it returns
//   to
//             the mass asked for within mass_return_s. The environment grows heavier at equal kinetic energy and
//             lighter at equal speed: neither gives energy.
// lag = delay + T/2 + servo lag + sensor lag. Why M_min: docs/admittance.md. The constants c, heavy, full_debt_j and
// mass_return_s were chosen on four drawn grids of `trocar study admittance` (seeds 1 to 4).
// One axis; N, m/s, J; f positive along v, E what the hand gave. Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace trocar {

enum class ParallelLaw : std::uint8_t { kOff, kThesis, kMended, kYield, kHeavy, kBudgeted };

inline constexpr std::array kParallelLaws{ParallelLaw::kOff,   ParallelLaw::kThesis, ParallelLaw::kMended,
                                          ParallelLaw::kYield, ParallelLaw::kHeavy,  ParallelLaw::kBudgeted};

constexpr const char* parallel_law_name(ParallelLaw law) {
  constexpr std::array kNames{"off", "thesis", "mended", "yield", "heavy", "budgeted"};
  return kNames[static_cast<std::size_t>(law)];
}

/// What the law may know of the device, and how far it may go.
struct ParallelParameters {
  ParallelLaw law = ParallelLaw::kBudgeted;
  double period_s = 1e-3;
  int delay_periods = 1;         ///< between command and drive, as measured; at most kMostDelay
  double servo_lag_s = 5e-3;     ///< of the drive's velocity loop
  double sensor_lag_s = 1.5e-3;  ///< of the measured force
  double hand_n_per_m = 900;     ///< stiffest hand reckoned with: the firm grip [assumed]
  double yield_share = 0.15;     ///< c of 1/alpha_max = c / (k_hand lag)
  double yield_m_s2 = 5;         ///< how fast the yielding may change: no blow [assumed]
  double dead_band_n = 0.1;      ///< force below which nothing is yielded: five times the sensor's noise [assumed]
  double credit_cap_j = 0.5e-3;
  double heavy = 5;             ///< M_min over k_hand lag^2
  double full_debt_j = 0.7e-3;  ///< debt at which M_min is shown
  double mass_return_s = 0.2;   ///< [assumed]
  double debt_decay_s = 0.2;    ///< of a debt while nobody pushes

  static constexpr int kMostDelay = 31;
  double lag_s() const { return (delay_periods + 0.5) * period_s + servo_lag_s + sensor_lag_s; }
  double least_mass_kg() const { return heavy * hand_n_per_m * lag_s() * lag_s(); }
  double most_yield() const { return yield_share / (hand_n_per_m * lag_s()); }  ///< m/s per N
};

struct ParallelWork {
  double wanted_m_s = 0;  ///< v2
  double force_n = 0;     ///< f, as measured
  double moved_m = 0;     ///< way really made in the last period
  double stored_j = 0;    ///< in the environment, with the mass it showed
  double mass_kg = 1;     ///< of the environment, as asked for
};

class ParallelPassivity {
 public:
  /// @throws std::invalid_argument for a delay, lag, period or stiffness out of range.
  explicit ParallelPassivity(const ParallelParameters& parameters);

  /// @return velocity to make, v1, m/s.
  double update(const ParallelWork& work);
  /// Mass that the environment is to show in its next step, >= the one asked for.
  double shown_mass_kg(double asked_kg) const;

  double energy_j() const { return energy_; }  ///< E, or T W for the thesis' forms
  double min_energy_j() const { return min_energy_; }
  double budget_j() const { return budget_; }
  bool active() const { return active_; }

 private:
  double thesis(const ParallelWork& work);
  void observe(const ParallelWork& work);
  double yielding(const ParallelWork& work);
  void weigh(double asked_kg);
  bool in_debt() const { return budget_ < 0; }

  ParallelParameters p_;
  double energy_ = 0, min_energy_ = 0, budget_ = 0;
  double w_ = 0;                                                         ///< (4.22), W
  double force_ = 0;                                                     ///< f(n-1)
  double moved_ = 0;                                                     ///< dx through the sensor's lag
  double shown_j_ = 0;                                                   ///< S
  double yielded_ = 0;                                                   ///< v1 - v2
  double shown_kg_ = 0;                                                  ///< 0: as asked
  std::array<double, ParallelParameters::kMostDelay + 1> on_the_way_{};  ///< energies held, ring
  std::size_t head_ = 0;
  bool active_ = false;
};

}  // namespace trocar
