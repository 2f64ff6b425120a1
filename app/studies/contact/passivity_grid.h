// The grid on which passivity laws are compared: 100 presses into a wall on the 6-DOF plant.
//
// Five stiffnesses x five delays x four grips, each with a pose, a direction and a speed of touch drawn by the seed;
// the same cases for every law. The list of a run is part of its result (grid.csv). Rule of stability:
// WallOutcome::stable(). After the one-axis grid of 100 of the haptics notes 3.4, carried to six axes. Thread: starts
// workers of its own; the result does not depend on how many.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "app/device_bench/wall_trial.h"

namespace trocar {

struct GridLaw {
  PassivityLaw law;
  bool clamp;  ///< K_max clamp on
  std::string name() const { return std::string(passivity_law_name(law)) + (clamp ? " + clamp" : ""); }
};

/// One law over all cases.
struct LawTally {
  GridLaw law;
  int stable = 0;
  double displayed = 0;     ///< mean share of the commanded force where "off" without clamp is stable
  double least_true_j = 0;  ///< over all cases
  double observer_gap_j = 0;
  double largest_step_n = 0;
};

struct GridResult {
  std::vector<WallCase> cases;
  std::vector<GridLaw> laws;
  std::vector<std::vector<WallOutcome>> outcome;  ///< [case][law], traces left out
  std::vector<LawTally> tally;                    ///< one a law
};

/// Pose, direction (along or against Y6 or Z6) and speed of a press, drawn until its way is comfortable.
void draw_press(WallCase& c, std::mt19937_64& random);

/// @param every keep every so manieth case; 1: all 100.
std::vector<WallCase> grid_cases(std::uint64_t seed, int every);
/// Every law of kPassivityLaws, without and with the clamp.
std::vector<GridLaw> grid_laws();
/// Runs do(0) .. do(count - 1) on all processors; the first failure is thrown when all have ended.
void on_all_processors(std::size_t count, const std::function<void(std::size_t)>& task);
GridResult run_grid(const std::vector<WallCase>& cases, const std::vector<GridLaw>& laws);

/// One row a case and law: everything that was set and everything that came out.
std::string grid_csv(const GridResult& result);
/// GitHub table of the laws.
std::string law_table(const GridResult& result);

}  // namespace trocar
