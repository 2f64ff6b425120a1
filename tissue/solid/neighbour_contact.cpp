#include "tissue/solid/neighbour_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "haptics/exchange/material_point.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kBoxEnough = 0.020;     // m from a neighbour's box, beyond which its own surface is not asked
constexpr double kSeldomFrom = 0.020;    // m from touching, beyond which a vertex is looked at
constexpr std::size_t kSeldomEvery = 4;  // steps: it would have to move at 0.5 m/s
constexpr double kOnSurface = 1e-7;      // m, where the way to the nearest place has no direction
constexpr double kFaceTells = 0.5;       // cosine between a face and the way to it, from which it tells in from out
constexpr double kGrownIn = 0.02;        // share of a neighbour's vertices deep in the organ: it is a part of it

/// The surfaces that share no vertex, by their first triangle.
std::vector<TriangleSurface> separate_pieces(const TriangleSurface& all) {
  const std::vector<std::int32_t> piece = triangle_components(all);
  std::vector<TriangleSurface> pieces;
  const std::int32_t last = piece.empty() ? -1 : *std::max_element(piece.begin(), piece.end());
  for (std::int32_t n = 0; n <= last; ++n) {
    std::vector<bool> of_this(piece.size());
    std::transform(piece.begin(), piece.end(), of_this.begin(), [n](std::int32_t of) { return of == n; });
    pieces.push_back(some_triangles(all, of_this));
  }
  return pieces;
}

/// Twice the vector area of a triangle.
Vec3 twice_area(const std::array<std::int32_t, 3>& triangle, const TriangleSurface& surface) {
  const Vec3& a = surface.vertices[static_cast<std::size_t>(triangle[0])];
  return (surface.vertices[static_cast<std::size_t>(triangle[1])] - a)
      .cross(surface.vertices[static_cast<std::size_t>(triangle[2])] - a);
}

/// The one place of a tie: a vertex on its cell, or by halves on two.
void hang_on(const Lattice& lattice, const Embedding& e, SoftTie& tie) {
  const auto& corners = lattice.cells[static_cast<std::size_t>(e.cell)].corners;
  const auto& others = e.other < 0 ? corners : lattice.cells[static_cast<std::size_t>(e.other)].corners;
  const float own = e.other < 0 ? 1.0F : 0.5F;
  for (std::size_t k = 0; k < 8; ++k) {
    tie.node[k] = corners[k];
    tie.share[k] = own * e.weights[k];
    tie.node[8 + k] = others[k];
    tie.share[8 + k] = (1 - own) * e.weights[k];
  }
}

Vec3 velocity_at(const Lattice& lattice, const Embedding& e, std::span<const Vec3f> velocity) {
  Vec3f sum = Vec3f::Zero();
  const auto add = [&](std::int32_t cell, float share) {
    const auto& corners = lattice.cells[static_cast<std::size_t>(cell)].corners;
    for (std::size_t k = 0; k < 8; ++k) sum += share * e.weights[k] * velocity[static_cast<std::size_t>(corners[k])];
  };
  add(e.cell, e.other < 0 ? 1.0F : 0.5F);
  if (e.other >= 0) add(e.other, 0.5F);
  return sum.cast<double>();
}

}  // namespace

NeighbourContact::NeighbourContact(const TriangleSurface& still_T, const CutLattice& lattice,
                                   const NeighbourOptions& options)
    : options_(options) {
  add_bodies(still_T, *lattice.rest());
  if (!bodies_.empty()) watch(lattice, 0);
}

void NeighbourContact::add_bodies(const TriangleSurface& still_T, const TriangleSurface& organ) {
  const auto made = [](TriangleSurface piece) {
    NearestSurface nearest(piece);
    std::vector<Vec3> normals = piece.vertex_normals();
    const Eigen::AlignedBox3d box = piece.bounds();
    return Body{std::move(piece), std::move(nearest), std::move(normals), box};
  };
  if (still_T.triangles.empty() || organ.triangles.empty()) return;
  const Body own = made(organ);
  for (TriangleSurface& piece : separate_pieces(still_T)) {
    double twice = 0;
    for (const auto& triangle : piece.triangles) twice += twice_area(triangle, piece).norm();
    if (!(piece.volume_m3() > options_.slender_m * twice / 4)) continue;
    std::size_t deep = 0, guess = 0;
    for (const Vec3& vertex : piece.vertices) {
      if (!own.box.contains(vertex)) continue;
      const Foot foot = foot_on(own, vertex, guess);
      guess = foot.triangle;
      deep += foot.gap_m < -options_.deep_m ? 1 : 0;
    }
    if (static_cast<double>(deep) > kGrownIn * static_cast<double>(piece.vertices.size())) continue;
    bodies_.push_back(made(std::move(piece)));
  }
}

NeighbourContact::Foot NeighbourContact::foot_on(const Body& body, const Vec3& place, std::size_t guess) {
  const NearestSurface::Hit hit = body.nearest.nearest(place, guess < body.surface.triangles.size() ? guess : 0);
  const Vec3 way = place - hit.place;
  const double distance = way.norm();
  Vec3 normal = hit.normal.normalized();
  double along = normal.dot(way);
  if (std::abs(along) < kFaceTells * distance) {  // beside a sharp edge: what the vertices say together
    std::array<Vec3, 3> corner, smooth;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(body.surface.triangles[hit.triangle][k]);
      corner[k] = body.surface.vertices[v];
      smooth[k] = body.normal[v];
    }
    along = interpolate(barycentric_of(hit.place, corner), smooth).dot(way);
  }
  const double side = along < 0 ? -1 : 1;
  if (distance > kOnSurface) normal = side / distance * way;
  return {side * distance, normal, hit.triangle};
}

void NeighbourContact::find_rings(const TriangleSurface& rest) {
  first_round_.assign(rest.vertices.size() + 1, 0);
  for (const auto& triangle : rest.triangles)
    for (const std::int32_t v : triangle) ++first_round_[static_cast<std::size_t>(v) + 1];
  std::partial_sum(first_round_.begin(), first_round_.end(), first_round_.begin());
  round_.resize(first_round_.back());
  std::vector<std::size_t> next(first_round_.begin(), first_round_.end() - 1);
  for (std::size_t t = 0; t < rest.triangles.size(); ++t)
    for (const std::int32_t v : rest.triangles[t])
      round_[next[static_cast<std::size_t>(v)]++] = static_cast<std::int32_t>(t);
}

void NeighbourContact::watch(const CutLattice& lattice, std::size_t first) {
  const TriangleSurface& rest = *lattice.rest();
  find_rings(rest);
  watched_.resize(rest.vertices.size());
  for (Watched& watched : watched_) watched.area_m2 = 0;
  for (const auto& triangle : rest.triangles) {
    const double area = twice_area(triangle, rest).norm() / 6;
    for (const std::int32_t v : triangle) watched_[static_cast<std::size_t>(v)].area_m2 += area;
  }
  std::size_t guess = 0;
  for (std::size_t v = first; v < watched_.size(); ++v) {
    Watched& watched = watched_[v];
    watched.seen = rest.vertices[v];
    watched.clear_m = kInfinite;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const double off = bodies_[b].box.exteriorDistance(watched.seen);
      if (off > kBoxEnough) {
        watched.clear_m = std::min(watched.clear_m, off);
        continue;
      }
      const Foot foot = foot_on(bodies_[b], watched.seen, guess);
      watched.guess = guess = foot.triangle;
      if (foot.gap_m < 0) crossing_[{v, b}] = foot.gap_m < -options_.deep_m ? -kInfinite : foot.gap_m;
      watched.clear_m = std::min(watched.clear_m, foot.gap_m - begins_m(v, b));
    }
  }
}

double NeighbourContact::begins_m(std::size_t vertex, std::size_t body) const {
  const auto crossed = crossing_.find({vertex, body});
  return (crossed == crossing_.end() ? 0 : crossed->second) - options_.slack_m;
}

void NeighbourContact::follow_cut(const CutLattice& lattice) {
  if (!bodies_.empty()) watch(lattice, watched_.size());
}

double NeighbourContact::carry(const Vec3& shift_T) {
  const Vec3 further = shift_T - shift_;
  shift_ = shift_T;
  double work = 0;
  for (Pressed& pressed : pressed_) {
    const double before = std::max(0.0, pressed.depth_m);
    pressed.depth_m += pressed.normal.dot(further);
    const double after = std::max(0.0, pressed.depth_m);
    work += pressed.stiffness * (after * after - before * before) / 2;
  }
  return work;
}

bool NeighbourContact::faces_away(std::size_t vertex, const Vec3& normal, const TriangleSurface& surface) const {
  Vec3 own = Vec3::Zero();
  for (std::size_t i = first_round_[vertex]; i < first_round_[vertex + 1]; ++i)
    own += twice_area(surface.triangles[static_cast<std::size_t>(round_[i])], surface);
  return own.dot(normal) > options_.facing_cosine * own.norm();
}

void NeighbourContact::look(std::size_t vertex, const Vec3& place, const Vec3& ahead, const Lattice& lattice,
                            const TriangleSurface& surface, std::vector<SoftTie>& ties) {
  ++looked_at_;
  Watched& watched = watched_[vertex];
  watched.seen = place;
  watched.clear_m = kInfinite;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const double off = bodies_[b].box.exteriorDistance(place);
    if (off > kBoxEnough) {
      watched.clear_m = std::min(watched.clear_m, off);
      continue;
    }
    const Foot foot = foot_on(bodies_[b], place, watched.guess);
    watched.guess = foot.triangle;
    const double depth = (foot.gap_m < 0 ? begins_m(vertex, b) : -options_.slack_m) - foot.gap_m;
    watched.clear_m = std::min(watched.clear_m, std::max(0.0, -depth));
    if (!(depth + std::max(0.0, -ahead.dot(foot.normal)) > 0) || faces_away(vertex, foot.normal, surface)) continue;
    const double stiffness = options_.stiffness_pa_per_m * watched.area_m2;
    SoftTie& tie = ties.emplace_back();
    hang_on(lattice, lattice.embedding[vertex], tie);
    tie.normal = foot.normal.cast<float>();
    tie.along_n_per_m = static_cast<float>(stiffness);
    tie.force_n = (stiffness * depth * foot.normal).cast<float>();
    pressed_.push_back({foot.normal, stiffness, depth});
  }
}

void NeighbourContact::press(const CutLattice& lattice, const SurfaceSnapshot& surface, SoftSolid& solid) {
  first_tie_ = solid.ties().size();
  pressed_.clear();
  looked_at_ = 0;
  ++looks_;
  const double step_s = solid.options().step_s;
  float fastest = 0;
  for (const Vec3f& velocity : solid.velocity()) fastest = std::max(fastest, velocity.squaredNorm());
  const double furthest = step_s * std::sqrt(static_cast<double>(fastest));
  for (std::size_t v = 0; v < watched_.size(); ++v) {
    const Watched& watched = watched_[v];
    if (watched.clear_m > kSeldomFrom && (looks_ + v) % kSeldomEvery != 0) continue;
    const Vec3 place = surface.vertices[v] - shift_;
    const double left = watched.clear_m - (place - watched.seen).norm();
    if (left > furthest) continue;
    const Vec3 ahead = step_s * velocity_at(lattice.lattice(), lattice.lattice().embedding[v], solid.velocity());
    if (left > ahead.norm()) continue;
    look(v, place, ahead, lattice.lattice(), surface, solid.ties());
  }
}

void NeighbourContact::bear(const SoftSolid& solid) {
  touching_ = 0;
  energy_ = 0;
  force_ = Vec3::Zero();
  for (std::size_t i = 0; i < pressed_.size(); ++i) {
    Pressed& pressed = pressed_[i];
    const double force = solid.ties()[first_tie_ + i].force_n.cast<double>().dot(pressed.normal);
    pressed.depth_m = force / pressed.stiffness;
    force_ += force * pressed.normal;
    if (!(force > 0)) continue;
    energy_ += force * pressed.depth_m / 2;
    ++touching_;
  }
}

}  // namespace trocar
