#include "tissue/solid/tetrahedra_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trocar {
namespace {

constexpr int kAngleSweeps = 8;
constexpr double kTurnedOver = 2;                     ///< in place of a cosine
constexpr double kFirstStep = 0.3, kLastStep = 0.01;  ///< of the shortest edge round the node

std::size_t corner_at(std::int32_t node) { return static_cast<std::size_t>(node); }

class Smoother {
 public:
  Smoother(TetrahedraMesh& mesh, const std::vector<double>& reach)
      : mesh_(mesh), reach_(reach), start_(mesh.nodes), star_(mesh.nodes.size()) {
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
      for (const std::int32_t node : mesh.tetrahedra[t]) star_[corner_at(node)].push_back(t);
  }

  /// One look at every tetrahedron. @return whether anything moved
  bool sweep(double wanted_deg) {
    bool moved = false;
    const double least = std::cos(wanted_deg * std::numbers::pi / 180);
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      if (worst_cosine(t) < least) continue;
      for (const std::int32_t node : mesh_.tetrahedra[t]) moved |= move(corner_at(node));
    }
    return moved;
  }

 private:
  /// Cosine of the smallest dihedral angle, the largest of the six; kTurnedOver when it is.
  double worst_cosine(std::size_t tetrahedron) const {
    const auto& t = mesh_.tetrahedra[tetrahedron];
    const Vec3 &a = mesh_.nodes[corner_at(t[0])], &b = mesh_.nodes[corner_at(t[1])], &c = mesh_.nodes[corner_at(t[2])],
               &d = mesh_.nodes[corner_at(t[3])];
    if ((b - a).cross(c - a).dot(d - a) <= 0) return kTurnedOver;
    const std::array<Vec3, 4> normals{(d - b).cross(c - b).normalized(), (c - a).cross(d - a).normalized(),
                                      (d - a).cross(b - a).normalized(), (b - a).cross(c - a).normalized()};
    double most = -1;
    for (std::size_t n = 0; n < 4; ++n)
      for (std::size_t m = n + 1; m < 4; ++m) most = std::max(most, -normals[n].dot(normals[m]));
    return most;
  }

  /// Stops at the first tetrahedron as bad as the `limit`.
  double worst_round(std::size_t node, double limit) const {
    double most = -1;
    for (const std::size_t t : star_[node])
      if (most = std::max(most, worst_cosine(t)); most >= limit) break;
    return most;
  }

  double shortest_edge(std::size_t node) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::size_t t : star_[node])
      for (const std::int32_t other : mesh_.tetrahedra[t])
        if (corner_at(other) != node)
          shortest = std::min(shortest, (mesh_.nodes[corner_at(other)] - mesh_.nodes[node]).norm());
    return shortest;
  }

  /// Tries the 26 neighbours on a grid of `step`, takes the best. @param worst round the node, lowered
  bool take_step(std::size_t node, double step, double& worst) {
    const Vec3 from = mesh_.nodes[node];
    Vec3 to = from;
    for (int n = 0; n < 27; ++n) {
      if (n == 13) continue;  // where it is
      const Vec3 place = from + step * Vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).normalized();
      if ((place - start_[node]).squaredNorm() > reach_[node] * reach_[node]) continue;
      mesh_.nodes[node] = place;
      if (const double there = worst_round(node, worst); there < worst) worst = there, to = place;
    }
    mesh_.nodes[node] = to;
    return to != from;
  }

  bool move(std::size_t node) {
    if (reach_[node] <= 0) return false;
    const double edge = shortest_edge(node);
    double worst = worst_round(node, kTurnedOver);
    bool moved = false;
    for (double step = kFirstStep; step > kLastStep;)
      if (take_step(node, step * edge, worst))
        moved = true;
      else
        step /= 2;
    return moved;
  }

  TetrahedraMesh& mesh_;
  const std::vector<double>& reach_;
  const std::vector<Vec3> start_;
  std::vector<std::vector<std::size_t>> star_;
};

}  // namespace

void improve_angles(TetrahedraMesh& mesh, const std::vector<double>& reach, double wanted_deg) {
  Smoother smoother(mesh, reach);
  for (int round = 0; round < kAngleSweeps && smoother.sweep(wanted_deg); ++round) {
  }
}

}  // namespace trocar
