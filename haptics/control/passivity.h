// Passivity of the rendered force: what the hand gets back is what it has put in.
//
// One scalar contact, arm or pinch. Three steps a tick (docs/decisions/0016-energy-account.md):
//   observe  A(k) = A(k-1) + absorbed + friction. absorbed = -tau(k-1-d)^T dq(k): everything but weight that really
//            acted, friction feed-forward included, times the way really made. friction: what the joints surely took
//            (sure_friction.h). In contact A <= what the wanted spring stores + credit, in free air A <= 0; debt of a
//            contact that rests returns slowly, in free air only friction pays it.
//   bound    No more force than a spring kappa that holds all of it: F <= sqrt(2 kappa (A' + loan)),
//              A' = A + F v Td + 1/2 m v^2 (the last while it goes in)
//            what is on its way by the delay, either way, and what the moving stylus must still give up. kappa =
//            b/(T/2 + Td) within least and most stiffness.
//   recover  F follows its own way with local stiffness min(kappa, k) and drifts towards the wanted force: at rest by
//            the share 1/recovery_s of what kappa makes of the surplus depth (slow enough for the softest hand), faster
//            while it surely goes in. Beside kappa dx the law moves F by no more than law_n_per_s.
// Springs that need no law, k <= max(least stiffness, b/(T/2 + Td)), follow the wanted force; only the bound holds
// them. The force never pulls. kIncrement is here for the degraded device: increment bounding alone (Kim and Ryu 2010).
// Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trocar {

/// The numbers are those of recordings and do not change; 2, 3, 5 and 6 were laws of comparison, which are gone.
enum class PassivityLaw : std::uint8_t { kOff = 0, kBudgeted = 1, kIncrement = 4 };

struct PassivityLawName {
  PassivityLaw law;
  const char* name;
};
/// Identifiers on the command line and in files.
inline constexpr std::array<PassivityLawName, 3> kPassivityLaws{
    {{PassivityLaw::kOff, "off"}, {PassivityLaw::kIncrement, "increment"}, {PassivityLaw::kBudgeted, "budgeted"}}};

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

struct PassivityParameters {
  PassivityLaw law = PassivityLaw::kBudgeted;
  double period_s = 1e-3;
  double delay_s = 1e-3;           ///< Td beyond the hold: one period of the seam
  double finest_hold_s = 1.5e-3;   ///< shortest T/2 + Td reckoned with: faster loops see the same coarse counts
  double viscous_n_s_per_m = 0.6;  ///< b of kappa: arm and hand, no energy is claimed from it [chosen on seeds 1, 2]
  double least_stiffness_n_per_m = 150, most_stiffness_n_per_m = 200;  ///< of kappa [chosen on seeds 1, 2]
  double effective_mass_kg = 0.127;  ///< m, of the arm at the tip, mid workspace [computed from the device's values]
  double loan_j = 1.4e-3;            ///< what friction beyond the sure one pays on every drawn arm [seeds 1 to 5]
  double credit_cap_j = 0.5e-3;
  double rest_speed_m_s = 0.01;    ///< mean speed below which a contact rests
  double forgiven_w = 0.01;        ///< how fast its debt returns there
  double recovery_s = 0.3;         ///< time constant of the surplus depth at rest
  double recovery_n_per_s = 4;     ///< at most so fast
  double pressing_m_s = 0.05;      ///< faster than this it surely goes in,
  double pressing_n_per_m = 1500;  ///< and the force may rise by this stiffness at the finest hold, less with delay
  double law_n_per_s = 48;         ///< most that the law moves the force beside its local stiffness
  double fade_debt_j = 0.05;       ///< debt that warns
  double fault_debt_j = 0.15;      ///< debt that is a fault

  double hold_s() const { return std::max(finest_hold_s, period_s / 2 + delay_s); }
  double kappa() const {
    return std::clamp(viscous_n_s_per_m / hold_s(), least_stiffness_n_per_m, most_stiffness_n_per_m);
  }
  /// A spring of this stiffness, N/m, needs no law.
  bool leaves_alone(double stiffness) const {
    return stiffness <= (1 + 1e-9) * std::max(least_stiffness_n_per_m, viscous_n_s_per_m / hold_s());
  }
};

/// One scalar contact: what happened in the last period.
struct ContactWork {
  double wanted_n = 0;    ///< spring force that the contact law asks for, >= 0
  double absorbed_j = 0;  ///< -tau_applied . dq of the last period
  double dx_m = 0;        ///< displacement against the force, positive pressing in
  double speed_m_s = 0;   ///< estimated speed of pressing in
  double stored_j = 0;    ///< energy that the wanted spring holds now
  double friction_j = 0;  ///< what friction surely took in the last period
  double stiffness = 0;   ///< N/m of the contact as asked of the motors; 0: taken from wanted and stored
};

class PassivityController {
 public:
  explicit PassivityController(const PassivityParameters& parameters) : p_(parameters) {}

  /// @return force to render, N, 0 <= result <= wanted.
  double update(const ContactWork& work);
  void reset();
  /// From the next update on; what has been observed stays.
  void set_law(PassivityLaw law) { p_.law = law; }
  /// Called after the torque limiter: only `scale` of what update() returned was delivered.
  void delivered(double scale) { force_ *= std::min(1.0, scale); }

  /// A spring of this stiffness, N/m, needs no law.
  bool leaves_alone(double stiffness) const { return !guards() || p_.leaves_alone(stiffness); }

  double absorbed_j() const { return absorbed_; }  ///< sum since reset
  double energy_j() const { return energy_; }      ///< the same with what friction surely took
  double min_energy_j() const { return min_energy_; }
  double budget_j() const { return budget_; }  ///< A
  bool active() const { return active_; }      ///< the law changed the force in the last update
  bool debt_faded() const { return guards() && -budget_ > p_.fade_debt_j; }
  bool debt_fault() const { return guards() && -budget_ > p_.fault_debt_j; }

 private:
  void observe(const ContactWork& work);
  double bound(const ContactWork& work) const;
  double recover(const ContactWork& work, double stiffness, double most) const;
  double increment_bounded(const ContactWork& work) const;
  bool guards() const { return p_.law != PassivityLaw::kOff; }

  PassivityParameters p_;
  double absorbed_ = 0, energy_ = 0, min_energy_ = 0;
  double budget_ = 0;    ///< A, J
  double force_ = 0;     ///< displayed spring force, N
  double stir_m_s_ = 0;  ///< mean speed, either way
  bool active_ = false;
};

}  // namespace trocar
