#include "app/studies/tissue/quadratic_reference.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <stdexcept>

namespace trocar::quadratic_reference_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

const auto kLiver = [](const Vector3d&) { return 5000.0; };

std::vector<double> even(int cells, double length) {
  std::vector<double> planes;
  for (int i = 0; i <= cells; ++i) planes.push_back(length * i / cells);
  return planes;
}

bool on_surface(const Vector3d& x, double side) { return (x.array() < 1e-9).any() || (x.array() > side - 1e-9).any(); }

/// A cube of 3 x 3 x 3 cells whose inner corners are shaken.
QuadraticMesh shaken_cube(double side) {
  TetrahedraMesh box = box_tetrahedra({even(3, side), even(3, side), even(3, side)});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shake(-0.1 * side / 3, 0.1 * side / 3);
  for (Vec3& node : box.nodes)
    if (!on_surface({node[0], node[1], node[2]}, side))
      for (double& component : node) component += shake(random);
  return quadratic_mesh(box);
}

TEST(QuadraticReference, ALinearFieldOnTheSurfaceIsOneInsideAtAnyPoisson) {
  constexpr double kSide = 0.03;
  const QuadraticMesh mesh = shaken_cube(kSide);
  Matrix3d gradient;
  gradient << 0.01, 0.02, -0.03, 0.04, -0.05, 0.06, 0.07, -0.08, 0.09;
  for (const double poisson : {0.0, 0.45, 0.495}) {
    QuadraticProblem problem{.mesh = mesh, .young_pa = kLiver, .poisson = poisson};
    for (int node = 0; node < mesh.nodes.cols(); ++node) {
      const Vector3d x = mesh.nodes.col(node), u = gradient * x;
      if (on_surface(x, kSide))
        for (int axis = 0; axis < 3; ++axis) problem.held.push_back({node, axis, u[axis]});
    }
    const Eigen::Matrix3Xd error = solve(problem).displacements_m - gradient * mesh.nodes;
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-8 * kSide) << poisson << ": the solver's own residual is 1e-9";
  }
}

TEST(QuadraticReference, PullOnABarGivesYoungAndPoisson) {
  constexpr double kSide = 0.03, kPull = 10;
  const QuadraticMesh mesh = shaken_cube(kSide);
  QuadraticProblem problem{.mesh = mesh, .young_pa = kLiver, .poisson = 0.45};
  for (int node = 0; node < mesh.nodes.cols(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      if (mesh.nodes(axis, node) < 1e-9) problem.held.push_back({node, axis, 0});
  problem.forces_n =
      traction_forces(mesh, [](const Vector3d& x) { return Vector3d(x[0] > kSide - 1e-9 ? kPull : 0.0, 0, 0); });
  EXPECT_NEAR(problem.forces_n.row(0).sum(), kPull * kSide * kSide, 1e-12);
  const QuadraticSolution solution = solve(problem);
  for (int node = 0; node < mesh.nodes.cols(); ++node) {
    const Vector3d strain{kPull / 5000, -0.45 * kPull / 5000, -0.45 * kPull / 5000};
    EXPECT_NEAR((solution.displacements_m.col(node) - strain.cwiseProduct(mesh.nodes.col(node))).norm(), 0, 1e-11);
  }
  EXPECT_NEAR(solution.reactions_n.row(0).sum(), -kPull * kSide * kSide, 1e-11);
}

TEST(QuadraticReference, AStampOnABedSinksByPressureOverSprings) {
  constexpr double kSide = 0.03, kBed = 1e5, kPressure = 100;
  const QuadraticMesh mesh = shaken_cube(kSide);
  QuadraticProblem problem{.mesh = mesh, .young_pa = kLiver, .poisson = 0, .bed_n_per_m3 = kBed};
  for (std::size_t face = 0; face < mesh.boundary.size(); ++face) {
    bool bottom = true;
    for (const int node : mesh.boundary[face]) bottom = bottom && mesh.nodes(2, node) < 1e-9;
    if (bottom) problem.bedded.push_back(static_cast<int>(face));
  }
  problem.forces_n =
      traction_forces(mesh, [](const Vector3d& x) { return Vector3d(0, 0, x[2] > kSide - 1e-9 ? -kPressure : 0.0); });
  const QuadraticSolution solution = solve(problem);
  for (int node = 0; node < mesh.nodes.cols(); ++node)
    EXPECT_NEAR(solution.displacements_m(2, node), -kPressure / kBed - kPressure / 5000 * mesh.nodes(2, node), 1e-11);
}

/// Tip deflection over Timoshenko's, 10:1, held at one end. @param cells across
double cantilever_ratio(int cells, double poisson) {
  constexpr double kSide = 0.01, kLength = 0.1, kShear = 1;  // m, m, N/m2
  const QuadraticMesh mesh =
      quadratic_mesh(box_tetrahedra({even(10 * cells, kLength), even(cells, kSide), even(cells, kSide)}));
  QuadraticProblem problem{.mesh = mesh, .young_pa = kLiver, .poisson = poisson};
  for (int node = 0; node < mesh.nodes.cols(); ++node)
    for (int axis = 0; axis < 3; ++axis)
      if (mesh.nodes(0, node) < 1e-9) problem.held.push_back({node, axis, 0});
  problem.forces_n =
      traction_forces(mesh, [](const Vector3d& x) { return Vector3d(0, 0, x[0] > kLength - 1e-9 ? -kShear : 0.0); });
  const double force = kShear * kSide * kSide;
  const double deflection = problem.forces_n.cwiseProduct(solve(problem).displacements_m).sum() / force;
  const double inertia = std::pow(kSide, 4) / 12, shear_modulus = 5000 / (2 * (1 + poisson));
  const double shear_factor = 10 * (1 + poisson) / (12 + 11 * poisson);  // Cowper 1966, rectangle
  const double timoshenko = force * std::pow(kLength, 3) / (3 * 5000 * inertia) +
                            force * kLength / (shear_factor * shear_modulus * kSide * kSide);
  return deflection / timoshenko;
}

TEST(QuadraticReference, CantileverBendsAsTimoshenkos) {
  // The clamp keeps the section's width, which the beam does not know of: that stiffens by up to 2 % at nu 0.45.
  for (const double poisson : {0.3, 0.45}) {
    const double ratio = cantilever_ratio(2, poisson);
    RecordProperty("ratio_" + std::to_string(poisson), std::to_string(ratio));
    EXPECT_NEAR(ratio, 0.985, 0.025) << poisson;
  }
}

TEST(QuadraticReference, RefusesFlatTetrahedraAndFloatingBodies) {
  TetrahedraMesh box = box_tetrahedra({even(1, 1), even(1, 1), even(1, 1)});
  QuadraticMesh mesh = quadratic_mesh(box);
  EXPECT_EQ(mesh.boundary.size(), 12u);
  EXPECT_EQ(mesh.nodes.cols(), 27);
  box.nodes.back() = box.nodes.front();
  EXPECT_THROW(quadratic_mesh(box), std::invalid_argument);
  QuadraticProblem floating{.mesh = mesh, .young_pa = kLiver};
  floating.forces_n = Eigen::Matrix3Xd::Constant(3, 27, 1.0);
  EXPECT_THROW(solve(floating), std::runtime_error);
}

}  // namespace
}  // namespace trocar::quadratic_reference_test
