// Configurations that would make the arm push where it should hold: each is refused by its name, none is run.
#include "haptics/loop_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

namespace trocar::loop_check_test {
namespace {

TEST(LoopCheck, TheDefaultsAndWhatStudiesSwitchOffAreLoops) {
  EXPECT_EQ(loop_refusal({}), "");
  HapticLoopConfig config;
  config.friction.share = 0;
  config.passivity.viscous_n_s_per_m = 0;
  config.safety.max_missed_share = std::numeric_limits<double>::infinity();
  config.daq.rate_hz = 4000;
  EXPECT_EQ(loop_refusal(config), "");
}

TEST(LoopCheck, WhatNoLoopCanBeIsNamedAndNotRun) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  using C = HapticLoopConfig;
  const std::pair<const char*, std::function<void(C&)>> wrong[] = {
      {"daq.rate_hz", [](C& c) { c.daq.rate_hz = 0; }},
      {"daq.rate_hz", [](C& c) { c.daq.rate_hz = -1000; }},
      {"daq.rate_hz", [](C& c) { c.daq.rate_hz = kNaN; }},
      {"daq.dac_bits", [](C& c) { c.daq.dac_bits = 0; }},
      {"device.transmission[2].amps_per_volt", [](C& c) { c.device.transmission[2].amps_per_volt *= -1; }},
      {"device.transmission[0].ratio", [](C& c) { c.device.transmission[0].ratio = 0; }},
      {"device.transmission[6].torque_constant", [](C& c) { c.device.transmission[6].torque_constant = kNaN; }},
      {"device.transmission[1].max_motor_torque", [](C& c) { c.device.transmission[1].max_motor_torque = kInf; }},
      {"device.transmission[1].offset_v", [](C& c) { c.device.transmission[1].offset_v = 11; }},
      {"device.transmission[3].counts_per_turn", [](C& c) { c.device.transmission[3].counts_per_turn = 0; }},
      {"device.coulomb[4]", [](C& c) { c.device.coulomb[4] = kNaN; }},
      {"device.viscous[4]", [](C& c) { c.device.viscous[4] = -1; }},
      {"device.platform_weights.home_W[1]", [](C& c) { c.device.platform_weights[0].home_W.y() = kNaN; }},
      {"safety.max_joint_rate", [](C& c) { c.safety.max_joint_rate = kNaN; }},
      {"safety.ramp_s", [](C& c) { c.safety.ramp_s = 0; }},
      {"safety.fade_s", [](C& c) { c.safety.fade_s = kInf; }},
      {"safety.max_encoder_rate", [](C& c) { c.safety.max_encoder_rate = 0; }},
      {"safety.fault_det_a", [](C& c) { c.safety.fault_det_a = kNaN; }},
      {"safety.overspeed_damping", [](C& c) { c.safety.overspeed_damping = -0.01; }},
      {"safety.max_patch_age_s", [](C& c) { c.safety.max_patch_age_s = 0; }},
      {"passivity.effective_mass_kg", [](C& c) { c.passivity.effective_mass_kg = 0; }},
      {"passivity.least_stiffness_n_per_m", [](C& c) { c.passivity.least_stiffness_n_per_m = 900; }},
      {"pinch_passivity.recovery_s", [](C& c) { c.pinch_passivity.recovery_s = kNaN; }},
      {"heat.fade_c", [](C& c) { c.heat.fade_c = 130; }},
      {"heat.winding_time_s", [](C& c) { c.heat.winding_time_s = 0; }},
      {"map.motion_scale", [](C& c) { c.map.motion_scale = -1; }},
      {"map.force_scale", [](C& c) { c.map.force_scale = 5; }},
      {"map.X_SI.R", [](C& c) { c.map.X_SI.R *= -1; }},
      {"map.X_TW.p[0]", [](C& c) { c.map.X_TW.p.x() = kNaN; }},
      {"friction.knee_rad_s", [](C& c) { c.friction.knee_rad_s = 0; }},
      {"known_delay_periods", [](C& c) { c.known_delay_periods = -1; }},
      {"torque_rate", [](C& c) { c.torque_rate = kNaN; }},
      {"peak.lasting_nm", [](C& c) { c.peak.lasting_nm = -1; }}};
  for (const auto& [field, change] : wrong) {
    C config;
    change(config);
    EXPECT_TRUE(loop_refusal(config).starts_with(std::string(field) + " is ")) << field << ": " << loop_refusal(config);
    EXPECT_THROW(HapticLoop{config}, std::invalid_argument) << field;
  }
}

}  // namespace
}  // namespace trocar::loop_check_test
