#include "tissue/mesh/surface/remesh.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "tissue/mesh/surface/cgal_mesh.h"
#include "tissue/mesh/surface/nearest_surface.h"

namespace trocar {
namespace {

using Mesh = SurfaceMesh;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;

constexpr int kCollapsePasses = 12;
constexpr double kSplitAbove = 4.0 / 3, kCollapseBelow = 4.0 / 5;
constexpr double kLeastAgreement = 0.5;  ///< cosine that a triangle's normal keeps with its old one
constexpr double kSpikeCosine = 0.95;    ///< a new corner sharper than this (18 degrees) is not made by a collapse

/// The surface that is projected onto, with its sizes.
class Source {
 public:
  Source(const TriangleSurface& surface, const std::vector<double>& sizes)
      : surface_(surface), sizes_(sizes), tree_(surface) {}

  struct Nearest {
    Vec3 place, normal;
    double size;
    std::size_t triangle;
  };

  Nearest nearest(const Vec3& p, std::size_t guess) const {
    const auto [q, normal, triangle] = tree_.nearest(p, guess);
    const auto& t = surface_.triangles[triangle];
    const Vec3 a = vertex(t, 0), b = vertex(t, 1), c = vertex(t, 2);
    const Vec3 shares((b - q).cross(c - q).norm(), (c - q).cross(a - q).norm(), (a - q).cross(b - q).norm());
    const double sum = std::max(shares.sum(), 1e-300);
    double size = 0;
    for (std::size_t n = 0; n < 3; ++n)
      size += shares[static_cast<Eigen::Index>(n)] / sum * sizes_[static_cast<std::size_t>(t[n])];
    return {q, normal, size, triangle};
  }

 private:
  Vec3 vertex(const std::array<std::int32_t, 3>& t, std::size_t n) const {
    return surface_.vertices[static_cast<std::size_t>(t[n])];
  }

  const TriangleSurface& surface_;
  const std::vector<double>& sizes_;
  NearestSurface tree_;
};

class Remesher {
 public:
  Remesher(const TriangleSurface& surface, const std::vector<double>& sizes)
      : source_(surface, sizes),
        mesh_(half_edge_mesh(surface)),
        size_(mesh_.add_property_map<Vertex, double>("v:size", 0).first),
        stamped_(mesh_.add_property_map<Vertex, std::uint32_t>("v:stamped", 0).first) {
    for (const auto v : mesh_.vertices()) size_[v] = sizes[v.idx()];
  }

  void round(double scale) {
    scale_ = scale;
    split_long();
    collapse_short();
    flip();
    relax();
  }
  void polish() {
    flip();
    relax();
  }
  std::size_t triangles() const { return mesh_.number_of_faces(); }
  TriangleSurface result() {
    mesh_.collect_garbage();
    return plain_surface(mesh_);
  }

 private:
  Vec3 at(Vertex v) const { return to_vec(mesh_.point(v)); }
  double wanted(Vertex a, Vertex b) const { return scale_ * std::min(size_[a], size_[b]); }
  double length(Vertex a, Vertex b) const { return (at(a) - at(b)).norm(); }

  std::vector<Mesh::Edge_index> edges() const { return {mesh_.edges().begin(), mesh_.edges().end()}; }

  void split_long() {
    for (const auto edge : edges()) {
      const Halfedge h = mesh_.halfedge(edge);
      const Vertex a = mesh_.source(h), b = mesh_.target(h);
      if (length(a, b) <= kSplitAbove * wanted(a, b)) continue;
      const Vec3 middle = (at(a) + at(b)) / 2;
      const double size = (size_[a] + size_[b]) / 2;
      const Halfedge split = CGAL::Euler::split_edge(h, mesh_);
      const Vertex fresh = mesh_.target(split);
      mesh_.point(fresh) = to_point(middle), size_[fresh] = size;
      CGAL::Euler::split_face(split, mesh_.next(mesh_.next(split)), mesh_);
      const Halfedge opposite = mesh_.prev(mesh_.opposite(split));
      CGAL::Euler::split_face(opposite, mesh_.next(mesh_.next(opposite)), mesh_);
    }
  }

  /// Edges under their wanted length, the shortest against it first.
  std::vector<Mesh::Edge_index> short_edges() const {
    std::vector<std::pair<double, Mesh::Edge_index>> found;
    for (const auto edge : mesh_.edges()) {
      const Halfedge h = mesh_.halfedge(edge);
      const double ratio = length(mesh_.source(h), mesh_.target(h)) / wanted(mesh_.source(h), mesh_.target(h));
      if (ratio < kCollapseBelow) found.emplace_back(ratio, edge);
    }
    std::sort(found.begin(), found.end());
    std::vector<Mesh::Edge_index> result;
    for (const auto& [ratio, edge] : found) result.push_back(edge);
    return result;
  }

  void collapse_short() {
    for (int pass = 0; pass < kCollapsePasses; ++pass) {
      std::size_t collapsed = 0;
      for (const auto edge : short_edges())
        if (!mesh_.is_removed(edge) && collapse(edge)) ++collapsed;
      if (collapsed * 200 < mesh_.number_of_edges()) break;
    }
  }

  /// The link condition of a closed surface: the two ends share the two vertices across the edge and no other.
  /// (CGAL's does_satisfy_link_condition says the same in several times the time.)
  bool keeps_manifold(Vertex a, Vertex b) {
    ++stamp_;
    for (const Vertex v : CGAL::vertices_around_target(a, mesh_)) stamped_[v] = stamp_;
    int common = 0;
    for (const Vertex v : CGAL::vertices_around_target(b, mesh_)) common += stamped_[v] == stamp_ ? 1 : 0;
    return common == 2 && (mesh_.degree(a) > 3 || mesh_.degree(b) > 3);  // both 3: a tetrahedron
  }

  bool collapse(Mesh::Edge_index edge) {
    const Halfedge h = mesh_.halfedge(edge);
    const Vertex a = mesh_.source(h), b = mesh_.target(h);
    if (length(a, b) >= kCollapseBelow * wanted(a, b) || !keeps_manifold(a, b)) return false;
    for (const Vec3& place : {Vec3((at(a) + at(b)) / 2), at(a), at(b)}) {
      if (!may_move(a, b, place) || !may_move(b, a, place)) continue;
      const double size = (size_[a] + size_[b]) / 2;
      const Vertex kept = CGAL::Euler::collapse_edge(edge, mesh_);
      mesh_.point(kept) = to_point(place), size_[kept] = size;
      return true;
    }
    return false;
  }

  /// Whether `moved` may go to `place` (its edge to `gone` vanishes): no long edge, no triangle that turns over, no new
  /// spike. Thin triangles have normals that mean nothing, so the mean of the fan is what the new ones are compared
  /// with.
  bool may_move(Vertex moved, Vertex gone, const Vec3& place) const {
    const Vec3 old = at(moved);
    std::optional<Vec3> mean;  // rarely asked for
    for (const Halfedge h : CGAL::halfedges_around_target(moved, mesh_)) {
      const Vertex from = mesh_.source(h), next = mesh_.target(mesh_.next(h));
      if (from == gone || next == gone) continue;
      const Vec3 p = at(from), q = at(next);
      if ((p - place).norm() > std::max(kSplitAbove * wanted(from, moved), (p - old).norm())) return false;
      const Vec3 before = (q - old).cross(p - old), after = (q - place).cross(p - place);
      const bool sliver = spike(old, p, q);
      if (sliver && !mean) mean = fan_normal(moved);
      const Vec3& reference = sliver ? *mean : before;
      if (reference.dot(after) < (sliver ? 0.2 : kLeastAgreement) * reference.norm() * after.norm()) return false;
      if (!sliver && spike(place, p, q)) return false;
    }
    return true;
  }

  /// Sum of the normals round a vertex, weighted by area.
  Vec3 fan_normal(Vertex v) const {
    Vec3 normal = Vec3::Zero();
    const Vec3 here = at(v);
    for (const Halfedge h : CGAL::halfedges_around_target(v, mesh_))
      normal += (at(mesh_.target(mesh_.next(h))) - here).cross(at(mesh_.source(h)) - here);
    return normal;
  }

  static bool spike(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = (b - a).normalized(), v = (c - b).normalized(), w = (a - c).normalized();
    return -u.dot(w) > kSpikeCosine || -u.dot(v) > kSpikeCosine || -v.dot(w) > kSpikeCosine;
  }

  /// Flips edges where that brings the valences nearer to six, or makes the smallest angle larger without hurting them.
  void flip() {
    for (const auto edge : edges()) {
      const Halfedge h = mesh_.halfedge(edge), o = mesh_.opposite(h);
      const Vertex a = mesh_.source(h), b = mesh_.target(h), c = mesh_.target(mesh_.next(h)),
                   d = mesh_.target(mesh_.next(o));
      if (c == d || mesh_.halfedge(c, d) != Mesh::null_halfedge()) continue;
      const auto off = [&](Vertex v, int change) {
        const int error = static_cast<int>(mesh_.degree(v)) + change - 6;
        return error * error;
      };
      const int before = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0),
                after = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
      if (after >= before || mesh_.degree(a) <= 3 || mesh_.degree(b) <= 3) continue;
      if (flip_keeps_shape(at(a), at(b), at(c), at(d))) CGAL::Euler::flip_edge(h, mesh_);
    }
  }

  /// Of the triangles (a, b, c) and (b, a, d), against (c, d, b) and (d, c, a).
  static bool flip_keeps_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 n1 = (b - a).cross(c - a), n2 = (a - b).cross(d - b), m1 = (d - c).cross(b - c),
               m2 = (c - d).cross(a - d);
    const Vec3 mean = (n1 + n2).normalized();
    const bool slivers = spike(a, b, c) || spike(b, a, d);
    if (!slivers && n1.dot(n2) < 0.7 * n1.norm() * n2.norm()) return false;  // a crease stays
    return m1.dot(mean) > 0.8 * m1.norm() && m2.dot(mean) > 0.8 * m2.norm() && !spike(c, d, b) && !spike(d, c, a);
  }

  /// Towards the centre of the surrounding triangles, weighted by area over wanted area, within the tangent plane; then
  /// onto the source.
  void relax() {
    std::vector<std::pair<Vertex, Vec3>> moves;
    moves.reserve(mesh_.number_of_vertices());
    std::size_t last = 0;  // neighbours follow each other: the last answer is a good guess
    for (const Vertex v : mesh_.vertices()) {
      Vec3 normal = Vec3::Zero(), centre = Vec3::Zero();
      double weight = 0;
      const Vec3 here = at(v);
      for (const Halfedge h : CGAL::halfedges_around_target(v, mesh_)) {
        const Vertex from = mesh_.source(h), next = mesh_.target(mesh_.next(h));
        const Vec3 p = at(from), q = at(next), doubled = (q - here).cross(p - here);
        const double size = (size_[v] + size_[from] + size_[next]) / 3, share = doubled.norm() / (size * size);
        normal += doubled;
        centre += share * (here + p + q) / 3;
        weight += share;
      }
      if (!(weight > 0)) continue;
      normal.normalize();
      const Vec3 step = centre / weight - here;
      const auto found = source_.nearest(here + step - normal * normal.dot(step), last);
      last = found.triangle;
      if (found.normal.dot(normal) > 0) moves.emplace_back(v, found.place), size_[v] = found.size;
    }
    for (const auto& [v, place] : moves)
      if (!turns_over(v, place)) mesh_.point(v) = to_point(place);
  }

  /// Whether more triangles would look against the fan's normal than do now.
  bool turns_over(Vertex v, const Vec3& place) const {
    const Vec3 here = at(v), normal = fan_normal(v);
    int before = 0, after = 0;
    for (const Halfedge h : CGAL::halfedges_around_target(v, mesh_)) {
      const Vec3 p = at(mesh_.source(h)), q = at(mesh_.target(mesh_.next(h)));
      before += (q - here).cross(p - here).dot(normal) <= 0 ? 1 : 0;
      after += (q - place).cross(p - place).dot(normal) <= 0 ? 1 : 0;
    }
    return after > before;
  }

  Source source_;
  Mesh mesh_;
  Mesh::Property_map<Vertex, double> size_;
  Mesh::Property_map<Vertex, std::uint32_t> stamped_;
  std::uint32_t stamp_ = 0;
  double scale_ = 1;
};

}  // namespace

TriangleSurface remeshed(const TriangleSurface& surface, const std::vector<double>& sizes_m,
                         const RemeshOptions& options) {
  if (sizes_m.size() != surface.vertices.size()) throw std::invalid_argument("remeshed: one size a vertex is wanted");
  Remesher remesher(surface, sizes_m);
  double scale = 1;
  for (int n = 0; n < options.rounds; ++n) {
    report(options.progress, "remeshing", static_cast<double>(n) / options.rounds);
    remesher.round(scale);
    const double ratio = static_cast<double>(remesher.triangles()) / std::max(options.triangles, 1);
    if (options.triangles > 0 && n + 2 < options.rounds) scale *= std::clamp(std::sqrt(ratio), 0.8, 1.25);
  }
  for (int n = 0; n < 2; ++n) remesher.polish();
  return remesher.result();
}

}  // namespace trocar
