// Heat of one motor of the plant: what its winding and case really have, which the controller only estimates.
//
//   C_w Tw' = i^2 R(Tw) - (Tw - Tc)/R_wc,   C_c Tc' = (Tw - Tc)/R_wc - (Tc - Ta)/R_ca
//   R(Tw) = R_25 (1 + a (Tw - 25)),   C_w = t_w / R_wc,   C_c = t_c / R_ca
// Heun's method: second order, so a step of 10 ms is as good as one of 50 us. Degrees Celsius, A, ohm, s.
// Thread: value type, one owner.
#pragma once

#include "haptics/device/plant/plant_options.h"

namespace trocar {

class PlantHeat {
 public:
  /// @param resistance of the winding at ambient temperature, ohm.
  PlantHeat(const HeatParameters& parameters, double resistance);

  bool on() const noexcept { return p_.on; }
  void advance(double current, double dt) noexcept;
  double winding_c() const noexcept { return winding_; }
  double case_c() const noexcept { return case_; }
  /// Of the winding as warm as it is, ohm.
  double resistance() const noexcept { return resistance_at(winding_); }

 private:
  struct Rates {
    double winding, housing;  ///< K/s
  };
  Rates rates(double winding, double housing, double current) const noexcept;
  double resistance_at(double winding) const noexcept;

  HeatParameters p_;
  double cold_ohm_;
  double winding_, case_;
};

}  // namespace trocar
