#include "haptics/loop_check.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace trocar {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();
constexpr double kEver = std::numeric_limits<double>::infinity();
constexpr double kTiny = std::numeric_limits<double>::min();
constexpr double kColdest_c = -50, kHottest_c = 500;  // what a motor can have at all

/// Collects what is wrong; the first stays.
class Bounds {
 public:
  void operator()(const std::string& field, double value, double least, double most) {
    if (!wrong_.empty() || (value >= least && value <= most)) return;  // false for NaN too
    std::ostringstream text;
    text << field << " is " << value << ": " << least << " to " << most << " is expected";
    wrong_ = text.str();
  }
  template <class Vector>
  void each(const std::string& field, const Vector& values, double least, double most) {
    for (Eigen::Index i = 0; i < values.size(); ++i)
      (*this)(field + '[' + std::to_string(i) + ']', values[i], least, most);
  }
  const std::string& wrong() const { return wrong_; }

 private:
  std::string wrong_;
};

void check_device(Bounds& in, const DeviceModel& device) {
  for (int i = 0; i < kChannels; ++i) {
    const Transmission& t = device.transmission[static_cast<std::size_t>(i)];
    const std::string at = "device.transmission[" + std::to_string(i) + "].";
    in(at + "ratio", t.ratio, kTiny, 100);
    in(at + "counts_per_turn", t.counts_per_turn, 1, 1e8);
    in(at + "torque_constant", t.torque_constant, kTiny, 100);
    in(at + "amps_per_volt", t.amps_per_volt, kTiny, 1000);
    in(at + "full_scale_v", t.full_scale_v, kTiny, 1000);
    in(at + "offset_v", t.offset_v, -t.full_scale_v, t.full_scale_v);
    in(at + "max_motor_torque", t.max_motor_torque, kTiny, 100);
  }
  for (const PlatformWeight& weight : device.platform_weights) {
    in("device.platform_weights.weight_n", weight.weight_n, 0, 100);
    in.each("device.platform_weights.home_W", weight.home_W, -1, 1);
  }
  in("device.stylus_weight_n", device.stylus_weight_n, 0, 100);
  in.each("device.coulomb", device.coulomb, 0, 10);
  in.each("device.viscous", device.viscous, 0, 10);
}

void check_safety(Bounds& in, const SafetyLimits& s) {
  in("safety.selftest_s", s.selftest_s, kTiny, kAny);
  in("safety.selftest_limit_s", s.selftest_limit_s, s.selftest_s, kEver);
  in("safety.homing.beam_s", s.homing.beam_s, 0, kAny);
  in("safety.homing.still_s", s.homing.still_s, 0, kAny);
  in("safety.homing.debounce_s", s.homing.debounce_s, 0, kAny);
  in("safety.arm_s", s.arm_s, 0, kAny);
  in("safety.ramp_s", s.ramp_s, kTiny, kAny);
  in("safety.fade_s", s.fade_s, kTiny, 0.1);
  in("safety.max_encoder_rate", s.max_encoder_rate, kTiny, 1e6);
  in("safety.max_pinch_speed", s.max_pinch_speed, kTiny, 1e6);
  in("safety.max_joint_rate", s.max_joint_rate, kTiny, kEver);
  in("safety.max_tip_speed", s.max_tip_speed, kTiny, kEver);
  in("safety.overspeed_s", s.overspeed_s, 0, kAny);
  in("safety.overspeed_damping", s.overspeed_damping, 0, 1);
  in("safety.fault_det_a", s.fault_det_a, -1, s.warn_det_a);
  in("safety.stuck_torque_share", s.stuck_torque_share, 0, kEver);
  in("safety.stuck_s", s.stuck_s, 0, kEver);
  in("safety.max_missed_share", s.max_missed_share, 0, kEver);
  in("safety.max_patch_age_s", s.max_patch_age_s, kTiny, kEver);
  in("safety.patch_return_s", s.patch_return_s, kTiny, kAny);
}

void check_passivity(Bounds& in, const std::string& at, const PassivityParameters& p) {
  in(at + "viscous_n_s_per_m", p.viscous_n_s_per_m, 0, kAny);
  in(at + "finest_hold_s", p.finest_hold_s, kTiny, 1);
  in(at + "least_stiffness_n_per_m", p.least_stiffness_n_per_m, 0, p.most_stiffness_n_per_m);
  in(at + "most_stiffness_n_per_m", p.most_stiffness_n_per_m, 0, kAny);
  in(at + "effective_mass_kg", p.effective_mass_kg, kTiny, kAny);
  in(at + "loan_j", p.loan_j, 0, kAny);
  in(at + "credit_cap_j", p.credit_cap_j, 0, kAny);
  in(at + "recovery_s", p.recovery_s, kTiny, kAny);
  in(at + "forgiven_w", p.forgiven_w, 0, kAny);
  in(at + "law_n_per_s", p.law_n_per_s, 0, kAny);
  in(at + "fade_debt_j", p.fade_debt_j, 0, p.fault_debt_j);
}

void check_heat(Bounds& in, const MotorHeatParameters& h, const MotorStates& motors) {
  for (const MotorTemperatures& motor : motors) {
    in("motors.winding_c", motor.winding_c, kColdest_c, kHottest_c);
    in("motors.case_c", motor.case_c, kColdest_c, kHottest_c);
  }
  in("heat.resistance_ohm", h.resistance_ohm, 0, kAny);
  in("heat.winding_to_case_k_per_w", h.winding_to_case_k_per_w, kTiny, kAny);
  in("heat.case_to_air_k_per_w", h.case_to_air_k_per_w, kTiny, kAny);
  in("heat.winding_time_s", h.winding_time_s, kTiny, kAny);
  in("heat.case_time_s", h.case_time_s, kTiny, kAny);
  in("heat.copper_per_k", h.copper_per_k, 0, kAny);
  in("heat.warn_c", h.warn_c, h.ambient_c, h.fade_c);
  in("heat.fade_c", h.fade_c, h.warn_c, h.cut_c);
  in("heat.cut_c", h.cut_c, h.fade_c, kEver);
}

}  // namespace

std::string loop_refusal(const HapticLoopConfig& c) {
  Bounds in;
  in("daq.rate_hz", c.daq.rate_hz, 100, 10000);
  in("daq.dac_bits", c.daq.dac_bits, 8, 24);
  check_device(in, c.device);
  check_safety(in, c.safety);
  check_passivity(in, "passivity.", c.passivity);
  check_passivity(in, "pinch_passivity.", c.pinch_passivity);
  check_heat(in, c.heat, c.motors);
  in("map.motion_scale", c.map.motion_scale, kTiny, 1000);
  in("map.force_scale", c.map.force_scale, 0, 1);
  in.each("map.X_TW.p", c.map.X_TW.p, -1000, 1000);
  in.each("map.X_SI.p", c.map.X_SI.p, -1000, 1000);
  in("map.X_TW.R", c.map.X_TW.R.determinant(), 0.999, 1.001);
  in("map.X_SI.R", c.map.X_SI.R.determinant(), 0.999, 1.001);
  in("port.axial_friction_n", c.port.axial_friction_n, 0, kAny);
  in("port.axial_stiffness_n_per_m", c.port.axial_stiffness_n_per_m, 0, kAny);
  in("port.alignment_n_m_per_rad", c.port.alignment_n_m_per_rad, 0, kAny);
  in("friction.share", c.friction.share, 0, kEver);  // never more than what surely is there is taken
  in("friction.knee_rad_s", c.friction.knee_rad_s, kTiny, kAny);
  in("friction.smoothing_s", c.friction.smoothing_s, 0, kAny);
  in("peak.lasting_nm", c.peak.lasting_nm, kTiny, kEver);
  in("peak.continuous_a", c.peak.continuous_a, kTiny, kEver);
  in("pinch_coulomb_n", c.pinch_coulomb_n, 0, kAny);
  in("known_delay_periods", c.known_delay_periods, 0, 63);
  in("torque_rate", c.torque_rate, kTiny, kEver);
  in("pinch_force_rate", c.pinch_force_rate, kTiny, kEver);
  return in.wrong();
}

}  // namespace trocar
