// `trocar study motor`: section 3.4.2 of the thesis measured on the plant's own motor model, and what the command
// drives.
//
// A dynamometer turns the motor model until its speed no longer changes under a load (figures 3.27 to 3.30): the
// amplifier opened wide, so that the supply alone limits the current, is a motor at that terminal voltage. The
// command's path is measured on the simulated device through its DACs, in the jig, with perfect torque cells. Thread:
// any.
#pragma once

#include "app/studies/study.h"

namespace trocar {

/// The motor in steady state.
struct MotorPoint {
  double speed_rad_s = 0, current_a = 0, torque_nm = 0;
};

/// Speed at which a motor at `terminal_v` carries `load_nm`, run from rest; at stall it stands.
MotorPoint loaded_motor(double terminal_v, double load_nm);
/// Torque of a motor whose shaft is turned at a speed; `command_v` through the amplifier on its own supply.
MotorPoint driven_motor(double command_v, double speed_rad_s);
/// The same with `terminal_v` at the motor's leads.
MotorPoint driven_motor_at_leads(double terminal_v, double speed_rad_s);

StudyResult motor_study(const StudyRequest& request);

}  // namespace trocar
