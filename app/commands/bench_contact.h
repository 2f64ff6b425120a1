// What a contact costs by the size of the surface: patch, refit and contact step over generated balls.
#pragma once

#include <string>
#include <vector>

namespace trocar {

/// CPU times of one stage, us.
struct Timing {
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
  Timing step, extraction, refit;
};

/// A rough ball of 80 mm (friction 0.3), its tool pressed 3 mm deep and dragged for `ticks` at 30 mm/s, a patch every 10
/// ticks. @param triangles roughly
ContactCost contact_cost(int triangles, int ticks);

}  // namespace trocar
