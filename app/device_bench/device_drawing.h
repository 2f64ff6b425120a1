// The device as a line drawing: base ring, legs and links of one configuration from table 2.3, and axes to read it by.
//
// Dimensions: d1 base ring through the motors' ends, d2 arc from U_i to W_i, d3 arc from W_i to V_i, links l1 and l2
// (haptics/kinematics/link_clearance.h, device_geometry.h). Everything is given in W' (z up, metres) and projected in
// parallel: the view looks from `azimuth` (0: along -y, from the front; turning to the right) and `elevation` above the
// horizontal. Output: SVG groups in user units, one decimal. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "haptics/kinematics/forward_solutions.h"
#include "haptics/quantities.h"

namespace trocar {

/// Parallel projection of W' onto the page.
struct DrawingView {
  double azimuth = 0, elevation = 0;  ///< rad
  double pixels_per_m = 1000;
  double origin_x = 0, origin_y = 0;  ///< page position of O

  /// The view that shows the box from `low` to `high` (m) as large as it fits into a rectangle of the page, with room
  /// for the ticks of its axes.
  static DrawingView fitted(double azimuth, double elevation, const Vec3& low, const Vec3& high,
                            const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
  Eigen::Vector2d project(const Vec3& p) const;
};

/// One polyline of the device in W'.
struct DeviceStroke {
  enum class Part { kBase, kMotor, kProximal, kDistal, kPlatform, kFirstLink, kSecondLink, kStylus };
  Part part;
  std::vector<Vec3> points;
};

/// Lines of the device at q (rad), base first. The stylus is drawn 60 mm along Z6 behind the stylus origin.
std::vector<DeviceStroke> device_strokes(const JointVector& q);
/// The same in another of its forward solutions (forward_solutions.h): how it would hang there.
std::vector<DeviceStroke> device_strokes(const JointVector& q, const ForwardSolution& solution);

/// A <g> with the device in one stroke colour and its three joints. @param width of the links, px; legs are thinner.
std::string device_group(const std::vector<DeviceStroke>& strokes, const DrawingView& view, const std::string& colour,
                         double width);
std::string device_group(const JointVector& q, const DrawingView& view, const std::string& colour, double width);

/// A <g> with a path in W'. @param style SVG attributes of the stroke.
std::string path_group(const std::vector<Vec3>& points, const DrawingView& view, const std::string& style);

/// Box of three axes x', y', z' with ticks in mm from `low` to `high` (m), drawn along its lower and left edges.
std::string axes_group(const Vec3& low, const Vec3& high, double tick_m, const DrawingView& view);

/// A whole <svg> document with a white ground, a title and the pieces given.
std::string drawing_svg(double width, double height, const std::string& title, const std::vector<std::string>& pieces);

}  // namespace trocar
