#include "tissue/thin/rod_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "tissue/thin/rod_section.h"

namespace trocar {
namespace {

constexpr double kThinnest = 0.6, kWidest = 1.4;  // of the radius, as the rod is stretched

/// Frame of a node: between those of the segments beside it.
Mat3 node_frame(const ElasticRod& rod, std::size_t node) {
  const auto segments = rod.segments();
  const bool before = node > 0 && segments[node - 1].whole, behind = node < segments.size() && segments[node].whole;
  const SegmentFrame& last = segments[behind ? node : node - 1].frame;
  const SegmentFrame& first = segments[before ? node - 1 : node].frame;
  Vec3 t = first.t + last.t;
  t = t.norm() > 1e-6 ? Vec3(t.normalized()) : last.t;
  Vec3 d1 = carried_over(first.d1, first.t, t) + carried_over(last.d1, last.t, t);
  d1 -= d1.dot(t) * t;
  d1 = d1.norm() > 1e-6 ? Vec3(d1.normalized()) : Vec3(t.unitOrthogonal());
  Mat3 R;
  R << d1, t.cross(d1), t;
  return R;
}

/// A rod keeps its volume: thinner where it is longer than drawn.
double thinning(const ElasticRod& rod, std::size_t node) {
  double drawn = 0, now = 0;
  for (const std::size_t i : {node - 1, node}) {
    if (i >= rod.segments().size() || !rod.segments()[i].whole) continue;
    drawn += rod.segments()[i].rest_m * (1 + rod.options().pre_strain);
    now += rod.segments()[i].frame.length_m;
  }
  return now > 0 ? std::clamp(std::sqrt(drawn / now), kThinnest, kWidest) : 1.0;
}

}  // namespace

RodSurface::RodSurface(const ElasticRod& rod, int sides) : sides_(sides), drawn_nodes_(rod.nodes().size()) {
  assert(sides >= 3 && rod.topology() == 0);
  for (const RodNode& node : rod.nodes()) add_ring(node.id);
  join(rod);
  auto rest = std::make_shared<SurfaceSnapshot>();
  rest->triangles = triangles_;
  rest->vertices = outline(rod, nullptr);
  rest_ = surface_ = rest;
  for (const RodNode& node : rod.nodes()) {
    const Ring& ring = rings_[static_cast<std::size_t>(node.id)];
    for (int k = 0; k < sides_; ++k) arcs_[static_cast<std::size_t>(ring.first + k)] = node.arc_m;
    if (ring.centre >= 0) arcs_[static_cast<std::size_t>(ring.centre)] = node.arc_m;
  }
  follow(rod);
}

void RodSurface::add_ring([[maybe_unused]] std::int32_t id) {
  assert(static_cast<std::size_t>(id) == rings_.size());
  rings_.push_back({static_cast<std::int32_t>(arcs_.size())});
  arcs_.resize(arcs_.size() + static_cast<std::size_t>(sides_));
}

void RodSurface::add_centre(std::int32_t id) {
  rings_[static_cast<std::size_t>(id)].centre = static_cast<std::int32_t>(arcs_.size());
  arcs_.push_back(0);
}

void RodSurface::set_strip(std::int32_t from, std::int32_t to) {
  Ring& ring = rings_[static_cast<std::size_t>(from)];
  const std::int32_t a = ring.first, b = rings_[static_cast<std::size_t>(to)].first;
  if (ring.strip < 0) {
    ring.strip = static_cast<std::int32_t>(triangles_.size());
    triangles_.resize(triangles_.size() + 2 * static_cast<std::size_t>(sides_));
  }
  for (std::int32_t k = 0; k < sides_; ++k) {
    const std::int32_t next = (k + 1) % sides_;
    const auto at = static_cast<std::size_t>(ring.strip + 2 * k);
    triangles_[at] = {a + k, a + next, b + k};
    triangles_[at + 1] = {a + next, b + next, b + k};
  }
}

void RodSurface::set_cap(std::int32_t id, bool at_start) {
  Ring& ring = rings_[static_cast<std::size_t>(id)];
  if (ring.cap >= 0) return;
  if (ring.centre < 0) add_centre(id);
  ring.cap = static_cast<std::int32_t>(triangles_.size());
  for (std::int32_t k = 0; k < sides_; ++k) {
    const std::int32_t here = ring.first + k, next = ring.first + (k + 1) % sides_;
    triangles_.push_back({ring.centre, at_start ? next : here, at_start ? here : next});
  }
}

void RodSurface::join(const ElasticRod& rod) {
  for (std::size_t i = 0; i < rod.segments().size(); ++i)
    if (rod.segments()[i].whole) set_strip(rod.nodes()[i].id, rod.nodes()[i + 1].id);
  for (const RodPart& part : rod.parts()) {
    set_cap(rod.nodes()[part.first].id, true);
    set_cap(rod.nodes()[part.last].id, false);
  }
}

void RodSurface::grow(const ElasticRod& rod) {
  added_.clear();
  const auto nodes = rod.nodes();
  std::vector<std::size_t> at(nodes.size());  // index of each id
  for (std::size_t i = 0; i < nodes.size(); ++i) at[static_cast<std::size_t>(nodes[i].id)] = i;
  for (std::size_t id = rings_.size(); id < nodes.size(); ++id) {
    // The nodes beside it when it was made: those of its own cut and later ones were not there yet.
    const auto own = static_cast<std::int32_t>(drawn_nodes_ + 2 * ((id - drawn_nodes_) / 2));
    std::size_t left = at[id], right = at[id];
    while (nodes[left].id >= own) --left;
    while (nodes[right].id >= own) ++right;
    const double share = (nodes[at[id]].arc_m - nodes[left].arc_m) / (nodes[right].arc_m - nodes[left].arc_m);
    add_ring(static_cast<std::int32_t>(id));
    const std::int32_t from = rings_[static_cast<std::size_t>(nodes[left].id)].first;
    const std::int32_t to = rings_[static_cast<std::size_t>(nodes[right].id)].first;
    for (std::int32_t k = 0; k < sides_; ++k) added_.push_back({from + k, to + k, share});
    add_centre(static_cast<std::int32_t>(id));
    added_.push_back({rings_[id].first, rings_[id].first + sides_ / 2, 0.5});
  }
  join(rod);
  const std::size_t before = rest_->vertices.size();
  auto rest = std::make_shared<SurfaceSnapshot>();
  rest->vertices = rest_->vertices;
  for (const VertexOrigin& origin : added_) {
    const Vec3 from = rest->vertices[static_cast<std::size_t>(origin.from)];
    const Vec3 to = rest->vertices[static_cast<std::size_t>(origin.to)];
    rest->vertices.emplace_back(from + origin.share * (to - from));
  }
  arcs_.resize(before);
  grow_values(arcs_, added_);
  rest->triangles = triangles_;
  rest->topology = rest_->topology + 1;
  rest_ = rest;
}

std::vector<Vec3> RodSurface::outline(const ElasticRod& rod, const Lumen* lumen) const {
  std::vector<Vec3> vertices(arcs_.size());
  for (std::size_t i = 0; i < rod.nodes().size(); ++i) {
    const RodNode& node = rod.nodes()[i];
    const Ring& ring = rings_[static_cast<std::size_t>(node.id)];
    const Mat3 R = node_frame(rod, i);
    const Lumen::Shape shape = lumen ? lumen->shape_at(rod, node.arc_m) : Lumen::Shape{};
    const RodSection section = rod_section(rod.options(), shape.flatness);
    const double thin = thinning(rod, i);
    const Vec3 squeezed = std::cos(shape.angle) * R.col(0) + std::sin(shape.angle) * R.col(1);
    const Vec3 wide = R.col(2).cross(squeezed);
    for (int k = 0; k < sides_; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides_ - shape.angle;
      vertices[static_cast<std::size_t>(ring.first + k)] =
          node.position + thin * (section.half_thickness_m * std::cos(angle) * squeezed +
                                  section.half_width_m * std::sin(angle) * wide);
    }
    if (ring.centre >= 0) vertices[static_cast<std::size_t>(ring.centre)] = node.position;
  }
  return vertices;
}

void RodSurface::follow(const ElasticRod& rod, const Lumen* lumen) {
  added_.clear();
  if (rod.topology() != cuts_) grow(rod);
  cuts_ = rod.topology();
  surface_ = moved_surface(rest_, outline(rod, lumen));
}

double RodSurface::arc_of(const MaterialPoint& place) const {
  const auto& corner = triangles_[static_cast<std::size_t>(place.triangle)];
  double arc = 0;
  for (std::size_t c = 0; c < 3; ++c) arc += place.weight[c] * arcs_[static_cast<std::size_t>(corner[c])];
  return arc;
}

}  // namespace trocar
