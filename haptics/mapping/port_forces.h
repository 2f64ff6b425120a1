// What the port itself does to the instrument: dry friction along the shaft and about it, and a weak spring that leads
// the stylus along the shaft.
//
// Friction: a bristle that slides when its force reaches the limit (axial N, roll N m), scene forces on the instrument,
// so kappa scales them like any other. Alignment: E = k (1 - Z6 . a), a the direction Z6 has when it follows the shaft
// from its reference; moment and handle force are its gradient, so it is conservative. Thread: haptic task; no
// allocation.
#pragma once

#include "haptics/mapping/instrument_map.h"

namespace trocar {

struct PortParameters {
  double axial_friction_n = 0.25;  ///< [from memory: 0.25 to 3 N for trocar seals; the lowest, so that bands stay felt]
  double roll_friction_n_m = 0.6e-3;         ///< axial friction on the radius of a 5 mm shaft [computed]
  double axial_stiffness_n_per_m = 300;      ///< of the seal before it slips [assumed]
  double roll_stiffness_n_m_per_rad = 0.02;  ///< [assumed]
  double alignment_n_m_per_rad = 0;          ///< 0: off, the two swing angles of the stylus stay free
};

class PortForces {
 public:
  explicit PortForces(const PortParameters& parameters) : p_(parameters) {}

  /// Friction on the instrument after the shaft has moved. @param depth_m of the tip beyond the port; @param roll_rad
  /// turned about the shaft since the last call. Wrench in T, moment about the tip; u the shaft's direction.
  Wrench friction(double depth_m, double roll_rad, const Vec3& u);
  void reset() { started_ = false; }
  double stored_j() const;  ///< in the two bristles

  const PortParameters& parameters() const { return p_; }

 private:
  PortParameters p_;
  bool started_ = false;
  double last_depth_m_ = 0, axial_m_ = 0, roll_rad_ = 0;  ///< bristle deflections
};

/// Wrench of the alignment spring at the stylus, in W' (not scaled by kappa: it is no force of the scene).
Wrench alignment_wrench(const InstrumentMap& map, const Pose& X_WS, double stiffness_n_m_per_rad);
double alignment_energy_j(const InstrumentMap& map, const Pose& X_WS, double stiffness_n_m_per_rad);

}  // namespace trocar
