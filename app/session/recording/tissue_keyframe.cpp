#include "app/session/recording/tissue_keyframe.h"

#include <algorithm>
#include <tuple>

namespace trocar {

InstrumentDetail detail_of(const TickRecord& record) {
  const StylusState& stylus = record.stylus;
  return {.R_TI = stylus.X_TI.R,
          .contact = stylus.contact,
          .tip_contact = stylus.tip_contact,
          .clutched = stylus.clutched,
          .port_held = stylus.port_held,
          .armed = record.amplifiers_armed,
          .fault = stylus.fault,
          .contact_point_T = stylus.contact_point_T,
          .contact_normal_T = stylus.contact_normal_T,
          .depth_m = stylus.depth_m,
          .depth_in_port_m = stylus.depth_in_port_m,
          .winding_c = record.winding_c,
          .rendered_grip_n = stylus.rendered_grip_n};
}

namespace {

constexpr double kJump_m = 0.02;  // a block that is carried does not move as far from one keyframe to the next

bool runs_on(const Demand& a, const Demand& b) {
  return a.normal_T == b.normal_T && a.radius_m == b.radius_m && a.R_TI == b.R_TI &&
         a.angle_tolerance_rad == b.angle_tolerance_rad && a.band == b.band && a.goal_T == b.goal_T &&
         (a.centre_T - b.centre_T).norm() < kJump_m;
}

}  // namespace

bool runs_on(const DirectorStatus& a, const DirectorStatus& b) {
  const auto steps = [](const DirectorStatus& s) {
    return std::tie(s.phase, s.cue, s.force_shown, s.target_index, s.targets_done, s.wrong_places, s.excess_forces,
                    s.timeouts, s.warning, s.shown_symbol, s.mark_count, s.demand.oriented, s.demand.object.slipping,
                    s.demand.foam_count);
  };
  return steps(a) == steps(b) && a.done == b.done && a.message == b.message && a.hint == b.hint &&
         runs_on(a.demand, b.demand);
}

bool runs_on(const TissueFrame& a, const TissueFrame& b) {
  const auto steps = [](const TissueFrame& f) {
    return std::tie(f.object_count, f.grip, f.grip_object, f.mark_count, f.clip_count);
  };
  return steps(a) == steps(b) &&
         std::equal(a.object.begin(), a.object.begin() + a.object_count, b.object.begin(),
                    [](const ObjectState& x, const ObjectState& y) { return x.crushed == y.crushed; });
}

}  // namespace trocar
