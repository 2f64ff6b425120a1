#include "haptics/mapping/instrument_map.h"

namespace trocar {

Pose InstrumentMap::mapped_stylus(const Pose& X_WS) const {
  return {X_TW.R * X_WS.R, X_TW.R * (motion_scale * X_WS.p) + X_TW.p + registration.shift_T};
}

Pose InstrumentMap::instrument_pose(const Pose& X_WS) const {
  const Pose X_TS = mapped_stylus(X_WS);
  const Pose X_TI = fulcrum ? fulcrum->instrument_pose(X_TS) : X_TS * X_SI;
  return {X_TI.R * registration.turn, X_TI.p};
}

Twist InstrumentMap::instrument_twist(const Pose& X_WS, const Twist& V_WS) const {
  const Twist V_TS{X_TW.R * (motion_scale * V_WS.linear), X_TW.R * V_WS.angular};
  if (fulcrum) return fulcrum->instrument_twist(mapped_stylus(X_WS), V_TS);
  const Vec3 lever = X_TW.R * (X_WS.R * X_SI.p);
  return {V_TS.linear + V_TS.angular.cross(lever), V_TS.angular};
}

Wrench InstrumentMap::stylus_wrench(const Pose& X_WS, const Wrench& F_I_T) const {
  Wrench F_S_T;
  if (fulcrum) {
    F_S_T = fulcrum->handle_wrench(mapped_stylus(X_WS), F_I_T);
  } else {
    const Vec3 lever = X_TW.R * (X_WS.R * X_SI.p);
    F_S_T = {F_I_T.force, F_I_T.moment + lever.cross(F_I_T.force)};
  }
  return {X_TW.R.transpose() * F_S_T.force * (force_scale * motion_scale),
          X_TW.R.transpose() * F_S_T.moment * force_scale};
}

Pose InstrumentMap::stylus_pose(const Pose& X_TI) const {
  const Pose without_turn{X_TI.R * registration.turn.transpose(), X_TI.p};
  const Pose X_TS = fulcrum ? fulcrum->mapped_stylus(without_turn) : without_turn * X_SI.inverse();
  return {X_TW.R.transpose() * X_TS.R, X_TW.R.transpose() * (X_TS.p - registration.shift_T - X_TW.p) / motion_scale};
}

Registration InstrumentMap::registration_keeping(const Pose& X_TI, const Pose& X_WS) const {
  InstrumentMap bare = *this;
  bare.registration = {};
  const Pose X_TS = bare.mapped_stylus(X_WS);
  const Vec3 shaft = (X_TI.R * registration.turn.transpose()).col(2);
  const Vec3 handle_T = X_TI.p - (fulcrum ? Vec3(fulcrum->length_m * shaft) : Vec3(X_TS.R * X_SI.p));
  bare.registration.shift_T = handle_T - X_TS.p;
  return {bare.registration.shift_T, bare.instrument_pose(X_WS).R.transpose() * X_TI.R};
}

InstrumentMap mirrored(const InstrumentMap& map) {
  const Mat3 M = Vec3(-1, 1, 1).asDiagonal();
  const auto rotation = [&](const Mat3& R) { return Mat3(M * R * M); };
  const auto pose = [&](const Pose& X) { return Pose{rotation(X.R), M * X.p}; };
  InstrumentMap out = map;
  out.X_TW = pose(map.X_TW);
  out.X_SI = pose(map.X_SI);
  out.registration = {M * map.registration.shift_T, rotation(map.registration.turn)};
  if (out.fulcrum) {
    out.fulcrum->port_T = M * map.fulcrum->port_T;
    out.fulcrum->R_TS_reference = rotation(map.fulcrum->R_TS_reference);
    out.fulcrum->R_TI_reference = rotation(map.fulcrum->R_TI_reference);
  }
  return out;
}

}  // namespace trocar
