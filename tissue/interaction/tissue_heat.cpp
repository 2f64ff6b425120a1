#include "tissue/interaction/tissue_heat.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kKelvin = 273.15, kGasConstant = 8.314;
constexpr double kRateStep = 0.1;       // K of the tables of rates: linear between within 0.02 %
constexpr double kArrives = 0.1;        // K at a block's face that the block beside takes part
constexpr double kCooled = 0.05;        // K below which a block sleeps
constexpr double kStableShare = 0.9;    // of the step at which a cube gives away all it has above its surroundings
constexpr double kQuietSteps = 10;      // taken as one while nothing is heated
constexpr float kMostDamage = 100;      // Omega that is counted
constexpr double kLeastDamage = 1e-3;   // Omega that counts as none between cubes
constexpr float kUnhurt = 0.01f;        // Omega of a block that may be freed
constexpr double kContactReach = 0.87;  // edges of a cube, half its diagonal: from the contact to middles of tissue
constexpr double kTipIsWarm = 0.5;      // K between tip and tissue
constexpr double kFadesOver = 3;        // radii of the contact within which its current is counted

/// Shares of a cube's middle at a distance, by the tent of a half-width.
double tent(const Vec3& apart, double half_width_m) {
  double share = 1;
  for (int axis = 0; axis < 3; ++axis) share *= std::max(0.0, 1 - std::abs(apart[axis]) / half_width_m);
  return share;
}

using HeatRow = Eigen::Array<float, HeatBlock::kEdge, 1>;  ///< cubes along x
using HeatRowDouble = Eigen::Array<double, HeatBlock::kEdge, 1>;

Vec3 all_axes(double length_m) { return Vec3::Constant(length_m); }

/// The rate at a temperature, linear in a table that begins at its first one; constant beyond its end.
double rate_in(const std::vector<double>& table, double above_first_k) {
  const double at = above_first_k / kRateStep;
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= table.size()) return table.back();
  return table[below] + (at - static_cast<double>(below)) * (table[below + 1] - table[below]);
}

}  // namespace

double ArrheniusLaw::rate_per_s(double temperature_c) const {
  return frequency_per_s * std::exp(-energy_j_per_mol / (kGasConstant * (temperature_c + kKelvin)));
}

TissueHeat::TissueHeat(SurfacePtr rest_T, const TissueHeatOptions& options) : options_(options), grid_(options.edge_m) {
  check_options();
  tabulate_rates();
  grid_.set_surface(std::move(rest_T));
  set_reach();
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

void TissueHeat::tabulate_rates() {
  const auto count = static_cast<std::size_t>((options_.boil_c - options_.damage_from_c) / kRateStep) + 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double temperature_c = options_.damage_from_c + kRateStep * static_cast<double>(i);
    cell_rate_.push_back(options_.cells.rate_per_s(temperature_c));
    collagen_rate_.push_back(options_.collagen.rate_per_s(temperature_c));
  }
}

void TissueHeat::reset() {
  awake_.clear();
  grid_.clear();
  const std::size_t vertices = grid_.surface().vertices.size();
  white_.assign(vertices, 0);
  charred_.assign(vertices, 0);
  looked_.assign(vertices, 0);
  given_.clear();
  vaporised_.clear();
  tips_.clear();
  ledger_ = {};
  hottest_k_ = pending_s_ = 0;
  steps_ = 0;
  ++looks_;
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

void TissueHeat::step(std::span<const HeatSource> sources) {
  vaporised_.clear();
  given_.assign(sources.size(), {});
  ++steps_;
  cool_tips(options_.step_s);
  const bool quiet = sources.empty() && hottest_k_ + options_.body_c < options_.damage_from_c;
  if (quiet) {
    if (!awake_.empty()) pending_s_ += options_.step_s;
    if (pending_s_ > (kQuietSteps - 0.5) * options_.step_s) advance({}, std::exchange(pending_s_, 0));
  } else {
    if (pending_s_ > 0) advance({}, std::exchange(pending_s_, 0));
    advance(sources, options_.step_s);
  }
  if (steps_ % options_.look_every == 0) look_again();
}

void TissueHeat::advance(std::span<const HeatSource> sources, double seconds) {
  const double parts = std::ceil(seconds / most_stable_step_s());
  const double dt = seconds / parts;
  for (int part = 0; part < static_cast<int>(parts); ++part) {
    for (std::size_t i = 0; i < sources.size(); ++i) heat(sources[i], dt, given_[i]);
    for (HeatBlock* block : awake_) conduct(*block, dt);
    hottest_k_ = 0;
    for (HeatBlock* block : awake_) settle(*block, dt);
  }
  spread_and_sleep();
}

// ---- sources and tips

TissueHeat::Spread TissueHeat::spread_of(const HeatSource& source) {
  Spread spread;
  const double a = source.radius_m, edge = options_.edge_m;
  const double fades_at = source.mode == HeatMode::kCut ? std::min(a, options_.spark_radius_m) : a;
  const double reach = std::max(a + std::min(kFadesOver * a, options_.most_spread_m), kContactReach * edge + a);
  const Vec3 low = source.rest_T - all_axes(reach), high = source.rest_T + all_axes(reach);
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
  const double offered = source.power_w * dt;
  given.offered_j += offered;
  ledger_.offered_j += offered;
  if (source.radius_m <= 0 || (source.power_w <= 0 && tip(source.tool) < kTipIsWarm)) return;
  const Spread spread = spread_of(source);
  if (spread.cube.empty()) return;
  given.touches = true;
  const double contact_k = contact_rise(spread);
  given.contact_c = options_.body_c + contact_k;
  exchange_with_tip(source, spread, contact_k, dt);
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

/// Both ways, until they are as warm as one another; more into the tissue than its cap no tip ever has.
void TissueHeat::exchange_with_tip(const HeatSource& source, const Spread& spread, double contact_k, double dt) {
  double holds = 0, shares = 0;
  for (std::size_t i = 0; i < spread.cube.size(); ++i)
    if (spread.under[i]) {
      holds += capacity(spread.cube[i].block->water[spread.cube[i].cell]);
      shares += spread.share[i];
    }
  const double conductance = 4 * options_.conductivity_w_per_m_k * source.radius_m;
  const double both = 1 / (1 / holds + 1 / options_.tip_j_per_k);
  const double joule = (tip(source.tool) - contact_k) * std::min(conductance * dt, both / 2);
  if (std::abs(tip(source.tool) - contact_k) < kTipIsWarm) return;
  tip(source.tool) -= joule / options_.tip_j_per_k;
  ledger_.from_tip_j += joule;
  for (std::size_t i = 0; i < spread.cube.size(); ++i)
    if (spread.under[i]) {
      const auto [block, cell] = spread.cube[i];
      block->rise_k[cell] += joule * spread.share[i] / shares / capacity(block->water[cell]);
      boil(*block, cell);
    }
}

// ---- conduction, blood and gas

namespace {

/// Rise, conductivity and whether it is tissue (1 or 0), of a block and one cube round it.
struct HeatPadded {
  static constexpr int kEdge = HeatBlock::kEdge + 2;
  std::array<float, kEdge * kEdge * kEdge> rise{}, conductivity{}, tissue{};

  static std::size_t at(int i, int j, int k) { return static_cast<std::size_t>(i + kEdge * (j + kEdge * k)); }
  void copy(const HeatBlock& block, std::size_t from, std::size_t to) {
    rise[to] = static_cast<float>(block.rise_k[from]);
    conductivity[to] = block.conductivity[from];
    tissue[to] = block.state[from] == HeatCell::kTissue ? 1.0f : 0.0f;
  }
  explicit HeatPadded(const HeatBlock& block) {
    constexpr int e = HeatBlock::kEdge;
    for (int k = 0; k < e; ++k)
      for (int j = 0; j < e; ++j)
        for (int i = 0; i < e; ++i) copy(block, HeatBlock::cell(i, j, k), at(i + 1, j + 1, k + 1));
    for (std::size_t side = 0; side < block.beside.size(); ++side)
      if (block.beside[side] != nullptr) copy_side(*block.beside[side], side);
  }
  void copy_side(const HeatBlock& beside, std::size_t side) {
    constexpr int e = HeatBlock::kEdge;
    const int from = side % 2 == 0 ? e - 1 : 0, to = side % 2 == 0 ? 0 : e + 1;
    for (int v = 0; v < e; ++v)
      for (int u = 0; u < e; ++u) {
        if (side / 2 == 0) copy(beside, HeatBlock::cell(from, u, v), at(to, u + 1, v + 1));
        if (side / 2 == 1) copy(beside, HeatBlock::cell(u, from, v), at(u + 1, to, v + 1));
        if (side / 2 == 2) copy(beside, HeatBlock::cell(u, v, from), at(u + 1, v + 1, to));
      }
  }
};

HeatRow heat_row(const float* first) { return Eigen::Map<const HeatRow>(first); }

}  // namespace

/// Eight cubes at a time. What passes between two cubes is the same number from either.
void TissueHeat::conduct(HeatBlock& block, double dt) {
  constexpr int kEdge = HeatBlock::kEdge, kRow = HeatPadded::kEdge;
  constexpr std::array<std::ptrdiff_t, 6> kBeside{-1, 1, -kRow, kRow, -kRow * kRow, kRow * kRow};
  const HeatPadded padded(block);
  const auto blood_w_per_k = static_cast<float>(options_.perfusion_w_per_m3_k * grid_.volume_m3());
  const auto gas_w_per_k = static_cast<float>(options_.gas_w_per_m2_k * options_.edge_m * options_.edge_m);
  const auto half_edge = static_cast<float>(options_.edge_m / 2);
  HeatRow perfused = HeatRow::Zero(), to_gas = HeatRow::Zero();
  for (int k = 0; k < kEdge; ++k)
    for (int j = 0; j < kEdge; ++j) {
      const std::size_t c = HeatBlock::cell(0, j, k), p = HeatPadded::at(1, j + 1, k + 1);
      const HeatRow rise = heat_row(&padded.rise[p]), conducts = heat_row(&padded.conductivity[p]),
                    tissue = heat_row(&padded.tissue[p]);
      HeatRow flow = HeatRow::Zero(), open = HeatRow::Constant(6);
      for (const std::ptrdiff_t n : kBeside) {
        const HeatRow beside = heat_row(&padded.tissue[p] + n);
        flow += (heat_row(&padded.conductivity[p] + n) * tissue + conducts * beside) *
                (heat_row(&padded.rise[p] + n) - rise);
        open -= beside;
      }
      const HeatRow flows = (1 - heat_row(&block.damage[c])).max(0.0f);
      const HeatRow skin = Eigen::Map<const Eigen::Array<bool, kEdge, 1>>(&block.skin[c]).cast<float>();
      const HeatRow blood = blood_w_per_k * tissue * flows * rise, gas = gas_w_per_k * tissue * skin * open * rise;
      const HeatRow warms = static_cast<float>(dt) * (half_edge * flow - blood - gas) / heat_row(&block.capacity[c]);
      Eigen::Map<HeatRowDouble>(&block.next_k[c]) =
          Eigen::Map<const HeatRowDouble>(&block.rise_k[c]) + warms.cast<double>();
      perfused += blood;
      to_gas += gas;
    }
  ledger_.perfused_j += dt * perfused.cast<double>().sum();
  ledger_.to_gas_j += dt * to_gas.cast<double>().sum();
}

// ---- what heat does

void TissueHeat::settle(HeatBlock& block, double dt) {
  const double hurts_k = options_.damage_from_c - options_.body_c;
  block.hottest_k = 0;
  for (std::size_t row = 0; row < HeatBlock::kCells; row += HeatBlock::kEdge) {
    Eigen::Map<HeatRowDouble> rise(&block.rise_k[row]), next(&block.next_k[row]);
    const HeatRowDouble mean = (rise + next) / 2;
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
  const double above = temperature_c - options_.damage_from_c;
  const auto add = [dt](float& omega, double rate) {
    omega = std::min(kMostDamage, omega + static_cast<float>(dt * rate));
  };
  block.looks_different = block.looks_different || block.damage[cell] < 1;
  add(block.damage[cell], rate_in(cell_rate_, above));
  add(block.collagen[cell], rate_in(collagen_rate_, above));
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
    add_watchers(*block, 0);
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

// ---- looks

void TissueHeat::set_reach() {
  const TriangleSurface& surface = grid_.surface();
  std::vector<double> sum(surface.vertices.size(), 0), count(surface.vertices.size(), 0);
  for (const auto& triangle : surface.triangles)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto a = static_cast<std::size_t>(triangle[corner]),
                 b = static_cast<std::size_t>(triangle[(corner + 1) % 3]);
      const double length = (surface.vertices[a] - surface.vertices[b]).norm();
      sum[a] += length;
      sum[b] += length;
      ++count[a];
      ++count[b];
    }
  reach_.resize(surface.vertices.size());
  for (std::size_t v = 0; v < reach_.size(); ++v)
    reach_[v] = static_cast<float>(
        std::clamp(count[v] > 0 ? sum[v] / count[v] : 0, options_.least_reach_m, options_.most_reach_m));
}

void TissueHeat::add_watchers(HeatBlock& block, std::size_t first_vertex) {
  const double half = options_.edge_m * HeatBlock::kEdge / 2;
  const Vec3 middle = 2 * half * (Vec3(block.index[0], block.index[1], block.index[2]) + all_axes(0.5));
  const auto& vertices = grid_.surface().vertices;
  for (std::size_t v = first_vertex; v < vertices.size(); ++v)
    if ((vertices[v] - middle).cwiseAbs().maxCoeff() < half + reach_[v] + options_.edge_m)
      block.watchers.push_back(static_cast<std::int32_t>(v));
}

HeatLook TissueHeat::look_of_vertex(std::size_t vertex) const {
  const Vec3& at = grid_.surface().vertices[vertex];
  const double reach = reach_[vertex], edge = options_.edge_m;
  HeatLook look;
  grid_.for_cells(at - all_axes(reach + edge), at + all_axes(reach + edge),
                  [&](const HeatBlock& block, std::size_t cell, const Vec3& middle) {
                    const bool seen = block.skin[cell] || block.state[cell] == HeatCell::kVaporised;
                    if (!seen || block.damage[cell] <= 0) return;
                    const double away = std::max(0.0, (middle - at).norm() - edge) / reach;
                    const auto share = static_cast<float>(std::max(0.0, 1 - away));
                    look.white = std::max(look.white, share * std::min(1.0f, block.damage[cell]));
                    look.charred = std::max(look.charred, share * block.charred[cell]);
                  });
  return look;
}

void TissueHeat::look_again() {
  bool any = false;
  grid_.for_blocks([&](HeatBlock& block) {
    if (!std::exchange(block.looks_different, false)) return;
    if (!std::exchange(any, true)) ++looks_;
    for (const std::int32_t vertex : block.watchers) {
      const auto v = static_cast<std::size_t>(vertex);
      if (std::exchange(looked_[v], looks_) == looks_) continue;
      const HeatLook look = look_of_vertex(v);
      white_[v] = look.white;
      charred_[v] = look.charred;
    }
  });
}

void TissueHeat::grow(SurfacePtr rest_T, const std::vector<VertexOrigin>& added) {
  const std::size_t before = white_.size();
  grid_.set_surface(std::move(rest_T));
  grid_.forget_empty();
  set_reach();
  const auto& vertices = grid_.surface().vertices;
  if (vertices.size() != before + added.size())
    throw InputError("heat in tissue: the surface has grown by " + std::to_string(vertices.size() - before) +
                     " vertices, not by " + std::to_string(added.size()));
  white_.resize(vertices.size(), 0);
  charred_.resize(vertices.size(), 0);
  looked_.resize(vertices.size(), 0);
  grid_.for_blocks([&](HeatBlock& block) {
    const std::size_t watchers = block.watchers.size();
    add_watchers(block, before);
    if (block.watchers.size() == watchers) return;
    block.looks_different = true;
    examine_again(block);
  });
  look_again();
}

void TissueHeat::examine_again(HeatBlock& block) {
  grid_.examine(block);
  for (std::size_t c = 0; c < HeatBlock::kCells; ++c)
    if (block.state[c] != HeatCell::kTissue)
      ledger_.removed_j += capacity(block.water[c]) * std::exchange(block.rise_k[c], 0);
  set_conductivity(block);
}

// ---- questions

template <typename Value>
double TissueHeat::mean_round(const Vec3& rest_T, double none, bool with_vaporised, Value value) const {
  for (const double width : {1.0, 2.0}) {
    double sum = 0, weights = 0;
    const Vec3 reach = all_axes(width * options_.edge_m);
    grid_.for_cells(rest_T - reach, rest_T + reach, [&](const HeatBlock& block, std::size_t cell, const Vec3& middle) {
      if (block.state[cell] == HeatCell::kOutside) return;
      if (!with_vaporised && block.state[cell] == HeatCell::kVaporised) return;
      const double weight = tent(middle - rest_T, reach[0]);
      sum += weight * value(block, cell);
      weights += weight;
    });
    if (weights > 0) return sum / weights;
  }
  return none;
}

double TissueHeat::temperature_c(const Vec3& rest_T) const {
  return options_.body_c + mean_round(rest_T, 0, false, [](const HeatBlock& b, std::size_t c) { return b.rise_k[c]; });
}

double TissueHeat::damage(const Vec3& rest_T) const {
  const double mean = mean_round(rest_T, std::log(kLeastDamage), true, [](const HeatBlock& b, std::size_t c) {
    return std::log(double(b.damage[c]) + kLeastDamage);
  });
  return std::max(0.0, std::exp(mean) - kLeastDamage);
}

double TissueHeat::softened(const Vec3& rest_T) const {
  return mean_round(rest_T, 0, true,
                    [](const HeatBlock& b, std::size_t c) { return 1 - std::exp(-double(b.collagen[c])); });
}

HeatLook TissueHeat::look(const Vec3& rest_T) const {
  const double charred =
      mean_round(rest_T, 0, true, [](const HeatBlock& b, std::size_t c) { return double(b.charred[c]); });
  return {static_cast<float>(std::min(1.0, damage(rest_T))), static_cast<float>(charred)};
}

bool TissueHeat::vaporised(const Vec3& rest_T) const {
  const double reach = 0.5 * options_.edge_m;
  bool gone = false;
  grid_.for_cells(
      rest_T - all_axes(reach), rest_T + all_axes(reach),
      [&](const HeatBlock& b, std::size_t c, const Vec3&) { gone = gone || b.state[c] == HeatCell::kVaporised; });
  return gone;
}

bool TissueHeat::sealed(const Vec3& rest_T, const Vec3& axis, double radius_m) const {
  const Vec3 u = axis.unitOrthogonal(), v = axis.normalized().cross(u);
  const int rings = std::max(1, static_cast<int>(std::ceil(2 * radius_m / options_.edge_m)));
  for (int ring = 0; ring <= rings; ++ring) {
    const int places = std::max(1, 6 * ring);
    for (int i = 0; i < places; ++i) {
      const double turn = 2 * std::numbers::pi * i / places, radius = radius_m * ring / rings;
      if (damage(rest_T + radius * (std::cos(turn) * u + std::sin(turn) * v)) < 1) return false;
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
