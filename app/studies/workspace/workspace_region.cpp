#include "app/studies/workspace/workspace_region.h"

#include <algorithm>
#include <cmath>

#include "app/studies/workspace/workspace_quality.h"
#include "haptics/device/plant/plant_random.h"
#include "haptics/kinematics/link_clearance.h"
#include "haptics/kinematics/spherical_parallel.h"

namespace trocar {
namespace {

constexpr double kLeastDetA = 0.05;  // under this the loop faults
constexpr int kReferenceSamples = 4000;

}  // namespace

RegionPercentiles::Three quantiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  const auto at = [&](double share) { return values[static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * (n - 1))]; };
  RegionPercentiles::Three out;
  constexpr std::array kShares{0.05, 0.50, 0.95};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double p = kShares[i], spread = 2 * std::sqrt(p * (1 - p) * (1.0 / kReferenceSamples + 1 / n));
    out[i] = {at(p), at(p - spread), at(p + spread)};
  }
  return out;
}

SweptExtent sweep_extent(int steps) {
  SweptExtent out;
  const auto angle = [&](int axis, int n) {
    const JointRange& range = kJointRange[static_cast<std::size_t>(axis)];
    return range.low + (range.high - range.low) * n / steps;
  };
  constexpr int kElbowSteps = 12;
  for (int n = 0; n < (steps + 1) * (steps + 1) * (steps + 1); ++n) {
    const Vec3 theta(angle(0, n % (steps + 1)), angle(1, n / (steps + 1) % (steps + 1)),
                     angle(2, n / ((steps + 1) * (steps + 1))));
    if (theta.array().sin().prod() + theta.array().cos().prod() < 1e-9) continue;
    const LinkClearance room = link_clearance(theta, spherical_parallel(theta).R_WP);
    for (int e = 0; e <= kElbowSteps; ++e) {
      JointVector q = JointVector::Zero();
      q << theta, kJointRange[3].low * e / kElbowSteps, 0, 0;
      const Vec3 p = arm_state(q).X_WS.p;
      out.limits.extend(p);
      if (room.ring_m + kLinkHalfWidth + kLegHalfWidth >= 0) out.ring.extend(p);
      if (room.clear()) out.clear.extend(p);
    }
  }
  return out;
}

RegionPercentiles region_percentiles(int samples, std::uint64_t seed) {
  const DeviceModel model;
  PlantRandom random(seed);
  std::vector<double> step, force28, force100, gravity, left;
  while (static_cast<int>(step.size()) < samples) {
    JointVector q;
    for (int i = 0; i < kArmJoints; ++i) {
      const JointRange& range = kJointRange[static_cast<std::size_t>(i)];
      q[i] = range.low + random.unit() * (range.high - range.low);
    }
    const ArmState arm = arm_state(q);
    const Vec3& p = arm.X_WS.p;
    const bool there = std::abs(p.x()) <= 0.13 && p.y() >= -0.18 && p.y() <= 0.06 && p.z() >= -0.274 && p.z() <= -0.12;
    if (arm.det_a < kLeastDetA || !there) continue;
    const PostureQuality quality = posture_quality(model, q);
    step.push_back(quality.step_m);
    force28.push_back(quality.force_before_n);
    force100.push_back(worst_direction_force(model, arm, JointVector::Zero(), kPeakMotor_nm));
    gravity.push_back(quality.gravity_motor_nm);
    left.push_back(quality.continuous_n);
  }
  RegionPercentiles out{quantiles(step),    quantiles(force28), quantiles(force100),
                        quantiles(gravity), quantiles(left),    0};
  out.over_rating = static_cast<double>(std::count_if(gravity.begin(), gravity.end(),
                                                      [](double g) { return g > kContinuousMotor_nm; })) /
                    samples;
  return out;
}

}  // namespace trocar
