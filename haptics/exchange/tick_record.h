// One haptic tick, complete: what came in, what went out, what was decided. The recorder, the state hash and the bench
// read it. Units as in the fields' types; joint quantities in rad, N m (pinch: m, N).
#pragma once

#include <limits>

#include "haptics/device/data_acquisition.h"
#include "haptics/exchange/loop_warning.h"
#include "haptics/exchange/stylus_state.h"

namespace trocar {

struct TickRecord {
  DaqSample in;
  DacFrame out;
  bool amplifiers_armed = false;
  WarningBits warnings = 0;  ///< LoopWarning bits of this tick
  ChannelVector q = ChannelVector::Zero();
  ChannelVector qd = ChannelVector::Zero();
  ChannelVector torque = ChannelVector::Zero();          ///< total asked of the motors
  ChannelVector contact_torque = ChannelVector::Zero();  ///< of that what was left to the contact; not recorded
  double det_a = 1;
  double winding_c = 25;                                           ///< hottest motor winding by the model
  double contact_scale = 1;                                        ///< < 1: torque budget cut the contact force
  double k_max_n_per_m = std::numeric_limits<double>::infinity();  ///< stiffness that the device can display here
  double stiffness_n_per_m = 0;  ///< that the contact asks for at the stylus, before any clamp; 0: nothing is touched
  double stiffness_share = 1;    ///< of the contact's stiffness that this is; it is cut to it only where so configured
  double stored_j = 0;
  double min_energy_j = 0;        ///< lowest value of the arm's energy observer so far
  std::uint64_t patch_stamp = 0;  ///< of the patch that the tick saw
  StylusState stylus;
};

}  // namespace trocar
