#include "tissue/interaction/tissue_heat.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/interaction/heat_conduction.h"

namespace trocar {
namespace {

constexpr double kArrives = 0.1;        // K at a block's face that the block beside takes part
constexpr double kCooled = 0.05;        // K below which a block sleeps
constexpr double kStableShare = 0.9;    // of the step at which a cube gives away all it has above its surroundings
constexpr double kCoolingSteps = 4;     // taken as one while nothing is heated
constexpr double kQuietSteps = 10;      // and nothing is destroyed
constexpr float kMostDamage = 100;      // Omega that is counted
constexpr double kLeastDamage = 1e-3;   // Omega that counts as none between cubes
constexpr float kUnhurt = 0.01f;        // Omega of a block that may be freed
constexpr double kContactReach = 0.87;  // edges of a cube, half its diagonal: from the contact to middles of tissue
constexpr double kTipIsWarm = 0.5;      // K between tip and tissue
constexpr double kFadesOver = 3;        // radii of the contact within which its current is counted

using HeatRowOfBlock = Eigen::Array<double, HeatBlock::kEdge, 1>;

Vec3 heat_round(double reach_m) { return Vec3::Constant(reach_m); }

}  // namespace

TissueHeat::TissueHeat(SurfacePtr rest_T, const TissueHeatOptions& options)
    : options_(options),
      grid_(options.edge_m),
      cell_rate_(options.cells, options.damage_from_c, options.boil_c),
      collagen_rate_(options.collagen, options.damage_from_c, options.boil_c) {
  check_options();
  grid_.set_surface(std::move(rest_T));
  reset();
}

void TissueHeat::check_options() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(std::string("heat in tissue: ") + what);
  };
  const TissueHeatOptions& o = options_;
  require(o.step_s > 0 && o.edge_m > 0, "step and edge are to be above 0");
  require(o.density_kg_m3 * o.specific_heat_j_per_kg_k > o.water_kg_m3 * o.water_j_per_kg_k,
          "the water holds more heat than the tissue");
  require(o.water_kg_m3 > 0 && o.latent_j_per_kg > 0, "no water");
  require(o.conductivity_w_per_m_k > 0 && o.conductivity_slope >= 0, "conductivity is to be above 0 and not to fall");
  require(o.dry_conductivity_share > 0 && o.dry_conductivity_share <= 1, "dry tissue conducts better than wet");
  require(o.perfusion_w_per_m3_k >= 0 && o.gas_w_per_m2_k >= 0, "tissue that takes heat from blood or gas");
  require(o.body_c < o.damage_from_c && o.damage_from_c < o.soft_cap_c && o.soft_cap_c <= o.boil_c &&
              o.boil_c < o.char_from_c && o.char_from_c < o.char_full_c && o.char_full_c <= o.hard_cap_c,
          "temperatures out of order");
  require(o.tip_j_per_k > 0 && o.tip_cools_s > 0 && o.tip_power_share >= 0 && o.tip_power_share < 1, "tip");
  require(o.look_every > 0 && o.char_s > 0, "looks and char");
}

void TissueHeat::reset() {
  awake_.clear();
  grid_.clear();
  looks_.reset(grid_.surface());
  given_.clear();
  vaporised_.clear();
  tips_.clear();
  ledger_ = {};
  hottest_k_ = pending_s_ = 0;
  steps_ = 0;
}

// ---- properties of a cube

double TissueHeat::capacity(double water) const {
  const double dry =
      options_.density_kg_m3 * options_.specific_heat_j_per_kg_k - options_.water_kg_m3 * options_.water_j_per_kg_k;
  return grid_.volume_m3() * (dry + water * options_.water_kg_m3 * options_.water_j_per_kg_k);
}

double TissueHeat::latent_j() const { return grid_.volume_m3() * options_.water_kg_m3 * options_.latent_j_per_kg; }

double TissueHeat::most_stable_step_s() const {
  const double h = options_.edge_m, faces = 6;
  const double most =
      options_.conductivity_w_per_m_k + options_.conductivity_slope * (options_.boil_c - options_.body_c);
  const double gives =
      faces * h * std::max(most, options_.gas_w_per_m2_k * h) + options_.perfusion_w_per_m3_k * grid_.volume_m3();
  return kStableShare * capacity(0) / gives;
}

// ---- a step

bool TissueHeat::heats(const HeatSource& source) const {
  return source.radius_m > 0 && source.rest_T.allFinite() &&
         (source.power_w > 0 || tip_c(source.tool) - options_.body_c > kTipIsWarm);
}

void TissueHeat::step(std::span<const HeatSource> sources) {
  vaporised_.clear();
  given_.assign(sources.size(), {});
  ++steps_;
  cool_tips(options_.step_s);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    given_[i].offered_j = sources[i].power_w * options_.step_s;
    ledger_.offered_j += given_[i].offered_j;
  }
  const bool heated = std::any_of(sources.begin(), sources.end(), [this](const HeatSource& s) { return heats(s); });
  const double together = hottest_c() < options_.damage_from_c ? kQuietSteps : kCoolingSteps;
  if (!heated && !awake_.empty()) pending_s_ += options_.step_s;
  if (pending_s_ > 0 && (heated || pending_s_ > (together - 0.5) * options_.step_s))
    advance({}, std::exchange(pending_s_, 0));
  if (heated) advance(sources, options_.step_s);
  if (steps_ % options_.look_every == 0) looks_.renew(grid_);
}

void TissueHeat::advance(std::span<const HeatSource> sources, double seconds) {
  const double parts = std::ceil(seconds / most_stable_step_s());
  const double dt = seconds / parts;
  for (int part = 0; part < static_cast<int>(parts); ++part) {
    for (std::size_t i = 0; i < sources.size(); ++i) heat(sources[i], dt, given_[i]);
    conduct_all(dt);
    hottest_k_ = 0;
    for (HeatBlock* block : awake_) settle(*block, dt);
  }
  spread_and_sleep();
}

void TissueHeat::conduct_all(double dt) {
  const double edge = options_.edge_m;
  const ConductionTerms terms{edge, options_.perfusion_w_per_m3_k * grid_.volume_m3(),
                              options_.gas_w_per_m2_k * edge * edge};
  for (HeatBlock* block : awake_) {
    const HeatLoss loss = conduct(*block, terms, dt);
    ledger_.perfused_j += loss.perfused_j;
    ledger_.to_gas_j += loss.to_gas_j;
  }
}

// ---- sources and tips

TissueHeat::Spread TissueHeat::spread_of(const HeatSource& source) {
  Spread spread;
  const double a = std::min(source.radius_m, options_.most_radius_m), edge = options_.edge_m;
  const double fades_at = source.mode == HeatMode::kCut ? std::min(a, options_.spark_radius_m) : a;
  const double reach = std::max(a + std::min(kFadesOver * a, options_.most_spread_m), kContactReach * edge + a);
  const Vec3 low = source.rest_T - heat_round(reach), high = source.rest_T + heat_round(reach);
  grid_.for_indices(low, high, [&](const HeatBlock::Index& index) { wake(index); });
  double sum = 0, nearest = reach;
  grid_.for_cells(low, high, [&](HeatBlock& block, std::size_t cell, const Vec3& middle) {
    const double distance = (middle - source.rest_T).norm();
    if (block.state[cell] != HeatCell::kTissue || distance > reach) return;
    const double radii = distance / fades_at, fades = 1 / ((1 + radii * radii) * (1 + radii * radii));
    spread.cube.push_back({&block, cell});
    spread.share.push_back(fades);
    spread.under.push_back(distance <= a + kContactReach * edge);
    sum += fades;
    nearest = std::min(nearest, distance);
  });
  if (nearest > a + kContactReach * edge) return {};
  for (double& share : spread.share) share /= sum;
  return spread;
}

double TissueHeat::contact_rise(const Spread& spread) const {
  double sum = 0, shares = 0;
  for (std::size_t i = 0; i < spread.cube.size(); ++i)
    if (spread.under[i]) {
      sum += spread.share[i] * spread.cube[i].block->rise_k[spread.cube[i].cell];
      shares += spread.share[i];
    }
  return sum / shares;
}

void TissueHeat::heat(const HeatSource& source, double dt, HeatGiven& given) {
  if (!heats(source)) return;
  const Spread spread = spread_of(source);
  if (spread.cube.empty()) return;
  given.touches = true;
  given.contact_c = options_.body_c + contact_rise(spread);
  exchange_with_tip(source, spread, dt);
  if (source.power_w > 0) deliver(source, spread, dt, given);
}

/// What a cube can take before it reaches the cap of the mode.
double TissueHeat::room_j(const HeatBlock& block, std::size_t cell, HeatMode mode) const {
  const double water = block.water[cell], temperature_c = options_.body_c + block.rise_k[cell];
  if (mode == HeatMode::kSoftCoagulation) return std::max(0.0, capacity(water) * (options_.soft_cap_c - temperature_c));
  if (water <= 0) return std::max(0.0, capacity(0) * (options_.hard_cap_c - temperature_c));
  return capacity(water) * (options_.boil_c - temperature_c) + water * latent_j() +
         capacity(0) * (options_.hard_cap_c - options_.boil_c);
}

void TissueHeat::deliver(const HeatSource& source, const Spread& spread, double dt, HeatGiven& given) {
  const double sparks = source.mode == HeatMode::kSoftCoagulation ? 0 : options_.tip_power_share * source.power_w * dt;
  const double hottest_tip = options_.hard_cap_c - options_.body_c;
  const double into_tip = std::clamp(options_.tip_j_per_k * (hottest_tip - tip(source.tool)), 0.0, sparks);
  tip(source.tool) += into_tip / options_.tip_j_per_k;
  ledger_.into_tip_j += into_tip;
  given.delivered_j += into_tip;
  for (std::size_t i = 0; i < spread.cube.size(); ++i) {
    const auto [block, cell] = spread.cube[i];
    const double joule = std::min(spread.share[i] * (source.power_w * dt - sparks), room_j(*block, cell, source.mode));
    block->rise_k[cell] += joule / capacity(block->water[cell]);
    ledger_.delivered_j += joule;
    given.delivered_j += joule;
    boil(*block, cell);
    if (source.mode == HeatMode::kCut && spread.under[i] && block->water[cell] <= 0) vaporise(*block, cell);
  }
}

double& TissueHeat::tip(int tool) {
  const auto t = static_cast<std::size_t>(std::max(tool, 0));
  if (t >= tips_.size()) tips_.resize(t + 1, 0);
  return tips_[t];
}

void TissueHeat::cool_tips(double dt) {
  for (double& rise_k : tips_) rise_k *= std::exp(-dt / options_.tip_cools_s);
}

/// Each cube under the contact comes nearer to the tip's temperature and never past it, nor the tip past theirs.
void TissueHeat::exchange_with_tip(const HeatSource& source, const Spread& spread, double dt) {
  double shares = 0, given_j = 0;
  for (std::size_t i = 0; i < spread.cube.size(); ++i) shares += spread.under[i] ? spread.share[i] : 0;
  const double passes_j_per_k =
      std::min(4 * options_.conductivity_w_per_m_k * source.radius_m * dt, options_.tip_j_per_k / 2);
  for (std::size_t i = 0; i < spread.cube.size(); ++i) {
    if (!spread.under[i]) continue;
    const auto [block, cell] = spread.cube[i];
    const double holds_j_per_k = capacity(block->water[cell]);
    const double joule = (tip(source.tool) - block->rise_k[cell]) *
                         std::min(passes_j_per_k * spread.share[i] / shares, holds_j_per_k / 2);
    block->rise_k[cell] += joule / holds_j_per_k;
    given_j += joule;
    boil(*block, cell);
  }
  tip(source.tool) -= given_j / options_.tip_j_per_k;
  ledger_.from_tip_j += given_j;
}

// ---- what heat does

void TissueHeat::settle(HeatBlock& block, double dt) {
  const double hurts_k = options_.damage_from_c - options_.body_c;
  block.hottest_k = 0;
  for (std::size_t row = 0; row < HeatBlock::kCells; row += HeatBlock::kEdge) {
    Eigen::Map<HeatRowOfBlock> rise(&block.rise_k[row]), next(&block.next_k[row]);
    const HeatRowOfBlock mean = (rise + next) / 2;
    rise = next;
    if (std::max(mean.maxCoeff(), rise.maxCoeff()) > hurts_k)
      for (std::size_t i = 0; i < HeatBlock::kEdge; ++i) settle(block, row + i, mean[static_cast<Eigen::Index>(i)], dt);
    block.hottest_k = std::max(block.hottest_k, rise.maxCoeff());
  }
  set_conductivity(block);
  hottest_k_ = std::max(hottest_k_, block.hottest_k);
}

void TissueHeat::set_conductivity(HeatBlock& block) {
  const double wet = options_.conductivity_w_per_m_k, slope = options_.conductivity_slope,
               dry_share = options_.dry_conductivity_share, most_k = options_.boil_c - options_.body_c;
  for (std::size_t c = 0; c < HeatBlock::kCells; ++c) {
    const double counted_k = std::min(std::max(block.rise_k[c], 0.0), most_k);
    const double conducts = (wet + slope * counted_k) * (dry_share + (1 - dry_share) * block.water[c]);
    block.conductivity[c] = block.state[c] == HeatCell::kTissue ? static_cast<float>(conducts) : 0.0f;
  }
}

void TissueHeat::settle(HeatBlock& block, std::size_t cell, double mean_k, double dt) {
  if (block.state[cell] != HeatCell::kTissue) return;
  boil(block, cell);
  const double temperature_c = options_.body_c + mean_k;
  if (temperature_c > options_.damage_from_c) hurt(block, cell, temperature_c, dt);
}

void TissueHeat::boil(HeatBlock& block, std::size_t cell) {
  const double boil_k = options_.boil_c - options_.body_c;
  double& water = block.water[cell];
  double& rise_k = block.rise_k[cell];
  if (rise_k <= boil_k || water <= 0) return;
  const double excess = capacity(water) * (rise_k - boil_k), all = water * latent_j();
  const double gone = excess < all ? excess / latent_j() : water;
  ledger_.steam_j += gone * (latent_j() + (capacity(1) - capacity(0)) * boil_k);
  water = excess < all ? water - gone : 0;
  rise_k = excess < all ? boil_k : boil_k + (excess - all) / capacity(0);
  block.capacity[cell] = static_cast<float>(capacity(water));
}

void TissueHeat::hurt(HeatBlock& block, std::size_t cell, double temperature_c, double dt) {
  const auto add = [dt](float& omega, double rate) {
    omega = std::min(kMostDamage, omega + static_cast<float>(dt * rate));
  };
  block.looks_different = block.looks_different || block.damage[cell] < 1;
  add(block.damage[cell], cell_rate_.rate_per_s(temperature_c));
  add(block.collagen[cell], collagen_rate_.rate_per_s(temperature_c));
  if (temperature_c <= options_.char_from_c || block.water[cell] > options_.char_dry || block.charred[cell] >= 1)
    return;
  const double full = (temperature_c - options_.char_from_c) / (options_.char_full_c - options_.char_from_c);
  block.charred[cell] = std::min(1.0f, block.charred[cell] + static_cast<float>(full * dt / options_.char_s));
  block.looks_different = true;
}

void TissueHeat::vaporise(HeatBlock& block, std::size_t cell) {
  ledger_.removed_j += capacity(block.water[cell]) * block.rise_k[cell];
  block.rise_k[cell] = block.next_k[cell] = 0;
  grid_.vaporise(block, cell);
  vaporised_.push_back({grid_.middle(block, cell), options_.edge_m});
  const auto left = static_cast<float>(options_.char_left_by_cut);
  const auto blacken = [left](HeatBlock& of, std::size_t which) {
    of.charred[which] = std::max(of.charred[which], left);
    of.looks_different = true;
  };
  blacken(block, cell);
  block.damage[cell] = block.collagen[cell] = kMostDamage;
  for (std::size_t side = 0; side < block.beside.size(); ++side)
    if (const HeatCube near = grid_.beside(block, cell, side);
        near.block != nullptr && near.block->state[near.cell] == HeatCell::kTissue)
      blacken(*near.block, near.cell);
}

// ---- blocks come and go

HeatBlock* TissueHeat::wake(const HeatBlock::Index& index) {
  bool fresh = false;
  HeatBlock* const block = grid_.need(index, fresh);
  if (block == nullptr) return nullptr;
  if (fresh) {
    block->capacity.fill(static_cast<float>(capacity(1)));
    set_conductivity(*block);
    looks_.watch(*block, grid_, 0);
  }
  block->wanted = true;
  if (!block->awake) {
    block->awake = true;
    const auto by_index = [](const HeatBlock* a, const HeatBlock* b) { return a->index < b->index; };
    awake_.insert(std::lower_bound(awake_.begin(), awake_.end(), block, by_index), block);
  }
  return block;
}

namespace {

/// Highest rise of the cubes along a side of a block.
double most_at_side(const HeatBlock& block, std::size_t side) {
  constexpr int e = HeatBlock::kEdge;
  const int at = side % 2 == 0 ? 0 : e - 1;
  double most = 0;
  for (int v = 0; v < e; ++v)
    for (int u = 0; u < e; ++u) {
      const std::array<std::size_t, 3> cell{HeatBlock::cell(at, u, v), HeatBlock::cell(u, at, v),
                                            HeatBlock::cell(u, v, at)};
      most = std::max(most, block.rise_k[cell[side / 2]]);
    }
  return most;
}

}  // namespace

bool TissueHeat::unhurt(const HeatBlock& block) const {
  const auto is_new = [](const HeatBlock& b, std::size_t c) {
    return b.state[c] != HeatCell::kVaporised && b.damage[c] < kUnhurt && b.charred[c] <= 0 && b.water[c] >= 1;
  };
  for (std::size_t c = 0; c < HeatBlock::kCells; ++c)
    if (!is_new(block, c)) return false;
  return true;
}

void TissueHeat::spread_and_sleep() {
  const std::vector<HeatBlock*> were_awake = awake_;
  for (const HeatBlock* block : were_awake)
    for (std::size_t side = 0; block->hottest_k > kArrives && side < block->beside.size(); ++side)
      if (most_at_side(*block, side) > kArrives) wake(HeatBlock::beside_index(block->index, side));
  std::vector<HeatBlock*> still;
  for (HeatBlock* block : awake_) {
    if (std::exchange(block->wanted, false) || block->hottest_k > kCooled) {
      still.push_back(block);
      continue;
    }
    for (std::size_t c = 0; c < HeatBlock::kCells; ++c)
      ledger_.dropped_j += capacity(block->water[c]) * std::exchange(block->rise_k[c], 0);
    block->awake = false;
    if (unhurt(*block)) grid_.free(*block);
  }
  awake_ = std::move(still);
}

void TissueHeat::grow(SurfacePtr rest_T, const std::vector<VertexOrigin>& added) {
  const std::size_t before = grid_.surface().vertices.size();
  if (rest_T->vertices.size() != before + added.size())
    throw InputError("heat in tissue: " + std::to_string(before) + " vertices and " + std::to_string(added.size()) +
                     " new ones are not " + std::to_string(rest_T->vertices.size()));
  grid_.set_surface(std::move(rest_T));
  grid_.forget_empty();
  looks_.grow(grid_.surface());
  grid_.for_blocks([&](HeatBlock& block) {
    if (!looks_.watch(block, grid_, before)) return;
    block.looks_different = true;
    examine_again(block);
  });
  looks_.renew(grid_);
}

void TissueHeat::examine_again(HeatBlock& block) {
  grid_.examine(block);
  for (std::size_t c = 0; c < HeatBlock::kCells; ++c)
    if (block.state[c] != HeatCell::kTissue)
      ledger_.removed_j += capacity(block.water[c]) * std::exchange(block.rise_k[c], 0);
  set_conductivity(block);
}

// ---- questions

Vec3 TissueHeat::at_rest(const MaterialPoint& place) const {
  const auto& [a, b, c] = grid_.surface().triangles[static_cast<std::size_t>(place.triangle)];
  const auto& vertices = grid_.surface().vertices;
  return interpolate(place.weight, {vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)],
                                    vertices[static_cast<std::size_t>(c)]});
}

double TissueHeat::temperature_at(const Vec3& rest_T) const {
  return options_.body_c +
         grid_.mean_round(rest_T, 0, false, [](const HeatBlock& b, std::size_t c) { return b.rise_k[c]; });
}

double TissueHeat::damage_at(const Vec3& rest_T) const {
  const double mean = grid_.mean_round(rest_T, std::log(kLeastDamage), true, [](const HeatBlock& b, std::size_t c) {
    return std::log(double(b.damage[c]) + kLeastDamage);
  });
  return std::max(0.0, std::exp(mean) - kLeastDamage);
}

double TissueHeat::softened_at(const Vec3& rest_T) const {
  return grid_.mean_round(rest_T, 0, true,
                          [](const HeatBlock& b, std::size_t c) { return 1 - std::exp(-double(b.collagen[c])); });
}

HeatLook TissueHeat::look_at(const Vec3& rest_T) const {
  const double charred =
      grid_.mean_round(rest_T, 0, true, [](const HeatBlock& b, std::size_t c) { return double(b.charred[c]); });
  return {static_cast<float>(std::min(1.0, damage_at(rest_T))), static_cast<float>(charred)};
}

bool TissueHeat::vaporised_at(const Vec3& rest_T) const {
  const double reach = 0.5 * options_.edge_m;
  bool gone = false;
  grid_.for_cells(
      rest_T - heat_round(reach), rest_T + heat_round(reach),
      [&](const HeatBlock& b, std::size_t c, const Vec3&) { gone = gone || b.state[c] == HeatCell::kVaporised; });
  return gone;
}

bool TissueHeat::sealed_at(const Vec3& rest_T, const Vec3& axis, double radius_m) const {
  const Vec3 u = axis.unitOrthogonal(), v = axis.normalized().cross(u);
  const int rings = std::max(1, static_cast<int>(std::ceil(2 * radius_m / options_.edge_m)));
  for (int ring = 0; ring <= rings; ++ring) {
    const int places = std::max(1, 6 * ring);
    for (int i = 0; i < places; ++i) {
      const double turn = 2 * std::numbers::pi * i / places, radius = radius_m * ring / rings;
      if (damage_at(rest_T + radius * (std::cos(turn) * u + std::sin(turn) * v)) < 1) return false;
    }
  }
  return true;
}

double TissueHeat::tip_c(int tool) const {
  const auto t = static_cast<std::size_t>(std::max(tool, 0));
  return options_.body_c + (t < tips_.size() ? tips_[t] : 0);
}

HeatLedger TissueHeat::ledger() const {
  HeatLedger ledger = ledger_;
  for (const HeatBlock* block : awake_)
    for (std::size_t c = 0; c < HeatBlock::kCells; ++c) ledger.stored_j += capacity(block->water[c]) * block->rise_k[c];
  return ledger;
}

double TissueHeat::hottest_c() const { return options_.body_c + hottest_k_; }

}  // namespace trocar
