// What the tests of the device loop share: a seeded generator, random configurations, small surfaces as patches.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/quantities.h"

namespace trocar::test {

/// Distributions by explicit formula: one seed, one sequence.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double symmetric(double half) { return between(-half, half); }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - unit()));
    return radius * std::cos(2 * std::numbers::pi * unit());
  }
  int below(int bound) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(bound)); }
  Vec3 vector(double half) {
    const double x = symmetric(half), y = symmetric(half);
    return {x, y, symmetric(half)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Mat3 rotation() { return Eigen::AngleAxisd(symmetric(std::numbers::pi), direction()).toRotationMatrix(); }
  Pose pose(double half) {
    const Mat3 R = rotation();
    return {R, vector(half)};
  }

 private:
  std::mt19937_64 engine_;
};

/// Joint angles inside table 2.4, `margin_deg` from its limits, with det A above `least_det`.
inline JointVector random_joints(Random& random, double margin_deg = 2, double least_det = 0.05) {
  for (;;) {
    JointVector q;
    for (int i = 0; i < kArmJoints; ++i) {
      const double margin = i < 5 ? margin_deg * kDegree : 0;
      q[i] = random.between(kJointRange[i].low + margin, kJointRange[i].high - margin);
    }
    const double det =
        std::sin(q[0]) * std::sin(q[1]) * std::sin(q[2]) + std::cos(q[0]) * std::cos(q[1]) * std::cos(q[2]);
    if (det > least_det) return q;
  }
}

inline JointVector degrees(double a, double b, double c, double d, double e, double f) {
  return (JointVector() << a, b, c, d, e, f).finished() * kDegree;
}

/// Angle of the rotation that leads from one orientation to the other, rad.
inline double turn_between(const Mat3& a, const Mat3& b) { return Eigen::AngleAxisd(Mat3(a.transpose() * b)).angle(); }

inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

inline void add_triangle(ContactPatch& patch, const Vec3& a, const Vec3& b, const Vec3& c) {
  trocar::add_triangle(patch, {a, b, c}, patch.count);
  ++patch.stamp;  // new content, new stamp
}

/// Parallelogram origin + u, v, in `cells` x `cells` squares; its normal is u x v.
inline void add_sheet(ContactPatch& patch, const Vec3& origin, const Vec3& u, const Vec3& v, int cells) {
  const auto at = [&](int i, int j) { return Vec3(origin + u * (double(i) / cells) + v * (double(j) / cells)); };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      add_triangle(patch, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add_triangle(patch, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

/// Horizontal square of side 2 `half` at `height`, normal up.
inline void flat_patch(ContactPatch& patch, double height = 0, double half = 0.04, int cells = 6) {
  patch.clear();
  add_sheet(patch, {-half, -half, height}, {2 * half, 0, 0}, {0, 2 * half, 0}, cells);
}

/// Instrument upright, tip down at p: its shaft points up, away from a horizontal surface.
inline Pose tip_down(const Vec3& p) { return {(Mat3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished(), p}; }

}  // namespace trocar::test
