// Heat of one motor: two-node model, winding and case.
//
// C_w dTw/dt = I^2 R (1 + a (Tw - 25)) - (Tw - Tc)/R_wc; C_c dTc/dt = (Tw - Tc)/R_wc - (Tc - 25)/R_ca.
// Values of the 24 V, 20 W graphite motor; thermal ones from memory [M], hence named here and configurable.
// Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <array>

#include "haptics/quantities.h"

namespace trocar {

/// Of one motor, C; those of one that has stood for long.
struct MotorTemperatures {
  double winding_c = 25, case_c = 25;
  bool operator==(const MotorTemperatures&) const = default;
};
using MotorStates = std::array<MotorTemperatures, kChannels>;

struct MotorHeatParameters {
  double resistance_ohm = 2.32;          ///< [T table 3.1]
  double winding_to_case_k_per_w = 3.1;  ///< [M]
  double case_to_air_k_per_w = 14;       ///< [M]
  double winding_time_s = 12.4;          ///< [M]
  double case_time_s = 612;              ///< [M]
  double copper_per_k = 0.0039;          ///< [M]
  double ambient_c = 25;
  double warn_c = 100, fade_c = 110, cut_c = 120;  ///< winding; limit of the motor is 125 C [M]
};

class MotorHeat {
 public:
  explicit MotorHeat(const MotorHeatParameters& p = {}) : MotorHeat(p, {p.ambient_c, p.ambient_c}) {}
  MotorHeat(const MotorHeatParameters& p, const MotorTemperatures& start)
      : p_(p), winding_(start.winding_c), case_(start.case_c) {}

  void update(double current_a, double dt_s) {
    const double loss = current_a * current_a * p_.resistance_ohm * (1 + p_.copper_per_k * (winding_ - p_.ambient_c));
    const double flow = (winding_ - case_) / p_.winding_to_case_k_per_w;
    winding_ += (loss - flow) * dt_s * p_.winding_to_case_k_per_w / p_.winding_time_s;
    case_ += (flow - (case_ - p_.ambient_c) / p_.case_to_air_k_per_w) * dt_s * p_.case_to_air_k_per_w / p_.case_time_s;
  }
  /// Without current. Allocates nothing, but takes its time: not in the tick.
  void rest(double seconds) {
    const double most_s = std::min(seconds, kForEver * p_.case_time_s), step_s = p_.winding_time_s / kRestSteps;
    for (double s = 0; s < most_s; s += step_s) update(0, std::min(step_s, most_s - s));
  }
  MotorTemperatures temperatures() const { return {winding_, case_}; }
  double winding_c() const { return winding_; }
  /// 1 below the fade temperature, 0 at the cut-off, linear between.
  double share() const {
    if (winding_ <= p_.fade_c) return 1;
    return winding_ >= p_.cut_c ? 0 : (p_.cut_c - winding_) / (p_.cut_c - p_.fade_c);
  }
  bool hot() const { return winding_ >= p_.warn_c; }
  bool cut() const { return winding_ >= p_.cut_c; }

 private:
  static constexpr double kForEver = 20, kRestSteps = 20;
  MotorHeatParameters p_;
  double winding_, case_;
};

}  // namespace trocar
