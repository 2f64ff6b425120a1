#include "app/picture/scene/scope_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kUpright = 1e-3;  // of "up" across the line of sight, below which level means nothing

Mat3 turn(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

/// Shaft at rest in T: z forward along +y, y down along -z.
Mat3 resting_shaft() {
  Mat3 R;
  R.col(0) = Vec3::UnitX();
  R.col(1) = -Vec3::UnitZ();
  R.col(2) = Vec3::UnitY();
  return R;
}

Mat3 shaft_axes(const ScopePose& pose) {
  return resting_shaft() * turn(pose.yaw_rad, Vec3::UnitY()) * turn(pose.pitch_rad, Vec3::UnitX());
}

Mat3 camera_axes(const ScopePose& pose) {
  return shaft_axes(pose) * turn(pose.post_rad, Vec3::UnitZ()) * turn(-pose.tilt_rad, Vec3::UnitX()) *
         turn(pose.head_rad, Vec3::UnitZ());
}

/// Where T's up lies in the picture, clockwise from 12 o'clock.
std::optional<double> up_angle(const Mat3& R_TC) {
  const double right = R_TC(2, 0), up = -R_TC(2, 1);
  if (std::hypot(right, up) < kUpright) return std::nullopt;
  return std::atan2(right, up);
}

}  // namespace

Camera scope_camera(const ScopePose& pose) {
  const Mat3 R_TC = camera_axes(pose);
  Camera camera;
  camera.eye_T = pose.port_T + pose.depth_m * shaft_axes(pose).col(2);
  camera.look_at_T = camera.eye_T + pose.focus_m * R_TC.col(2);
  camera.up_T = -R_TC.col(1);
  camera.diagonal_fov_deg = pose.diagonal_fov_deg;
  camera.notch_rad = -pose.head_rad;
  camera.level_rad = up_angle(R_TC);
  return camera;
}

double level_head_rad(const ScopePose& pose) {
  // Turning the head by an angle moves "up" in the picture back by as much.
  const auto off = up_angle(camera_axes(pose));
  return off ? std::remainder(pose.head_rad + *off, 2 * std::numbers::pi) : pose.head_rad;
}

ScopePose scope_behind(const Camera& camera, double tilt_rad, double depth_m) {
  ScopePose pose;
  pose.tilt_rad = tilt_rad;
  pose.depth_m = depth_m;
  pose.focus_m = (camera.look_at_T - camera.eye_T).norm();
  pose.diagonal_fov_deg = camera.diagonal_fov_deg;
  const Vec3 forward = (camera.look_at_T - camera.eye_T).normalized();
  pose.yaw_rad = std::atan2(forward.x(), forward.y());
  // A tilted tip looks below its shaft: the shaft stands higher by the tilt.
  pose.pitch_rad = std::asin(std::clamp(forward.z(), -1.0, 1.0)) + tilt_rad;
  const Mat3 level = camera_axes(pose);
  Vec3 right = forward.cross(camera.up_T);
  if (right.norm() > kUpright) {
    right.normalize();
    pose.head_rad = std::atan2(right.dot(level.col(1)), right.dot(level.col(0)));
  }
  pose.port_T = camera.eye_T - depth_m * shaft_axes(pose).col(2);
  return pose;
}

}  // namespace trocar
