// Budget: a step of an organ that gives way in 6 ms at 10 mm cells and 7 ms at 8 mm, linear in the nodes, and 1.3 times
// as much after 200 cuts. Solid, clamped neighbourhood, surface and patch; CPU time of a step, no blood.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <numbers>

#include "app/cli/machine/bench_tissue.h"

namespace {

using namespace trocar;

void press(benchmark::State& state, double edge_m, int cuts) {
  PressedBench pressed(edge_m);
  const int made = scatter_cuts(pressed.bench(), cuts);
  int iterations = 0;
  for (auto step : state) {
    state.SetIterationTime(1e-6 * pressed.step());
    iterations += pressed.bench().organ().solid().iterations();
  }
  const SoftOrgan& organ = pressed.bench().organ();
  state.counters["nodes"] = static_cast<double>(organ.solid().node_count());
  state.counters["triangles"] = static_cast<double>(organ.surface()->triangles.size());
  state.counters["cuts"] = made;
  state.counters["solver"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
#define TROCAR_PRESS(name, edge_m, cuts) \
  BENCHMARK_CAPTURE(press, name, edge_m, cuts)->UseManualTime()->Iterations(250)->Unit(benchmark::kMillisecond)
TROCAR_PRESS(nodes_1k, 0.0140, 0);
TROCAR_PRESS(nodes_1k_cut, 0.0140, 200);
TROCAR_PRESS(nodes_2k, 0.0100, 0);
TROCAR_PRESS(nodes_2k_cut, 0.0100, 200);
TROCAR_PRESS(nodes_5k, 0.0074, 0);
TROCAR_PRESS(nodes_5k_cut, 0.0074, 200);
TROCAR_PRESS(nodes_20k, 0.00435, 0);
TROCAR_PRESS(nodes_20k_cut, 0.00435, 200);

/// The solid alone on the bench's organ: one spring presses it.
void solid(benchmark::State& state, double edge_m) {
  const PressedBench pressed(edge_m);
  const TriangleSurface surface = *pressed.bench().organ().rest();
  const Lattice lattice = build_lattice(surface, {.cell_m = edge_m}).lattice;
  std::vector<Vec3> nodes;
  std::map<std::pair<int, int>, std::size_t> lowest;  // by column
  for (std::size_t n = 0; n < lattice.nodes.size(); ++n) {
    nodes.push_back(lattice.node_m(n));
    const auto [column, first] = lowest.emplace(std::pair(lattice.nodes[n][0], lattice.nodes[n][1]), n);
    if (nodes[n].z() < nodes[column->second].z()) column->second = n;
  }
  std::vector<SoftCell> cells;
  for (const LatticeCell& cell : lattice.cells) cells.push_back({cell.corners, cell.fill, 0});
  const TissueSolid material = pressed.bench().organ().material();
  SoftSolidOptions options;
  options.edge_m = edge_m;
  SoftSolid body(nodes, cells, std::span(&material, 1), options);
  for (const auto& [column, node] : lowest)
    body.hold(static_cast<std::int32_t>(node), SoftOrganOptions{}.bed_n_per_m3 * edge_m * edge_m);
  SoftSpring tool{.place = pressed.bench().organ().shares_of(
                      pressed.bench().organ().nearest_place(pressed.bench().touching(0.013, 0.007))),
                  .stiffness_n_per_m = 150,
                  .pushes_only = true};
  int steps = 0, iterations = 0;
  for (auto step : state) {
    double height = 0;
    for (std::size_t i = 0; i < tool.place.node.size(); ++i) {
      const auto n = static_cast<std::size_t>(tool.place.node[i]);
      height += static_cast<double>(tool.place.share[i] * (body.position()[n] - body.rest()[n]).z());
    }
    tool.stretch_m = height + 0.005 + 0.004 * std::sin(0.04 * std::numbers::pi * steps++);
    body.step({&tool, 1});
    iterations += body.iterations();
  }
  state.counters["nodes"] = static_cast<double>(body.node_count());
  state.counters["solver"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
#define TROCAR_SOLID(name, edge_m) \
  BENCHMARK_CAPTURE(solid, name, edge_m)->Iterations(250)->Unit(benchmark::kMillisecond)
TROCAR_SOLID(nodes_1k, 0.0140);
TROCAR_SOLID(nodes_2k, 0.0100);
TROCAR_SOLID(nodes_5k, 0.0074);
TROCAR_SOLID(nodes_20k, 0.00435);

}  // namespace

BENCHMARK_MAIN();
