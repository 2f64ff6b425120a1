#include "haptics/device/plant/plant_friction.h"

#include <cmath>

namespace trocar {

PlantFriction::PlantFriction(const FrictionParameters& p)
    : p_(p),
      sigma0_(p.coulomb > 0 ? p.coulomb / p.bristle_length : 0.0),
      sigma1_(2.0 * std::sqrt(sigma0_ * p.damping_inertia)) {}

ResistanceLine PlantFriction::linearise(double v_old, double dt) noexcept {
  if (sigma0_ <= 0) return {0.0, p_.viscous};
  const double ratio = v_old / p_.stribeck_speed;
  const double hill = std::exp(-ratio * ratio);
  const double g = p_.coulomb * (1.0 + (p_.stribeck_ratio - 1.0) * hill);
  sink_ = 1.0 + dt * sigma0_ * std::abs(v_old) / g;
  const double sigma1 = sigma1_ * hill;
  // z_new = (z + dt v)/sink; f = sigma0 z_new + sigma1 (z_new - z)/dt + viscous v.
  const double gain = (sigma0_ + sigma1 / dt) / sink_;
  return {gain * z_ - sigma1 * z_ / dt, gain * dt + p_.viscous};
}

void PlantFriction::advance(double v_new, double dt) noexcept {
  if (sigma0_ > 0) z_ = (z_ + dt * v_new) / sink_;
}

ResistanceLine stop_resistance(const StopParameters& stop, double position, double v_old) noexcept {
  const double beyond =
      position > stop.upper ? position - stop.upper : (position < stop.lower ? position - stop.lower : 0.0);
  if (beyond == 0.0) return {};
  const double spring = stop.stiffness * beyond;
  const bool pushes = (spring + stop.damping * v_old) * beyond > 0;  // the damper may not glue the link to the stop
  return pushes ? ResistanceLine{spring, stop.damping} : ResistanceLine{};
}

}  // namespace trocar
