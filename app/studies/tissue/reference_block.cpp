#include "app/studies/tissue/reference_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "app/studies/tissue/quadratic_reference.h"

namespace trocar {
namespace {

using Eigen::Vector3d;

constexpr double kSame = 1e-9;  ///< m: two places that rounding set apart

/// Growth of distances from where the load ends: t = 1 stands for its radius, `cells` cells for t from 0 to 1.
/// A punch presses infinitely hard at its rim: there the cells shrink.
double grown(double t, bool rim) {
  if (rim) return t < 1 ? t * t : std::exp(2 * (t - 1));
  return std::expm1(t);
}

/// Distances from a place where the load ends out to `end`, of which the first is left out.
void grow(std::vector<double>& result, double from, double radius, double end, int cells, bool rim) {
  const double reach = (end - from) / radius;
  const double last = !rim ? std::log1p(reach) : reach < 1 ? std::sqrt(reach) : 1 + std::log(reach) / 2;
  const int count = static_cast<int>(std::ceil(last * cells));
  for (int i = 1; i < count; ++i) result.push_back(from + radius * grown(last * i / count, rim));
  result.push_back(end);
}

/// Planes across: from the axis over the load and on to the side.
std::vector<double> across(double radius, int cells, double end, bool rim) {
  std::vector<double> result;
  for (int i = 0; i <= cells; ++i) {
    const double left = 1 - static_cast<double>(i) / cells;
    result.push_back(radius * (1 - (rim ? left * left : left)));
  }
  grow(result, radius, radius, end, cells, rim);
  return result;
}

/// Planes from the top down, of which a tent's are even over a radius.
std::vector<double> down(double radius, int cells, double end, bool rim) {
  if (!rim) return across(radius, cells, end, false);
  std::vector<double> result{0};
  grow(result, 0, radius, end, cells, true);
  return result;
}

/// Squares about the axis become circles up to the load's rim and turn back into squares towards the sides.
void round_off(Vec3& node, double radius, double end) {
  const double square = std::max(node[0], node[1]), circle = std::hypot(node[0], node[1]);
  if (square == 0 || square >= end) return;
  const double rounding = square <= radius ? 1 : (end - square) / (end - radius);
  const double scale = 1 + rounding * (square / circle - 1);
  node[0] *= scale, node[1] *= scale;
}

QuadraticMesh quarter_mesh(const ReferenceBlock& block, double radius, bool rim) {
  const Vector3d half{block.size_m[0] / 2, block.size_m[1] / 2, block.size_m[2]};
  if (block.cells < 1 || !(radius > 0) || !(radius < half.minCoeff()))
    throw std::invalid_argument("the load must be smaller than the block, on one cell or more");
  std::array<std::vector<double>, 3> planes;
  for (int axis = 0; axis < 2; ++axis) planes[axis] = across(radius, block.cells, half[axis], rim);
  planes[2] = down(radius, block.cells, half[2], rim);
  std::reverse(planes[2].begin(), planes[2].end());
  for (double& z : planes[2]) z = -z;
  TetrahedraMesh box = box_tetrahedra(planes);
  for (Vec3& node : box.nodes) round_off(node, radius, std::min(half[0], half[1]));
  return quadratic_mesh(box);
}

/// Mirror planes, bottom and, where they are, held sides.
std::vector<HeldComponent> supports(const QuadraticMesh& mesh, const ReferenceBlock& block) {
  std::vector<HeldComponent> held;
  for (int node = 0; node < mesh.nodes.cols(); ++node) {
    const Vector3d x = mesh.nodes.col(node);
    const bool side = x[0] > block.size_m[0] / 2 - kSame || x[1] > block.size_m[1] / 2 - kSame;
    const bool all = x[2] < -block.size_m[2] + kSame || (side && block.sides == BlockSides::held);
    for (int axis = 0; axis < 3; ++axis)
      if (all || (axis < 2 && x[axis] < kSame)) held.push_back({node, axis, 0});
  }
  return held;
}

void press_punch(const QuadraticMesh& mesh, double radius, double depth, bool bonded,
                 std::vector<HeldComponent>& held) {
  for (int node = 0; node < mesh.nodes.cols(); ++node) {
    const Vector3d x = mesh.nodes.col(node);
    if (x[2] < -kSame || x.head<2>().norm() > radius + kSame) continue;
    held.push_back({node, 2, -depth});
    if (bonded) held.insert(held.end(), {{node, 0, 0}, {node, 1, 0}});
  }
}

}  // namespace

BlockStiffness stiffness(const ReferenceBlock& block, BlockLoad load, double radius_m) {
  const QuadraticMesh mesh = quarter_mesh(block, radius_m, load != BlockLoad::tent);
  QuadraticProblem problem{.mesh = mesh, .young_pa = block.young_pa, .poisson = block.poisson};
  problem.held = supports(mesh, block);
  BlockStiffness result{.nodes = static_cast<int>(mesh.nodes.cols())};
  if (load == BlockLoad::tent) {
    problem.forces_n = traction_forces(mesh, [radius_m](const Vector3d& x) -> Vector3d {
      return x[2] < -kSame ? Vector3d::Zero().eval()
                           : Vector3d(0, 0, -std::max(0.0, 1 - x.head<2>().norm() / radius_m));
    });
    const QuadraticSolution solution = solve(problem);
    result.force_n = -4 * problem.forces_n.row(2).sum();
    result.displacement_m = 4 * problem.forces_n.cwiseProduct(solution.displacements_m).sum() / result.force_n;
    result.iterations = solution.iterations;
  } else {
    result.displacement_m = radius_m / 10;  // any: the law is linear
    std::vector<HeldComponent> punch;
    press_punch(mesh, radius_m, result.displacement_m, load == BlockLoad::bonded_punch, punch);
    problem.held.insert(problem.held.end(), punch.begin(), punch.end());
    const QuadraticSolution solution = solve(problem);
    for (const HeldComponent& pressed : punch)
      if (pressed.axis == 2) result.force_n -= 4 * solution.reactions_n(2, pressed.node);
    result.iterations = solution.iterations;
  }
  result.n_per_m = result.force_n / result.displacement_m;
  return result;
}

ConvergedStiffness converged_stiffness(ReferenceBlock block, BlockLoad load, double radius_m) {
  std::array<double, 3> k{};
  for (double& value : k) {
    value = stiffness(block, load, radius_m).n_per_m;
    block.cells *= 2;
  }
  const double ratio = (k[0] - k[1]) / (k[1] - k[2]);
  const double end = k[2] - (k[1] - k[2]) / (ratio - 1);
  return {end, std::abs(end - k[2]), std::log2(ratio)};
}

}  // namespace trocar
