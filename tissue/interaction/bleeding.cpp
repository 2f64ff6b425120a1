#include "tissue/interaction/bleeding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kMillilitre = 1e-6;  // m3
constexpr std::size_t kMostWoundVertices = 24;
constexpr double kShutLumen = 1e-3;    // share of a vessel's area: less is closed
constexpr double kBesideCut = 1e-6;    // of a vessel's length: where heat closes a cut end
constexpr double kDropStart = 0.002;   // m above the surface
constexpr double kDropScatter = 0.25;  // of a drop's direction

/// Well mixed bits of a number (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// 0 <= u < 1.
double share_of(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

std::uint64_t cell_bits(const Vec3& place, double edge_m) {
  std::uint64_t bits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(std::floor(place[axis] / edge_m), -1e9, 1e9);
    bits = mixed(bits ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)));
  }
  return bits;
}

}  // namespace

std::vector<VesselSize> liver_vessels() {
  return {{Supply::kPortal, 0.4e-3, 0.03, 1e4, 0.003, 0.012},
          {Supply::kArterial, 0.2e-3, 0.03, 1e4, 0.003, 0.012},
          {Supply::kPortal, 0.8e-3, 0.06, 3e3, 0.010, 0.025},
          {Supply::kArterial, 0.4e-3, 0.06, 3e3, 0.010, 0.025}};
}

Bleeding::Bleeding(const TriangleSurface& rest_T, const BleedingOptions& options)
    : options_(options), rest_(rest_T), circulation_(options.circulation), film_(rest_T, options.film) {}

Bleeding::Bleeding(const TriangleSurface& rest_T, const BleedingOptions& options, const VesselFlow& vessels)
    : Bleeding(rest_T, options) {
  whole_vessels_ = vessels_ = vessels;
  known_vessels_ = true;
}

std::optional<Bleeding::Wound> Bleeding::wound_at(std::span<const std::int32_t> vertices,
                                                  std::span<const double> weights) const {
  Wound wound;
  double sum = 0;
  for (std::size_t i = 0; i < vertices.size() && wound.vertices.size() < kMostWoundVertices; ++i) {
    const std::int32_t v = vertices[i];
    if (v < 0 || static_cast<std::size_t>(v) >= rest_.vertices.size()) return std::nullopt;
    if (!(weights[i] > 0) || !rest_.vertices[static_cast<std::size_t>(v)].allFinite()) continue;
    wound.vertices.push_back(v);
    wound.weights.push_back(weights[i]);
    sum += weights[i];
  }
  if (!(sum > 0) || !std::isfinite(sum)) return std::nullopt;
  for (std::size_t i = 0; i < wound.vertices.size(); ++i) {
    wound.weights[i] /= sum;
    wound.rest_T += wound.weights[i] * rest_.vertices[static_cast<std::size_t>(wound.vertices[i])];
  }
  wound.place_T = wound.rest_T;
  return wound;
}

std::optional<Bleeding::Wound> Bleeding::wound_at(const MaterialPoint& place) const {
  if (place.triangle < 0 || static_cast<std::size_t>(place.triangle) >= rest_.triangles.size()) return std::nullopt;
  return wound_at(rest_.triangles[static_cast<std::size_t>(place.triangle)], place.weight);
}

WoundId Bleeding::add_wound(const MaterialPoint& place, double area_m2, double depth_m) {
  auto wound = wound_at(place);
  return wound ? add(std::move(*wound), area_m2, depth_m) : -1;
}

WoundId Bleeding::add_wound(std::span<const std::int32_t> vertices, double area_m2, double depth_m) {
  const std::vector<double> weights(vertices.size(), 1.0);
  auto wound = wound_at(vertices, weights);
  return wound ? add(std::move(*wound), area_m2, depth_m) : -1;
}

WoundId Bleeding::add(Wound wound, double area_m2, double depth_m) {
  if (!(area_m2 > 0) || !std::isfinite(area_m2) || !(depth_m >= 0) || !std::isfinite(depth_m)) return -1;
  wound.area = wound.oozing = area_m2;
  wound.depth = depth_m;
  for (std::size_t i = 0; i < wounds_.size(); ++i) {
    if (wounds_[i].end >= 0 || (wounds_[i].rest_T - wound.rest_T).norm() >= options_.merge_m) continue;
    widen(wounds_[i], wound);
    return static_cast<WoundId>(i);
  }
  wound.met.assign(options_.vessels.size(), false);
  meet_vessels(wound);
  wounds_.push_back(std::move(wound));
  return static_cast<WoundId>(wounds_.size()) - 1;
}

WoundId Bleeding::open_vessel(const MaterialPoint& place, const VesselSize& size) {
  auto wound = wound_at(place);
  if (!wound || !(size.radius_m > 0) || !(size.feed_m > 0)) return -1;
  wound->area = std::numbers::pi * size.radius_m * size.radius_m;
  wound->met.assign(options_.vessels.size(), true);
  wound->vessels.push_back({size});
  wounds_.push_back(std::move(*wound));
  return static_cast<WoundId>(wounds_.size()) - 1;
}

void Bleeding::widen(Wound& wound, const Wound& by) const {
  const double before = wound.area / (wound.area + by.area);
  for (double& weight : wound.weights) weight *= before;
  double left_out = 0;
  for (std::size_t i = 0; i < by.vertices.size(); ++i) {
    const double weight = (1 - before) * by.weights[i];
    const auto same = std::ranges::find(wound.vertices, by.vertices[i]);
    if (same != wound.vertices.end()) {
      wound.weights[static_cast<std::size_t>(same - wound.vertices.begin())] += weight;
    } else if (wound.vertices.size() < kMostWoundVertices) {
      wound.vertices.push_back(by.vertices[i]);
      wound.weights.push_back(weight);
    } else {
      left_out += weight;
    }
  }
  for (double& weight : wound.weights) weight /= 1 - left_out;
  wound.area += by.area;
  wound.oozing += by.oozing;
  wound.depth = std::max(wound.depth, by.depth);
  meet_vessels(wound);
}

void Bleeding::meet_vessels(Wound& wound) const {
  if (known_vessels_) return;
  const std::uint64_t bits = cell_bits(wound.rest_T, options_.patch_m);
  for (std::size_t k = 0; k < options_.vessels.size(); ++k) {
    const VesselSize& size = options_.vessels[k];
    const double deep =
        std::clamp((wound.depth - size.from_depth_m) / (size.full_depth_m - size.from_depth_m), 0.0, 1.0);
    // Vessels lie at random (Poisson): the chance of at least one grows with area and depth, the draw is the place's.
    if (wound.met[k] || share_of(mixed(bits + k)) >= 1 - std::exp(-size.per_m2 * wound.area * deep)) continue;
    wound.met[k] = true;
    wound.vessels.push_back({size});
  }
}

WoundId Bleeding::cut_vessel(std::int32_t vessel, double at, const MaterialPoint& from_end,
                             const MaterialPoint& to_end) {
  if (vessel < 0 || static_cast<std::size_t>(vessel) >= vessels_.vessels() || !std::isfinite(at)) return -1;
  auto first = wound_at(from_end), second = wound_at(to_end);
  if (!first || !second) return -1;
  const double place = std::clamp(at, 0.0, 1.0);
  for (std::size_t i = 0; i < wounds_.size(); ++i) {
    const std::int32_t end = wounds_[i].end;
    if (end < 0 || vessels_.open_ends()[static_cast<std::size_t>(end)].vessel != vessel) continue;
    vessels_.cut(vessel, place);
    return static_cast<WoundId>(i);
  }
  const auto ends = static_cast<std::int32_t>(vessels_.open_ends().size());
  vessels_.cut(vessel, place);
  first->end = ends;
  first->end_at = place * (1 - kBesideCut);
  second->end = ends + 1;
  second->end_at = place + (1 - place) * kBesideCut;
  wounds_.push_back(std::move(*first));
  wounds_.push_back(std::move(*second));
  return static_cast<WoundId>(wounds_.size()) - 2;
}

void Bleeding::clip_vessel(std::int32_t vessel, double at, double share) {
  if (vessel < 0 || static_cast<std::size_t>(vessel) >= vessels_.vessels() || !std::isfinite(at + share)) return;
  vessels_.clip(vessel, at, share);
}

void Bleeding::unclip_vessel(std::int32_t vessel, double at) {
  if (vessel < 0 || static_cast<std::size_t>(vessel) >= vessels_.vessels() || !std::isfinite(at)) return;
  vessels_.unclip(vessel, at);
}

void Bleeding::pinch_vessel(std::int32_t vessel, double at, double share) {
  if (vessel < 0 || static_cast<std::size_t>(vessel) >= vessels_.vessels() || !std::isfinite(at + share)) return;
  vessels_.pinch(vessel, at, share);
}

void Bleeding::clip_wound(WoundId id, double share, double spanned_m2) {
  if (id < 0 || static_cast<std::size_t>(id) >= wounds_.size() || !std::isfinite(share + spanned_m2)) return;
  Wound& wound = wounds_[static_cast<std::size_t>(id)];
  const double open = 1 - std::clamp(share, 0.0, 1.0);
  for (CutVessel& vessel : wound.vessels) vessel.lumen = std::min(vessel.lumen, open);
  wound.oozing = std::max(0.0, wound.oozing - std::max(0.0, spanned_m2));
  if (wound.end >= 0)
    vessels_.clip(vessels_.open_ends()[static_cast<std::size_t>(wound.end)].vessel, wound.end_at, share);
}

void Bleeding::coagulate(WoundId id, double share) {
  if (id < 0 || static_cast<std::size_t>(id) >= wounds_.size()) return;
  coagulate(wounds_[static_cast<std::size_t>(id)], share, share);
}

void Bleeding::coagulate(const Vec3& place_T, double radius_m, double share) {
  if (!place_T.allFinite() || !(radius_m > 0)) return;
  for (Wound& wound : wounds_) {
    if (!((wound.place_T - place_T).norm() < radius_m)) continue;
    const double covered = std::min(1.0, std::pow(radius_m / radius(wound), 2));
    coagulate(wound, covered * share, share);
  }
}

void Bleeding::coagulate(Wound& wound, double ooze_share, double vessel_share) {
  const auto left = [](double share) { return 1 - std::clamp(std::isfinite(share) ? share : 0, 0.0, 1.0); };
  wound.oozing *= left(ooze_share);
  for (CutVessel& vessel : wound.vessels)
    if (vessel.size.radius_m <= options_.seals_up_to_m) vessel.lumen *= left(vessel_share);
  if (wound.end < 0) return;
  const std::int32_t vessel = vessels_.open_ends()[static_cast<std::size_t>(wound.end)].vessel;
  if (vessels_.vessel(vessel).radius_m > options_.seals_up_to_m) return;
  wound.end_sealed = 1 - (1 - wound.end_sealed) * left(vessel_share);
  vessels_.seal(vessel, wound.end_at, wound.end_sealed > 1 - kShutLumen ? 1 : wound.end_sealed);
}

double Bleeding::radius(const Wound& wound) const { return std::sqrt(std::max(wound.area, 1e-8) / std::numbers::pi); }

void Bleeding::press(const Vec3& place_T, double radius_m, double pressure_pa) {
  if (!place_T.allFinite() || !(radius_m > 0) || !(pressure_pa > 0) || !std::isfinite(pressure_pa)) return;
  for (Wound& wound : wounds_) {
    if (!((wound.place_T - place_T).norm() < radius_m)) continue;
    wound.pressed_pa += pressure_pa;
    wound.pressed_share = std::max(wound.pressed_share, std::min(1.0, std::pow(radius_m / radius(wound), 2)));
  }
}

void Bleeding::irrigate(const Irrigation& jet) { jets_.push_back(jet); }

void Bleeding::suck(const Suction& suction) { suctions_.push_back(suction); }

void Bleeding::solve_network(const BloodPressures& pressures) {
  if (vessels_.open_ends().empty()) return;
  std::vector<double> pressed(vessels_.vessels());
  for (const Wound& wound : wounds_) {
    if (wound.end < 0) continue;
    const auto vessel = static_cast<std::size_t>(vessels_.open_ends()[static_cast<std::size_t>(wound.end)].vessel);
    pressed[vessel] = std::max(pressed[vessel], wound.pressed_pa);
  }
  for (std::size_t v = 0; v < pressed.size(); ++v) vessels_.press(static_cast<std::int32_t>(v), pressed[v]);
  vessels_.solve(pressures);
}

double Bleeding::ooze(const Wound& wound, const BloodPressures& pressures) const {
  const double full = options_.circulation.portal_pa - options_.circulation.pneumoperitoneum_pa;
  const double driving = std::max(0.0, pressures.portal_pa - pressures.outside_pa);
  const double pressed = std::max(0.0, driving - wound.pressed_pa);
  const double mean = (1 - wound.pressed_share) * driving + wound.pressed_share * pressed;
  return options_.ooze_m_per_s * wound.oozing * mean / full;
}

Bleeding::Jet Bleeding::vessel_jet(const Wound& wound, const CutVessel& vessel, const BloodPressures& pressures) const {
  if (vessel.lumen < kShutLumen) return {};
  const double supplied = vessel.size.supply == Supply::kArterial ? pressures.arterial_pa
                          : vessel.size.supply == Supply::kPortal ? pressures.portal_pa
                                                                  : pressures.venous_pa;
  // An open share s of the lumen is a tube of s of the area: its resistance goes with 1 / s^2.
  const double mouth = options_.flow.spasm * vessel.size.radius_m * std::sqrt(vessel.lumen);
  const double resistance =
      poiseuille_resistance(options_.flow.viscosity_pa_s, vessel.size.radius_m, vessel.size.feed_m) /
      (vessel.lumen * vessel.lumen);
  const double flow = jet_flow(supplied - pressures.outside_pa - wound.pressed_pa, resistance,
                               jet_loss(options_.flow.exit_loss, options_.flow.density_kg_per_m3, mouth));
  return {flow, flow / (std::numbers::pi * mouth * mouth)};
}

void Bleeding::run(const Wound& wound, double volume_m3) {
  for (std::size_t i = 0; i < wound.vertices.size(); ++i)
    film_.add_blood(wound.vertices[i], wound.weights[i] * volume_m3);
}

void Bleeding::spurt(Wound& wound, double volume_m3, double speed, std::span<const Vec3> vertices_T) {
  wound.waiting += volume_m3;
  if (wound.waiting < options_.drop_m3) return;
  const Vec3 outward = film_.area_vector(wound.vertices.front(), vertices_T);
  const double size = outward.norm();
  const Vec3 normal = size > 0 && std::isfinite(size) ? Vec3(outward / size) : Vec3::UnitZ();
  ++launched_;
  Vec3 direction = normal;
  for (std::uint64_t axis = 0; axis < 3; ++axis)
    direction[static_cast<int>(axis)] += kDropScatter * (2 * share_of(mixed(3 * launched_ + axis)) - 1);
  const BloodDrop drop{wound.place_T + kDropStart * normal, options_.drop_speed_share * speed * direction.normalized(),
                       wound.waiting, 0};
  if (!drops_.launch(drop)) run(wound, wound.waiting);
  wound.waiting = 0;
}

void Bleeding::bleed(Wound& wound, const BloodPressures& pressures, std::span<const Vec3> vertices_T, double step_s) {
  double flow = wound.end < 0 ? ooze(wound, pressures) : 0, fast = 0, speed = 0;
  const auto add = [&](const Jet& jet, bool arterial) {
    const double share = arterial && jet.speed > options_.spurt_speed_m_per_s ? options_.spurt_share : 0;
    flow += jet.flow;
    fast += share * jet.flow;
    if (share > 0) speed = std::max(speed, jet.speed);
  };
  for (CutVessel& vessel : wound.vessels) {
    const Jet jet = vessel_jet(wound, vessel, pressures);
    vessel.flow = jet.flow;
    add(jet, vessel.size.supply == Supply::kArterial);
  }
  if (wound.end >= 0) {
    const OpenEnd& end = vessels_.open_ends()[static_cast<std::size_t>(wound.end)];
    add({end.flow_m3_per_s, end.speed_m_per_s}, true);
  }
  wound.flow = flow;
  wound.mean_flow += (1 - std::exp(-step_s / options_.mean_over_s)) * (flow - wound.mean_flow);
  wound.lost += flow * step_s;
  lost_ += flow * step_s;
  run(wound, (flow - fast) * step_s);
  if (fast > 0) {
    spurt(wound, fast * step_s, speed, vertices_T);
  } else if (wound.waiting > 0) {
    run(wound, wound.waiting);
    wound.waiting = 0;
  }
}

void Bleeding::clot(Wound& wound, double step_s) const {
  const double faster = wound.pressed_pa > 0 ? 1 + wound.pressed_share * (options_.pressed_clots_faster - 1) : 1;
  const double left = std::exp(-faster * step_s / options_.clot_s);
  wound.oozing *= left;
  for (CutVessel& vessel : wound.vessels)
    if (vessel.size.radius_m <= options_.clots_up_to_m) vessel.lumen *= left;
}

void Bleeding::step(std::span<const Vec3> vertices_T, double step_s) {
  circulation_.step(step_s, lost_);
  const BloodPressures pressures = circulation_.pressures();
  solve_network(pressures);
  for (Wound& wound : wounds_) {
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0; i < wound.vertices.size(); ++i)
      place += wound.weights[i] * vertices_T[static_cast<std::size_t>(wound.vertices[i])];
    if (place.allFinite()) wound.place_T = place;
    bleed(wound, pressures, vertices_T, step_s);
    clot(wound, step_s);
    wound.was_pressed = wound.pressed_pa > 0;
    wound.pressed_pa = wound.pressed_share = 0;
  }
  for (const Irrigation& jet : jets_) film_.irrigate(jet, vertices_T, step_s);
  for (const Suction& suction : suctions_) film_.suck(suction, vertices_T, step_s);
  jets_.clear();
  suctions_.clear();
  film_.step(vertices_T, step_s);
  drops_.step(vertices_T, step_s, film_);
}

void Bleeding::grow(const TriangleSurface& rest_T, const std::vector<VertexOrigin>& added,
                    const std::vector<bool>& inside) {
  rest_ = rest_T;
  film_.grow(rest_T, added, inside);
}

void Bleeding::reset() {
  circulation_.reset();
  film_.reset();
  drops_.reset();
  vessels_ = whole_vessels_;
  wounds_.clear();
  jets_.clear();
  suctions_.clear();
  lost_ = 0;
  launched_ = 0;
}

WoundState Bleeding::wound(WoundId id) const {
  const Wound& wound = wounds_[static_cast<std::size_t>(id)];
  WoundState out{.place_T = wound.place_T,
                 .area_m2 = wound.area,
                 .depth_m = wound.depth,
                 .oozing_m2 = wound.oozing,
                 .vessels = static_cast<std::int32_t>(wound.vessels.size()) + (wound.end >= 0 ? 1 : 0),
                 .pressed = wound.was_pressed,
                 .lost_ml = wound.lost / kMillilitre,
                 .rate_ml_per_min = wound.mean_flow * 60 / kMillilitre};
  for (const CutVessel& vessel : wound.vessels) {
    out.open_vessels += vessel.flow > 0 ? 1 : 0;
    out.open_share = std::max(out.open_share, vessel.lumen);
  }
  if (wound.end >= 0 && vessels_.open_ends()[static_cast<std::size_t>(wound.end)].flow_m3_per_s > 0) ++out.open_vessels;
  return out;
}

BloodLedger Bleeding::ledger() const {
  const FilmAccount film = film_.account();
  double waiting = 0, flow = 0;
  for (const Wound& wound : wounds_) {
    waiting += wound.waiting;
    flow += wound.mean_flow;
  }
  return {.lost_ml = lost_ / kMillilitre,
          .film_ml = film.film.blood / kMillilitre,
          .dried_ml = film.dried / kMillilitre,
          .pool_ml = film.pool.blood / kMillilitre,
          .sucked_ml = film.sucked.blood / kMillilitre,
          .air_ml = (drops_.volume_m3() + waiting) / kMillilitre,
          .water_given_ml = film.given.water / kMillilitre,
          .water_film_ml = film.film.water / kMillilitre,
          .water_pool_ml = film.pool.water / kMillilitre,
          .water_sucked_ml = film.sucked.water / kMillilitre,
          .evaporated_ml = film.evaporated / kMillilitre,
          .rate_ml_per_min = flow * 60 / kMillilitre};
}

}  // namespace trocar
