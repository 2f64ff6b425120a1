#include "app/placement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/control/gravity.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

const Vec3 kRegionCentre_W(0, -0.060, -0.215);  // m in W', see the header
constexpr double kShaftIncline = 50 * kDegree;  // of the shaft below the stylus axis
constexpr double kShaftYaw = 45 * kDegree;      // of the shaft to the trainee's left, so that it enters from the right
constexpr double kLowestPercentile = 0.05;

/// Largest force along `direction_W` that all joints can add to gravity, N.
double force_room(const DeviceModel& device, const ArmState& arm, const Vec3& direction_W) {
  const JointVector per_newton = arm.J_WS.topRows<3>().transpose() * direction_W;
  const JointVector gravity = gravity_torque(device, arm);
  double room = 1e9;
  for (int i = 0; i < kArmJoints; ++i) {
    const double load = std::abs(per_newton[i]);
    if (load < 1e-9) continue;
    const double left = max_joint_torque(device.transmission[i]) - std::copysign(1.0, per_newton[i]) * gravity[i];
    room = std::min(room, std::max(0.0, left) / load);
  }
  return room;
}

}  // namespace

InstrumentMap place_theatre(const ExerciseLevel& level) {
  if (level.mapping != Mapping::kDirect) {
    throw InputError("level " + level.name + ": mapping \"fulcrum\" is not available in this version");
  }
  InstrumentMap map;
  map.motion_scale = level.motion_scale;
  map.X_TW.R = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  map.X_TW.p = -(map.X_TW.R * (level.motion_scale * kRegionCentre_W));
  // At home x of the stylus points up and y to the trainee's right.
  map.X_SI.R = (Eigen::AngleAxisd(kShaftYaw, Vec3::UnitX()) * Eigen::AngleAxisd(-kShaftIncline, Vec3::UnitY()))
                   .toRotationMatrix();
  return map;
}

double renderable_force_n(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout) {
  constexpr int kSteps = 9;
  std::vector<double> room;
  const Mat3 R_TI = map.instrument_pose(home_pose()).R;
  const Vec3 up_W = map.X_TW.R.transpose() * Vec3::UnitZ();
  const JointVector home = home_angles();
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      for (const double height : {-layout.relief_m, 0.0, layout.relief_m}) {
        const Vec3 point_T((i / (kSteps - 1.0) - 0.5) * layout.region_x_m, (j / (kSteps - 1.0) - 0.5) * layout.region_y_m,
                           height);
        const auto q = inverse_within_limits(map.stylus_pose({R_TI, point_T}), home);
        room.push_back(q ? force_room(device, arm_state(*q), up_W) : 0);
      }
    }
  }
  const auto rank = room.begin() + static_cast<std::ptrdiff_t>(kLowestPercentile * static_cast<double>(room.size()));
  std::nth_element(room.begin(), rank, room.end());
  return *rank;
}

double force_scale(const ExerciseLevel& level, const InstrumentMap& map, const DeviceModel& device,
                   const TargetLayout& layout, double soft_force_n) {
  if (level.force_scale > 0) return std::min(1.0, level.force_scale);
  return std::min(1.0, renderable_force_n(map, device, layout) / soft_force_n);
}

}  // namespace trocar
