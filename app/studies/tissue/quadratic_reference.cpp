#include "app/studies/tissue/quadratic_reference.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace trocar {
namespace {

using Eigen::Matrix3d, Eigen::Matrix3Xd, Eigen::Vector3d, Eigen::Vector4d;
using Sparse = Eigen::SparseMatrix<double>;
using ElementGradients = Eigen::Matrix<double, 3, 10>;
using ElementMatrix = Eigen::Matrix<double, 30, 30>;

constexpr double kResidual = 1e-9;
constexpr int kMostIterations = 20000;
constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<int, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};  ///< outwards

/// Gradients of the barycentric coordinates and volume of an element.
struct Straight {
  Eigen::Matrix<double, 3, 4> gradients;
  double volume;
};

Straight straight(const QuadraticMesh& mesh, const std::array<int, 10>& element) {
  Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = mesh.nodes.col(element[i + 1]) - mesh.nodes.col(element[0]);
  Straight result;
  result.volume = edges.determinant() / 6;
  result.gradients.rightCols<3>() = edges.inverse().transpose();
  result.gradients.col(0) = -result.gradients.rightCols<3>().rowwise().sum();
  return result;
}

Eigen::Matrix<double, 10, 1> shapes(const Vector4d& l) {
  Eigen::Matrix<double, 10, 1> n;
  for (int i = 0; i < 4; ++i) n[i] = l[i] * (2 * l[i] - 1);
  for (int e = 0; e < 6; ++e) n[4 + e] = 4 * l[kEdges[e][0]] * l[kEdges[e][1]];
  return n;
}

ElementGradients shape_gradients(const Straight& s, const Vector4d& l) {
  ElementGradients g;
  for (int i = 0; i < 4; ++i) g.col(i) = (4 * l[i] - 1) * s.gradients.col(i);
  for (int e = 0; e < 6; ++e) {
    const auto [i, j] = kEdges[e];
    g.col(4 + e) = 4 * (l[i] * s.gradients.col(j) + l[j] * s.gradients.col(i));
  }
  return g;
}

/// Barycentric coordinates of the four-point rule of degree 2; all weights are a quarter.
Vector4d gauss_point(int index) {
  Vector4d l = Vector4d::Constant((5 - std::sqrt(5.0)) / 20);
  l[index] = (5 + 3 * std::sqrt(5.0)) / 20;
  return l;
}

ElementMatrix element_matrix(const QuadraticProblem& problem, const std::array<int, 10>& element) {
  const Straight s = straight(problem.mesh, element);
  Eigen::Matrix<double, 3, 10> corners;
  for (int a = 0; a < 10; ++a) corners.col(a) = problem.mesh.nodes.col(element[a]);
  ElementMatrix k = ElementMatrix::Zero();
  for (int point = 0; point < 4; ++point) {
    const Vector4d l = gauss_point(point);
    const double young = problem.young_pa(corners * shapes(l));
    const double mu = young / (2 * (1 + problem.poisson)) * s.volume / 4;
    const double lambda = 2 * mu * problem.poisson / (1 - 2 * problem.poisson);
    const ElementGradients g = shape_gradients(s, l);
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b <= a; ++b)
        k.block<3, 3>(3 * a, 3 * b) += lambda * g.col(a) * g.col(b).transpose() + mu * g.col(b) * g.col(a).transpose() +
                                       mu * g.col(a).dot(g.col(b)) * Matrix3d::Identity();
  }
  for (int a = 0; a < 10; ++a)
    for (int b = 0; b < a; ++b) k.block<3, 3>(3 * b, 3 * a) = k.block<3, 3>(3 * a, 3 * b).transpose();
  return k;
}

/// A point of a boundary face with what a traction there does to its six nodes.
struct FacePoint {
  Vector3d x;
  Eigen::Matrix<double, 6, 1> shapes;
  double area = 0;  ///< that the point stands for
};

/// Every face as 16 parts of seven points (degree 5): a traction's kink within a face costs little.
template <typename Use>
void each_face_point(const QuadraticMesh& mesh, const std::array<int, 6>& face, const Use& use) {
  static constexpr int kSplits = 4;
  static const double r = std::sqrt(15.0);
  const std::array<std::array<double, 3>, 3> rule{
      {{1.0 / 3, 9.0 / 40, 1}, {(6 - r) / 21, (155 - r) / 1200, 3}, {(6 + r) / 21, (155 + r) / 1200, 3}}};
  const Vector3d origin = mesh.nodes.col(face[0]);
  const Vector3d u = mesh.nodes.col(face[1]) - origin, v = mesh.nodes.col(face[2]) - origin;
  const double part_area = u.cross(v).norm() / 2 / (kSplits * kSplits);
  const auto at = [&](double s, double t, double weight) {
    const double l = 1 - s - t;
    FacePoint point{origin + s * u + t * v, {}, weight * part_area};
    point.shapes << l * (2 * l - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * l * s, 4 * s * t, 4 * l * t;
    use(point);
  };
  for (int i = 0; i < kSplits; ++i)
    for (int j = 0; i + j < kSplits; ++j)
      for (const double turned : {1.0, -1.0}) {
        if (turned < 0 && i + j == kSplits - 1) continue;
        const double s0 = i + (turned < 0), t0 = j + (turned < 0);
        for (const auto& [b, weight, count] : rule)
          for (int k = 0; k < count; ++k) {
            const double ds = k == 1 ? 1 - 2 * b : b, dt = k == 2 ? 1 - 2 * b : b;
            at((s0 + turned * ds) / kSplits, (t0 + turned * dt) / kSplits, weight);
          }
      }
}

/// Numbers of the components that are solved for, -1 for a held one.
struct Unknowns {
  std::vector<int> number;
  int count = 0;
};

Unknowns unknowns(const QuadraticProblem& problem) {
  Unknowns result{std::vector<int>(3 * static_cast<std::size_t>(problem.mesh.nodes.cols()), 0)};
  for (const HeldComponent& held : problem.held) result.number[3 * held.node + held.axis] = -1;
  for (int& number : result.number)
    if (number == 0) number = result.count++;
  return result;
}

/// Lower triangle with every entry that an element can fill, all zero.
Sparse empty_matrix(const QuadraticMesh& mesh, const Unknowns& unknowns) {
  std::vector<std::vector<int>> near(static_cast<std::size_t>(mesh.nodes.cols()));
  for (const auto& element : mesh.elements)
    for (const int a : element)
      for (const int b : element)
        if (a >= b) near[b].push_back(a);
  Eigen::VectorXi sizes = Eigen::VectorXi::Zero(unknowns.count);
  for (std::size_t b = 0; b < near.size(); ++b) {
    std::sort(near[b].begin(), near[b].end());
    near[b].erase(std::unique(near[b].begin(), near[b].end()), near[b].end());
    for (int axis = 0; axis < 3; ++axis)
      if (const int column = unknowns.number[3 * b + axis]; column >= 0)
        sizes[column] = 3 * static_cast<int>(near[b].size());
  }
  Sparse matrix(unknowns.count, unknowns.count);
  matrix.reserve(sizes);
  for (std::size_t b = 0; b < near.size(); ++b)
    for (int axis = 0; axis < 3; ++axis) {
      const int column = unknowns.number[3 * b + axis];
      if (column < 0) continue;
      for (const int a : near[b])
        for (int other = 0; other < 3; ++other)
          if (const int row = unknowns.number[3 * a + other]; row >= column) matrix.insert(row, column) = 0;
    }
  matrix.makeCompressed();
  return matrix;
}

/// Adds a small dense matrix over some nodes' components. What is held goes to the right side.
template <typename Nodes, typename Dense>
void scatter(const Nodes& nodes, const Dense& k, const Unknowns& unknowns, const Matrix3Xd& held, Sparse& matrix,
             Eigen::VectorXd& right) {
  const int size = static_cast<int>(k.rows());
  for (int j = 0; j < size; ++j) {
    const int column = unknowns.number[3 * nodes[j / 3] + j % 3];
    for (int i = 0; i < size; ++i) {
      const int row = unknowns.number[3 * nodes[i / 3] + i % 3];
      if (row < 0) continue;
      if (column < 0)
        right[row] -= k(i, j) * held(j % 3, nodes[j / 3]);
      else if (row >= column)
        matrix.coeffRef(row, column) += k(i, j);
    }
  }
}

Eigen::Matrix<double, 18, 18> bed_matrix(const QuadraticProblem& problem, const std::array<int, 6>& face) {
  Eigen::Matrix<double, 18, 18> k = Eigen::Matrix<double, 18, 18>::Zero();
  each_face_point(problem.mesh, face, [&](const FacePoint& point) {
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        k.block<3, 3>(3 * a, 3 * b).diagonal().array() +=
            problem.bed_n_per_m3 * point.area * point.shapes[a] * point.shapes[b];
  });
  return k;
}

/// What the elements and the bed pull at the nodes, N.
Matrix3Xd inner_forces(const QuadraticProblem& problem, const Matrix3Xd& u) {
  Matrix3Xd forces = Matrix3Xd::Zero(3, u.cols());
  const auto add = [&](const auto& nodes, const auto& k) {
    Eigen::VectorXd local(k.rows());
    for (std::size_t a = 0; a < nodes.size(); ++a) local.segment<3>(3 * a) = u.col(nodes[a]);
    const Eigen::VectorXd pull = k * local;
    for (std::size_t a = 0; a < nodes.size(); ++a) forces.col(nodes[a]) += pull.segment<3>(3 * a);
  };
  for (const auto& element : problem.mesh.elements) add(element, element_matrix(problem, element));
  for (const int face : problem.bedded)
    add(problem.mesh.boundary[face], bed_matrix(problem, problem.mesh.boundary[face]));
  return forces;
}

}  // namespace

TetrahedraMesh box_tetrahedra(const std::array<std::vector<double>, 3>& planes) {
  const auto count = [&](int axis) { return static_cast<std::int32_t>(planes[axis].size()); };
  TetrahedraMesh mesh;
  for (const double z : planes[2])
    for (const double y : planes[1])
      for (const double x : planes[0]) mesh.nodes.push_back({x, y, z});
  const std::array<std::int32_t, 3> step{1, count(0), count(0) * count(1)};
  std::array<int, 3> order{0, 1, 2};
  do {
    const bool turned = (order[1] - order[0] + 3) % 3 == 2;
    for (std::int32_t k = 0; k + 1 < count(2); ++k)
      for (std::int32_t j = 0; j + 1 < count(1); ++j)
        for (std::int32_t i = 0; i + 1 < count(0); ++i) {
          std::array<std::int32_t, 4> corners{};
          corners[0] = i * step[0] + j * step[1] + k * step[2];
          for (int way = 0; way < 3; ++way) corners[way + 1] = corners[way] + step[order[way]];
          if (turned) std::swap(corners[1], corners[2]);
          mesh.tetrahedra.push_back(corners);
        }
  } while (std::next_permutation(order.begin(), order.end()));
  mesh.labels.assign(mesh.tetrahedra.size(), 1);
  return mesh;
}

QuadraticMesh quadratic_mesh(const TetrahedraMesh& mesh) {
  QuadraticMesh result;
  std::vector<Vector3d> nodes;
  for (const auto& node : mesh.nodes) nodes.emplace_back(node[0], node[1], node[2]);
  std::unordered_map<std::uint64_t, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [found, fresh] = middles.try_emplace(
        static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high), static_cast<int>(nodes.size()));
    if (fresh) nodes.push_back((nodes[a] + nodes[b]) / 2);
    return found->second;
  };
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> faces;  // sorted corners: how often, as seen outside
  for (const auto& corners : mesh.tetrahedra) {
    std::array<int, 10> element{};
    std::copy(corners.begin(), corners.end(), element.begin());
    for (int e = 0; e < 6; ++e) element[4 + e] = middle(corners[kEdges[e][0]], corners[kEdges[e][1]]);
    for (const auto& face : kFaces) {
      const std::array<int, 3> outside{corners[face[0]], corners[face[1]], corners[face[2]]};
      std::array<int, 3> sorted = outside;
      std::sort(sorted.begin(), sorted.end());
      auto& entry = faces[sorted];
      ++entry.first, entry.second = outside;
    }
    result.elements.push_back(element);
  }
  for (const auto& [sorted, face] : faces) {
    const auto& [a, b, c] = face.second;
    if (face.first == 1) result.boundary.push_back({a, b, c, middle(a, b), middle(b, c), middle(a, c)});
  }
  result.nodes = Eigen::Map<const Matrix3Xd>(nodes[0].data(), 3, static_cast<Eigen::Index>(nodes.size()));
  for (const auto& element : result.elements)
    if (!(straight(result, element).volume > 0)) throw std::invalid_argument("a tetrahedron has no volume");
  return result;
}

QuadraticSolution solve(const QuadraticProblem& problem) {
  const Unknowns free = unknowns(problem);
  Matrix3Xd u = Matrix3Xd::Zero(3, problem.mesh.nodes.cols());
  for (const HeldComponent& held : problem.held) u(held.axis, held.node) = held.value_m;
  const Matrix3Xd forces = problem.forces_n.size() ? problem.forces_n : Matrix3Xd::Zero(3, u.cols()).eval();
  Eigen::VectorXd right(free.count);
  for (std::size_t i = 0; i < free.number.size(); ++i)
    if (free.number[i] >= 0) right[free.number[i]] = forces.data()[i];
  Sparse matrix = empty_matrix(problem.mesh, free);
  for (const auto& element : problem.mesh.elements)
    scatter(element, element_matrix(problem, element), free, u, matrix, right);
  for (const int face : problem.bedded)
    scatter(problem.mesh.boundary[face], bed_matrix(problem, problem.mesh.boundary[face]), free, u, matrix, right);

  Eigen::ConjugateGradient<Sparse, Eigen::Lower> solver;  // Jacobi: twice as fast as with an incomplete factor
  solver.setTolerance(kResidual);
  solver.setMaxIterations(kMostIterations);
  const Eigen::VectorXd found = solver.compute(matrix).solve(right);
  if (solver.info() != Eigen::Success || !found.allFinite())
    throw std::runtime_error("the static solution was not found: is enough held?");
  for (std::size_t i = 0; i < free.number.size(); ++i)
    if (free.number[i] >= 0) u.data()[i] = found[free.number[i]];

  QuadraticSolution solution{u, Matrix3Xd::Zero(3, u.cols()), static_cast<int>(solver.iterations())};
  const Matrix3Xd pull = inner_forces(problem, u) - forces;
  for (const HeldComponent& held : problem.held)
    solution.reactions_n(held.axis, held.node) = pull(held.axis, held.node);
  return solution;
}

Matrix3Xd traction_forces(const QuadraticMesh& mesh, const std::function<Vector3d(const Vector3d&)>& traction) {
  Matrix3Xd forces = Matrix3Xd::Zero(3, mesh.nodes.cols());
  for (const auto& face : mesh.boundary)
    each_face_point(mesh, face, [&](const FacePoint& point) {
      const Vector3d force = traction(point.x) * point.area;
      if (force.isZero(0)) return;
      for (int a = 0; a < 6; ++a) forces.col(face[a]) += point.shapes[a] * force;
    });
  return forces;
}

}  // namespace trocar
