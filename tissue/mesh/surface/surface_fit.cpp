#include "tissue/mesh/surface/surface_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "haptics/contact/segment_triangle.h"
#include "tissue/mesh/surface/edge_sizes.h"
#include "tissue/mesh/surface/nearest_surface.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

using Index = std::int32_t;

constexpr std::size_t kSamplesPerTriangle = 8, kCloseSamplesPerTriangle = 16;
constexpr double kOvershoot = 1.5;     ///< the shares' sum overrates the stiffness: a full step is too short (1..2)
constexpr double kTether = 0.003;      ///< holds a vertex within the tangent plane, against what the samples do
constexpr double kLongestEdge = 2.5;   ///< of an even mesh's edge, that a step or flip makes
constexpr double kLongestStep = 0.3;   ///< of the vertex's shortest edge
constexpr double kLeastStep = 0.2;     ///< of the step wanted: not halved below
constexpr double kLeastGain = 0.02;    ///< of the squared distances, that a flip is worth
constexpr double kLeastFitTurn = 0.8;  ///< cosine that a triangle's normal keeps with its old one
constexpr double kLeastFlipTurn = 0.5;
constexpr std::size_t kLeastValence = 4, kLargestValence = 8;

std::size_t at(Index n) { return static_cast<std::size_t>(n); }

/// Shares of the three corners at a point of the triangle, by areas.
Vec3 barycentric(const std::array<Vec3, 3>& p, const Vec3& point) {
  Vec3 shares;
  for (std::size_t n = 0; n < 3; ++n)
    shares[static_cast<Eigen::Index>(n)] = (p[(n + 1) % 3] - point).cross(p[(n + 2) % 3] - point).norm();
  const double sum = shares.sum();
  return sum > 0 ? Vec3(shares / sum) : Vec3::Constant(1.0 / 3);
}

/// Cosine of the smallest angle.
double sharpest(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = (b - a).normalized(), v = (c - b).normalized(), w = (a - c).normalized();
  return std::max({-u.dot(w), -u.dot(v), -v.dot(w)});
}

/// Numbers 0..n by the group that each belongs to; those of a negative group in none.
struct Groups {
  std::vector<std::size_t> begin;  ///< one a group, and the end
  std::vector<Index> member;

  Groups(const std::vector<Index>& group, std::size_t count) : begin(count + 1, 0) {
    for (const Index g : group)
      if (g >= 0) ++begin[at(g) + 1];
    for (std::size_t n = 0; n < count; ++n) begin[n + 1] += begin[n];
    member.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t n = 0; n < group.size(); ++n)
      if (group[n] >= 0) member[next[at(group[n])]++] = static_cast<Index>(n);
  }
  std::size_t size(Index group) const { return begin[at(group) + 1] - begin[at(group)]; }
};

class Fit {
 public:
  /// @param per_triangle samples: of a denser target every second, third, ... vertex
  Fit(TriangleSurface& surface, const TriangleSurface& target, std::size_t per_triangle)
      : surface_(surface), longest_edge_m_(kLongestEdge * even_edge_m(surface, surface.triangles.size())) {
    const std::vector<Vec3> normals = target.vertex_normals();
    const std::size_t stride =
        std::max<std::size_t>(1, target.vertices.size() / (per_triangle * surface.triangles.size() + 1));
    for (std::size_t n = 0; n < target.vertices.size(); n += stride)
      samples_.push_back({target.vertices[n], normals[n], Vec3::Zero()});
  }

  void project() {
    const NearestSurface nearest(surface_);
    std::size_t last = 0;  // a good guess: what the sample had before, or its neighbour has
    triangle_.resize(samples_.size(), -1);
    for (std::size_t n = 0; n < samples_.size(); ++n) {
      const NearestSurface::Hit hit = nearest.nearest(samples_[n].place, triangle_[n] < 0 ? last : at(triangle_[n]));
      last = hit.triangle;
      samples_[n].foot = hit.place;
      const bool same_side = hit.normal.dot(samples_[n].normal) > 0;  // of something thin
      triangle_[n] = same_side ? static_cast<Index>(hit.triangle) : -1;
    }
  }

  /// Every vertex by the weighted mean of its samples' residuals, along its normal.
  void move_along_normals() {
    std::vector<Vec3> moments(surface_.vertices.size(), Vec3::Zero());
    std::vector<double> weights(surface_.vertices.size(), 0.0);
    for_shares([&](const Sample& sample, Index vertex, double share) {
      moments[at(vertex)] += share * (sample.place - sample.foot);
      weights[at(vertex)] += share;
    });
    const std::vector<Vec3> normals = surface_.vertex_normals();
    for (std::size_t v = 0; v < normals.size(); ++v)
      if (weights[v] > 0) surface_.vertices[v] += normals[v] * normals[v].dot(moments[v]) / weights[v];
  }

  /// Every vertex to the least-squares meeting point of its samples' planes, as far as its triangles allow.
  void move_to_planes(const CapKeeper& caps) {
    std::vector<Mat3> stiffness(surface_.vertices.size(), Mat3::Zero());
    std::vector<Vec3> pull(surface_.vertices.size(), Vec3::Zero());
    for_shares([&](const Sample& sample, Index vertex, double share) {
      stiffness[at(vertex)] += share * sample.normal * sample.normal.transpose();
      pull[at(vertex)] += share * sample.normal.dot(sample.place - sample.foot) * sample.normal;
    });
    const Groups corners = corners_by_vertex();
    for (std::size_t v = 0; v < stiffness.size(); ++v) {
      const double weight = stiffness[v].trace();
      if (!(weight > 0)) continue;
      Vec3 step = (stiffness[v] + kTether * weight * Mat3::Identity()).ldlt().solve(kOvershoot * pull[v]);
      step *= std::min(1.0, kLongestStep * shortest_edge_m(v, corners) / std::max(step.norm(), 1e-300));
      for (double share = 1; share > kLeastStep; share /= 2) {
        const Vec3 place = caps.kept(v, surface_.vertices[v] + share * step);
        if (!may_move(v, place, corners)) continue;
        surface_.vertices[v] = place;
        break;
      }
    }
  }

  /// Flips every edge that lies across a bend: where the samples of its two triangles come closer by it.
  void flip_edges() {
    const Groups corners = corners_by_vertex(), samples(triangle_, surface_.triangles.size());
    std::vector<std::size_t> valence;
    for (std::size_t v = 0; v < surface_.vertices.size(); ++v) valence.push_back(corners.size(static_cast<Index>(v)));
    std::vector<bool> flipped(surface_.triangles.size(), false);
    std::vector<std::array<Index, 2>> fresh;
    for (const Diamond& d : diamonds()) {
      const auto& [a, b, c, e] = d.corner;
      if (flipped[d.triangle[0]] || flipped[d.triangle[1]] || c == e) continue;
      if (std::min(valence[at(a)], valence[at(b)]) <= kLeastValence) continue;
      if (std::max(valence[at(c)], valence[at(e)]) >= kLargestValence) continue;
      if ((place(c) - place(e)).norm() > longest_edge_m_ || !keeps_shape(d) || joined(c, e, corners)) continue;
      const std::array<Index, 2> edge{std::min(c, e), std::max(c, e)};
      if (std::find(fresh.begin(), fresh.end(), edge) != fresh.end() || !comes_closer(d, samples)) continue;
      surface_.triangles[d.triangle[0]] = {c, a, e};
      surface_.triangles[d.triangle[1]] = {e, b, c};
      flipped[d.triangle[0]] = flipped[d.triangle[1]] = true;
      --valence[at(a)], --valence[at(b)], ++valence[at(c)], ++valence[at(e)];
      fresh.push_back(edge);
    }
  }

 private:
  struct Sample {
    Vec3 place, normal;
    Vec3 foot;  ///< nearest point of the coarse surface
  };

  /// Two triangles and their edge from a to b: (c, a, b) and (e, b, a).
  struct Diamond {
    std::array<Index, 4> corner;  ///< a, b, c, e
    std::array<std::size_t, 2> triangle;
  };

  const Vec3& place(Index vertex) const { return surface_.vertices[at(vertex)]; }
  std::array<Vec3, 3> places(std::size_t triangle) const {
    const auto& [a, b, c] = surface_.triangles[triangle];
    return {place(a), place(b), place(c)};
  }

  /// visit(sample, vertex, share) for the corners of each sample's triangle.
  template <typename Visit>
  void for_shares(Visit visit) const {
    for (std::size_t n = 0; n < samples_.size(); ++n) {
      if (triangle_[n] < 0) continue;
      const Vec3 shares = barycentric(places(at(triangle_[n])), samples_[n].foot);
      for (std::size_t m = 0; m < 3; ++m)
        visit(samples_[n], surface_.triangles[at(triangle_[n])][m], shares[static_cast<Eigen::Index>(m)]);
    }
  }

  /// Corner n of triangle t is number 3 t + n.
  Groups corners_by_vertex() const {
    std::vector<Index> vertex;
    for (const auto& triangle : surface_.triangles) vertex.insert(vertex.end(), triangle.begin(), triangle.end());
    return {vertex, surface_.vertices.size()};
  }

  /// The triangle of a corner, turned so that the corner comes first.
  std::array<Index, 3> from_corner(Index corner) const {
    const auto& t = surface_.triangles[at(corner / 3)];
    const std::size_t n = at(corner % 3);
    return {t[n], t[(n + 1) % 3], t[(n + 2) % 3]};
  }

  double shortest_edge_m(std::size_t vertex, const Groups& corners) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = corners.begin[vertex]; k < corners.begin[vertex + 1]; ++k) {
      const auto [v, next, last] = from_corner(corners.member[k]);
      shortest = std::min(shortest, (place(next) - place(v)).norm());
    }
    return shortest;
  }

  bool may_move(std::size_t vertex, const Vec3& moved, const Groups& corners) const {
    for (std::size_t k = corners.begin[vertex]; k < corners.begin[vertex + 1]; ++k) {
      const auto [v, next, last] = from_corner(corners.member[k]);
      const Vec3 &p = place(v), &q = place(next), &r = place(last);
      const Vec3 before = (q - p).cross(r - p), after = (q - moved).cross(r - moved);
      if (after.dot(before) < kLeastFitTurn * after.norm() * before.norm()) return false;
      if ((q - moved).norm() > std::max(longest_edge_m_, (q - p).norm())) return false;
      if (sharpest(moved, q, r) > std::max(sharpest(p, q, r), least_cosine_)) return false;
    }
    return true;
  }

  bool joined(Index c, Index e, const Groups& corners) const {
    for (std::size_t k = corners.begin[at(c)]; k < corners.begin[at(c) + 1]; ++k) {
      const auto [v, next, last] = from_corner(corners.member[k]);
      if (next == e || last == e) return true;
    }
    return false;
  }

  std::vector<Diamond> diamonds() const {
    struct Side {
      Index low, high, corner;  ///< the corner across the edge
    };
    std::vector<Side> sides;
    for (Index corner = 0; at(corner) < 3 * surface_.triangles.size(); ++corner) {
      const auto [c, a, b] = from_corner(corner);
      sides.push_back({std::min(a, b), std::max(a, b), corner});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
      return std::array{s.low, s.high, s.corner} < std::array{t.low, t.high, t.corner};
    });
    std::vector<Diamond> result;
    for (std::size_t n = 0; n + 1 < sides.size(); n += 2) {
      const auto [c, a, b] = from_corner(sides[n].corner);
      const Index e = from_corner(sides[n + 1].corner)[0];
      result.push_back({{a, b, c, e}, {at(sides[n].corner / 3), at(sides[n + 1].corner / 3)}});
    }
    return result;
  }

  bool keeps_shape(const Diamond& d) const {
    const Vec3 &a = place(d.corner[0]), &b = place(d.corner[1]), &c = place(d.corner[2]), &e = place(d.corner[3]);
    const Vec3 mean = ((a - c).cross(b - c) + (b - e).cross(a - e)).normalized();
    for (const Vec3& normal : {Vec3((a - c).cross(e - c)), Vec3((b - e).cross(c - e))})
      if (normal.dot(mean) < kLeastFlipTurn * normal.norm()) return false;
    const double before = std::max(sharpest(c, a, b), sharpest(e, b, a));
    return std::max(sharpest(c, a, e), sharpest(e, b, c)) <= std::max(before, least_cosine_);
  }

  bool comes_closer(const Diamond& d, const Groups& samples) const {
    const Vec3 &a = place(d.corner[0]), &b = place(d.corner[1]), &c = place(d.corner[2]), &e = place(d.corner[3]);
    double before = 0, after = 0;
    for (const std::size_t triangle : d.triangle)
      for (std::size_t k = samples.begin[triangle]; k < samples.begin[triangle + 1]; ++k) {
        const Vec3& p = samples_[at(samples.member[k])].place;
        const auto off = [&p](const std::array<Vec3, 3>& t) {
          return (p - closest_point_on_triangle(p, t)).squaredNorm();
        };
        before += std::min(off({c, a, b}), off({e, b, a}));
        after += std::min(off({c, a, e}), off({e, b, c}));
      }
    return after < (1 - kLeastGain) * before;
  }

  TriangleSurface& surface_;
  std::vector<Sample> samples_;
  std::vector<Index> triangle_;  ///< that each sample projects onto; -1: none
  double longest_edge_m_;
  double least_cosine_ = std::cos(kLeastFittedAngleDeg * std::numbers::pi / 180);
};

}  // namespace

TriangleSurface fitted(const TriangleSurface& surface, const TriangleSurface& target, int sweeps) {
  TriangleSurface result = surface;
  Fit fit(result, target, kSamplesPerTriangle);
  for (int n = 0; n < sweeps; ++n) {
    fit.project();
    fit.move_along_normals();
  }
  return result;
}

TriangleSurface closely_fitted(const TriangleSurface& surface, const TriangleSurface& target, const CapKeeper& caps,
                               int sweeps) {
  TriangleSurface result = surface;
  Fit fit(result, target, kCloseSamplesPerTriangle);
  for (int n = 0; n < sweeps; ++n) {
    fit.project();
    fit.move_to_planes(caps);
    fit.flip_edges();
  }
  return result;
}

}  // namespace trocar
