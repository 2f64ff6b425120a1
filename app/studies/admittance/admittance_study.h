// `trocar study admittance`: the two-port parallel form (thesis 4.20 to 4.24) on a simulated admittance device.
//
// One press of a firm hand with a small virtual mass and delay, law by law; the smallest virtual mass that settles over
// delay; and the laws side by side on 100 drawn presses: five virtual masses x five delays x four grips, each with a
// hand drawn about its grip, wall, wall damping, speed, servo bandwidth and sensor noise drawn by the seed.
#pragma once

#include "app/studies/admittance/admittance_trial.h"
#include "app/studies/study.h"

namespace trocar {

/// @param every 1: all 100, n: every nth of the same draw.
std::vector<AdmittanceCase> admittance_cases(std::uint64_t seed, int every);

struct AdmittanceTally {
  ParallelLaw law{};
  int stable = 0, faulted = 0, rescued = 0, broken = 0;  ///< rescued, broken: against the law off
  double least_j = 0, observer_gap_j = 0;
  double mass_ratio = 0, drag = 0, stiffness_ratio = 0, active = 0;  ///< means where off is stable; ratios to off's
};

struct AdmittanceGrid {
  std::vector<AdmittanceCase> cases;
  std::vector<std::vector<AdmittanceOutcome>> outcome;  ///< [case][law of kParallelLaws], without traces
  std::vector<AdmittanceTally> tally;
};

AdmittanceGrid run_admittance_grid(const std::vector<AdmittanceCase>& cases);

StudyResult admittance_study(const StudyRequest& request);

}  // namespace trocar
