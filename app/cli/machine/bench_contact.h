// What a contact costs by the size of the surface: patch, refit and contact step over generated balls.
#pragma once

#include <string>
#include <vector>

namespace trocar {

/// CPU times of one stage, us.
struct StageTimes {
  std::string stage;
  std::vector<double> us;

  double percentile(double share);
};

/// CPU time of this thread, us: what the budgets are stated in.
double cpu_now_us();

struct ContactCost {
  int triangles = 0;
  int patch = 0;          ///< triangles in the last patch
  double reach_m = 0;     ///< of the last patch
  int contact_ticks = 0;  ///< ticks that felt the surface
  StageTimes step;        ///< every tick of the first run
  StageTimes fresh;       ///< of those, the ticks that saw a new patch
  StageTimes
      least;  ///< every tick, the least of all runs: what the tick itself costs, without what else the machine did
  StageTimes extraction, refit;
  double lists = 0, listed = 0,
         measured = 0;  ///< a tick: lists of near pairs made, pairs on them, pairs measured exactly
};

/// A rough ball of 80 mm (friction 0.3), its tool pressed 3 mm deep and dragged for `ticks` at 30 mm/s, a patch every
/// 10 ticks; shape, path, depth and tool are the same for every size of triangle. The times hold the clock's own.
/// @param triangles roughly; @param runs over the same ticks
ContactCost contact_cost(int triangles, int ticks, int runs = 1);

/// The same fixed arithmetic of about two microseconds again and again: the spread that this machine adds to any time.
StageTimes fixed_work(int times);

}  // namespace trocar
