#include "tissue/mesh/surface/cut_tracing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "haptics/contact/segment_triangle.h"

namespace trocar {
namespace {

using Vec2 = Eigen::Vector2d;
using Edge = std::pair<std::int32_t, std::int32_t>;  // lower vertex first

constexpr double kLeastShare = 0.02;    // of an edge from its ends, where a line may cross it
constexpr double kEndRoom = 0.15;       // the same of an end on the way through its triangle
constexpr double kNearMiss = 0.003;     // m from the outline, at which a lone crossing still counts
constexpr double kLeastSideways = 0.3;  // share of the surface's normal that lies in the blade's plane
constexpr std::size_t kMostCrossings = 64;

struct LineCrossing {
  std::array<std::int32_t, 2> triangle{-1, -1};
  double share = 0;  ///< from the edge's lower vertex
  Vec2 place = Vec2::Zero();
  bool inside = false;
};

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// How far beyond the outline's farthest-out side; <= 0 inside.
double outside_by(const std::vector<Vec2>& outline, const Vec2& p) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i], along = (outline[(i + 1) % outline.size()] - a).normalized();
    most = std::max(most, cross(p - a, along));
  }
  return most;
}
/// From a point of the outline's inside along a unit direction to its edge.
double way_out(const std::vector<Vec2>& outline, const Vec2& p, const Vec2& direction) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i], along = (outline[(i + 1) % outline.size()] - a).normalized();
    const double approach = cross(direction, along);
    if (approach > 1e-9) least = std::min(least, std::max(0.0, -cross(p - a, along) / approach));
  }
  return std::isfinite(least) ? least : 0;
}

/// The section of a surface with the blade's plane, near the blade.
class Section {
 public:
  Section(const TriangleSurface& now, const Blade& blade, const CutTracingOptions& options)
      : now_(now), blade_(blade), options_(options) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& corner : blade.outline) middle += corner / static_cast<double>(blade.outline.size());
    double reach = 0;
    for (const Vec2& corner : blade.outline) reach = std::max(reach, (corner - middle).norm());
    const Vec3 centre = blade.X_TB * Vec3(0, middle.x(), middle.y());
    const Pose X_BT = blade.X_TB.inverse();
    for (std::size_t t = 0; t < now.triangles.size(); ++t) {
      std::array<Vec3, 3> at;
      for (std::size_t k = 0; k < 3; ++k) at[k] = now.vertices[static_cast<std::size_t>(now.triangles[t][k])];
      const double size = std::max((at[1] - at[0]).norm(), (at[2] - at[0]).norm());
      if ((at[0] - centre).norm() > 2 * reach + size + kNearMiss) continue;
      for (Vec3& corner : at) corner = X_BT * corner;
      for (std::size_t k = 0; k < 3; ++k) meet(static_cast<std::int32_t>(t), k, at);
    }
    for (const auto& [edge, crossing] : crossings_)
      for (const std::int32_t t : crossing.triangle)
        if (t >= 0) edges_[t].push_back(edge);
  }

  TracedCut trace() const {
    TracedCut out;
    const std::optional<Edge> seed = find_seed();
    if (!seed) return out;
    // From the seed one way to the line's beginning, and from there back to its end.
    Line line;
    line.edges = {*seed};
    line.triangles = {crossings_.at(*seed).triangle[0]};
    extend(line);
    std::reverse(line.edges.begin(), line.edges.end());
    std::reverse(line.triangles.begin(), line.triangles.end());
    line.triangles.push_back(crossings_.at(*seed).triangle[1]);
    extend(line);
    out.refusal = judge(line);
    if (out.refusal == CutRefusal::kNone) describe(line, out);
    return out;
  }

 private:
  /// triangles[i] lies before edges[i], triangles.back() behind the last.
  struct Line {
    std::vector<Edge> edges;
    std::vector<std::int32_t> triangles;
  };

  void meet(std::int32_t triangle, std::size_t k, const std::array<Vec3, 3>& at) {
    const std::size_t next = (k + 1) % 3;
    if ((at[k].x() < 0) == (at[next].x() < 0)) return;
    const auto& corners = now_.triangles[static_cast<std::size_t>(triangle)];
    const bool ordered = corners[k] < corners[next];
    const std::size_t low = ordered ? k : next, high = ordered ? next : k;
    LineCrossing& crossing = crossings_[{corners[low], corners[high]}];
    if (crossing.triangle[0] >= 0) {
      crossing.triangle[1] = triangle;
      return;
    }
    crossing.triangle[0] = triangle;
    const double exact = at[low].x() / (at[low].x() - at[high].x());
    crossing.share = std::clamp(exact, kLeastShare, 1 - kLeastShare);
    const Vec3 place = at[low] + exact * (at[high] - at[low]);
    crossing.place = {place.y(), place.z()};
    crossing.inside = outside_by(blade_.outline, crossing.place) <= 0;
  }

  /// The crossing that lies deepest in the outline; else the one nearest to it.
  std::optional<Edge> find_seed() const {
    std::optional<Edge> best;
    double least = kNearMiss;
    for (const auto& [edge, crossing] : crossings_) {
      const double outside = outside_by(blade_.outline, crossing.place);
      if (crossing.triangle[1] < 0 || outside >= least) continue;
      least = outside;
      best = edge;
    }
    return best;
  }

  Edge other_edge(std::int32_t triangle, const Edge& edge) const {
    for (const Edge& e : edges_.at(triangle))
      if (e != edge) return e;
    return edge;
  }

  void extend(Line& line) const {
    // The last triangle is where the line stands; it goes on over that one's other edge as long as that lies inside.
    std::set<std::int32_t> seen(line.triangles.begin(), line.triangles.end());
    while (line.edges.size() < kMostCrossings) {
      const std::int32_t here = line.triangles.back();
      const Edge next = other_edge(here, line.edges.back());
      const LineCrossing& crossing = crossings_.at(next);
      if (!crossing.inside || crossing.triangle[1] < 0) return;
      const std::int32_t beyond = crossing.triangle[crossing.triangle[0] == here ? 1 : 0];
      if (!seen.insert(beyond).second) return;
      line.edges.push_back(next);
      line.triangles.push_back(beyond);
    }
  }

  CutRefusal judge(const Line& line) const {
    if (std::set<std::int32_t>(line.triangles.begin(), line.triangles.end()).size() != line.triangles.size())
      return CutRefusal::kNothingThere;
    for (const std::int32_t t : line.triangles) {
      const auto& [a, b, c] = now_.triangles[static_cast<std::size_t>(t)];
      const double longest = std::max({(at(a) - at(b)).norm(), (at(b) - at(c)).norm(), (at(c) - at(a)).norm()});
      if (longest < options_.least_edge_m) return CutRefusal::kTooFine;
    }
    return CutRefusal::kNone;
  }

  const Vec3& at(std::int32_t vertex) const { return now_.vertices[static_cast<std::size_t>(vertex)]; }
  Vec3 place_of(const Edge& edge) const {
    return at(edge.first) + crossings_.at(edge).share * (at(edge.second) - at(edge.first));
  }

  /// The point within a first or last triangle at which the line runs out.
  MaterialPoint run_out(std::int32_t triangle, const Edge& edge) const {
    const LineCrossing& in = crossings_.at(edge);
    const Edge beyond = other_edge(triangle, edge);
    const LineCrossing& out = crossings_.at(beyond);
    double share = in.inside ? 1 : kEndRoom;
    const double a = outside_by(blade_.outline, in.place), b = outside_by(blade_.outline, out.place);
    if (in.inside && b > 0) share = -a / (b - a);
    share = std::clamp(share, kEndRoom, 1 - kEndRoom);
    const Vec3 from = place_of(edge), to = place_of(beyond);
    const auto& [i, j, k] = now_.triangles[static_cast<std::size_t>(triangle)];
    return {triangle, barycentric_of(from + share * (to - from), {at(i), at(j), at(k)})};
  }

  void describe(const Line& line, TracedCut& out) const {
    // The line leaves a triangle over an edge that there runs from right to left.
    Vec3 normal = Vec3::Zero();
    for (const std::int32_t t : line.triangles) {
      const auto& [a, b, c] = now_.triangles[static_cast<std::size_t>(t)];
      normal += (at(b) - at(a)).cross(at(c) - at(a));
    }
    const Vec3 normal_B = blade_.X_TB.R.transpose() * normal.normalized();
    Vec2 inward(-normal_B.y(), -normal_B.z());
    if (inward.norm() < kLeastSideways) return void(out.refusal = CutRefusal::kNothingThere);
    inward.normalize();
    const Vec3 inward_T = blade_.X_TB.R * Vec3(0, inward.x(), inward.y());
    out.cut.begin = run_out(line.triangles.front(), line.edges.front());
    out.cut.end = run_out(line.triangles.back(), line.edges.back());
    const auto end_place = [&](const MaterialPoint& p) {
      const auto& [a, b, c] = now_.triangles[static_cast<std::size_t>(p.triangle)];
      return interpolate(p.weight, {at(a), at(b), at(c)});
    };
    std::vector<double> along{0};
    std::vector<Vec3> places{end_place(out.cut.begin)};
    for (const Edge& edge : line.edges) places.push_back(place_of(edge));
    places.push_back(end_place(out.cut.end));
    for (std::size_t i = 1; i < places.size(); ++i) along.push_back(along.back() + (places[i] - places[i - 1]).norm());
    out.length_m = along.back();
    double before = 0;
    for (std::size_t i = 0; i < line.edges.size(); ++i) {
      const LineCrossing& crossing = crossings_.at(line.edges[i]);
      const double to_end = std::min(along[i + 1], along.back() - along[i + 1]);
      const double depth = (crossing.inside ? way_out(blade_.outline, crossing.place, inward) : 0) +
                           options_.bite_m * std::min(1.0, to_end / options_.taper_m);
      CutCrossing made;
      const auto& corners = now_.triangles[static_cast<std::size_t>(line.triangles[i])];
      const auto& [low, high] = line.edges[i];
      bool rises = false;  // in that triangle the edge runs from low to high
      for (std::size_t k = 0; k < 3; ++k) rises |= corners[k] == low && corners[(k + 1) % 3] == high;
      made.left = rises ? high : low;
      made.right = rises ? low : high;
      made.share = rises ? 1 - crossing.share : crossing.share;
      made.triangle = line.triangles[i + 1];
      made.depth_m = depth * inward_T;
      made.gape_m = std::min(options_.most_gape_m, options_.gape_per_depth * depth);
      out.cut.crossings.push_back(made);
      out.depth_m = std::max(out.depth_m, depth);
      out.area_m2 += (depth + before) / 2 * (along[i + 1] - along[i]);
      out.middle_T += places[i + 1] / static_cast<double>(line.edges.size());
      before = depth;
    }
    out.area_m2 += before / 2 * (along.back() - along[along.size() - 2]);
    if (out.depth_m < options_.least_depth_m) out.refusal = CutRefusal::kTooShallow;
  }

  const TriangleSurface& now_;
  const Blade& blade_;
  const CutTracingOptions& options_;
  std::map<Edge, LineCrossing> crossings_;
  std::map<std::int32_t, std::vector<Edge>> edges_;  ///< crossed ones of a triangle
};

}  // namespace

Blade scissor_blade(const Pose& X_TI, double length_m, double opening_m) {
  return {X_TI, {{0, -length_m}, {opening_m / 2, 0}, {-opening_m / 2, 0}}};
}

Blade track_blade(const Vec3& from_T, const Vec3& to_T, const Vec3& inward_T, double depth_m, double above_m) {
  const Vec3 along = (to_T - from_T) - (to_T - from_T).dot(inward_T) * inward_T;
  const double length = along.norm();
  if (!(length > 0)) return {};
  Pose X_TB;
  X_TB.R.col(1) = along / length;
  X_TB.R.col(2) = inward_T;
  X_TB.R.col(0) = X_TB.R.col(1).cross(X_TB.R.col(2));
  X_TB.p = from_T;
  return {X_TB, {{0, -above_m}, {length, -above_m}, {length, depth_m}, {0, depth_m}}};
}

std::string_view refusal_words(CutRefusal refusal) {
  switch (refusal) {
    case CutRefusal::kNone:
      return "cut";
    case CutRefusal::kNothingThere:
      return "no tissue between the blades";
    case CutRefusal::kTooShallow:
      return "the blades only touch the surface";
    case CutRefusal::kTooFine:
      return "cut to shreds here already";
    case CutRefusal::kThrough:
      return "the cut would go through the organ";
    case CutRefusal::kPieceOff:
      return "the cut would take a piece off";
    case CutRefusal::kNoWound:
      return "no wound between the jaws";
    case CutRefusal::kBesideCut:
      return "too close to a cut, begin at its end";
  }
  return "?";
}

bool runs_beside_wound(const TriangleSurface& now, const std::vector<bool>& inside, const SurfaceCut& cut,
                       double least_strip_m) {
  constexpr double kOnIt = 1e-4;     // m
  constexpr double kSideways = 0.5;  // share of the way to a wound that lies along the line, at most
  const auto at = [&](std::int32_t vertex) { return now.vertices[static_cast<std::size_t>(vertex)]; };
  std::vector<Vec3> line;
  Vec3 middle = Vec3::Zero();
  for (const CutCrossing& c : cut.crossings) {
    line.push_back(at(c.left) + c.share * (at(c.right) - at(c.left)));
    middle += line.back() / static_cast<double>(cut.crossings.size());
  }
  double reach = least_strip_m;
  for (const Vec3& place : line) reach = std::max(reach, least_strip_m + (place - middle).norm());
  std::vector<std::array<Vec3, 3>> walls;
  for (std::size_t t = 0; t < inside.size(); ++t) {
    if (!inside[t]) continue;
    const auto& [a, b, c] = now.triangles[t];
    const std::array<Vec3, 3> corners{at(a), at(b), at(c)};
    if ((closest_point_on_triangle(middle, corners) - middle).norm() < reach) walls.push_back(corners);
  }
  std::size_t beside = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (walls.empty() || line.size() < 2 || inside[static_cast<std::size_t>(cut.crossings[i].triangle)]) continue;
    const Vec3 along = (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    beside += std::any_of(walls.begin(), walls.end(), [&](const std::array<Vec3, 3>& wall) {
      const Vec3 way = closest_point_on_triangle(line[i], wall) - line[i];
      const double far = way.norm();
      return far > kOnIt && far < least_strip_m && std::abs(way.dot(along)) < kSideways * far;
    });
  }
  return 2 * beside > line.size();
}

TracedCut trace_cut(const TriangleSurface& now, const Blade& blade, const CutTracingOptions& options) {
  if (blade.outline.size() < 3) return {};
  return Section(now, blade, options).trace();
}

}  // namespace trocar
