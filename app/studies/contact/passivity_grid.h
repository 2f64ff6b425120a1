// The presses on which passivity laws are compared: drawn hands on drawn arms (drawn_presses.h), five stiffnesses x
// five delays x four grips, the same presses for every law.
//
// The list of a run is part of its result (grid.csv). Rule of stability: stable_beside(). Thread: starts workers
// of its own; the result does not depend on how many.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/studies/contact/drawn_presses.h"

namespace trocar {

struct GridLaw {
  PassivityLaw law;
  bool clamp = false;                         ///< K_max clamp on
  std::optional<ComparisonLaw> instead = {};  ///< of the loop's own
  std::string name() const;
};

inline constexpr double kWithinMotors = 0.5;  ///< share of the time of measuring in which the motors may be saturated

/// One law over all presses.
struct LawTally {
  GridLaw law;
  int stable = 0;            ///< beside the ideal wall
  int stable_alone = 0;      ///< by WallOutcome::stable()
  double displayed = 0;      ///< mean share of the commanded force that was rendered, where the motors could
  double displayed_all = 0;  ///< the same over all presses, of what the motors could
  double held = 0;           ///< mean of held force over the ideal wall's, at most 1, where the motors could
  double least_net_j = 0;    ///< over all presses
  double overclaimed_j = 0;
  double law_step_n = 0;
};

struct GridResult {
  std::vector<DrawnPress> cases;
  std::vector<GridLaw> laws;
  std::vector<std::vector<WallOutcome>> outcome;  ///< [case][law], traces left out
  std::vector<WallOutcome> ideal;                 ///< [case], the continuous wall
  std::vector<LawTally> tally;                    ///< one a law
};

inline constexpr std::size_t kGridPresses = 300;
std::vector<DrawnPress> grid_cases(std::uint64_t seed, std::size_t count, bool nominal);
/// Every law of the loop, those of others, and the default one with the K_max clamp.
std::vector<GridLaw> grid_laws();
/// Runs do(0) .. do(count - 1) on all processors; the first failure is thrown when all have ended.
void on_all_processors(std::size_t count, const std::function<void(std::size_t)>& task);
GridResult run_grid(const std::vector<DrawnPress>& cases, const std::vector<GridLaw>& laws);

/// One row a case and law: everything that was set and everything that came out.
std::string grid_csv(const GridResult& result);
/// GitHub table of the laws.
std::string law_table(const GridResult& result);

/// Lowest share that `of` trials with `hits` hits speak for, 95 % two-sided (Wilson 1927).
double wilson_low(int hits, int of);

}  // namespace trocar
