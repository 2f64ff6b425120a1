#include "app/picture/scene/scope_optics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kNear_m = 0.003, kFar_m = 1.5;
constexpr double kShadowTan = 0.9;  // half field of the shadow map, wider than the picture's

Eigen::Matrix4f clip_matrix(const Mat3& R_TC, const Vec3& eye, double tan_x, double tan_y) {
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();  // OpenGL's eye frame: x right, y up, z back
  view.block<1, 3>(0, 0) = R_TC.col(0).transpose();
  view.block<1, 3>(1, 0) = -R_TC.col(1).transpose();
  view.block<1, 3>(2, 0) = -R_TC.col(2).transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = 1 / tan_x;
  projection(1, 1) = 1 / tan_y;
  projection(2, 2) = -(kFar_m + kNear_m) / (kFar_m - kNear_m);
  projection(2, 3) = -2 * kFar_m * kNear_m / (kFar_m - kNear_m);
  projection(3, 2) = -1;
  return (projection * view).cast<float>();
}

/// Image radius whose source radius is given, both in circle radii: inverse of the barrel by Newton's method.
double distorted(double source) {
  constexpr double k = ScopeOptics::kBarrel;
  double r = source;
  for (int i = 0; i < 20; ++i) r -= (r * (1 + k * r * r) - source * (1 + k)) / (1 + 3 * k * r * r);
  return r;
}

}  // namespace

ScopeOptics::ScopeOptics(const Camera& camera, const PixelRect& window) : window_(window), eye_(camera.eye_T) {
  const Vec3 forward = (camera.look_at_T - camera.eye_T).normalized();
  Vec3 right = forward.cross(camera.up_T);
  if (right.norm() < 1e-6) right = forward.unitOrthogonal();  // looking straight along "up": any horizon will do
  right.normalize();
  R_TC_.col(0) = right;
  R_TC_.col(1) = forward.cross(right);
  R_TC_.col(2) = forward;
  radius_ = std::min(0.64 * window.height, 0.49 * window.width);
  centre_x_ = window.x + 0.5 * window.width;
  centre_y_ = window.y + 0.5 * window.height;
  tan_half_ = std::tan(camera.diagonal_fov_deg * std::numbers::pi / 360);
}

Vec3 ScopeOptics::lamp() const { return eye_ + 0.010 * right() + 0.008 * up(); }

Eigen::Matrix4f ScopeOptics::view_projection() const {
  return clip_matrix(R_TC_, eye_, tan_half_ * 0.5 * window_.width / radius_,
                     tan_half_ * 0.5 * window_.height / radius_);
}

Eigen::Matrix4f ScopeOptics::lamp_projection() const { return clip_matrix(R_TC_, lamp(), kShadowTan, kShadowTan); }

std::optional<Eigen::Vector2d> ScopeOptics::project(const Vec3& point_T) const {
  const Vec3 p_C = R_TC_.transpose() * (point_T - eye_);
  if (p_C.z() < kNear_m) return std::nullopt;
  const Eigen::Vector2d source = Eigen::Vector2d(p_C.x(), p_C.y()) / (p_C.z() * tan_half_);
  const double r = source.norm();
  if (r >= 1) return std::nullopt;
  const double stretch = r > 0 ? distorted(r) / r : 1 + kBarrel;
  return Eigen::Vector2d(centre_x_, centre_y_) + radius_ * stretch * source;
}

}  // namespace trocar
