#include "app/cli/machine/bench_tissue.h"

#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr int kTicksPerStep = 10, kTurns = 5, kStepsToSettle = 30;
constexpr double kMostTries = 4;                                 // a cut, as some are refused
const Vec3 kCutHalf(0.080, 0.058, 0.040);                        // m: on top, clear of the organ's edge
constexpr double kLeastLength = 0.010, kLeastDepth = 0.004;      // m
constexpr double kFurtherLength = 0.010, kFurtherDepth = 0.008;  // m
constexpr double kAbove = 0.010;                                 // m of the blade that stands out
constexpr double kSequence[5] = {2., 3., 5., 7., 11.};           // bases: places that fill the top evenly

/// The i-th of numbers that fill 0 to 1 evenly (van der Corput 1935).
double evenly(int i, double base) {
  double out = 0, digit = 1;
  for (double left = i; left >= 1; left = std::floor(left / base)) out += (digit /= base) * std::fmod(left, base);
  return out;
}

SoftBenchSetup bench_setup(double edge_m) {
  SoftBenchSetup setup;
  setup.material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
  setup.material.stiffening = 1;
  setup.material.residual_strain = 0.06;
  setup.organ.solid.edge_m = edge_m;
  return setup;
}

}  // namespace

int scatter_cuts(SoftBench& bench, int cuts) {
  int made = 0;
  for (int i = 1; made < cuts && i < kMostTries * cuts; ++i) {
    double at[5];
    for (std::size_t k = 0; k < 5; ++k) at[k] = evenly(i, kSequence[k]);
    const double turn = std::numbers::pi * at[2], half = (kLeastLength + kFurtherLength * at[3]) / 2;
    const Vec3 along(half * std::cos(turn), half * std::sin(turn), 0);
    const Vec3 middle(kCutHalf.x() * (2 * at[0] - 1), kCutHalf.y() * (2 * at[1] - 1), 0);
    if (std::hypot(middle.x() / kCutHalf.x(), middle.y() / kCutHalf.y()) > 1) continue;
    const auto on_top = [&](const Vec3& p) {
      const Vec3 tip = bench.touching(p.x(), p.y());
      return Vec3(tip - Vec3(0, 0, ToolShape{}.radius_m));
    };
    const double depth = kLeastDepth + kFurtherDepth * at[4];
    if (bench.cut(track_blade(on_top(middle - along), on_top(middle + along), -Vec3::UnitZ(), depth, kAbove))) ++made;
  }
  return made;
}

PressedBench::PressedBench(double edge_m) : bench_(bench_setup(edge_m)), touch_(bench_.touching(0.013, 0.007)) {}

double PressedBench::step() {
  const double before = bench_.tissue_cpu_s();
  for (int i = 0; i < kTicksPerStep; ++i, ++tick_)
    bench_.tick(touch_ - Vec3(0, 0, 0.005 + 0.004 * std::sin(4e-3 * std::numbers::pi * tick_)), Vec3::Zero());
  return 1e6 * (bench_.tissue_cpu_s() - before);
}

TissueCost tissue_cost(double edge_m, int cuts, int steps) {
  PressedBench whole(edge_m), cut(edge_m);
  TissueCost out;
  out.cuts = scatter_cuts(cut.bench(), cuts);
  out.nodes = whole.bench().organ().solid().node_count();
  out.nodes_cut = cut.bench().organ().solid().node_count();
  out.triangles = whole.bench().organ().surface()->triangles.size();
  out.triangles_cut = cut.bench().organ().surface()->triangles.size();
  for (PressedBench* bench : {&whole, &cut})
    for (int i = 0; i < kStepsToSettle; ++i) bench->step();
  for (int turn = 0; turn < kTurns; ++turn) {
    for (int i = 0; i < steps / kTurns; ++i) out.whole.us.push_back(whole.step());
    for (int i = 0; i < steps / kTurns; ++i) out.cut.us.push_back(cut.step());
  }
  return out;
}

}  // namespace trocar
