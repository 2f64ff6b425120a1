#include "app/studies/tissue/soft_studies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "app/studies/tissue/reference_block.h"
#include "app/studies/tissue/soft_bench.h"
#include "tissue/interaction/soft_grip.h"

namespace trocar {
namespace {

/// A block of cubes, its bottom held, origin in the middle of its top: that of reference_block.h.
struct CubeBlock {
  std::vector<Vec3> nodes;
  std::vector<SoftCell> cells;
  std::array<int, 3> count{};

  CubeBlock(const Vec3& size_m, double edge_m) {
    for (int axis = 0; axis < 3; ++axis)
      count[static_cast<std::size_t>(axis)] = static_cast<int>(std::lround(size_m[axis] / edge_m));
    const auto [nx, ny, nz] = count;
    const auto at = [nx = nx, ny = ny](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
          nodes.push_back(edge_m * Vec3(i, j, k) - Vec3(size_m.x() / 2, size_m.y() / 2, size_m.z()));
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          SoftCell cell;
          for (int a = 0; a < 8; ++a)
            cell.node[static_cast<std::size_t>(a)] = at(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
          cells.push_back(cell);
        }
  }
  Vec3 middle(const SoftCell& cell) const {
    return (nodes[static_cast<std::size_t>(cell.node[0])] + nodes[static_cast<std::size_t>(cell.node[7])]) / 2;
  }
};

constexpr double kHard = 1e7;  // N/m, of a node of the bottom

/// N/m by work under a tent of pressure about a place of the top.
double tent_stiffness(const CubeBlock& block, double edge_m, std::span<const TissueSolid> materials, double radius_m,
                      double x_m) {
  SoftSolidOptions options;
  options.edge_m = edge_m;
  options.tolerance = 1e-5;
  options.most_iterations = 2000;
  SoftSolid solid(block.nodes, block.cells, materials, options);
  NodeShares place;
  std::vector<double> weight;
  double sum = 0;
  for (std::size_t n = 0; n < block.nodes.size(); ++n) {
    const Vec3& p = block.nodes[n];
    if (p.z() < -1e-9) continue;
    // Share of the tent on the tiles round the node, by a fine grid.
    double share = 0;
    constexpr int kFine = 20;
    for (int i = 0; i < kFine; ++i)
      for (int j = 0; j < kFine; ++j) {
        const double dx = edge_m * ((i + 0.5) / kFine * 2 - 1), dy = edge_m * ((j + 0.5) / kFine * 2 - 1);
        const double r = std::hypot(p.x() + dx - x_m, p.y() + dy);
        share += std::max(0.0, 1 - r / radius_m) * (1 - std::abs(dx) / edge_m) * (1 - std::abs(dy) / edge_m);
      }
    if (share <= 0) continue;
    place.node.push_back(static_cast<std::int32_t>(n));
    weight.push_back(share);
    sum += share;
  }
  for (const double w : weight) place.share.push_back(static_cast<float>(w / sum));
  const double lowest = -block.count[2] * edge_m + 1e-9;
  for (std::size_t n = 0; n < block.nodes.size(); ++n)
    if (block.nodes[n].z() < lowest) solid.hold(static_cast<std::int32_t>(n), kHard);
  constexpr double kForce = 0.02;  // N: a small strain
  for (std::size_t i = 0; i < place.node.size(); ++i)
    solid.load(place.node[i], Vec3(0, 0, -kForce * static_cast<double>(place.share[i])));
  solid.settle({}, 1e-9, 40);
  double down = 0;
  for (std::size_t i = 0; i < place.node.size(); ++i) {
    const auto n = static_cast<std::size_t>(place.node[i]);
    down -= static_cast<double>(place.share[i]) * static_cast<double>((solid.position()[n] - solid.rest()[n]).z());
  }
  return kForce / down;
}

/// Force on the probe this deep, after it has come to rest.
double probe_force(double edge_m, const TissueSolid& material, double depth_m, double aside_m) {
  SoftBenchSetup setup;
  setup.material = material;
  setup.organ.solid.edge_m = edge_m;
  SoftBench bench(setup);
  const Vec3 touch = bench.touching(0.013 + aside_m, 0.007);
  constexpr double kSpeed = 0.013;
  double force = 0;
  for (int tick = 0; tick < 2500; ++tick) {
    const double depth = std::min(depth_m, kSpeed * tick * 1e-3 - 0.002);
    force = bench.tick(touch - Vec3(0, 0, depth), {0, 0, depth < depth_m ? -kSpeed : 0}).z();
  }
  return force;
}

void nodule(const StudyRequest& request, StudyResult& study) {
  // 15 mm, twice as stiff, its middle 10 mm deep; pressed by a fingertip's tent of 10 mm.
  constexpr double kEdge = 0.010, kRadius = 0.0075, kDeep = 0.010;
  CubeBlock plain(Vec3(0.120, 0.120, 0.060), kEdge), with = plain;
  TissueSolid soft, hard;
  hard.young_pa = 2 * soft.young_pa;
  std::vector<TissueSolid> mixes;
  for (int share = 0; share <= 10; ++share) {
    mixes.push_back(soft);
    mixes.back().young_pa = soft.young_pa + (hard.young_pa - soft.young_pa) * share / 10.0;
  }
  for (SoftCell& cell : with.cells) {
    int inside = 0;
    constexpr int kFine = 8;
    for (int s = 0; s < kFine * kFine * kFine; ++s) {
      const Vec3 offset = kEdge * (Vec3(s % kFine, s / kFine % kFine, s / kFine / kFine) / kFine +
                                   Vec3::Constant(0.5 / kFine) - Vec3::Constant(0.5));
      if ((with.middle(cell) + offset + Vec3(0, 0, kDeep)).norm() < kRadius) ++inside;
    }
    cell.material = static_cast<std::int32_t>(std::lround(10.0 * inside / (kFine * kFine * kFine)));
  }
  StudyCurves curves{"nodule",    "A 15 mm nodule, twice as stiff, 10 mm deep",
                     "place, mm", "dF/dx over that without",
                     {},          {{"10 mm cells", {}}}};
  double most = 0;
  const int places = request.quick ? 3 : 9;
  for (int i = 0; i < places; ++i) {
    const double x = 0.040 * i / (places - 1);
    const double ratio = tent_stiffness(with, kEdge, mixes, 0.010, x) / tent_stiffness(plain, kEdge, mixes, 0.010, x);
    curves.x.push_back(x * 1e3);
    curves.series[0].y.push_back(ratio);
    most = std::max(most, ratio - 1);
  }
  study.curves.push_back(curves);
  study.cases.push_back(
      {"nodule: change of dF/dx",
       "share",
       most,
       {},
       "> 0.07 (just noticeable)",
       most > 0.07,
       "15 mm ball twice as stiff, its middle 10 mm below the surface, tent of 10 mm, cells of 10 mm."});
}

}  // namespace

StudyResult indentation_study(const StudyRequest& request) {
  StudyResult study{"indentation", "none: tissue alone, 5 kPa, nu 0.45", {}, {}};
  ReferenceBlock block;
  const ConvergedStiffness reference = converged_stiffness(block, BlockLoad::tent, 0.015);
  StudyCurves tent{"tent", "Tent load of 15 mm on a block of 120 x 120 x 60 mm",   "cell, mm", "N/m",
                   {},     {{"cubes", {}}, {"ten-node tetrahedra, converged", {}}}};
  TissueSolid tissue;
  for (const double edge : {0.010, 0.0075, 0.005}) {
    if (request.quick && edge < 0.010) continue;
    const double stiffness =
        tent_stiffness(CubeBlock(Vec3(0.120, 0.120, 0.060), edge), edge, std::span(&tissue, 1), 0.015, 0);
    tent.x.push_back(edge * 1e3);
    tent.series[0].y.push_back(stiffness);
    tent.series[1].y.push_back(reference.n_per_m);
    if (edge < 0.010) continue;
    const double error = stiffness / reference.n_per_m - 1;
    study.cases.push_back({"tent load at 10 mm cells against the converged block",
                           "share",
                           error,
                           {},
                           "within 0.07",
                           std::abs(error) < 0.07,
                           "Stiffness by work; reference by ten-node tetrahedra, extrapolated."});
  }
  study.curves.push_back(tent);
  StudyCurves cells{"cells", "Probe of 5 mm on an ellipsoid: force over depth", "depth, mm", "N", {}, {}};
  std::vector<double> edges{0.0125, 0.010, 0.008};
  if (request.quick) edges = {0.0125, 0.010};
  double least = 1e9, most = 0;
  for (const double depth : {0.002, 0.004, 0.006, 0.008, 0.010}) cells.x.push_back(depth * 1e3);
  for (const double edge : edges) {
    cells.series.push_back({std::to_string(edge * 1e3).substr(0, 4) + " mm cells", {}});
    for (const double depth : cells.x) cells.series.back().y.push_back(probe_force(edge, tissue, depth * 1e-3, 0));
    least = std::min(least, cells.series.back().y.back());
    most = std::max(most, cells.series.back().y.back());
  }
  study.curves.push_back(cells);
  study.cases.push_back({"spread over cell sizes, 10 mm deep",
                         "share",
                         most / least - 1,
                         {},
                         "< 0.05",
                         most / least - 1 < 0.05,
                         "Probe of 5 mm on an ellipsoid of 200 x 150 x 80 mm, at rest."});
  nodule(request, study);
  return study;
}

StudyResult relaxation_study(const StudyRequest&) {
  StudyResult study{"relaxation", "none: tissue alone, 5 kPa", {}, {}};
  SoftBenchSetup setup;
  setup.material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
  SoftBench bench(setup);
  const Vec3 touch = bench.touching(0.013, 0.007);
  constexpr double kDepth = 0.006, kRise = 0.030;  // m, s
  StudyCurves curves{"relaxation", "A probe held 6 mm deep",
                     "time, s",    "force over that after 10 s",
                     {},           {{"felt", {}}, {"Prony series", {}}}};
  std::vector<double> force;
  for (int tick = 0; tick < 12000; ++tick) {
    const double t = tick * 1e-3 - 1, depth = kDepth * std::clamp(t / kRise, -1.0, 1.0);
    const double f = bench.tick(touch - Vec3(0, 0, depth), Vec3::Zero()).z();
    if (t < 0.1 || tick % 20 != 0) continue;
    curves.x.push_back(t);
    force.push_back(f);
  }
  const auto series = [&](double t) {
    double left = 1;
    for (const PronyBranch& branch : setup.material.prony) left -= branch.share * (1 - std::exp(-t / branch.tau_s));
    return left;
  };
  for (std::size_t i = 0; i < force.size(); ++i) {
    curves.series[0].y.push_back(force[i] / force.back());
    curves.series[1].y.push_back(series(curves.x[i]) / series(curves.x.back()));
  }
  const double left = 1 / curves.series[0].y.front();
  study.curves.push_back(curves);
  study.cases.push_back({"left of the force of 0.1 s after 11 s",
                         "share",
                         left,
                         {},
                         "0.4 to 0.8 (liver, ex vivo, ranges)",
                         left > 0.4 && left < 0.8,
                         "The lattice relaxes, the sub-cell law does not: the probe relaxes less than the bulk."});
  return study;
}

StudyResult grasp_study(const StudyRequest&) {
  StudyResult study{"grasp", "none: jaws at prescribed places, tissue of 5 kPa", {}, {}};
  SoftBenchSetup setup;
  const SurfacePtr rest = still_surface(ellipsoid_surface(Vec3(0.100, 0.075, 0.040), setup.rows));
  LatticeOptions lattice;
  lattice.cell_m = setup.organ.solid.edge_m;
  SoftOrgan organ(build_lattice(*rest, lattice).lattice, rest, setup.material, setup.organ);
  const SoftGripOptions options;
  SoftGrip grip(options);
  StudyCurves curves{
      "pull", "A fold squeezed by 1.2 N, then lifted by 60 mm", "lifted, mm", "N", {}, {{"pull", {}}, {"2 mu N", {}}}};
  const auto step = [&](double z_m, double opening_m) {
    Pose X;
    X.R = Vec3(1, -1, -1).asDiagonal();
    X.p = Vec3(0.002, 0.001, z_m);
    std::vector<SoftSpring> springs;
    grip.reach(X, opening_m, organ, springs);
    organ.step({}, &X.p, springs);
    grip.feel(X, springs, organ);
  };
  const double top = 0.040;
  for (int i = 0; i < 20; ++i) step(top - 0.001, 0.010);
  const double closed = options.fold_m - 1.2 / grip.block().stiffness_n_per_m;
  for (int i = 0; i <= 20; ++i) step(top - 0.001, 0.010 + (closed - 0.010) * i / 20);
  double most = 0, limit = 0;
  int slips = 0;
  for (int i = 0; i < 300; ++i) {
    step(top - 0.001 + 0.060 * i / 300, closed);
    if (grip.state() == GripState::kEmpty) break;
    curves.x.push_back(60.0 * i / 300);
    limit = 2 * options.friction * grip.squeeze_n();
    curves.series[0].y.push_back(grip.pull_T().norm());
    curves.series[1].y.push_back(limit);
    most = std::max(most, grip.pull_T().norm());
    slips += grip.state() == GripState::kSlipping ? 1 : 0;
  }
  grip.let_go();
  for (int i = 0; i < 500; ++i) organ.step({}, nullptr);
  double left = 0;
  for (std::size_t v = 0; v < rest->vertices.size(); ++v)
    left = std::max(left, (organ.surface()->vertices[v] - rest->vertices[v]).norm());
  study.curves.push_back(curves);
  study.cases.push_back({"pull at which it slips over 2 mu N",
                         "1",
                         most / limit,
                         {},
                         "within 0.05 of 1",
                         std::abs(most / limit - 1) < 0.05,
                         "Largest pull of the fold on the jaws."});
  study.cases.push_back({"steps slipping",
                         "1",
                         static_cast<double>(slips),
                         {},
                         "> 0",
                         slips > 0,
                         "Of 10 ms: the fold creeps through the pads before it is lost."});
  study.cases.push_back({"left after letting go",
                         "mm",
                         left * 1e3,
                         {},
                         "< 0.1",
                         left < 1e-4,
                         "Furthest vertex from its rest 5 s after the end of the grip."});
  return study;
}

StudyResult tissue_scaling_study(const StudyRequest& request) {
  StudyResult study{"tissue-scaling", "none: thread CPU time on this machine, with whatever else it did", {}, {}};
  StudyCurves curves{"scaling", "One step of 10 ms, probe pressing at 2 Hz",     "nodes", "ms",
                     {},        {{"mean", {}}, {"linear from the smallest", {}}}};
  std::vector<double> edges{0.0125, 0.010, 0.008, 0.0065, 0.005};
  if (request.quick) edges = {0.0125, 0.010};
  for (const double edge : edges) {
    SoftBenchSetup setup;
    setup.material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
    setup.material.stiffening = 1;
    setup.organ.solid.edge_m = edge;
    SoftBench bench(setup);
    const Vec3 touch = bench.touching(0.013, 0.007);
    for (int tick = 0; tick < 1500; ++tick)
      bench.tick(touch - Vec3(0, 0, 0.005 + 0.004 * std::sin(12.566e-3 * tick)), Vec3::Zero());
    const double mean = bench.tissue_cpu_s() / bench.tissue_steps() * 1e3;
    curves.x.push_back(static_cast<double>(bench.organ().solid().node_count()));
    curves.series[0].y.push_back(mean);
    curves.series[1].y.push_back(curves.series[0].y.front() * curves.x.back() / curves.x.front());
    if (edge != 0.010 && edge != 0.008) continue;
    const double most = edge == 0.010 ? 6 : 7;
    study.cases.push_back({"step at " + std::to_string(std::lround(edge * 1e3)) + " mm cells, " +
                               std::to_string(static_cast<int>(curves.x.back())) + " nodes",
                           "ms",
                           mean,
                           {},
                           most == 6 ? "<= 6" : "<= 7",
                           mean <= most,
                           "Mean over 150 steps: solid, clamped neighbourhood, surface, patch."});
  }
  if (!request.quick) {
    const double growth = curves.series[0].y.back() / curves.series[1].y.back();
    study.cases.push_back({"growth with the nodes, 12.5 to 5 mm cells, over linear",
                           "1",
                           growth,
                           {},
                           "<= 1",
                           growth <= 1,
                           "Of the mean step."});
  }
  study.curves.push_back(curves);
  return study;
}

}  // namespace trocar
