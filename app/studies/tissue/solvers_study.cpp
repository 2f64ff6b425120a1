#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "app/studies/tissue/soft_studies.h"
#include "app/studies/tissue/solver_runs.h"

namespace trocar {
namespace {

constexpr std::array kBudgets{2.0, 5.0, 10.0};  // ms of a step
constexpr double kTooLong = 15;                 // ms: a solver that takes more is not made slower
constexpr std::array kSolverNames{"ours, cubes", "corotational linear tetrahedra", "XPBD, linear tetrahedra"};
constexpr std::array kMeshNames{"cubes", "of the cubes", "fitted"};

struct NamedScene {
  StiffPart stiff;
  const char *file, *name;
};
constexpr std::array kScenes{NamedScene{StiffPart::kNone, "uniform", "5 kPa throughout"},
                             NamedScene{StiffPart::kNodule, "nodule", "nodule of 30 mm, 50 times as stiff"},
                             NamedScene{StiffPart::kLayer, "layer", "layer of 10 mm, 100 times as stiff"}};

/// What is tried of each solver.
struct SolverGrid {
  std::vector<double> cubes, lattice, fitted;  ///< cells, m
  std::vector<int> substeps;
};
SolverGrid grid_of(bool quick) {
  if (quick) return {{0.0125, 0.010}, {0.0125, 0.010}, {0.0125}, {5, 20}};
  return {{0.0125, 0.010, 0.008, 0.0065, 0.005},
          {0.0125, 0.010, 0.008, 0.0065, 0.005},
          {0.016, 0.0125, 0.010, 0.008},
          {5, 10, 20, 50}};
}

std::vector<SolverRun> all_runs(const SolverScene& scene, const SolverGrid& grid) {
  std::vector<SolverRun> runs;
  for (const double cell : grid.cubes) runs.push_back(run_ours(scene, cell));
  const auto add = [&](const PeerMesh& mesh, SolverMesh from, double cell) {
    runs.push_back(run_peer(scene, mesh, {SolverKind::kCorotational, from, cell}));
    for (const int substeps : grid.substeps) {
      runs.push_back(run_peer(scene, mesh, {SolverKind::kXpbd, from, cell, substeps}));
      if (runs.back().step_ms > kTooLong) break;
    }
  };
  for (const double cell : grid.lattice) add(lattice_mesh(scene, cell), SolverMesh::kLattice, cell);
  for (const double cell : grid.fitted) add(fitted_mesh(scene, cell), SolverMesh::kFitted, cell);
  return runs;
}

/// Least error over the surface within so much time; infinite where nothing is as fast.
double best_within(const std::vector<SolverRun>& runs, SolverKind kind, double most_ms) {
  double best = std::numeric_limits<double>::infinity();
  for (const SolverRun& run : runs)
    if (run.choice.kind == kind && run.step_ms <= most_ms) best = std::min(best, run.surface_error);
  return best;
}
/// Least time for no more than that error.
double fastest_to(const std::vector<SolverRun>& runs, SolverKind kind, double error) {
  double best = std::numeric_limits<double>::infinity();
  for (const SolverRun& run : runs)
    if (run.choice.kind == kind && run.surface_error <= error) best = std::min(best, run.step_ms);
  return best;
}

std::string time_in(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", ms);
  return std::isfinite(ms) ? text : "-";
}
std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(share) < 10 ? "%.1f %%" : "%.0f %%", 100 * share);
  return std::isfinite(share) ? text : "-";
}

std::string run_row(const SolverRun& run, double early) {
  const SolverChoice& choice = run.choice;
  const std::string substeps =
      choice.kind == SolverKind::kXpbd ? ", " + std::to_string(choice.substeps) + " substeps" : "";
  char row[300];
  std::snprintf(row, sizeof row, "| %s%s | %s, %.1f mm | %zu | %zu | %.2f | %s | %s | %s | %.1e |\n",
                kSolverNames[static_cast<std::size_t>(choice.kind)], substeps.c_str(),
                kMeshNames[static_cast<std::size_t>(choice.mesh)], choice.cell_m * 1e3, run.nodes, run.elements,
                run.step_ms, percent(run.surface_error).c_str(), percent(run.load_error).c_str(),
                percent(run.early / early - 1).c_str(), run.energy_made);
  return row;
}

void compare_on(const NamedScene& named, const StudyRequest& request, std::string& table, StudyResult& study) {
  SolverSceneOptions options{.stiff = named.stiff};
  if (named.stiff == StiffPart::kLayer) options.reference_m = 0.008;  // the layer itself is meshed more finely
  if (request.quick) options.reference_m = 0.012, options.rows = 40;
  const SolverScene scene = make_scene(options);
  const std::vector<SolverRun> runs = all_runs(scene, grid_of(request.quick));
  const double early = run_ours(scene, request.quick ? 0.0125 : 0.008, 0.001).early;
  table += std::string("\n") + named.name +
           "\n\n| solver | mesh | nodes | elements | ms a step | error over the surface | at the load | of the share "
           "reached at 0.1 s | energy made |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const SolverRun& run : runs) table += run_row(run, early);
  table +=
      "\n| ms a step | ours | tetrahedra | XPBD | tetrahedra as right as ours, ms | XPBD as right as ours, ms |\n"
      "|---|---|---|---|---|---|\n";
  StudyCurves curves{std::string("error_") + named.file,
                     std::string("Least error over the surface in a given time, ") + named.name,
                     "ms a step",
                     "share",
                     {},
                     {}};
  for (const char* name : kSolverNames) curves.series.push_back({name, {}});
  for (const double budget : kBudgets) {
    std::array<double, 3> best{};
    curves.x.push_back(budget);
    for (std::size_t kind = 0; kind < best.size(); ++kind) {
      best[kind] = best_within(runs, static_cast<SolverKind>(kind), budget);
      curves.series[kind].y.push_back(std::isfinite(best[kind]) ? best[kind] : std::nan(""));
    }
    table += "| " + time_in(budget) + " | " + percent(best[0]) + " | " + percent(best[1]) + " | " + percent(best[2]) +
             " | " + time_in(fastest_to(runs, SolverKind::kCorotational, best[0])) + " | " +
             time_in(fastest_to(runs, SolverKind::kXpbd, best[0])) + " |\n";
    study.cases.push_back(
        {std::string(named.name) + ": error within " + std::to_string(std::lround(budget)) + " ms a step",
         "share",
         best[0],
         {},
         "< " + percent(best[1]) + " (tetrahedra) and " + percent(best[2]) + " (XPBD)",
         best[0] < best[1] && best[0] < best[2],
         "Rms of the settled displacement's error over the surface, over that of the displacement; ten-node "
         "tetrahedra are right."});
  }
  study.curves.push_back(curves);
}

void bend_beams(const StudyRequest& request, std::string& table, StudyResult& study) {
  table +=
      "\nCantilever 10 : 1, four cubes across, nu 0.45\n\n"
      "| solver | end, over Timoshenko's beam | ms a step |\n|---|---|---|\n";
  std::array<double, 3> least{9, 9, 9};
  const auto add = [&](const SolverChoice& choice, const std::string& name) {
    const BeamRun run = run_beam(choice);
    const auto kind = static_cast<std::size_t>(choice.kind);
    least[kind] = std::min(least[kind], std::abs(run.over_timoshenko - 1));
    char row[200];
    std::snprintf(row, sizeof row, "| %s | %.3f | %.2f |\n", name.c_str(), run.over_timoshenko, run.step_ms);
    table += row;
  };
  for (const SolverKind kind : {SolverKind::kOurs, SolverKind::kCorotational})
    add({.kind = kind}, kSolverNames[static_cast<std::size_t>(kind)]);
  for (const int substeps : grid_of(request.quick).substeps)
    add({.kind = SolverKind::kXpbd, .substeps = substeps},
        std::string(kSolverNames[2]) + ", " + std::to_string(substeps) + " substeps");
  study.cases.push_back({"cantilever: error against Timoshenko's beam",
                         "share",
                         least[0],
                         {},
                         "< 0.04, " + percent(least[1]) + " (tetrahedra) and " + percent(least[2]) + " (XPBD)",
                         least[0] < 0.04 && least[0] < least[1] && least[0] < least[2],
                         "End of a beam 10 : 1 at rest, four cubes across, nu 0.45."});
}

}  // namespace

StudyResult solvers_study(const StudyRequest& request) {
  StudyResult study{
      "solvers", "none: solvers alone, thread CPU time on this machine, with whatever else it did", {}, {}};
  std::string table = "Ours and its peers on the same organ\n";
  for (const NamedScene& scene : kScenes)
    if (!request.quick || scene.stiff != StiffPart::kLayer) compare_on(scene, request, table, study);
  bend_beams(request, table, study);
  study.files.push_back({"solvers.md", table});
  return study;
}

}  // namespace trocar
