// A duct of 40 mm along x between two anchors, and instruments that come from above.
#pragma once

#include <numbers>
#include <vector>

#include "tissue/thin/elastic_rod.h"

namespace trocar::test {

inline constexpr double kDuctLength = 0.040;

inline ElasticRod hung_duct(const RodOptions& options = {}, const Vec3& from = Vec3::Zero(), std::size_t nodes = 41) {
  std::vector<Vec3> path;
  for (std::size_t i = 0; i < nodes; ++i)
    path.push_back(from + Vec3(kDuctLength * static_cast<double>(i) / static_cast<double>(nodes - 1), 0, 0));
  ElasticRod rod(path, options);
  rod.anchor(RodEnd::kStart, {.position = path.front()});
  rod.anchor(RodEnd::kFinish, {.position = path.back()});
  return rod;
}

/// Tips at a place, shaft from above: z of I down, x of I along x of T, jaws close along y.
inline Pose jaws_from_above(const Vec3& tip, double turn_about_shaft = 0) {
  Pose X;
  X.R.col(0) = Vec3::UnitX();
  X.R.col(1) = -Vec3::UnitY();
  X.R.col(2) = -Vec3::UnitZ();
  X.R = Mat3(X.R * Eigen::AngleAxisd(turn_about_shaft, Vec3::UnitZ()).toRotationMatrix());
  X.p = tip;
  return X;
}

}  // namespace trocar::test
