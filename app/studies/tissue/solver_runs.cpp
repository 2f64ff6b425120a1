#include "app/studies/tissue/solver_runs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/studies/tissue/corotational_solid.h"
#include "app/studies/tissue/soft_bench.h"
#include "app/studies/tissue/xpbd_solid.h"
#include "tissue/solid/cube_element.h"

namespace trocar {
namespace {

constexpr double kRamp = 0.1, kRunEnd = 1.5, kLast = 0.5;  // s: the load grows; all of a run; what the mean is over
constexpr double kSolverStep = 0.010, kOrganDamping = 5;   // s, 1/s

/// Steps of which each is timed.
class Timed {
 public:
  template <class Solver>
  void step(Solver& solver) {
    const double begin = thread_cpu_s();
    solver.step();
    ms_.push_back((thread_cpu_s() - begin) * 1e3);
  }
  double median_ms() {
    const auto middle = ms_.begin() + static_cast<std::ptrdiff_t>(ms_.size() / 2);
    std::nth_element(ms_.begin(), middle, ms_.end());
    return *middle;
  }

 private:
  std::vector<double> ms_;
};

Vec3 displacement_of(const SoftSolid& solid, std::int32_t node) {
  const auto n = static_cast<std::size_t>(node);
  return (solid.position()[n] - solid.rest()[n]).cast<double>();
}
template <class Peer>
Vec3 displacement_of(const Peer& peer, std::int32_t node) {
  return peer.displacement(node);
}
template <class Solver>
Vec3 displacement_at(const Solver& solver, const NodeShares& place) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < place.node.size(); ++i)
    sum += static_cast<double>(place.share[i]) * displacement_of(solver, place.node[i]);
  return sum;
}

template <class Solver>
void press_organ(const SolverScene& scene, const std::vector<NodeShares>& surface, Solver& solver, double step_s,
                 SolverRun& out) {
  std::vector<std::size_t> loaded;
  for (std::size_t v = 0; v < surface.size(); ++v) {
    if (scene.force_n[v] > 0) loaded.push_back(v);
    for (std::size_t i = 0; i < surface[v].node.size(); ++i)
      solver.hold(surface[v].node[i], scene.bed_n_per_m[v] * static_cast<double>(surface[v].share[i]));
  }
  const auto load_more = [&](double share) {
    for (const std::size_t v : loaded)
      for (std::size_t i = 0; i < surface[v].node.size(); ++i)
        solver.load(surface[v].node[i],
                    Vec3(0, 0, -share * scene.force_n[v] * static_cast<double>(surface[v].share[i])));
  };
  Timed timed;
  std::vector<Vec3> mean(surface.size(), Vec3::Zero());
  double share = 0, work = 0, most_work = 0, before = 0, made = 0, mean_pressed = 0, early = 0;
  const auto at = [&](double time) { return static_cast<int>(std::lround(time / step_s)); };
  const double last = at(kLast);
  for (int step = 1; step <= at(kRunEnd); ++step) {
    const double next = std::min(1.0, step / static_cast<double>(at(kRamp)));
    load_more(next - share);
    share = next;
    timed.step(solver);
    double pressed = 0;
    for (const std::size_t v : loaded)
      pressed -= scene.force_n[v] * displacement_at(solver, surface[v]).z() / scene.options.force_n;
    work += share * scene.options.force_n * (pressed - before);
    before = pressed;
    most_work = std::max(most_work, work);
    made = std::max(made, solver.energy_j() - work);
    if (step == at(kRamp)) early = pressed;
    if (step <= at(kRunEnd) - at(kLast)) continue;
    mean_pressed += pressed / last;
    for (std::size_t v = 0; v < surface.size(); ++v) mean[v] += displacement_at(solver, surface[v]) / last;
  }
  out.step_ms = timed.median_ms();
  out.energy_made = made / most_work;
  out.early = early / mean_pressed;
  out.load_error = mean_pressed / scene.pressed_m - 1;
  double wrong = 0, right = 0;
  for (std::size_t v = 0; v < surface.size(); ++v) {
    wrong += (mean[v] - scene.displacement_m[v]).squaredNorm();
    right += scene.displacement_m[v].squaredNorm();
  }
  out.surface_error = std::sqrt(wrong / right);
}

/// Beam along x, the end that is held at the origin.
struct Beam {
  static constexpr int kAcross = 4, kAlong = 40;
  static constexpr double kEdge = 0.0025, kWidth = kAcross * kEdge, kLength = kAlong * kEdge;  // m
  std::vector<Vec3> nodes;
  std::vector<SoftCell> cells;
  PeerBody body;

  Beam() {
    const auto at = [](int i, int j, int k) { return (k * (kAcross + 1) + j) * (kAlong + 1) + i; };
    for (int k = 0; k <= kAcross; ++k)
      for (int j = 0; j <= kAcross; ++j)
        for (int i = 0; i <= kAlong; ++i) nodes.push_back(kEdge * Vec3(i, j, k));
    for (int k = 0; k < kAcross; ++k)
      for (int j = 0; j < kAcross; ++j)
        for (int i = 0; i < kAlong; ++i) {
          SoftCell cell;
          for (int a = 0; a < kCubeCorners; ++a)
            cell.node[static_cast<std::size_t>(a)] = at(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
          cells.push_back(cell);
          split_cube(cell.node, (i + j + k) % 2 != 0, 0, body.mesh);
        }
    body.mesh.nodes = nodes;
    body.share.assign(body.mesh.tetrahedra.size(), 1);
    body.materials = {TissueSolid{}};
  }
};

constexpr double kBeamDamping = 4.4;  // 1/s: next to critical for its first mode, of 0.35 Hz

template <class Solver>
BeamRun bend(const Beam& beam, Solver& solver) {
  constexpr double kSettled = 4, kHeld = 1e4;  // s; N/m of a node
  const TissueSolid& material = beam.body.materials.front();
  const double area = Beam::kWidth * Beam::kWidth, inertia = area * area / 12;
  const double shear = material.young_pa / (2 * (1 + material.poisson));
  const double per_newton =
      std::pow(Beam::kLength, 3) / (3 * material.young_pa * inertia) + Beam::kLength / (5.0 / 6 * shear * area);
  const double force = 0.01 * Beam::kLength / per_newton;
  NodeShares end;
  for (std::size_t n = 0; n < beam.nodes.size(); ++n) {
    const Vec3& place = beam.nodes[n];
    const auto node = static_cast<std::int32_t>(n);
    if (place.x() < Beam::kEdge / 2) solver.hold(node, kHeld);
    if (place.x() < Beam::kLength - Beam::kEdge / 2) continue;
    const auto inner = [](double y) { return y > Beam::kEdge / 2 && y < Beam::kWidth - Beam::kEdge / 2 ? 1.0 : 0.5; };
    end.node.push_back(node);
    end.share.push_back(static_cast<float>(inner(place.y()) * inner(place.z()) / (Beam::kAcross * Beam::kAcross)));
    solver.load(node, Vec3(0, 0, -force * static_cast<double>(end.share.back())));
  }
  Timed timed;
  double mean = 0;
  const int steps = static_cast<int>(std::lround(kSettled / kSolverStep)), last = steps / 8;
  for (int step = 0; step < steps; ++step) {
    timed.step(solver);
    if (step >= steps - last) mean -= displacement_at(solver, end).z() / last;
  }
  return {mean / (force * per_newton), timed.median_ms()};
}

}  // namespace

SolverRun run_ours(const SolverScene& scene, double cell_m, double step_s) {
  SoftMesh mesh = soft_mesh(scene, {cell_m, step_s, kOrganDamping});
  SolverRun out{{.cell_m = cell_m}, mesh.solid.node_count(), mesh.solid.cell_count()};
  press_organ(scene, mesh.surface, mesh.solid, step_s, out);
  return out;
}

SolverRun run_peer(const SolverScene& scene, const PeerMesh& mesh, const SolverChoice& choice) {
  SolverRun out{choice, mesh.body.mesh.nodes.size(), mesh.body.mesh.tetrahedra.size()};
  if (choice.kind == SolverKind::kXpbd) {
    XpbdSolid solid(mesh.body, {kSolverStep, choice.substeps, kOrganDamping});
    press_organ(scene, mesh.surface, solid, kSolverStep, out);
  } else {
    CorotationalSolid solid(mesh.body, {kSolverStep, kOrganDamping});
    press_organ(scene, mesh.surface, solid, kSolverStep, out);
  }
  return out;
}

BeamRun run_beam(const SolverChoice& choice) {
  const Beam beam;
  if (choice.kind == SolverKind::kXpbd) {
    XpbdSolid solid(beam.body, {kSolverStep, choice.substeps, kBeamDamping});
    return bend(beam, solid);
  }
  if (choice.kind == SolverKind::kCorotational) {
    CorotationalSolid solid(beam.body, {kSolverStep, kBeamDamping});
    return bend(beam, solid);
  }
  SoftSolid solid(beam.nodes, beam.cells, beam.body.materials, {Beam::kEdge, kSolverStep, kBeamDamping});
  return bend(beam, solid);
}

}  // namespace trocar
