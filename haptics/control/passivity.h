// Passivity of the rendered force: exact energy observer and a budget that pays for stored energy.
//
// The force held during a period does work on the true displacement: E(k) = E(k-1) - tau_r(k-1-d)^T dq(k), tau_r what
// was really applied. (The thesis pairs force and backward difference of the same tick and cannot see the energy that
// sampling creates, docs/thesis_errata.md.) Budget, in joules, R the energy that the displayed spring holds:
//   B(k) = min(cap, B(k-1) + absorbed + 1/2 (b v^2 + fc |v|) T - (R(k) - R(k-1))),  R = stored * displayed / wanted
// The full spring force passes while B stays >= 0; otherwise the largest affordable force, but never less than
// increment bounding allows: F changes by beta dx with
//   beta = clamp((F_wanted - F)/dx, -eta - |eta + kappa|, -eta + |eta + kappa|), eta = F/dx, kappa = b/(T/2 + Td)
// (after Kim and Ryu 2010); in debt a bounded damping is added. No spring is stiffer than one whose step from count to
// count is texture_n. Near rest the force follows no faster than a press at the dead band would ask, so that flickering
// counts shake nothing, and what is missing returns at rest_recovery_n_per_s up to rest_stiffness_n_per_m: that energy
// is not paid for. The force never pulls. Why R and not the full spring's energy:
// docs/decisions/0003-passivity-budget.md; what was tried: 0007-calm-passivity.md.
//
// That is the default, kBudgeted. The others are here to be compared with it (`trocar study passivity`):
//   kThesis     W = sum f(k) dx(k) (4.17), f + alpha v with alpha = -W / (T v^2), unbounded (4.18)
//   kReference  full spring plus damping alpha = min(alpha_max, -B / (T v^2)), B against the full spring's energy
//               (Ryu, Preusche, Hannaford and Hirzinger 2005, with the bound of docs/device.md)
//   kIncrement  increment bounding at every tick, no budget
//   kCap        the spring weakened to kappa
//   kDistributed  budgeted, but the damping's power is placed on the joints under the motors' limits
//               (damping_distribution.h): update() returns the spring alone, damping_w() the power to take out
// One budget for the arm, one for the pinch. Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trocar {

/// The numbers are those of recordings and do not change.
enum class PassivityLaw : std::uint8_t {
  kOff = 0,
  kBudgeted = 1,
  kThesis = 2,
  kReference = 3,
  kIncrement = 4,
  kCap = 5,
  kDistributed = 6
};

struct PassivityLawName {
  PassivityLaw law;
  const char* name;
};
/// Identifiers on the command line and in files.
inline constexpr std::array<PassivityLawName, 7> kPassivityLaws{{{PassivityLaw::kOff, "off"},
                                                                 {PassivityLaw::kThesis, "thesis"},
                                                                 {PassivityLaw::kReference, "reference"},
                                                                 {PassivityLaw::kIncrement, "increment"},
                                                                 {PassivityLaw::kCap, "cap"},
                                                                 {PassivityLaw::kDistributed, "distributed"},
                                                                 {PassivityLaw::kBudgeted, "budgeted"}}};

constexpr const char* passivity_law_name(PassivityLaw law) {
  for (const PassivityLawName& known : kPassivityLaws) {
    if (known.law == law) return known.name;
  }
  return "unknown";
}

constexpr std::optional<PassivityLaw> passivity_law_named(std::string_view name) {
  for (const PassivityLawName& known : kPassivityLaws) {
    if (name == known.name) return known.law;
  }
  return std::nullopt;
}

/// What the law may assume of the device at the tip; half of the identified friction is counted.
struct PassivityParameters {
  PassivityLaw law = PassivityLaw::kBudgeted;
  double period_s = 1e-3;
  double delay_s = 1e-3;           ///< Td beyond the hold: one period of the seam
  double viscous_n_s_per_m = 0.3;  ///< b at the tip [assumed, reference 3.4]
  double friction_left = 1;        ///< share of b and fc that compensation leaves to dissipate
  double finest_hold_s = 1.5e-3;  ///< shortest T/2 + Td that kappa believes in: faster loops see the same coarse counts
  double coulomb_n = 0.06;        ///< fc at the tip [assumed, reference 3.4]
  double effective_mass_kg = 0.127;  ///< at the tip, mid workspace [computed from the device's values]
  double dead_band_m_s = 0.005;      ///< FOAW is zero at rest
  double credit_cap_j = 0.5e-3;
  double debt_decay_s = 0.2;
  double rest_speed_m_s = 0.005;        ///< mean speed below which the stylus counts as at rest,
  double rest_s = 0.05;                 ///< when it has been so for so long
  double rest_recovery_n_per_s = 3;     ///< at rest the force returns this fast unpaid: nothing moves that could swing
  double rest_stiffness_n_per_m = 300;  ///< up to this displayed stiffness
  double texture_n = 0.06;              ///< force that one count may switch on and off: felt as a buzz above [assumed]
  double recovery_n_per_s = 100;        ///< how fast the full force may return when the budget recovers
  double damping_n_per_s = 250;         ///< how fast the damping force may change: the law gives no blow
  double fade_debt_j = 0.05;            ///< debt that fades the force to a fifth
  double fault_debt_j = 0.15;           ///< debt that is a fault
};

/// One scalar contact: what happened in the last period.
struct ContactWork {
  double wanted_n = 0;    ///< spring force that the contact law asks for, >= 0
  double absorbed_j = 0;  ///< -tau_applied . dq of the last period
  double dx_m = 0;        ///< displacement against the force, positive pressing in
  double speed_m_s = 0;   ///< estimated speed of pressing in
  double stored_j = 0;    ///< energy that the wanted spring holds now (kappa applied)
  double lag_s = 4e-3;    ///< of speed_m_s
  double count_m = 0;     ///< largest step of the stylus against the force that one encoder count shows
  double beyond_m = 0;    ///< depth beyond the one at which the motors' limit is reached
  double stiffness = 0;   ///< N/m of the contact as asked of the motors; 0: taken from wanted and stored
};

class PassivityController {
 public:
  explicit PassivityController(const PassivityParameters& parameters) : p_(parameters) {}

  /// @return force to render, N, 0 <= result.
  double update(const ContactWork& work);
  void reset();
  /// From the next update on; what has been observed stays.
  void set_law(PassivityLaw law) { p_.law = law; }
  /// Damping that may be counted on from the next update on, N s/m.
  void set_viscous(double viscous_n_s_per_m) { p_.viscous_n_s_per_m = viscous_n_s_per_m; }
  /// Called after the torque budget: only `scale` of what update() returned was delivered, so only that is stored.
  void delivered(double scale);

  double energy_j() const { return energy_; }  ///< observer: absorbed minus returned since reset
  double min_energy_j() const { return min_energy_; }
  double budget_j() const { return budget_; }
  double damping_w() const { return damping_w_; }  ///< kDistributed: power to be placed on the joints, >= 0
  bool active() const { return active_; }          ///< the law changed the force in the last update
  bool debt_faded() const { return guards() && -budget_ > p_.fade_debt_j; }
  bool debt_fault() const { return guards() && -budget_ > p_.fault_debt_j; }

 private:
  /// Force of the law. `spring` of it is what a spring holds.
  double apply_law(const ContactWork& work, double income_j, double& spring);
  /// The wanted force as weak as a spring of this stiffness, N/m, would make it.
  static double capped(const ContactWork& work, double stiffness);
  double at_rest(const ContactWork& work, double spring);
  /// Force of the stiffest spring whose step from count to count is not felt.
  double smooth(const ContactWork& work) const;
  static double stiffness_of(const ContactWork& work);
  double thesis_force(const ContactWork& work);
  /// The comparison laws of the past do without an observer that they could trust.
  bool guards() const { return p_.law != PassivityLaw::kOff && p_.law != PassivityLaw::kThesis; }
  double kappa() const { return p_.viscous_n_s_per_m / std::max(p_.finest_hold_s, p_.period_s / 2 + p_.delay_s); }
  double affordable(const ContactWork& work, double income_j) const;
  double bounded(const ContactWork& work) const;
  double damping(const ContactWork& work);
  void forget_in_free_space(const ContactWork& work);

  PassivityParameters p_;
  double energy_ = 0, min_energy_ = 0, budget_ = 0;
  double held_ = 0;      ///< R, J
  double spring_ = 0;    ///< displayed spring force, N
  double stir_m_s_ = 0;  ///< mean speed, either way
  double at_rest_s_ = 0;
  double lost_ = 0;  ///< damping force of the last update, N
  double damping_w_ = 0;
  double missing_ = 0;   ///< wanted minus displayed spring force, N
  double thesis_j_ = 0;  ///< W of (4.17)
  int free_ticks_ = 0;
  bool active_ = false;
};

}  // namespace trocar
