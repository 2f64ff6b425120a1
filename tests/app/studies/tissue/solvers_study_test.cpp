// The soft solid's peers are what they are said to be, and do worse on the same organ.
#include "app/studies/tissue/solver_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/studies/tissue/corotational_solid.h"
#include "app/studies/tissue/soft_studies.h"
#include "app/studies/tissue/xpbd_solid.h"

namespace trocar::solvers_study_test {
namespace {

constexpr double kEdge = 0.01;

/// Two by two by two cubes, five tetrahedra to each.
PeerBody block() {
  PeerBody body;
  const auto at = [](int i, int j, int k) { return (k * 3 + j) * 3 + i; };
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) body.mesh.nodes.push_back(kEdge * Vec3(i, j, k));
  for (int cube = 0; cube < 8; ++cube) {
    const int i = cube & 1, j = cube >> 1 & 1, k = cube >> 2;
    std::array<std::int32_t, 8> corners{};
    for (int a = 0; a < 8; ++a) corners[static_cast<std::size_t>(a)] = at(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
    split_cube(corners, (i + j + k) % 2 != 0, 0, body.mesh);
  }
  body.share.assign(body.mesh.tetrahedra.size(), 1);
  body.materials = {TissueSolid{}};
  return body;
}

/// Pulls a block along x. @return its strains along x and y
template <class Solid>
std::pair<double, double> pulled(Solid& solid, double stress_pa) {
  const PeerBody body = block();
  const auto x = [&](std::int32_t node) { return body.mesh.nodes[static_cast<std::size_t>(node)].x(); };
  for (const auto& corners : body.mesh.tetrahedra)
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      // All outer faces of these tetrahedra are halves of a cube's.
      std::vector<std::int32_t> face(corners.begin(), corners.end());
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(opposite));
      for (const double side : {-1.0, 1.0})
        if (std::all_of(face.begin(), face.end(), [&](std::int32_t n) { return side * (x(n) - kEdge) > kEdge / 2; }))
          for (const std::int32_t node : face) solid.load(node, Vec3(side * stress_pa * kEdge * kEdge / 6, 0, 0));
    }
  solid.hold(13, 1);  // the middle
  for (int step = 0; step < 300; ++step) solid.step();
  const auto u = [&](int node) { return solid.displacement(node); };
  return {(u(14) - u(12)).x() / (2 * kEdge), (u(16) - u(10)).y() / (2 * kEdge)};
}

TEST(SolverPeers, ABlockUnderTensionStretchesByHooke) {
  // A uniform strain is one that linear tetrahedra have exactly; 1 % of it is left to the laws' own curves.
  constexpr double kStress = 50, kYoung = 5000, kPoisson = 0.45;
  CorotationalSolid turned(block(), {.mass_damping_per_s = 20, .tolerance = 1e-4});
  const auto [along, across] = pulled(turned, kStress);
  EXPECT_NEAR(along, kStress / kYoung, 0.01 * kStress / kYoung);
  EXPECT_NEAR(across, -kPoisson * kStress / kYoung, 0.01 * kStress / kYoung);
  XpbdSolid projected(block(), {.substeps = 20, .mass_damping_per_s = 20});
  const auto [along_x, across_x] = pulled(projected, kStress);
  EXPECT_NEAR(along_x, kStress / kYoung, 0.02 * kStress / kYoung);
  EXPECT_NEAR(across_x, -kPoisson * kStress / kYoung, 0.02 * kStress / kYoung);
}

TEST(SolverPeers, WhatNothingPullsRests) {
  XpbdSolid projected(block(), {.substeps = 10});
  CorotationalSolid turned(block(), {});
  for (int step = 0; step < 100; ++step) projected.step(), turned.step();
  for (int node = 0; node < 27; ++node) {
    EXPECT_LT(projected.displacement(node).norm(), 1e-7) << "rounding of a thousand substeps";
    EXPECT_LT(turned.displacement(node).norm(), 1e-9);
  }
}

TEST(SolverPeers, OursHasLessErrorThanTheSameNodesInTetrahedra) {
  constexpr double kCell = 0.0125;
  for (const StiffPart stiff : {StiffPart::kNone, StiffPart::kNodule}) {
    const SolverScene scene = make_scene({.stiff = stiff, .rows = 40, .reference_m = 0.012});
    const SolverRun ours = run_ours(scene, kCell);
    RecordProperty("ours_" + std::to_string(static_cast<int>(stiff)), std::to_string(ours.surface_error));
    EXPECT_LT(ours.surface_error, 0.2);
    EXPECT_LT(ours.energy_made, 1e-3);
    const PeerMesh lattice = lattice_mesh(scene, kCell), fitted = fitted_mesh(scene, kCell);
    const auto worse = [&](const PeerMesh& mesh, const SolverChoice& peer) {
      const SolverRun run = run_peer(scene, mesh, peer);
      EXPECT_GT(run.surface_error, 1.2 * ours.surface_error)
          << static_cast<int>(stiff) << ", peer " << static_cast<int>(peer.kind) << ", " << peer.substeps;
    };
    worse(lattice, {.kind = SolverKind::kCorotational});
    worse(fitted, {.kind = SolverKind::kCorotational});
    for (const int substeps : {5, 20}) worse(lattice, {.kind = SolverKind::kXpbd, .substeps = substeps});
  }
}

TEST(SolverPeers, ABeamOfCubesIsNearerToTimoshenkosThanTheSameNodesInTetrahedra) {
  EXPECT_NEAR(run_beam({}).over_timoshenko, 1, 0.04);
  EXPECT_LT(run_beam({.kind = SolverKind::kCorotational}).over_timoshenko, 0.9);
  EXPECT_LT(run_beam({.kind = SolverKind::kXpbd, .substeps = 20}).over_timoshenko, 0.93);
}

#ifdef NDEBUG  // times of a build without optimisation tell nothing
TEST(SolverPeers, OursHasTheLeastErrorInAnyTime) {
  for (const StudyCase& c : solvers_study({.quick = true}).cases)
    EXPECT_TRUE(c.met) << c.name << ": " << c.value << ", asked for " << c.bar;
}
#endif

}  // namespace
}  // namespace trocar::solvers_study_test
