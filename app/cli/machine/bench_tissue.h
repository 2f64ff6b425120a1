// What a step of an organ that gives way costs by the number of its nodes, whole and after many cuts.
#pragma once

#include <vector>

#include "app/cli/machine/bench_contact.h"
#include "app/studies/tissue/soft_bench.h"

namespace trocar {

/// Scattered cuts on the bench's organ, 10 to 20 mm long, 4 to 12 mm deep; the same ones for every size of cell.
/// @param cuts wanted @return made
int scatter_cuts(SoftBench& bench, int cuts);

/// A probe that presses 1 to 9 mm deep at 2 Hz.
class PressedBench {
 public:
  explicit PressedBench(double edge_m);
  /// From one step of the tissue to the next. @return CPU time of the step, us
  double step();
  SoftBench& bench() { return bench_; }
  const SoftBench& bench() const { return bench_; }

 private:
  SoftBench bench_;
  Vec3 touch_;
  int tick_ = 0;
};

struct TissueCost {
  std::size_t nodes = 0, nodes_cut = 0;
  std::size_t triangles = 0, triangles_cut = 0;
  int cuts = 0;
  /// Of 10 ms: solid, clamped neighbourhood, surface, patch; no blood, no heat.
  StageTimes whole, cut;
};

/// @param steps of each, in turns, so that both see the same machine
TissueCost tissue_cost(double edge_m, int cuts, int steps);

}  // namespace trocar
