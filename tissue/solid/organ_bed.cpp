#include "tissue/solid/organ_bed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "haptics/contact/segment_triangle.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kLooks = 0.012;      // m from the nearest vertex of part 0: beyond, nothing touches
constexpr double kMayTouch = 0.005;   // m of a gap that may close within
constexpr std::size_t kFarEvery = 4;  // steps, between which others are looked at
constexpr double kLeastGap = -0.003;  // m of surfaces that interpenetrate at rest
constexpr float kRamp = 1e-3F;        // of a tie's stiffness, below which it is left out

std::array<Vec3, 3> corners_in(const std::array<std::int32_t, 3>& triangle, const TriangleSurface& surface) {
  return {surface.vertices[static_cast<std::size_t>(triangle[0])],
          surface.vertices[static_cast<std::size_t>(triangle[1])],
          surface.vertices[static_cast<std::size_t>(triangle[2])]};
}

Vec3 normal_of(const std::array<Vec3, 3>& corner) {
  const Vec3 twice = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double length = twice.norm();
  return length > 0 ? Vec3(twice / length) : Vec3::UnitZ();
}

/// The one place by its cell, the other against it.
void set_places(const Lattice& lattice, const Embedding& one, const Embedding& other, SoftTie& tie) {
  for (std::size_t k = 0; k < 8; ++k) {
    tie.node[k] = lattice.cells[static_cast<std::size_t>(one.cell)].corners[k];
    tie.share[k] = one.weights[k];
    tie.node[8 + k] = lattice.cells[static_cast<std::size_t>(other.cell)].corners[k];
    tie.share[8 + k] = -other.weights[k];
  }
}

double off_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double length = way.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0;
  return (p - a - share * way).norm();
}

}  // namespace

OrganBed::OrganBed(const CutLattice& lattice, const BedOptions& options, double young_pa) : options_(options) {
  if (!(options.strength_pa > 0 && options.energy_j_per_m2 > 0 && options.shear_energy > 0 && options.release_s > 0))
    throw InputError("a bed needs a strength, an energy, their share in shear and a time of release above 0");
  const double energy = options.energy_j_per_m2, edge = lattice.lattice().cell_m;
  strength_ = std::min(options.strength_pa, std::sqrt(young_pa * energy / edge));
  energy_per_m2_ = energy - strength_ * strength_ * edge / (2 * young_pa);
  find_rings(*lattice.rest());
  find_touchers(lattice);
  find_links(lattice);
  if (links_.empty()) throw InputError("the two organs do not face each other: there is no bed between them");
  hang_links(lattice);
}

double OrganBed::stiffness() const { return 2 * strength_ * strength_ / energy_per_m2_; }

double OrganBed::left_at(double way_m) const {
  const double peak = strength_ / stiffness(), end = 2 * energy_per_m2_ / strength_;
  return std::clamp((end - way_m) / (end - peak), 0.0, 1.0);
}

double OrganBed::way(const Vec3f& apart, const Vec3f& normal) const {
  const double opening = static_cast<double>(apart.dot(normal));
  const double sliding = static_cast<double>(apart.squaredNorm()) - opening * opening;
  const double opened = std::max(0.0, opening);
  return std::sqrt(opened * opened + std::max(0.0, sliding) / options_.shear_energy);
}

double OrganBed::next_hold(const Link& link, double furthest_m, double step_s) const {
  return std::min(link.holds, std::max(left_at(furthest_m), link.holds - step_s / options_.release_s));
}

double OrganBed::damage(const Link& link, double holds, double furthest_m) const {
  const double bears = holds * strength_ / (stiffness() * furthest_m);
  return std::clamp(1 - bears, link.damage, 1.0);
}

void OrganBed::find_rings(const TriangleSurface& rest) {
  first_round_.assign(rest.vertices.size() + 1, 0);
  for (const auto& triangle : rest.triangles)
    for (const std::int32_t v : triangle) ++first_round_[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) first_round_[v + 1] += first_round_[v];
  round_.resize(first_round_.back());
  std::vector<std::size_t> next(first_round_.begin(), first_round_.end() - 1);
  for (std::size_t t = 0; t < rest.triangles.size(); ++t)
    for (const std::int32_t v : rest.triangles[t])
      round_[next[static_cast<std::size_t>(v)]++] = static_cast<std::int32_t>(t);
}

void OrganBed::find_touchers(const CutLattice& lattice) {
  const SurfaceSnapshot& rest = *lattice.rest();
  std::vector<std::int32_t> below;
  for (std::size_t v = 0; v < rest.vertices.size(); ++v)
    if (lattice.part_of(static_cast<std::int32_t>(v)) == 0) below.push_back(static_cast<std::int32_t>(v));
  const std::size_t known = touchers_.size();
  for (std::size_t v = known == 0 ? 0 : static_cast<std::size_t>(touchers_.back().vertex) + 1; v < rest.vertices.size();
       ++v) {
    if (lattice.part_of(static_cast<std::int32_t>(v)) != 1) continue;
    Toucher& made = touchers_.emplace_back();
    made.vertex = static_cast<std::int32_t>(v);
    made.nearest = *std::min_element(below.begin(), below.end(), [&](std::int32_t a, std::int32_t b) {
      return (rest.vertices[static_cast<std::size_t>(a)] - rest.vertices[v]).squaredNorm() <
             (rest.vertices[static_cast<std::size_t>(b)] - rest.vertices[v]).squaredNorm();
    });
    made.begins_m = std::clamp(foot_round(made.nearest, rest.vertices[v], rest).gap_m, kLeastGap, options_.contact_m);
  }
  for (Toucher& toucher : touchers_) {
    const auto v = static_cast<std::size_t>(toucher.vertex);
    toucher.area_m2 = 0;
    for (std::size_t i = first_round_[v]; i < first_round_[v + 1]; ++i) {
      const auto corner = corners_in(rest.triangles[static_cast<std::size_t>(round_[i])], rest);
      toucher.area_m2 += (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm() / 6;
    }
  }
}

OrganBed::Foot OrganBed::foot_round(std::int32_t vertex, const Vec3& place, const TriangleSurface& surface) const {
  Foot foot;
  double least = std::numeric_limits<double>::infinity();
  const auto v = static_cast<std::size_t>(vertex);
  for (std::size_t i = first_round_[v]; i < first_round_[v + 1]; ++i) {
    const auto corner = corners_in(surface.triangles[static_cast<std::size_t>(round_[i])], surface);
    const Vec3 there = closest_point_on_triangle(place, corner);
    const double distance = (there - place).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    foot = {round_[i], there, normal_of(corner), barycentric_of(there, corner), 0};
  }
  foot.gap_m = foot.normal.dot(place - foot.place);
  return foot;
}

void OrganBed::find_links(const CutLattice& lattice) {
  const SurfaceSnapshot& rest = *lattice.rest();
  const std::vector<Vec3> normals = rest.vertex_normals();
  for (const Toucher& toucher : touchers_) {
    const Vec3& place = rest.vertices[static_cast<std::size_t>(toucher.vertex)];
    const Foot foot = foot_round(toucher.nearest, place, rest);
    if ((foot.place - place).norm() > options_.reach_m ||
        foot.normal.dot(normals[static_cast<std::size_t>(toucher.vertex)]) > options_.facing_cosine)
      continue;
    const auto& facing = rest.triangles[static_cast<std::size_t>(foot.triangle)];
    const auto below =
        static_cast<std::size_t>(std::max_element(foot.weight.begin(), foot.weight.end()) - foot.weight.begin());
    links_.push_back({toucher.vertex, facing[below], facing, toucher.area_m2});
    area_ += toucher.area_m2;
  }
}

void OrganBed::hang_links(const CutLattice& lattice) {
  hung_.resize(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Vec3& place = lattice.rest()->vertices[static_cast<std::size_t>(links_[i].vertex)];
    set_places(lattice.lattice(), lattice.hang(place, links_[i].vertex), lattice.hang(place, links_[i].below),
               hung_[i]);
  }
}

void OrganBed::follow_cut(const CutLattice& lattice) {
  find_rings(*lattice.rest());
  find_touchers(lattice);
  hang_links(lattice);
}

void OrganBed::bind(const CutLattice& lattice, const SurfaceSnapshot& surface, SoftSolid& solid) {
  std::vector<SoftTie>& ties = solid.ties();
  ties.clear();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    SoftTie& tie = ties.emplace_back(hung_[i]);
    if (link.free()) continue;
    tie.normal = normal_of(corners_in(link.facing, surface)).cast<float>();
    // A link that parts on as it does will bear less at the end of the step: with what it bears now, a peel would take
    // more than G.
    const double furthest = std::max(link.furthest_m, way(2 * solid.apart(tie) - link.apart, tie.normal));
    const double gone = damage(link, next_hold(link, furthest, solid.options().step_s), furthest);
    tie.all_n_per_m = static_cast<float>((1 - gone) * (1 - link.softened) * stiffness() * link.area_m2);
    tie.force_n = -tie.all_n_per_m * solid.apart(tie);
  }
  add_contacts(lattice, surface, solid);
}

void OrganBed::add_contacts(const CutLattice& lattice, const SurfaceSnapshot& surface, SoftSolid& solid) {
  std::vector<SoftTie>& ties = solid.ties();
  const std::size_t links = ties.size();
  contact_energy_ = 0;
  ++looks_;
  for (std::size_t i = 0; i < touchers_.size(); ++i) {
    Toucher& toucher = touchers_[i];
    if (!toucher.near && (looks_ + i) % kFarEvery != 0) continue;
    const Vec3& place = surface.vertices[static_cast<std::size_t>(toucher.vertex)];
    const auto distance = [&](std::int32_t v) {
      return (surface.vertices[static_cast<std::size_t>(v)] - place).squaredNorm();
    };
    // The nearest vertex of part 0 is looked for from that of the step before.
    double least = distance(toucher.nearest);
    for (bool nearer = true; nearer;) {
      nearer = false;
      const auto v = static_cast<std::size_t>(toucher.nearest);
      for (std::size_t t = first_round_[v]; t < first_round_[v + 1]; ++t)
        for (const std::int32_t next : surface.triangles[static_cast<std::size_t>(round_[t])])
          if (const double d = distance(next); d < least) least = d, toucher.nearest = next, nearer = true;
    }
    toucher.near = least < kLooks * kLooks;
    if (!toucher.near) continue;
    const Foot foot = foot_round(toucher.nearest, place, surface);
    toucher.near = foot.gap_m < kMayTouch;
    const double in = toucher.begins_m - foot.gap_m, ramp = options_.contact_m;
    // Deeper than that, the surface is another side of the organ.
    if (!(in > 0) || in > kLooks) continue;
    const double rise = options_.contact_pa_per_m * toucher.area_m2 * std::min(1.0, in / ramp);
    if (rise < static_cast<double>(kRamp)) continue;
    const double force = in < ramp ? rise * in / 2 : rise * (in - ramp / 2);
    contact_energy_ += in < ramp ? rise * in * in / 6 : rise * (ramp * ramp / 6 + (in - ramp) * in / 2);
    const Vec3 under = interpolate(
        foot.weight, corners_in(surface.triangles[static_cast<std::size_t>(foot.triangle)], *lattice.rest()));
    SoftTie& tie = ties.emplace_back();
    set_places(lattice.lattice(),
               lattice.hang(lattice.rest()->vertices[static_cast<std::size_t>(toucher.vertex)], toucher.vertex),
               lattice.hang(under, toucher.nearest), tie);
    tie.normal = foot.normal.cast<float>();
    tie.along_n_per_m = static_cast<float>(rise);
    tie.force_n = (force * foot.normal).cast<float>();
  }
  contacts_ = ties.size() - links;
}

void OrganBed::wear(const SoftSolid& solid, double step_s) {
  freed_.clear();
  energy_ = contact_energy_;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link& link = links_[i];
    if (link.free()) continue;
    const SoftTie& tie = solid.ties()[i];
    const Vec3f before = std::exchange(link.apart, solid.apart(tie));
    const double stretch = 0.5 * (1 - link.softened) * stiffness() * link.area_m2;
    const double held = stretch * (1 - link.damage) * static_cast<double>(before.squaredNorm());
    link.furthest_m = std::max(link.furthest_m, way(link.apart, tie.normal));
    link.holds = next_hold(link, link.furthest_m, step_s);
    link.damage = damage(link, link.holds, link.furthest_m);
    const double holds = stretch * (1 - link.damage) * static_cast<double>(link.apart.squaredNorm());
    energy_ += holds;
    // What the step's forces have put in and is not held: it went with the damage, or the implicit step has lost it.
    taken_ += held - holds - static_cast<double>(tie.force_n.dot(link.apart - before));
    if (link.free()) freed_.push_back(static_cast<std::int32_t>(i));
  }
  free_area_ = damage_ = 0;  // in the order of the whole: when all are free it is all of it
  for (const Link& link : links_) {
    if (link.free()) free_area_ += link.area_m2;
    damage_ += link.free() ? link.area_m2 : link.damage * link.area_m2;
  }
}

void OrganBed::soften(std::size_t link, double softened) {
  const double least = 1 - options_.heat_leaves;
  links_[link].softened = std::max(links_[link].softened, least * std::clamp(softened, 0.0, 1.0));
}

int OrganBed::vaporise(const Vec3& place_T, double radius_m, const SurfaceSnapshot& surface) {
  int count = 0;
  const double end = 2 * energy_per_m2_ / strength_;
  for (Link& link : links_) {
    if (link.free() || link.furthest_m >= end) continue;
    const auto facing = corners_in(link.facing, surface);
    const Vec3& above = surface.vertices[static_cast<std::size_t>(link.vertex)];
    const Vec3 below = closest_point_on_triangle(above, facing);
    if (off_segment(place_T, above, below) > radius_m) continue;
    link.furthest_m = end;
    link.vaporised = true;
    ++count;
  }
  return count;
}

bool faces(const CutLattice& lattice, const BedOptions& options) {
  try {
    return !OrganBed(lattice, options, 1).links().empty();
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace trocar
