#include "app/session/setup/placement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/session/setup/torque_budget.h"
#include "haptics/control/gravity.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/least_turn.h"

namespace trocar {
namespace {

const Vec3 kRegionCentre_W(0, -0.060, -0.215);      // m in W', see the header
const Vec3 kHandleCentre_W(0.015, -0.090, -0.195);  // fulcrum: the handle while the tip is at the region's centre
constexpr double kHandlePitch = 20 * kDegree;       // fulcrum: of the stylus above its home direction
constexpr double kShaftIncline = 50 * kDegree;      // of the shaft below the stylus axis
constexpr double kShaftYaw = 45 * kDegree;  // of the shaft to the trainee's left, so that it enters from the right
constexpr double kLowestPercentile = 0.05;

/// Largest scene force that all joints can add to gravity, N. @param per_scene_newton what one newton asks at the
/// stylus.
double force_room(const DeviceModel& device, const ArmState& arm, const Wrench& per_scene_newton) {
  JointVector most;
  for (int i = 0; i < kArmJoints; ++i) most[i] = max_joint_torque(device.transmission[static_cast<std::size_t>(i)]);
  return share_beyond_gravity(most, gravity_torque(device, arm), torque_of(arm, per_scene_newton));
}

/// T is W' turned by half a turn about z: home stylus pointing away from the trainee, towards +y of T.
Mat3 theatre_turn() { return Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix(); }

/// At home x of the stylus points up and y to the trainee's right.
Mat3 shaft_in_stylus() {
  return (Eigen::AngleAxisd(kShaftYaw, Vec3::UnitX()) * Eigen::AngleAxisd(-kShaftIncline, Vec3::UnitY()))
      .toRotationMatrix();
}

/// The jaws open through a port as they do without one: the smallest turn that brings the shaft onto the port's line.
Fulcrum through_port(const ExerciseLevel& level, const InstrumentMap& map) {
  Fulcrum fulcrum;
  fulcrum.port_T = level.port_m;
  fulcrum.length_m = level.instrument_length_m;
  fulcrum.R_TS_reference = Eigen::AngleAxisd(kHandlePitch, Vec3::UnitX()) * (map.X_TW.R * home_pose().R);
  const Mat3 direct = map.X_TW.R * home_pose().R * map.X_SI.R;
  fulcrum.R_TI_reference = least_turn(direct.col(2), -level.port_m).toRotationMatrix() * direct;
  return fulcrum;
}

}  // namespace

InstrumentMap place_theatre(const ExerciseLevel& level) {
  InstrumentMap map;
  map.motion_scale = level.motion_scale;
  map.X_TW.R = theatre_turn();
  map.X_SI.R = shaft_in_stylus();
  Vec3 origin_T = Vec3::Zero(), origin_W = kRegionCentre_W;  // the same point, mapped
  if (level.mapping == Mapping::kFulcrum) {
    map.fulcrum = through_port(level, map);
    origin_T = -level.instrument_length_m * map.fulcrum->R_TI_reference.col(2);
    origin_W = kHandleCentre_W;
  }
  map.X_TW.p = origin_T - map.X_TW.R * (level.motion_scale * origin_W);
  return map;
}

double renderable_force_n(const InstrumentMap& map, const DeviceModel& device, const Vec3& tip_T) {
  InstrumentMap unscaled = map;
  unscaled.force_scale = 1;
  const Pose X_WS = map.stylus_pose({map.instrument_pose(home_pose()).R, tip_T});
  const auto q = inverse_within_limits(X_WS, home_angles());
  return q ? force_room(device, arm_state(*q), unscaled.stylus_wrench(X_WS, {Vec3::UnitZ(), Vec3::Zero()})) : 0;
}

namespace {

/// Room over a grid of the region, at its middle height and at both ends of the relief, N, rising.
std::vector<double> rooms(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout) {
  constexpr int kSteps = 9;
  std::vector<double> room;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      for (const double height : {-layout.relief_m, 0.0, layout.relief_m}) {
        room.push_back(renderable_force_n(map, device,
                                          Vec3((i / (kSteps - 1.0) - 0.5) * layout.region_x_m,
                                               (j / (kSteps - 1.0) - 0.5) * layout.region_y_m, height)));
      }
    }
  }
  std::sort(room.begin(), room.end());
  return room;
}

}  // namespace

double renderable_force_n(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout) {
  const std::vector<double> room = rooms(map, device, layout);
  return room[static_cast<std::size_t>(kLowestPercentile * static_cast<double>(room.size()))];
}

double room_share(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout,
                  double soft_force_n) {
  const std::vector<double> room = rooms(map, device, layout);
  const double asked = map.force_scale * soft_force_n * (1 - 1e-9);  // kappa was made of one of these very numbers
  const auto enough = std::lower_bound(room.begin(), room.end(), asked);
  return static_cast<double>(room.end() - enough) / static_cast<double>(room.size());
}

}  // namespace trocar
