#include "app/session/setup/force_scale.h"

#include <algorithm>
#include <cmath>

#include "app/session/setup/placement.h"
#include "app/session/setup/torque_budget.h"
#include "haptics/control/gravity.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/kinds/kind.h"

namespace trocar {

std::vector<Stop> stops_of(const Exercise& exercise, const Board& board, const Mat3& R_TI_rest) {
  const bool oriented = kind_of(exercise).oriented;
  std::vector<Stop> stops{{{R_TI_rest, board.start_T}, Vec3::UnitZ()}};
  for (const Target& target : board.targets) {
    const Mat3& R = oriented ? target.R_TI : R_TI_rest;
    stops.push_back({{R, target.centre_T}, target.normal_T});
    const Vec3 back = oriented ? Vec3(-R.col(2)) : Vec3::UnitZ();
    stops.push_back({{R, target.centre_T + exercise.retract_height_m * back}, target.normal_T});
  }
  // What is hidden is searched for: it is pressed over each.
  for (const HiddenNodule& nodule : board.nodules) {
    const Vec3 over = nodule.centre_T + nodule.radius_m * Vec3::UnitZ();
    stops.push_back({{R_TI_rest, over}, Vec3::UnitZ()});
  }
  return stops;
}

double auto_force_scale(const InstrumentMap& map, const DeviceModel& device, const Exercise& exercise,
                        const std::vector<Board>& boards) {
  InstrumentMap unscaled = map;
  unscaled.force_scale = 1;
  double kappa = 1;
  if (exercise.soft_force_n > 0)
    kappa = std::min(kappa, renderable_force_n(map, device, exercise.layout) / exercise.soft_force_n);
  const JointVector budget = torque_budget(device);
  const Mat3 R_TI_rest = map.instrument_pose(home_pose()).R;
  for (const Board& board : boards) {
    for (const Stop& stop : stops_of(exercise, board, R_TI_rest)) {
      const Pose X_WS = map.stylus_pose(stop.X_TI);
      const auto q = inverse_within_limits(X_WS, home_angles());
      if (!q) continue;
      const ArmState arm = arm_state(*q);
      const Wrench hard = unscaled.stylus_wrench(X_WS, {exercise.hard_force_n * stop.normal_T, Vec3::Zero()});
      kappa = std::min(kappa, share_beyond_gravity(budget, gravity_torque(device, arm), torque_of(arm, hard)));
    }
  }
  return std::max(0.01, std::floor(100 * kappa + 1e-9) / 100);
}

}  // namespace trocar
