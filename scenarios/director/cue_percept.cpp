#include "scenarios/director/cue_percept.h"

namespace trocar {

void show_cue(const DirectorStatus& status, Percept& percept) {
  const Demand& demand = status.demand;
  percept.cue = status.cue;
  percept.target_index = status.target_index;
  percept.target_T = demand.centre_T;
  percept.target_normal_T = demand.normal_T;
  percept.target_radius_m = demand.radius_m;
  percept.target_oriented = demand.oriented;
  percept.target_R_TI = demand.R_TI;
  percept.target_angle_rad = demand.angle_tolerance_rad;
  percept.band_low_n = demand.band.low_n;
  percept.band_high_n = demand.band.high_n;
  percept.object = demand.object;
  percept.goal_T = demand.goal_T;
  percept.shown_share = status.exposure;
  percept.asked_instrument = demand.instrument;
  percept.shown_symbol = status.shown_symbol;
  percept.answers_T = demand.answers_T;
  percept.foam = demand.foam;
  percept.foam_count = demand.foam_count;
}

}  // namespace trocar
