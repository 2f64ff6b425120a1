// Where things land in the picture: camera pose, field of view, the round field and the lens's barrel distortion.
//
// Frame T, m; pixels of the final image, x right, y down. The circle's rim lies at half the diagonal field of view.
// Barrel (normalised to the rim): r_source = r_image * (1 + k r_image^2) / (1 + k), k = kBarrel. Thread: plain value.
#pragma once

#include <optional>

#include "app/picture/scene/scene_view.h"

namespace trocar {

struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;  ///< px, top left corner first
};

class ScopeOptics {
 public:
  static constexpr double kBarrel = 0.11;

  /// @param window part of the image that the scope's picture fills.
  ScopeOptics(const Camera& camera, const PixelRect& window);

  const Vec3& eye() const { return eye_; }
  Vec3 forward() const { return R_TC_.col(2); }
  Vec3 right() const { return R_TC_.col(0); }
  Vec3 up() const { return -R_TC_.col(1); }
  /// End of the light guide beside the lens.
  Vec3 lamp() const;
  double circle_radius() const { return radius_; }  ///< px
  double circle_x() const { return centre_x_; }     ///< px of the image
  double circle_y() const { return centre_y_; }

  /// Clip-space matrix of the undistorted picture over the window.
  Eigen::Matrix4f view_projection() const;
  /// Clip-space matrix of the lamp's shadow map, looking where the scope looks.
  Eigen::Matrix4f lamp_projection() const;

  /// Pixel of a point; empty when it lies behind the lens or outside the circle.
  std::optional<Eigen::Vector2d> project(const Vec3& point_T) const;

 private:
  PixelRect window_;
  Vec3 eye_;
  Mat3 R_TC_;  // camera axes in T: x right, y down, z forward
  double radius_ = 0, centre_x_ = 0, centre_y_ = 0, tan_half_ = 0;
};

}  // namespace trocar
