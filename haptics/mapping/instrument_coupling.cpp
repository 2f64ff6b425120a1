#include "haptics/mapping/instrument_coupling.h"

#include <algorithm>

namespace trocar {

InstrumentCoupling::InstrumentCoupling(const InstrumentMap& map) : map_(map), first_(map.registration) { reset(); }

void InstrumentCoupling::reset() {
  map_.registration = first_;
  clutched_ = held_ = false;
  share_ = 1;
  if (!map_.fulcrum) return;
  // Held from the start, the instrument stands in the port as deep as it may.
  const Fulcrum& f = *map_.fulcrum;
  const Mat3 R_TI = f.R_TI_reference * first_.turn;
  X_TI_ = {R_TI, f.port_T + (f.length_m - Fulcrum::kNearest_m) * f.R_TI_reference.col(2)};
  X_WS_ = map_.stylus_pose(X_TI_);
}

bool InstrumentCoupling::near_port(const Pose& X_WS) const {
  if (!map_.fulcrum) return false;
  const Fulcrum& f = *map_.fulcrum;
  const Vec3 handle_T = map_.mapped_stylus(X_WS).p;
  const bool beyond = (f.port_T - handle_T).dot(X_TI_.R * map_.registration.turn.transpose().col(2)) <= 0;
  return beyond || f.distance_m(handle_T) < Fulcrum::kNearest_m + (held_ ? kHysteresis_m : 0);
}

void InstrumentCoupling::take_up_offset(const Pose& X_WS) {
  map_.registration = map_.registration_keeping(X_TI_, X_WS);
  X_WS_ = X_WS;
}

void InstrumentCoupling::update(const Pose& X_WS, const Twist& V_WS, bool clutch, double dt_s) {
  const bool was_frozen = frozen();
  // Before nearness is judged: where the handle stood by the old registration no longer matters.
  if (clutched_ && !clutch) take_up_offset(X_WS);
  clutched_ = clutch;
  held_ = !clutch && near_port(X_WS);
  const double step = dt_s / kFade_s;
  share_ = std::clamp(share_ + (frozen() ? -step : step), 0.0, 1.0);
  if (frozen()) {
    V_TI_T_ = {};
    return;
  }
  if (was_frozen) take_up_offset(X_WS);
  X_WS_ = X_WS;
  X_TI_ = map_.instrument_pose(X_WS);
  V_TI_T_ = map_.instrument_twist(X_WS, V_WS);
}

}  // namespace trocar
