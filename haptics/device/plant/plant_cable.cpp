#include "haptics/device/plant/plant_cable.h"

#include <cmath>
#include <numbers>

namespace trocar {
namespace {

FrictionParameters share_of(FrictionParameters friction, double share) {
  friction.coulomb *= share;
  friction.viscous *= share;
  return friction;
}

}  // namespace

FrictionParameters friction_behind_cable(const FrictionParameters& whole, const CableParameters& cable) {
  return cable.stiffness > 0 ? share_of(whole, 1 - cable.friction_on_motor) : whole;
}

double PlantCable::stretch(double q) const noexcept { return std::remainder(angle_ - q, 2 * std::numbers::pi); }

PlantCable::PlantCable(const CableParameters& cable, double rotor_inertia, const FrictionParameters& friction)
    : p_(cable), inertia_(rotor_inertia), brushes_(share_of(friction, cable.friction_on_motor)) {}

void PlantCable::place(double joint_angle, double joint_rate) noexcept {
  angle_ = joint_angle;
  rate_ = joint_rate;
  brushes_.reset();
}

ResistanceLine PlantCable::linearise(double q, double qd, double motor_load, double dt) noexcept {
  // Mean of the stretch before and after the step: that of mid-step plus dt/4 of the change of rate.
  const double follow = 0.25 * dt * p_.stiffness;
  const double pull = p_.stiffness * stretch(q) - follow * (rate_ - qd);
  const double slope = p_.damping + follow;
  rub_ = brushes_.linearise(rate_, dt);
  mass_ = inertia_ + dt * (slope + rub_.slope);
  push_ = inertia_ * rate_ + dt * (motor_load - pull - rub_.constant);
  coupling_ = dt * slope;
  return {-(pull + slope * push_ / mass_), slope * (1 - coupling_ / mass_)};
}

void PlantCable::advance(double qd_new, double dt) noexcept {
  rate_ = (push_ + coupling_ * qd_new) / mass_;
  brushes_.advance(rate_, dt);
}

double PlantCable::energy(double q) const noexcept {
  return 0.5 * inertia_ * rate_ * rate_ + 0.5 * p_.stiffness * stretch(q) * stretch(q);
}

}  // namespace trocar
