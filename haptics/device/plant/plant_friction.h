// LuGre friction and end stops of one channel, linearised for an implicit velocity step.
//
//   z' = v - sigma0 |v| z / g(v),  g = f_c (1 + (ratio - 1) exp(-(v/v_s)^2)),  f = sigma0 z + sigma1 z' + sigma2 v
//   sigma0 = f_c / bristle_length, sigma1 = 2 sqrt(sigma0 I) exp(-(v/v_s)^2), sigma2 = viscous
// The Gaussian on sigma1 keeps the bristle damping from exceeding breakaway when sliding starts. Below breakaway the
// bristles hold a load with v = 0 exactly: the device does not creep.
// Units: those of the channel's output. Thread: value type, one owner.
#pragma once

#include "haptics/device/plant/plant_parameters.h"

namespace trocar {

/// Resisting load written as constant + slope * v_new, both to be subtracted from the driving load.
struct ResistanceLine {
  double constant = 0;
  double slope = 0;
  double at(double v_new) const { return constant + slope * v_new; }
};

class PlantFriction {
 public:
  explicit PlantFriction(const FrictionParameters& p);

  /// Implicit resistance over the coming step dt, |v| of the sink term taken at the old speed.
  ResistanceLine linearise(double v_old, double dt) noexcept;
  /// Moves the bristle to the end of the step that linearise() prepared.
  void advance(double v_new, double dt) noexcept;
  void reset() noexcept { z_ = 0; }
  /// Energy in the bristle, J.
  double stored_energy() const noexcept { return 0.5 * sigma0_ * z_ * z_; }

 private:
  FrictionParameters p_;
  double sigma0_, sigma1_;
  double z_ = 0;     ///< bristle deflection
  double sink_ = 1;  ///< 1 + dt sigma0 |v| / g of the prepared step
};

/// One-sided stop: pushes back when outside [lower, upper], never pulls.
ResistanceLine stop_resistance(const StopParameters& stop, double position, double v_old) noexcept;

}  // namespace trocar
