#include "tissue/interaction/surface_film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace trocar {
namespace {

constexpr double kLeastArea = 1e-9;                            // m2 of a vertex: triangles without area hold liquid too
constexpr float kLeastCotangent = 0.002F, kMostCotangent = 5;  // of an edge's weight: liquid runs along every edge
constexpr double kRunsFrom = 3e-6;    // m beyond what clings: thinner runs less than 0.1 mm in a second
constexpr double kSlowBelow = 60e-6;  // m beyond what clings: blood runs less than 4 mm/s, and is run in longer steps
constexpr double kDryHeight = 1e-7;   // m: thinner is dry
constexpr std::uint32_t kRestingEvery = 16, kSlopeEvery = 8, kShownEvery = 4, kSlowEvery = 4;  // steps
constexpr float kCleftRise = 3;              // of what fills a cut, over its walls; unchecked
constexpr double kLevelling = 0.125;         // share of the volume that would level two neighbours
constexpr double kDissolvingHeight = 20e-6;  // m of water that dissolves a stain

/// Of the angle at a in a triangle; 0 where there is none.
double cotangent(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double value = u.dot(v) / u.cross(v).norm();
  return std::isfinite(value) ? value : 0;
}

std::span<const std::int32_t> corners_at(std::span<const std::int32_t> triangles, std::span<const std::int32_t> begin,
                                         std::int32_t vertex) {
  const auto v = static_cast<std::size_t>(vertex);
  return triangles.subspan(static_cast<std::size_t>(begin[v]), static_cast<std::size_t>(begin[v + 1] - begin[v]));
}

/// A third of the area vectors of a vertex's triangles, but for those left out.
Vec3 summed_area(std::span<const std::array<std::int32_t, 3>> triangles, std::span<const std::int32_t> at_vertex,
                 std::span<const Vec3> vertices_T, const std::vector<bool>& left_out) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t number : at_vertex) {
    const auto t = static_cast<std::size_t>(number);
    if (t < left_out.size() && left_out[t]) continue;
    const auto& [a, b, c] = triangles[t];
    const Vec3 &p = vertices_T[static_cast<std::size_t>(a)], &q = vertices_T[static_cast<std::size_t>(b)],
               &r = vertices_T[static_cast<std::size_t>(c)];
    sum += (q - p).cross(r - p) / 6;
  }
  return sum;
}

double part_in(double step_s, double constant_s) { return 1 - std::exp(-step_s / constant_s); }

}  // namespace

SurfaceFilm::SurfaceFilm(const TriangleSurface& rest_T, const SurfaceFilmOptions& options) : options_(options) {
  build(rest_T);
}

void SurfaceFilm::build(const TriangleSurface& rest_T) {
  const std::size_t count = rest_T.vertices.size(), before = cells_.size();
  assert(count >= before);
  auto triangles = rest_T.triangles;
  std::erase_if(triangles, [count](const auto& corners) {
    return std::ranges::any_of(corners, [count](std::int32_t v) { return v < 0 || v >= static_cast<int>(count); });
  });
  // What lies at vertices of the same triangles as before is taken over.
  std::vector<char> fresh(count, 0);
  std::fill(fresh.begin() + static_cast<std::ptrdiff_t>(before), fresh.end(), 1);
  const auto mark = [&](const std::vector<std::array<std::int32_t, 3>>& list, std::size_t t) {
    if (t >= list.size()) return;
    for (const std::int32_t v : list[t]) fresh[static_cast<std::size_t>(v)] = 1;
  };
  for (std::size_t t = 0; t < std::max(triangles.size(), triangles_.size()); ++t) {
    if (t < triangles.size() && t < triangles_.size() && triangles[t] == triangles_[t]) continue;
    mark(triangles, t);
    mark(triangles_, t);
  }
  triangles_ = std::move(triangles);
  cells_.resize(count);
  feet_.resize(count);
  change_.assign(count, {});
  blood_shown_.resize(count, 0);
  wet_shown_.resize(count, 0);
  build_corners(fresh);
  build_areas(rest_T, fresh);
  build_neighbours(rest_T, fresh);
  find_floor(rest_T);
}

void SurfaceFilm::find_floor(const TriangleSurface& rest_T) {
  floor_m_ = options_.floor_m;
  if (std::isfinite(floor_m_)) return;
  floor_m_ = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : rest_T.vertices)
    if (vertex.z() < floor_m_) floor_m_ = vertex.z();
  if (!std::isfinite(floor_m_)) floor_m_ = 0;
}

void SurfaceFilm::build_corners(const std::vector<char>& fresh) {
  std::vector<std::int32_t> begin(cells_.size() + 1, 0);
  for (std::size_t v = 0; v + 1 < corner_begin_.size(); ++v)
    if (fresh[v] == 0) begin[v + 1] = corner_begin_[v + 1] - corner_begin_[v];
  for (const auto& triangle : triangles_)
    for (const std::int32_t v : triangle) begin[static_cast<std::size_t>(v) + 1] += fresh[static_cast<std::size_t>(v)];
  for (std::size_t v = 0; v < cells_.size(); ++v) begin[v + 1] += begin[v];
  std::vector<std::int32_t> corners(static_cast<std::size_t>(begin.back()));
  for (std::size_t v = 0; v + 1 < corner_begin_.size(); ++v)
    if (fresh[v] == 0)
      std::copy(corner_triangles_.begin() + corner_begin_[v], corner_triangles_.begin() + corner_begin_[v + 1],
                corners.begin() + begin[v]);
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const std::int32_t v : triangles_[t])
      if (fresh[static_cast<std::size_t>(v)] != 0)
        corners[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<std::int32_t>(t);
  corner_begin_ = std::move(begin);
  corner_triangles_ = std::move(corners);
}

void SurfaceFilm::build_areas(const TriangleSurface& rest_T, const std::vector<char>& fresh) {
  for (std::size_t v = 0; v < cells_.size(); ++v) {
    if (fresh[v] == 0) continue;
    double sum = 0;
    for (std::int32_t c = corner_begin_[v]; c < corner_begin_[v + 1]; ++c) {
      const auto& triangle = triangles_[static_cast<std::size_t>(corner_triangles_[static_cast<std::size_t>(c)])];
      const auto at = [&](std::size_t i) -> const Vec3& {
        return rest_T.vertices[static_cast<std::size_t>(triangle[i])];
      };
      const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
      if (std::isfinite(area)) sum += area / 3;
    }
    cells_[v].area = std::max(sum, kLeastArea);
    feet_[v].area = static_cast<float>(cells_[v].area);
  }
}

void SurfaceFilm::build_neighbours(const TriangleSurface& rest_T, const std::vector<char>& fresh) {
  std::vector<std::int32_t> begin(1, 0);
  std::vector<Neighbour> neighbours;
  begin.reserve(cells_.size() + 1);
  neighbours.reserve(3 * triangles_.size());
  for (std::size_t v = 0; v < cells_.size(); ++v) {
    if (fresh[v] == 0)
      neighbours.insert(neighbours.end(), neighbours_.begin() + neighbour_begin_[v],
                        neighbours_.begin() + neighbour_begin_[v + 1]);
    else
      add_neighbours(v, rest_T, neighbours);
    begin.push_back(static_cast<std::int32_t>(neighbours.size()));
  }
  neighbour_begin_ = std::move(begin);
  neighbours_ = std::move(neighbours);
}

void SurfaceFilm::add_neighbours(std::size_t v, const TriangleSurface& rest_T, std::vector<Neighbour>& out) {
  const std::size_t begin = out.size();
  std::vector<int> sides;  // triangles at each edge
  const auto add = [&](std::int32_t other, double weight) {
    if (other == static_cast<std::int32_t>(v)) return;
    std::size_t i = begin;
    while (i < out.size() && out[i].vertex != other) ++i;
    if (i == out.size()) {
      out.push_back({other, 0});
      sides.push_back(0);
    }
    out[i].weight += static_cast<float>(weight / 2);
    ++sides[i - begin];
  };
  for (std::int32_t c = corner_begin_[v]; c < corner_begin_[v + 1]; ++c) {
    const auto& t = triangles_[static_cast<std::size_t>(corner_triangles_[static_cast<std::size_t>(c)])];
    const int k = t[0] == static_cast<int>(v) ? 0 : t[1] == static_cast<int>(v) ? 1 : 2;
    const std::int32_t b = t[static_cast<std::size_t>((k + 1) % 3)], d = t[static_cast<std::size_t>((k + 2) % 3)];
    const Vec3 &p = rest_T.vertices[v], &q = rest_T.vertices[static_cast<std::size_t>(b)],
               &r = rest_T.vertices[static_cast<std::size_t>(d)];
    add(b, cotangent(r, p, q));
    add(d, cotangent(q, p, r));
  }
  cells_[v].rim = std::ranges::find(sides, 1) != sides.end();
  for (std::size_t i = begin; i < out.size(); ++i)
    out[i].weight = std::clamp(out[i].weight, kLeastCotangent, kMostCotangent);
}

void SurfaceFilm::activate(std::int32_t vertex) {
  Cell& cell = cells_[static_cast<std::size_t>(vertex)];
  if (cell.active) return;
  cell.active = true;
  active_.push_back(vertex);
}

double SurfaceFilm::add_blood(std::int32_t vertex, double volume_m3) {
  if (!(volume_m3 > 0) || !std::isfinite(volume_m3) || vertex < 0 || static_cast<std::size_t>(vertex) >= cells_.size())
    return 0;
  cells_[static_cast<std::size_t>(vertex)].blood += volume_m3;
  given_.blood += volume_m3;
  activate(vertex);
  return volume_m3;
}

double SurfaceFilm::add_water(std::int32_t vertex, double volume_m3) {
  if (!(volume_m3 > 0) || !std::isfinite(volume_m3) || vertex < 0 || static_cast<std::size_t>(vertex) >= cells_.size())
    return 0;
  cells_[static_cast<std::size_t>(vertex)].water += volume_m3;
  given_.water += volume_m3;
  activate(vertex);
  return volume_m3;
}

double SurfaceFilm::add_to_pool(const Liquids& volume) {
  const double blood = volume.blood > 0 && std::isfinite(volume.blood) ? volume.blood : 0;
  const double water = volume.water > 0 && std::isfinite(volume.water) ? volume.water : 0;
  pool_.blood += blood, given_.blood += blood;
  pool_.water += water, given_.water += water;
  return blood + water;
}

Vec3 SurfaceFilm::area_vector(std::int32_t vertex, std::span<const Vec3> vertices_T) const {
  return summed_area(triangles_, corners_at(corner_triangles_, corner_begin_, vertex), vertices_T, {});
}

void SurfaceFilm::irrigate(const Irrigation& jet, std::span<const Vec3> vertices_T, double step_s) {
  const double volume = jet.flow_m3_per_s * step_s;
  if (!(volume > 0) || !jet.tip_T.allFinite() || !jet.direction_T.allFinite()) return;
  const Vec3 direction = jet.direction_T.normalized();
  const double cosine = std::cos(jet.half_angle_rad);
  constexpr double kDeep = 0.015;  // m behind the nearest place that the jet still meets
  std::vector<std::pair<std::int32_t, double>> met;
  double nearest = jet.reach_m;
  for (std::size_t v = 0; v < cells_.size(); ++v) {
    const Vec3 way = vertices_T[v] - jet.tip_T;
    const double along = way.dot(direction);
    if (!(along > 0 && along < nearest + kDeep) || along * along < cosine * cosine * way.squaredNorm()) continue;
    met.emplace_back(static_cast<std::int32_t>(v), along);
    nearest = std::min(nearest, along);
  }
  std::erase_if(met, [&](const auto& place) {
    return place.second > std::min(nearest + kDeep, jet.reach_m) ||
           area_vector(place.first, vertices_T).dot(direction) >= 0;
  });
  double area = 0;
  for (const auto& place : met) area += area_m2(place.first);
  for (const auto& place : met) add_water(place.first, volume * area_m2(place.first) / area);
  if (met.empty()) add_to_pool({0, volume});
}

Liquids SurfaceFilm::suck(const Suction& suction, std::span<const Vec3> vertices_T, double step_s) {
  Liquids taken;
  double left = suction.most_m3_per_s * step_s;
  if (!(left > 0) || !suction.tip_T.allFinite()) return taken;
  std::vector<std::int32_t> reached;
  double there = 0;
  for (const std::int32_t v : active_) {
    if (!((vertices_T[static_cast<std::size_t>(v)] - suction.tip_T).norm() < suction.radius_m)) continue;
    reached.push_back(v);
    there += at(v).sum();
  }
  const double share = there > left ? left / there : 1;
  for (const std::int32_t v : reached) {
    Cell& cell = cells_[static_cast<std::size_t>(v)];
    const Liquids part{share * cell.blood, share * cell.water};
    cell.blood -= part.blood, cell.water -= part.water;
    taken.blood += part.blood, taken.water += part.water;
    show(static_cast<std::size_t>(v));
  }
  left -= taken.sum();
  if (left > 0 && pool_.sum() > 0 && suction.tip_T.z() - suction.radius_m < pool_level_m()) {
    const double part = std::min(1.0, left / pool_.sum());
    const Liquids of_pool{part * pool_.blood, part * pool_.water};
    pool_.blood -= of_pool.blood, pool_.water -= of_pool.water;
    taken.blood += of_pool.blood, taken.water += of_pool.water;
  }
  sucked_.blood += taken.blood, sucked_.water += taken.water;
  return taken;
}

void SurfaceFilm::find_levels(std::span<const Vec3> vertices_T) {
  for (std::size_t v = 0; v < cells_.size(); ++v) feet_[v].level_m = static_cast<float>(vertices_T[v].z() - floor_m_);
  for (const std::int32_t vertex : active_) {
    const auto v = static_cast<std::size_t>(vertex);
    Cell& cell = cells_[v];
    if (!cell.sloped || (static_cast<std::uint32_t>(vertex) + steps_) % kSlopeEvery == 0) find_slope(v, vertices_T);
    feet_[v].level_m += cell.rise * static_cast<float>(height(cell));
    feet_[v].wet = true;
  }
}

void SurfaceFilm::find_slope(std::size_t vertex, std::span<const Vec3> vertices_T) {
  Cell& cell = cells_[vertex];
  const Vec3 area = summed_area(
      triangles_, corners_at(corner_triangles_, corner_begin_, static_cast<std::int32_t>(vertex)), vertices_T, inside_);
  const double size = area.norm();
  cell.sloped = true;
  if (!(size > 0)) {  // in a cut, whose walls lie close together
    cell.faces_down = cell.overhangs = false;
    cell.rise = kCleftRise;
    return;
  }
  const double n_z = std::isfinite(size) ? area.z() / size : 1;
  cell.faces_down = n_z < 0;
  cell.overhangs = n_z < options_.overhang;
  cell.rise = cell.faces_down ? 0 : static_cast<float>(std::max(n_z, options_.steepest_rise));
}

bool SurfaceFilm::run_down(std::size_t vertex, double moving_m, double step_s) {
  constexpr std::size_t kMostNeighbours = 24;
  constexpr double kTallest = 1e3;  // m
  const Cell& cell = cells_[vertex];
  const double sum = cell.blood + cell.water, blood_share = cell.blood / sum;
  const double viscosity = options_.water_pa_s + blood_share * (options_.blood_pa_s - options_.water_pa_s);
  const double limited = std::min(moving_m, options_.thickest_m);
  const double mobility = options_.density_kg_per_m3 * kGravity / (3 * viscosity) * moving_m * limited * limited;
  const float here = feet_[vertex].level_m;
  const bool advances = moving_m > options_.advance_m;
  std::array<double, kMostNeighbours> flow;  // the first `lower` are filled: cleared, they cost as much as the rest
  std::array<std::int32_t, kMostNeighbours> to;
  std::size_t lower = 0;
  bool slopes = false;
  double out = 0;
  for (std::int32_t i = neighbour_begin_[vertex]; i < neighbour_begin_[vertex + 1]; ++i) {
    const Neighbour& neighbour = neighbours_[static_cast<std::size_t>(i)];
    const auto other = static_cast<std::size_t>(neighbour.vertex);
    const Foot& foot = feet_[other];
    const auto fall = static_cast<double>(here - foot.level_m);
    if (!(fall > 0 && fall < kTallest) || lower == kMostNeighbours) continue;  // NaN is none
    slopes = true;
    if (!foot.wet && !advances) continue;
    const double levelling = kLevelling * fall * std::min(cell.area, static_cast<double>(foot.area));
    flow[lower] = std::min(step_s * mobility * static_cast<double>(neighbour.weight) * fall, levelling);
    to[lower] = neighbour.vertex;
    out += flow[lower++];
  }
  if (lower == 0) return slopes;
  const double most = options_.most_share * moving_m * cell.area;
  const double scale = (out > most ? most / out : 1) / sum;
  for (std::size_t i = 0; i < lower; ++i) {
    const Liquids part{flow[i] * scale * cell.blood, flow[i] * scale * cell.water};
    change_[vertex].blood -= part.blood, change_[vertex].water -= part.water;
    Liquids& there = change_[static_cast<std::size_t>(to[i])];
    there.blood += part.blood, there.water += part.water;
    if (!feet_[static_cast<std::size_t>(to[i])].wet) activate(to[i]);
  }
  return true;
}

void SurfaceFilm::drip(std::size_t vertex, double step_s) {
  const Cell& cell = cells_[vertex];
  const double sum = cell.blood + cell.water, held = options_.hang_m * cell.area;
  if (sum <= held) return;
  const double share = part_in(step_s, options_.drip_s) * (sum - held) / sum;
  const Liquids part{share * cell.blood, share * cell.water};
  change_[vertex].blood -= part.blood, change_[vertex].water -= part.water;
  pool_.blood += part.blood, pool_.water += part.water;
}

void SurfaceFilm::dry(Cell& cell, double step_s) const {
  // A share of what there is, at most of a layer that clings: deep blood does not dry faster than thin.
  const double thin = std::min(1.0, options_.cling_m * cell.area / std::max(cell.blood, 1e-30));
  const double water_m = cell.water / cell.area;
  if (cell.dried > 0 && water_m > kDissolvingHeight) {
    const double part = std::min(1.0, step_s / options_.dissolve_s) * cell.dried;
    cell.dried -= part, cell.blood += part;
  } else {
    const double part = std::min(1.0, step_s / options_.dry_s) * thin * cell.blood;
    cell.blood -= part, cell.dried += part;
  }
}

void SurfaceFilm::settle(double step_s) {
  const double resting_s = step_s * kRestingEvery;
  std::size_t kept = 0;
  for (const std::int32_t v : active_) {
    const auto i = static_cast<std::size_t>(v);
    Cell& cell = cells_[i];
    cell.blood += change_[i].blood, cell.water += change_[i].water;
    const bool changed = change_[i].blood != 0 || change_[i].water != 0;
    change_[i] = {};
    const bool due = (static_cast<std::uint32_t>(v) + steps_) % kRestingEvery == 0;
    if (due) {
      dry(cell, resting_s);
      const double thin = std::min(1.0, options_.cling_m * cell.area / std::max(cell.water, 1e-30));
      const double part = std::min(1.0, resting_s / options_.evaporate_s) * thin * cell.water;
      cell.water -= part, evaporated_ += part;
      if (height(cell) < kDryHeight) {
        cell.dried += cell.blood, evaporated_ += cell.water;
        cell.blood = cell.water = 0;
        cell.active = cell.sloped = false;
        feet_[i].wet = false;
        show(i);
        continue;
      }
    }
    if (due || (changed && (static_cast<std::uint32_t>(v) + steps_) % kShownEvery == 0)) show(i);
    active_[kept++] = v;
  }
  active_.resize(kept);
}

void SurfaceFilm::show(std::size_t vertex) {
  const Cell& cell = cells_[vertex];
  const double blood = (cell.blood + cell.dried) / cell.area, all = blood + cell.water / cell.area;
  blood_shown_[vertex] = static_cast<float>(1 - std::exp(-blood / options_.blood_shown_m));
  wet_shown_[vertex] = static_cast<float>(1 - std::exp(-(all - cell.dried / cell.area) / options_.wet_shown_m));
}

void SurfaceFilm::step(std::span<const Vec3> vertices_T, double step_s) {
  ++steps_;
  if (active_.empty()) return;
  find_levels(vertices_T);
  const std::size_t count = active_.size();  // those that become wet now run from the next step on
  for (std::size_t k = 0; k < count; ++k) {
    const auto v = static_cast<std::size_t>(active_[k]);
    const Cell& cell = cells_[v];
    const double moving = height(cell) - options_.cling_m;
    if (!(moving > kRunsFrom)) continue;
    const bool slow = moving < kSlowBelow;
    if (slow && (static_cast<std::uint32_t>(active_[k]) + steps_) % kSlowEvery != 0) continue;
    const bool lowest = !run_down(v, moving, slow ? kSlowEvery * step_s : step_s);
    if (cell.rim || cell.overhangs || (lowest && cell.faces_down)) drip(v, step_s);
  }
  settle(step_s);
}

void SurfaceFilm::grow(const TriangleSurface& rest_T, const std::vector<VertexOrigin>& added,
                       const std::vector<bool>& inside) {
  inside_ = inside;
  const std::size_t before = cells_.size();
  std::vector<Liquids> old_height(before);
  std::vector<double> old_stain(before);
  for (std::size_t v = 0; v < before; ++v) {
    old_height[v] = {cells_[v].blood / cells_[v].area, cells_[v].water / cells_[v].area};
    old_stain[v] = cells_[v].dried / cells_[v].area;
  }
  build(rest_T);
  constexpr double kMostTaken = 0.5;  // of a vertex's liquid, by one new vertex
  for (std::size_t k = 0; k < added.size() && before + k < cells_.size(); ++k) {
    const VertexOrigin& origin = added[k];
    Cell& fresh = cells_[before + k];
    const auto take = [&](std::int32_t from, double share) {
      if (from < 0 || static_cast<std::size_t>(from) >= before + k || !(share > 0)) return;
      const auto f = static_cast<std::size_t>(from);
      Cell& cell = cells_[f];
      const double area = std::min(share, 1.0) * fresh.area;
      const double blood = std::min(area * old_height[f].blood, kMostTaken * cell.blood);
      const double water = std::min(area * old_height[f].water, kMostTaken * cell.water);
      const double stain = std::min(area * old_stain[f], kMostTaken * cell.dried);
      cell.blood -= blood, cell.water -= water, cell.dried -= stain;
      fresh.blood += blood, fresh.water += water, fresh.dried += stain;
      show(f);
    };
    take(origin.from, 1 - origin.share);
    take(origin.to, origin.share);
    old_height.push_back({fresh.blood / fresh.area, fresh.water / fresh.area});
    old_stain.push_back(fresh.dried / fresh.area);
    if (fresh.blood + fresh.water > 0) activate(static_cast<std::int32_t>(before + k));
    show(before + k);
  }
  for (const std::int32_t v : active_) show(static_cast<std::size_t>(v));
}

void SurfaceFilm::reset() {
  for (Cell& cell : cells_) {
    cell.blood = cell.water = cell.dried = 0;
    cell.rise = 1;
    cell.active = cell.sloped = cell.faces_down = cell.overhangs = false;
  }
  std::ranges::fill(change_, Liquids{});
  for (Foot& foot : feet_) foot.wet = false;
  std::ranges::fill(blood_shown_, 0.0F);
  std::ranges::fill(wet_shown_, 0.0F);
  active_.clear();
  given_ = pool_ = sucked_ = {};
  evaporated_ = 0;
  steps_ = 0;
}

Liquids SurfaceFilm::at(std::int32_t vertex) const {
  const Cell& cell = cells_[static_cast<std::size_t>(vertex)];
  return {cell.blood, cell.water};
}

double SurfaceFilm::height_m(std::int32_t vertex) const { return height(cells_[static_cast<std::size_t>(vertex)]); }

double SurfaceFilm::pool_level_m() const { return floor_m_ + pool_.sum() / options_.pool_area_m2; }

FilmAccount SurfaceFilm::account() const {
  FilmAccount out;
  out.given = given_, out.pool = pool_, out.sucked = sucked_, out.evaporated = evaporated_;
  for (const Cell& cell : cells_) {
    out.film.blood += cell.blood;
    out.film.water += cell.water;
    out.dried += cell.dried;
  }
  return out;
}

}  // namespace trocar
