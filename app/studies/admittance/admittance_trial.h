// One press with the admittance device: the hand reaches for a virtual wall and stays pressed against it.
//
// Virtual environment, once a period T: a mass m, v2 += T / m (f - F_wall), wall F = max(0, k p + b v2), p its depth.
// The controller (haptics/control/parallel_passivity.h) makes v1 of v2; where the device ought to be is the sum of T
// v1. The command takes delay_periods more to reach the drive. Stopped as faulted beyond 2 m/s or 39 N. Settled: last
// time after touch (after the reach where nothing was touched) at which the hand's force differs by 0.1 N or more from
// its centred 50 ms mean. N, m, s, J. Thread: one owner.
#pragma once

#include <vector>

#include "app/studies/admittance/admittance_device.h"
#include "haptics/control/parallel_passivity.h"

namespace trocar {

struct AdmittanceCase {
  double mass_kg = 0.5;  ///< virtual
  double wall_n_per_m = 1000;
  double wall_damping = 0.1;  ///< damping ratio of virtual mass and wall
  int delay_periods = 2;
  double speed_m_s = 0.3;  ///< peak of the hand's minimum-jerk intent
  double servo_hz = 30;
  GripPreset grip = GripPreset::kFirm;
  HandParameters hand = hand_parameters(GripPreset::kFirm);
  std::uint64_t noise_seed = 1;
};

struct AdmittanceTrace {
  std::vector<double> t, position_m, speed_m_s, force_n, given_j, observed_j;
};

struct AdmittanceOutcome {
  bool faulted = false;
  double settled_s = 0;
  double least_j = 0;         ///< lowest true energy that the hand has given since the start
  double observer_gap_j = 0;  ///< largest difference of observed and true energy
  double felt_mass_kg = 0;    ///< least squares of force on acceleration and speed before touch
  double drag_n_s_per_m = 0;  ///< of the same fit
  double shown_n_per_m = 0;   ///< mean force over mean depth of the handle at the end
  double depth_m = 0;         ///< that depth
  double active_share = 0;    ///< of the periods in which the law acted
  AdmittanceTrace trace;
  bool stable() const;
};
inline constexpr double kAdmittanceSettle = 1.0;   ///< s
inline constexpr double kAdmittanceWatched = 2.5;  ///< s after touch

AdmittanceOutcome press(const AdmittanceCase& c, ParallelLaw law);

}  // namespace trocar
