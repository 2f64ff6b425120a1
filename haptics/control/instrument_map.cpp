#include "haptics/control/instrument_map.h"

namespace trocar {

Pose InstrumentMap::instrument_pose(const Pose& X_WS) const {
  const Pose X_TS{X_TW.R * X_WS.R, X_TW.R * (motion_scale * X_WS.p) + X_TW.p};
  return X_TS * X_SI;
}

Twist InstrumentMap::instrument_twist(const Pose& X_WS, const Twist& V_WS) const {
  const Vec3 omega = X_TW.R * V_WS.angular;
  const Vec3 lever = X_TW.R * (X_WS.R * X_SI.p);
  return {X_TW.R * (motion_scale * V_WS.linear) + omega.cross(lever), omega};
}

Wrench InstrumentMap::stylus_wrench(const Pose& X_WS, const Wrench& F_I_T) const {
  const Vec3 lever = X_TW.R * (X_WS.R * X_SI.p);
  const Vec3 moment_T = F_I_T.moment + lever.cross(F_I_T.force);
  return {X_TW.R.transpose() * F_I_T.force * (force_scale * motion_scale), X_TW.R.transpose() * moment_T * force_scale};
}

Pose InstrumentMap::stylus_pose(const Pose& X_TI) const {
  const Pose X_TS = X_TI * X_SI.inverse();
  return {X_TW.R.transpose() * X_TS.R, X_TW.R.transpose() * (X_TS.p - X_TW.p) / motion_scale};
}

}  // namespace trocar
