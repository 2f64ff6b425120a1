// What one haptic tick publishes to the rest of the program: the instrument in the theatre and what it feels.
//
// All positions in the theatre frame T (m), all forces in scene newtons ("virtual", before the force scale kappa)
// unless the name says otherwise. Written by the haptic task only; read through Latest<> or Ring<>.
#pragma once

#include <cstdint>

#include "haptics/exchange/homing_report.h"
#include "haptics/fault.h"
#include "haptics/mapping/instrument_map.h"
#include "haptics/quantities.h"

namespace trocar {

/// States of the device loop (safety chain: docs/device_and_safety.md).
/// The numbers are those of recordings and do not change.
enum class LoopState : std::uint8_t {
  kUnhomed = 0,  ///< torque off, waits for the jig
  kHomed = 1,    ///< torque off, waits for the deadman
  kActive = 2,
  kFault = 3,     ///< latched
  kOff = 4,       ///< before the first sample
  kSelfTest = 5,  ///< torque off
  kArmed = 6,     ///< deadman closed, amplifiers on, codes zero
};

constexpr const char* loop_state_name(LoopState state) {
  switch (state) {
    case LoopState::kUnhomed:
      return "unhomed";
    case LoopState::kHomed:
      return "homed";
    case LoopState::kActive:
      return "active";
    case LoopState::kFault:
      return "fault";
    case LoopState::kOff:
      return "off";
    case LoopState::kSelfTest:
      return "self-test";
    case LoopState::kArmed:
      return "armed";
  }
  return "unknown";
}

struct StylusState {
  std::uint64_t tick = 0;
  std::uint64_t period = 0;  ///< SYNC periods since the loop began, missed ones included
  double t_s = 0;            ///< loop time = period / rate, s
  LoopState loop = LoopState::kOff;
  Fault fault;
  HomingReport homing;

  Pose X_TI;     ///< instrument (tip) in the theatre
  Twist V_TI_T;  ///< its velocity, linear part at the tip, expressed in T
  Wrench F_I_T;  ///< scene wrench ON the instrument, moment about the tip, expressed in T; virtual N
  Vec3 commanded_force_T =
      Vec3::Zero();                      ///< kappa times the conjugate map of F_I_T: at the stylus, device N, axes of T
  Vec3 rendered_force_T = Vec3::Zero();  ///< delivered: what ramp, heat, passivity and torque budget left of it
  double delivered_share = 0;            ///< rendered / commanded; 0 while nothing is commanded

  double jaw_opening_m = 0;    ///< gap between the jaw pads
  double grip_force_n = 0;     ///< virtual force with which the jaws squeeze what is between them, >= 0
  double rendered_grip_n = 0;  ///< grip force delivered to the fingers

  bool contact = false;                   ///< instrument touches the tissue
  bool tip_contact = false;               ///< the touching part is the tip sphere (not the shaft)
  Vec3 contact_point_T = Vec3::Zero();    ///< undeformed surface point under the deepest contact (the proxy's foot)
  Vec3 contact_normal_T = Vec3::UnitZ();  ///< outward unit normal there
  double depth_m = 0;                     ///< indentation, >= 0

  bool clutched = false;        ///< instrument frozen, stylus free
  bool pedal = false;           ///< the instrument in hand is energised, or sucks; never while the loop is not active
  std::int32_t instrument = 0;  ///< in hand: index into the exercise's list
  bool port_held = false;       ///< handle too near to the port: the instrument is held, the trainee must draw back
  double depth_in_port_m = 0;   ///< of the tip beyond the port; 0 with direct mapping
  Registration registration;    ///< what clutching has added so far

  bool saturated = false;         ///< the torque budget cut the contact force this tick
  bool passivity_active = false;  ///< the passivity law changed the force this tick
  double energy_j = 0;            ///< observer: energy absorbed by the loop so far minus returned, J
};

}  // namespace trocar
