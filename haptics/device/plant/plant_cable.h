// The capstan cable of one joint as a spring, with the motor's rotor behind it as a mass of its own.
//
//   Jr phi'' = tau_motor - tau_c - tau_brushes,   tau_c = k (phi - q) + d (phi' - q')   pulls the joint
// phi is the rotor's angle seen at the joint (motor angle times ratio), Jr its inertia seen there. The spring is taken
// at the mean of the positions before and after the step (implicit midpoint: a spring alone keeps its energy at any
// step, and is stable at any stiffness), damping and brushes at the new rates. The rotor's new rate is linear in the
// joint's, so it is eliminated, and the joint sees one more line in its own new rate.
// Units: joint rad, N m. Thread: value type, one owner.
#pragma once

#include "haptics/device/plant/plant_friction.h"
#include "haptics/device/plant/plant_parameters.h"

namespace trocar {

class PlantCable {
 public:
  /// @param rotor_inertia seen at the joint, kg m2. @param friction of the whole joint.
  PlantCable(const CableParameters& cable, double rotor_inertia, const FrictionParameters& friction);

  bool elastic() const noexcept { return p_.stiffness > 0; }
  /// The rotor stands over the joint, at rest or with the joint's rate; the cable is slack of load.
  void place(double joint_angle, double joint_rate = 0) noexcept;
  void drift(double dt) noexcept { angle_ += dt * rate_; }
  /// What the cable resists the joint with over the coming step, a line in the joint's new rate.
  /// @param q, qd joint at mid-step and its rate before. @param motor_load of the motor at the joint.
  ResistanceLine linearise(double q, double qd, double motor_load, double dt) noexcept;
  /// The rotor's rate at the end of the step that linearise() prepared.
  void advance(double qd_new, double dt) noexcept;

  double angle() const noexcept { return angle_; }
  double rate() const noexcept { return rate_; }
  /// Energy of rotor and spring, J.
  double energy(double q) const noexcept;
  /// What damping and brushes take from the motion in the step that advance() ended, W. @param qd_new of the joint.
  double taken_w(double qd_new) const noexcept { return loss(qd_new) + rub_.at(rate_) * rate_; }
  /// Heat that the damping makes, W.
  double loss(double qd) const noexcept { return p_.damping * (rate_ - qd) * (rate_ - qd); }

 private:
  /// Shoulder angles are known within a turn, the rotor's beyond: no cable stretches by half a turn.
  double stretch(double q) const noexcept;

  CableParameters p_;
  double inertia_;
  PlantFriction brushes_;
  ResistanceLine rub_;  ///< of the brushes in the prepared step
  double angle_ = 0, rate_ = 0;
  double push_ = 0, mass_ = 1, coupling_ = 0;  ///< of the prepared step: rate_new = (push + coupling qd_new) / mass
};

/// The part of a joint's friction that stays with the joint when its cable is elastic; all of it when rigid.
FrictionParameters friction_behind_cable(const FrictionParameters& whole, const CableParameters& cable);

}  // namespace trocar
