#include "tissue/mesh/complex/complex_remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tissue/mesh/complex/complex_mesh.h"
#include "tissue/mesh/complex/crossing_guard.h"
#include "tissue/mesh/surface/edge_sizes.h"
#include "tissue/mesh/surface/nearest_surface.h"
#include "tissue/mesh/surface/surface_fit.h"

namespace trocar {
namespace {

using Index = ComplexMesh::Index;
using Kind = ComplexMesh::Kind;
using Pair = std::array<std::int16_t, 2>;

constexpr double kSplitAbove = 4.0 / 3, kCollapseBelow = 4.0 / 5;
constexpr double kMostScale = 1.2;  ///< an organ whose neighbours are finer gets more triangles rather than long edges
constexpr double kLeastAgreement = 0.5, kSpikeCosine = 0.95;
constexpr double kMostStretch = 1.5;  ///< of the edges that mending a sliver leaves

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

bool spike(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = (b - a).normalized(), v = (c - b).normalized(), w = (a - c).normalized();
  return -u.dot(w) > kSpikeCosine || -u.dot(v) > kSpikeCosine || -v.dot(w) > kSpikeCosine;
}

/// One patch of the dense complex, with the sizes that its two organs want at its vertices.
struct Patch {
  TriangleSurface surface;
  std::optional<NearestSurface> tree;
  std::array<std::vector<double>, 2> sizes;  ///< of the first and second region; endless for the rest
};

struct FeatureSegment {
  Vec3 a, b;
};

/// What is projected onto: patches by pair, curves by the pairs that meet in them.
class DenseComplex {
 public:
  DenseComplex(const LabelComplex& dense, const ComplexRemeshOptions& options) {
    std::vector<std::vector<double>> wanted(options.triangles.size() + 1);  // by region, by vertex of the complex
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    for (auto& sizes : wanted) sizes.assign(dense.vertices.size(), kEndless);
    for (std::size_t region = 1; region < wanted.size(); ++region) size_region(dense, options, region, wanted[region]);
    limit_together(dense, wanted);
    collect_patches(dense, wanted);
    collect_curves(dense);
  }

  struct Found {
    Vec3 place, normal;
    std::array<double, 2> sizes;
  };

  Found nearest(const Pair& pair, const Vec3& p) const {
    const Patch& patch = patches_.at(pair);
    const auto hit = patch.tree->nearest(p);
    const auto& t = patch.surface.triangles[hit.triangle];
    std::array<double, 2> sizes{};
    for (std::size_t side = 0; side < 2; ++side)
      for (const Index corner : t) sizes[side] += patch.sizes[side][at(corner)] / 3;
    return {hit.place, hit.normal, sizes};
  }

  Vec3 nearest_on_curve(const std::vector<Pair>& pairs, const Vec3& p) const {
    const auto found = curves_.find(pairs);
    if (found == curves_.end()) return p;
    Vec3 best = p;
    double least = std::numeric_limits<double>::infinity();
    for (const FeatureSegment& s : found->second) {
      const Vec3 along = s.b - s.a;
      const Vec3 q = s.a + along * std::clamp((p - s.a).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
      if ((q - p).squaredNorm() < least) least = (q - p).squaredNorm(), best = q;
    }
    return best;
  }

  const std::map<Pair, Patch>& patches() const { return patches_; }

 private:
  static void size_region(const LabelComplex& dense, const ComplexRemeshOptions& options, std::size_t region,
                          std::vector<double>& wanted) {
    std::vector<Index> source;
    const TriangleSurface border = dense.border(static_cast<int>(region), &source);
    if (border.triangles.empty()) return;
    EdgeSizeOptions sizes;
    sizes.triangles = options.triangles[region - 1], sizes.smoothing_m = options.smoothing_m;
    const std::vector<double> own = edge_sizes(border, sizes);
    for (std::size_t t = 0; t < source.size(); ++t) {
      const auto& original = dense.triangles[at(source[t])];
      const bool turned = dense.regions[at(source[t])][1] == static_cast<std::int16_t>(region);
      for (std::size_t n = 0; n < 3; ++n)
        wanted[at(original[turned && n > 0 ? 3 - n : n])] = own[at(border.triangles[t][n])];
    }
  }

  /// Beside a finer organ an organ becomes finer by and by: short edges of a curve would be the bases of thin
  /// triangles.
  static void limit_together(const LabelComplex& dense, std::vector<std::vector<double>>& wanted) {
    std::vector<double> smallest = wanted[0];
    for (const auto& sizes : wanted)
      for (std::size_t v = 0; v < sizes.size(); ++v) smallest[v] = std::min(smallest[v], sizes[v]);
    limit_growth(smallest, {dense.vertices, dense.triangles}, EdgeSizeOptions{}.growth);
    for (std::size_t region = 1; region < wanted.size(); ++region)
      for (std::size_t v = 0; v < smallest.size(); ++v) wanted[region][v] = std::min(wanted[region][v], smallest[v]);
  }

  void collect_patches(const LabelComplex& dense, const std::vector<std::vector<double>>& wanted) {
    std::map<Pair, std::map<Index, Index>> numbers;
    for (std::size_t t = 0; t < dense.triangles.size(); ++t) {
      const Pair& pair = dense.regions[t];
      Patch& patch = patches_[pair];
      auto triangle = dense.triangles[t];
      for (Index& corner : triangle) {
        const auto [entry, fresh] =
            numbers[pair].try_emplace(corner, static_cast<Index>(patch.surface.vertices.size()));
        if (fresh) {
          patch.surface.vertices.push_back(dense.vertices[at(corner)]);
          for (std::size_t side = 0; side < 2; ++side)
            patch.sizes[side].push_back(wanted[static_cast<std::size_t>(pair[side])][at(corner)]);
        }
        corner = entry->second;
      }
      patch.surface.triangles.push_back(triangle);
    }
    for (auto& [pair, patch] : patches_) patch.tree.emplace(patch.surface);
  }

  void collect_curves(const LabelComplex& dense) {
    const ComplexMesh mesh(dense);
    for (const auto& [a, b] : mesh.edges()) {
      std::vector<Pair> pairs;
      for (const Index t : mesh.around(a, b)) pairs.push_back(mesh.regions(t));
      std::sort(pairs.begin(), pairs.end());
      if (pairs.size() != 2 || pairs[0] != pairs[1]) curves_[pairs].push_back({mesh.place(a), mesh.place(b)});
    }
  }

  std::map<Pair, Patch> patches_;
  std::map<std::vector<Pair>, std::vector<FeatureSegment>> curves_;
};

class ComplexRemesher {
 public:
  ComplexRemesher(const LabelComplex& dense, const ComplexRemeshOptions& options)
      : options_(options),
        source_(dense, options),
        mesh_(dense),
        guard_(dense),
        scale_(options.triangles.size() + 1, 1.0) {
    size_.assign(mesh_.vertices(), 0);
    resize_all();
  }

  LabelComplex run() {
    for (int n = 0; n < options_.rounds; ++n) {
      report(options_.progress, "remeshing together", static_cast<double>(n) / options_.rounds);
      split_long();
      collapse_short();
      flip_all();
      relax();
      if (n + 2 < options_.rounds) rescale();
      resize_all();
    }
    flip_all();
    relax();
    constexpr int kPasses = 3;
    for (int n = 0; n < kPasses; ++n) mend_slivers();
    LabelComplex result = mesh_.compact();
    LabelComplex closer = result;
    for (int n = 0; n < options_.fit_sweeps; ++n) fit(closer);
    move_without_crossing(result, closer.vertices);
    return result;
  }

 private:
  double length(Index a, Index b) const { return (mesh_.place(a) - mesh_.place(b)).norm(); }
  double wanted(Index a, Index b) const { return std::min(size_[at(a)], size_[at(b)]); }

  double scaled(const Pair& pair, const std::array<double, 2>& sizes) const {
    return std::min(scale_[static_cast<std::size_t>(pair[0])] * sizes[0],
                    scale_[static_cast<std::size_t>(pair[1])] * sizes[1]);
  }

  /// The smallest of what the patches round a vertex want.
  double size_at(Index vertex) const {
    double size = std::numeric_limits<double>::infinity();
    std::vector<Pair> pairs;
    for (const Index t : mesh_.fan(vertex))
      if (std::find(pairs.begin(), pairs.end(), mesh_.regions(t)) == pairs.end()) pairs.push_back(mesh_.regions(t));
    for (const Pair& pair : pairs)
      size = std::min(size, scaled(pair, source_.nearest(pair, mesh_.place(vertex)).sizes));
    return size;
  }

  void resize_all() {
    for (std::size_t v = 0; v < mesh_.vertices(); ++v)
      if (mesh_.alive(static_cast<Index>(v))) size_[v] = size_at(static_cast<Index>(v));
  }

  /// Regions with too many triangles get longer edges, and the other way round.
  void rescale() {
    std::vector<double> count(scale_.size(), 0);
    const LabelComplex now = mesh_.compact();
    for (const auto& [low, high] : now.regions)
      ++count[static_cast<std::size_t>(low)], ++count[static_cast<std::size_t>(high)];
    for (std::size_t region = 1; region < scale_.size(); ++region)
      scale_[region] =
          std::clamp(scale_[region] * std::clamp(std::sqrt(count[region] / options_.triangles[region - 1]), 0.8, 1.25),
                     0.6, kMostScale);
  }

  void split_long() {
    for (const auto& [a, b] : mesh_.edges()) {
      if (length(a, b) <= kSplitAbove * wanted(a, b)) continue;
      if (split_clear(a, b)) size_.push_back((size_[at(a)] + size_[at(b)]) / 2);
    }
  }

  void collapse_short() {
    constexpr int kPasses = 12;
    for (int pass = 0; pass < kPasses; ++pass) {
      std::vector<std::pair<double, std::pair<Index, Index>>> todo;
      for (const auto& [a, b] : mesh_.edges())
        if (const double ratio = length(a, b) / wanted(a, b); ratio < kCollapseBelow) todo.push_back({ratio, {a, b}});
      std::sort(todo.begin(), todo.end());
      std::size_t collapsed = 0;
      for (const auto& [ratio, edge] : todo) collapsed += collapse(edge.first, edge.second) ? 1 : 0;
      if (collapsed * 20 < todo.size() || collapsed == 0) break;
    }
  }

  bool collapse(Index a, Index b) {
    if (mesh_.around(a, b).empty() || length(a, b) >= kCollapseBelow * wanted(a, b)) return false;
    const Kind kind_a = mesh_.kind(a), kind_b = mesh_.kind(b);
    if (kind_a == Kind::corner && kind_b == Kind::corner) return false;
    if (kind_a == Kind::curve && kind_b == Kind::curve && in_small_loop(a)) return false;
    if (kind_b > kind_a) return collapse_into(b, a, {mesh_.place(b)});
    if (kind_a > kind_b) return collapse_into(a, b, {mesh_.place(a)});
    return collapse_into(a, b, {(mesh_.place(a) + mesh_.place(b)) / 2, mesh_.place(a), mesh_.place(b)});
  }

  bool collapse_into(Index kept, Index gone, const std::vector<Vec3>& places) {
    bool allowed = false;
    for (const Vec3& place : places) {
      if (!may_move(kept, gone, place) || !may_move(gone, kept, place)) continue;
      if (!allowed && !mesh_.may_collapse(kept, gone)) return false;
      allowed = true;
      if (collapse_clear(kept, gone, as_float(place))) return true;
    }
    return false;
  }

  NumberedTriangle numbered(Index t) const {
    NumberedTriangle result{mesh_.triangle(t), {}};
    for (std::size_t n = 0; n < 3; ++n) result.points[n] = mesh_.place(result.corners[n]);
    return result;
  }

  /// The triangle with another corner, or with the old one elsewhere.
  NumberedTriangle replaced(Index t, Index corner, Index by, const Vec3& place) const {
    NumberedTriangle result = numbered(t);
    for (std::size_t n = 0; n < 3; ++n)
      if (result.corners[n] == corner) result.corners[n] = by, result.points[n] = place;
    return result;
  }

  void tell_guard(const std::vector<Index>& triangles) {
    for (const Index t : triangles) guard_.set(t, numbered(t));
  }

  /// @return whether it was done: nothing would come to cross
  bool collapse_clear(Index kept, Index gone, const Vec3& place) {
    const std::vector<Index> vanish = mesh_.around(kept, gone);
    std::vector<Index> old = mesh_.fan(kept);
    for (const Index t : mesh_.fan(gone))
      if (std::find(vanish.begin(), vanish.end(), t) == vanish.end()) old.push_back(t);
    std::vector<NumberedTriangle> fresh;
    for (const Index t : old) {
      if (std::find(vanish.begin(), vanish.end(), t) != vanish.end()) continue;
      const auto& corners = mesh_.triangle(t);
      const bool of_kept = std::find(corners.begin(), corners.end(), kept) != corners.end();
      fresh.push_back(replaced(t, of_kept ? kept : gone, kept, place));
    }
    if (!guard_.clear(fresh, old)) return false;
    size_[at(kept)] = (size_[at(kept)] + size_[at(gone)]) / 2;
    for (const Index t : vanish) guard_.erase(t);
    mesh_.collapse(kept, gone);
    mesh_.place(kept) = place;
    tell_guard(mesh_.fan(kept));
    return true;
  }

  /// Flips the longest edge of each thin triangle, or takes its shortest one out, where the angles become larger.
  void mend_slivers() {
    for (std::size_t n = 0; n < mesh_.vertices(); ++n) {
      const auto& now = mesh_.fan(static_cast<Index>(n));
      const std::vector<Index> fan = now;
      for (const Index t : fan)
        if (mesh_.triangle(t)[0] == static_cast<Index>(n) && std::find(now.begin(), now.end(), t) != now.end() &&
            sharpest_cosine(numbered(t).points) > kThinCosine)
          mend_sliver(t);
    }
  }

  void mend_sliver(Index t) {
    auto corners = mesh_.triangle(t);  // turned so that the edge from 0 to 1 is the longest one
    for (int n = 0; n < 2; ++n)
      if (length(corners[0], corners[1]) < std::max(length(corners[1], corners[2]), length(corners[2], corners[0])))
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    const auto& [a, b, c] = corners;
    if (flip_sliver(t, a, b, c)) return;
    const Index near = length(a, c) < length(b, c) ? a : b;
    const Kind kind_near = mesh_.kind(near), kind_c = mesh_.kind(c);
    if (kind_near == Kind::corner && kind_c == Kind::corner) return;
    if (kind_near == Kind::curve && kind_c == Kind::curve && in_small_loop(near)) return;
    const bool keep_near = kind_near >= kind_c, keep_c = kind_c >= kind_near;
    if (keep_near && collapse_sliver(near, c)) return;
    if (keep_c) collapse_sliver(c, near);
  }

  bool flip_sliver(Index t, Index a, Index b, Index c) {
    const std::vector<Index> pair = mesh_.around(a, b);
    if (pair.size() != 2 || mesh_.regions(pair[0]) != mesh_.regions(pair[1])) return false;
    const Index other = pair[0] == t ? pair[1] : pair[0], d = mesh_.third(other, a, b);
    const NumberedTriangle first = replaced(t, b, d, mesh_.place(d)), second = replaced(other, a, c, mesh_.place(c));
    const double before = std::max(sharpest_cosine(numbered(t).points), sharpest_cosine(numbered(other).points));
    if (std::max(sharpest_cosine(first.points), sharpest_cosine(second.points)) >= before) return false;
    const Vec3 mean = normal(t) + normal(other);
    if (!agrees(first, mean) || !agrees(second, mean)) return false;
    return flip_clear({t, other}, a, b, c, d);
  }

  bool collapse_sliver(Index kept, Index gone) {
    double before = 0, after = 0;
    for (const Index t : mesh_.fan(gone)) {
      before = std::max(before, sharpest_cosine(numbered(t).points));
      const auto& corners = mesh_.triangle(t);
      if (std::find(corners.begin(), corners.end(), kept) != corners.end()) continue;
      const NumberedTriangle fresh = replaced(t, gone, kept, mesh_.place(kept));
      after = std::max(after, sharpest_cosine(fresh.points));
      if (!agrees(fresh, fan_normal(gone, mesh_.regions(t)))) return false;
      for (const Index corner : corners)
        if (corner != gone &&
            length(corner, kept) > kMostStretch * std::max(wanted(corner, kept), length(corner, gone)))
          return false;
    }
    return after < before && mesh_.may_collapse(kept, gone) && collapse_clear(kept, gone, mesh_.place(kept));
  }

  static bool agrees(const NumberedTriangle& triangle, const Vec3& mean) {
    const Vec3 n = (triangle.points[1] - triangle.points[0]).cross(triangle.points[2] - triangle.points[0]);
    return n.dot(mean) > kLeastAgreement * n.norm() * mean.norm();
  }

  /// @return whether it was done: rounding the middle makes nothing cross
  bool split_clear(Index a, Index b) {
    const auto middle = static_cast<Index>(mesh_.vertices());
    const Vec3 place = as_float((mesh_.place(a) + mesh_.place(b)) / 2);
    const std::vector<Index> old = mesh_.around(a, b);
    std::vector<NumberedTriangle> fresh;
    for (const Index t : old)
      for (const Index end : {a, b}) fresh.push_back(replaced(t, end, middle, place));
    if (!guard_.clear(fresh, old)) return false;
    mesh_.place(mesh_.split(a, b)) = place;
    tell_guard(mesh_.fan(middle));
    return true;
  }

  /// Moves a vertex unless something would come to cross.
  void move_clear(Index v, const Vec3& place) {
    std::vector<NumberedTriangle> fresh;
    for (const Index t : mesh_.fan(v)) fresh.push_back(replaced(t, v, v, place));
    if (!guard_.clear(fresh, mesh_.fan(v))) return;
    mesh_.place(v) = place;
    tell_guard(mesh_.fan(v));
  }

  /// The triangles (a, b, c) and (b, a, d), in either winding, as flip would leave them.
  /// @return whether it was done
  bool flip_clear(const std::vector<Index>& pair, Index a, Index b, Index c, Index d) {
    if (!guard_.clear({replaced(pair[0], b, d, mesh_.place(d)), replaced(pair[1], a, c, mesh_.place(c))}, pair) ||
        !mesh_.flip(a, b))
      return false;
    tell_guard(pair);
    return true;
  }

  Vec3 normal(Index t) const {
    const auto& [a, b, c] = mesh_.triangle(t);
    return (mesh_.place(b) - mesh_.place(a)).cross(mesh_.place(c) - mesh_.place(a));
  }

  /// Sum of the normals of the triangles of one pair round a vertex.
  Vec3 fan_normal(Index vertex, const Pair& pair) const {
    Vec3 sum = Vec3::Zero();
    for (const Index t : mesh_.fan(vertex))
      if (mesh_.regions(t) == pair) sum += normal(t);
    return sum;
  }

  bool may_move(Index moved, Index gone, const Vec3& place) const {
    for (const Index t : mesh_.fan(moved)) {
      const auto& corners = mesh_.triangle(t);
      if (std::find(corners.begin(), corners.end(), gone) != corners.end()) continue;
      std::array<Vec3, 3> old, now;
      for (std::size_t n = 0; n < 3; ++n)
        old[n] = mesh_.place(corners[n]), now[n] = corners[n] == moved ? place : old[n];
      for (const Index corner : corners)
        if (corner != moved &&
            (mesh_.place(corner) - place).norm() > std::max(kSplitAbove * wanted(corner, moved), length(corner, moved)))
          return false;
      const bool sliver = spike(old[0], old[1], old[2]);
      const Vec3 reference = sliver ? fan_normal(moved, mesh_.regions(t)) : normal(t);
      const Vec3 after = (now[1] - now[0]).cross(now[2] - now[0]);
      if (reference.dot(after) < (sliver ? 0.2 : kLeastAgreement) * reference.norm() * after.norm()) return false;
      if (!sliver && spike(now[0], now[1], now[2])) return false;
    }
    return true;
  }

  void flip_all() {
    for (const auto& [a, b] : mesh_.edges()) {
      const auto pair = mesh_.around(a, b);
      if (pair.size() != 2 || mesh_.regions(pair[0]) != mesh_.regions(pair[1])) continue;
      const Index c = mesh_.third(pair[0], a, b), d = mesh_.third(pair[1], a, b);
      const auto off = [&](Index v, int change) {
        const int wanted_valence = mesh_.kind(v) == Kind::patch ? 6 : 4;
        int valence = change - wanted_valence;
        for (const Index t : mesh_.fan(v)) valence += mesh_.regions(t) == mesh_.regions(pair[0]) ? 1 : 0;
        return valence * valence;
      };
      if (off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) >= off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0)) continue;
      if (mesh_.fan(a).size() <= 3 || mesh_.fan(b).size() <= 3) continue;
      if (flip_keeps_shape(normal(pair[0]), normal(pair[1]), pair[0], a, b, c, d)) flip_clear(pair, a, b, c, d);
    }
  }

  bool flip_keeps_shape(const Vec3& n1, const Vec3& n2, Index first, Index a, Index b, Index c, Index d) const {
    const Vec3 &pa = mesh_.place(a), &pb = mesh_.place(b), &pc = mesh_.place(c), &pd = mesh_.place(d);
    const bool slivers = spike(pa, pb, pc) || spike(pb, pa, pd);
    if (!slivers && n1.dot(n2) < 0.7 * n1.norm() * n2.norm()) return false;
    const Vec3 mean = (n1 + n2).normalized();
    // Along the winding of the first triangle the edge runs from a to b, or the other way.
    const double sense = (pb - pa).cross(pc - pa).dot(normal(first)) >= 0 ? 1 : -1;
    const Vec3 m1 = sense * (pd - pc).cross(pb - pc), m2 = sense * (pc - pd).cross(pa - pd);
    return m1.dot(mean) > 0.8 * m1.norm() && m2.dot(mean) > 0.8 * m2.norm() && !spike(pc, pd, pb) && !spike(pd, pc, pa);
  }

  void relax() {
    std::vector<std::pair<Index, Vec3>> moves;
    for (std::size_t n = 0; n < mesh_.vertices(); ++n) {
      const auto v = static_cast<Index>(n);
      if (!mesh_.alive(v)) continue;
      const auto curve = mesh_.curve_neighbours(v);
      if (curve.size() == 2 && in_small_loop(v)) continue;
      if (curve.size() == 2) {
        moves.emplace_back(v, on_curve(v, curve));
      } else if (curve.empty()) {
        const Vec3 wish = relaxed(v);
        const auto found = source_.nearest(mesh_.regions(mesh_.fan(v)[0]), wish);
        if (found.normal.dot(fan_normal(v, mesh_.regions(mesh_.fan(v)[0]))) > 0) moves.emplace_back(v, found.place);
      }
    }
    for (const auto& [v, place] : moves)
      if (!turns_over(v, place)) move_clear(v, as_float(place));
  }

  /// Whether the curve through a vertex closes within five edges: relaxed, such a loop would shrink to a point.
  bool in_small_loop(Index v) const {
    Index previous = v, here = mesh_.curve_neighbours(v)[0];
    constexpr int kFewest = 5;
    for (int n = 1; n < kFewest; ++n) {
      const auto next = mesh_.curve_neighbours(here);
      if (next.size() != 2) return false;
      const Index step = next[0] == previous ? next[1] : next[0];
      previous = here, here = step;
      if (here == v) return true;
    }
    return false;
  }

  Vec3 on_curve(Index v, const std::vector<Index>& curve) const {
    std::vector<Pair> pairs;
    for (const Index t : mesh_.around(v, curve[0])) pairs.push_back(mesh_.regions(t));
    std::sort(pairs.begin(), pairs.end());
    return source_.nearest_on_curve(pairs, (mesh_.place(v) + (mesh_.place(curve[0]) + mesh_.place(curve[1])) / 2) / 2);
  }

  Vec3 relaxed(Index v) const {
    Vec3 sum = Vec3::Zero(), centre = Vec3::Zero();
    double weight = 0;
    for (const Index t : mesh_.fan(v)) {
      const auto& [a, b, c] = mesh_.triangle(t);
      const Vec3 n = normal(t);
      const double size = (size_[at(a)] + size_[at(b)] + size_[at(c)]) / 3, share = n.norm() / (size * size);
      sum += n, weight += share;
      centre += share * (mesh_.place(a) + mesh_.place(b) + mesh_.place(c)) / 3;
    }
    if (!(weight > 0)) return mesh_.place(v);
    const Vec3 step = centre / weight - mesh_.place(v), along = sum.normalized();
    return mesh_.place(v) + step - along * along.dot(step);
  }

  bool turns_over(Index v, const Vec3& place) const {
    int before = 0, after = 0;
    for (const Index t : mesh_.fan(v)) {
      const Vec3 mean = fan_normal(v, mesh_.regions(t));
      std::array<Vec3, 3> p;
      for (std::size_t n = 0; n < 3; ++n) p[n] = mesh_.triangle(t)[n] == v ? place : mesh_.place(mesh_.triangle(t)[n]);
      before += normal(t).dot(mean) <= 0 ? 1 : 0;
      after += (p[1] - p[0]).cross(p[2] - p[0]).dot(mean) <= 0 ? 1 : 0;
    }
    return after > before;
  }

  /// One sweep of the least-squares fit in each patch; curves stay.
  void fit(LabelComplex& complex) const {
    const ComplexMesh mesh(complex);
    for (const auto& [pair, patch] : source_.patches()) {
      TriangleSurface coarse;
      coarse.vertices = complex.vertices;
      for (std::size_t t = 0; t < complex.triangles.size(); ++t)
        if (complex.regions[t] == pair) coarse.triangles.push_back(complex.triangles[t]);
      if (coarse.triangles.empty()) continue;
      const TriangleSurface moved = fitted(coarse, patch.surface, 1);
      for (std::size_t v = 0; v < complex.vertices.size(); ++v)
        if (moved.vertices[v] != coarse.vertices[v] && mesh.kind(static_cast<Index>(v)) == Kind::patch)
          complex.vertices[v] = moved.vertices[v];
    }
  }

  const ComplexRemeshOptions& options_;
  DenseComplex source_;
  ComplexMesh mesh_;
  CrossingGuard guard_;
  std::vector<double> scale_;  ///< by region
  std::vector<double> size_;   ///< by vertex
};

}  // namespace

LabelComplex remeshed(const LabelComplex& dense, const ComplexRemeshOptions& options) {
  return ComplexRemesher(dense, options).run();
}

}  // namespace trocar
