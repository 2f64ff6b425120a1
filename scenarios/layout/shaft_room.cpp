#include "scenarios/layout/shaft_room.h"

#include <algorithm>

#include "haptics/kinematics/device_geometry.h"

namespace trocar {

ShaftRoom::ShaftRoom(const TriangleSurface& felt_T, const ToolShape& tool, const InstrumentMap& map)
    : ShaftRoom(felt_T, tool, map.instrument_pose(home_pose()).R) {
  if (map.fulcrum) through_port_ = map;
}

ShaftRoom::ShaftRoom(const TriangleSurface& felt_T, const ToolShape& tool, const Mat3& R_TI)
    : tree_(felt_T), tool_(tool), R_TI_(R_TI) {}

Vec3 ShaftRoom::touching(const Vec3& point_T, const Vec3& normal_T) const {
  return point_T + (tool_.jaw_length_m > 0 ? tool_.jaw_radius_m : tool_.radius_m) * normal_T;
}

double ShaftRoom::gap_up_to(double farthest_m, const Vec3& tip_T) const {
  Pose X_TI{R_TI_, tip_T};
  if (through_port_) X_TI = through_port_->instrument_pose(through_port_->stylus_pose(X_TI));
  const ToolCapsules capsules = tool_capsules(tool_, 0, {});
  double least = farthest_m;
  for (int c = 0; c < capsules.count; ++c) {
    const Capsule& capsule = capsules.at[static_cast<std::size_t>(c)];
    const double cut = std::max(0.0, kNearTip + capsule.X_IC.p.z());  // what of it lies nearer to the tip
    if (cut >= capsule.length_m) continue;
    const Pose X_TC = X_TI * capsule.X_IC;
    const Vec3 back = -X_TC.R.col(2);
    const QuerySegment axis{X_TC.p + cut * back, X_TC.p + capsule.length_m * back};
    tree_.nearest({&axis, 1}, least + capsule.radius_m, 1, hits_);
    if (!hits_.empty()) least = std::min(least, hits_.front().distance - capsule.radius_m);
  }
  return least;
}

}  // namespace trocar
