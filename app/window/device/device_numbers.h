// The numbers of the engineering panel (thesis figures 3.11 and 3.12): one tick's record as texts of fixed width.
//
// Angles deg, rates deg/s, torques mN m, lengths mm, forces N, energies mJ; stylus pose in W', tip force in T. A
// number's sign and decimals always take the same columns, so that nothing jumps. Pure. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "haptics/haptic_loop.h"

namespace trocar {

struct DeviceReading {
  double t_s = 0;
  ChannelVector q = ChannelVector::Zero(), qd = ChannelVector::Zero();  ///< rad, m; per s
  ChannelVector asked = ChannelVector::Zero();                          ///< of the motors: N m, N
  ChannelVector delivered = ChannelVector::Zero();                      ///< that the DAC codes of this tick stand for
  Pose X_WS;                                                            ///< forward kinematics, m
  Mat3 R_WP = Mat3::Identity();                                         ///< mobile platform
  Vec3 tip_force_T = Vec3::Zero();                                      ///< of the scene, on the instrument
  Vec3 stylus_force_T = Vec3::Zero();                                   ///< rendered at the stylus
  double grip_n = 0;
  double det_a = 0, winding_c = 0, energy_j = 0, k_max_n_per_m = 0, stiffness_n_per_m = 0;
  LoopState state = LoopState::kOff;
  HomingReport homing;
  std::string loop;  ///< the state in words
  bool saturated = false, passivity_active = false;
};

DeviceReading device_reading(const TickRecord& record, const HapticLoopConfig& loop);

/// "+12.34": sign and decimals always, so that right-aligned its columns stand still; longer than `width` characters:
/// so many '>' signs.
std::string fixed_number(double value, int width, int decimals);

/// Rows of the table of joints: name, angle, rate, torque asked, delivered. The pinch comes last in mm and N.
std::vector<std::vector<std::string>> joint_rows(const DeviceReading& reading);
/// Rows of X_WS (4 x 4, mm) and of R_WP (3 x 3).
std::vector<std::vector<std::string>> stylus_matrix(const DeviceReading& reading);
std::vector<std::vector<std::string>> platform_matrix(const DeviceReading& reading);
/// Rows of forces: name, x, y, z, size.
std::vector<std::vector<std::string>> force_rows(const DeviceReading& reading);

/// Every number with its unit, one a line: "q1,-0.421,deg".
std::string device_csv(const DeviceReading& reading);

}  // namespace trocar
