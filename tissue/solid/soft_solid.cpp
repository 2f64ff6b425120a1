#include "tissue/solid/soft_solid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

#include "haptics/input_error.h"
#include "tissue/solid/cell_lanes.h"
#include "tissue/solid/cube_element.h"

namespace trocar {
namespace {

constexpr float kMostExponent = 2.0794415F;  // ln 8: the most by which strain stiffens
constexpr int kActiveSetPasses = 3;
constexpr int kMostLocal = 80;            // iterations of a clamped neighbourhood
constexpr double kLocalTolerance = 1e-6;  // of its energy: 0.1 % of the displacement
constexpr double kLooseFit = 1e-3;        // of the edge, between a cell's corners and a cube

Vec3f as_vector(const Vec3f& value) { return value; }
Vec3f as_vector(const NodeRow& row) { return {row.at[0], row.at[1], row.at[2]}; }

/// Of the lattice that the nodes lie on.
std::vector<std::array<std::int32_t, 3>> grid_places(std::span<const Vec3> nodes, double edge_m) {
  Vec3 low = Vec3::Constant(1e9);
  for (const Vec3& node : nodes) low = low.cwiseMin(node);
  std::vector<std::array<std::int32_t, 3>> out;
  for (const Vec3& node : nodes) {
    const Vec3 at = (node - low) / edge_m + Vec3::Constant(0.5);
    out.push_back(
        {static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]), static_cast<std::int32_t>(at[2])});
  }
  return out;
}

/// Spreads the bits of a lattice index: cells of one neighbourhood stand together.
std::uint64_t interleaved(const std::array<std::int32_t, 3>& at) {
  std::uint64_t key = 0;
  for (unsigned bit = 0; bit < 21; ++bit)
    for (unsigned axis = 0; axis < kAxes; ++axis)
      key |= static_cast<std::uint64_t>(at[axis] >> bit & 1) << (kAxes * bit + axis);
  return key;
}

}  // namespace

/// What a product with the step's matrix reads of eight cells.
struct alignas(kLanes * sizeof(float)) SoftSolid::Group {
  std::int32_t node[kCubeCorners][kLanes];
  Lane rotation[kAxes][kAxes];
  Lane growth[kAxes][kAxes];  ///< cofactors of R^T F
  Lane step_mu, step_kappa;   ///< of the step's matrix
};

/// The rest of what is known of them.
struct alignas(kLanes * sizeof(float)) SoftSolid::History {
  Lane strain[kAxes][kCubeCorners];   ///< R^T x - X, in modes
  Lane held[kAxes][kCubeCorners][2];  ///< strain that the branches still hold, in modes
  Lane swollen, held_swollen[2];      ///< change of volume, as strain is in modes, and what the branches hold of it
  Lane mu, kappa;                     ///< long-term, with fill and edge
  Lane instant;                       ///< instantaneous over long-term
  Lane share[2], keep[2];             ///< g_i and a_i
  Lane stiffening;                    ///< c
  Lane volume;                        ///< of tissue, m3, for the record
};

SoftSolid::~SoftSolid() = default;
SoftSolid::SoftSolid(SoftSolid&&) noexcept = default;

SoftSolid::SoftSolid(std::span<const Vec3> nodes, std::span<const SoftCell> cells,
                     std::span<const TissueSolid> materials, const SoftSolidOptions& options)
    : options_(options), cells_(cells.begin(), cells.end()), materials_(materials.begin(), materials.end()) {
  for (const Vec3& node : nodes) rest_.push_back(node.cast<float>());
  rest_.push_back(Vec3f::Zero());  // what lanes without a cell hang on
  position_ = rest_;
  const std::size_t count = rest_.size();
  velocity_.assign(count, Vec3f::Zero());
  velocity_before_ = velocity_next_ = change_ = guess_ = elastic_ = load_ = velocity_;
  support_.assign(count, 0);
  resize_rows();
  root_.resize(count - 1);
  std::iota(root_.begin(), root_.end(), 0);

  const std::vector<std::array<std::int32_t, 3>> places = grid_places(nodes, options.edge_m);
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 first = nodes[static_cast<std::size_t>(cells[i].node[0])];
    for (int a = 0; a < kCubeCorners; ++a) {
      const Vec3 cube = first + options.edge_m * Vec3(a & 1, a >> 1 & 1, a >> 2);
      if ((nodes[static_cast<std::size_t>(cells[i].node[static_cast<std::size_t>(a)])] - cube).norm() >
          kLooseFit * options.edge_m)
        throw InputError("cell " + std::to_string(i) + " of the lattice is no cube of its edge");
    }
    if (cells[i].material < 0 || cells[i].material >= static_cast<std::int32_t>(materials.size()))
      throw InputError("cell " + std::to_string(i) + " of the lattice has a material that there is not");
    if (!(cells[i].stiffness > 0)) throw InputError("cell " + std::to_string(i) + " of the lattice has no stiffness");
    order.emplace_back(interleaved(places[static_cast<std::size_t>(cells[i].node[0])]), i);
  }
  std::sort(order.begin(), order.end());
  lane_.resize(cells.size());
  for (std::size_t at = 0; at < order.size(); ++at) lane_[order[at].second] = at;
  add_groups();
  for (const SoftCell& cell : cells_) places_.push_back(places[static_cast<std::size_t>(cell.node[0])]);
  find_levels();
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) fill_lane(cell);
  spread_cells();
  prepare();
}

void SoftSolid::add_groups() {
  while (groups_.size() * kLanes < cells_.size()) {
    all_groups_.push_back(static_cast<std::int32_t>(groups_.size()));
    Group& group = groups_.emplace_back();
    History& history = histories_.emplace_back();
    std::memset(&group, 0, sizeof group);
    std::memset(&history, 0, sizeof history);
    for (std::size_t c = 0; c < kAxes; ++c) group.rotation[c][c] = all(1);
  }
  // Lanes without a cell stand behind all others and hang on the last node.
  for (std::size_t at = cells_.size(); at < groups_.size() * kLanes; ++at)
    for (auto& corner : groups_[at / kLanes].node) corner[at % kLanes] = static_cast<std::int32_t>(rest_.size() - 1);
}

void SoftSolid::resize_rows() {
  const std::size_t count = rest_.size();
  for (auto* rows : {&right_, &residual_, &direction_, &product_, &solution_}) rows->assign(count, NodeRow{});
  for (auto* values : {&stiffness_diagonal_, &shift_, &inverse_, &tie_diagonal_}) values->assign(count, 0);
}

void SoftSolid::find_levels() {
  std::vector<PlacedCell> cells;
  for (std::size_t i = 0; i < cells_.size(); ++i) cells.push_back({places_[i], cells_[i].node});
  levels_ = NodeLevels(cells, node_count());
}

void SoftSolid::fill_lane(std::size_t number) {
  Group& group = groups_[lane_[number] / kLanes];
  History& history = histories_[lane_[number] / kLanes];
  const std::size_t l = lane_[number] % kLanes;
  const SoftCell& cell = cells_[number];
  const TissueSolid& material = materials_[static_cast<std::size_t>(cell.material)];
  const double young = cell.stiffness * material.young_pa;
  const double shear = young / (2 * (1 + material.poisson));
  const double bulk = young / (3 * (1 - 2 * material.poisson));
  history.mu[l] = static_cast<float>(cell.fill * options_.edge_m * shear);
  history.kappa[l] = static_cast<float>(cell.fill * options_.edge_m * bulk);
  history.volume[l] = static_cast<float>(cell.fill * std::pow(options_.edge_m, 3));
  history.instant[l] = static_cast<float>(1 / (1 - material.prony[0].share - material.prony[1].share));
  for (std::size_t i = 0; i < 2; ++i) {
    const double tau = material.prony[i].tau_s;
    history.share[i][l] = static_cast<float>(material.prony[i].share);
    history.keep[i][l] = static_cast<float>(tau / (tau + options_.step_s));
  }
  history.stiffening[l] = static_cast<float>(material.stiffening);
  for (std::size_t a = 0; a < kCubeCorners; ++a) group.node[a][l] = cell.node[a];
}

void SoftSolid::spread_cells() {
  mass_.assign(rest_.size(), 0);
  groups_of_node_.assign(rest_.size(), {});
  std::vector<std::size_t> order(cells_.size());
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) order[lane_[cell]] = cell;
  for (const std::size_t number : order) {
    const SoftCell& cell = cells_[number];
    const double density = materials_[static_cast<std::size_t>(cell.material)].density_kg_m3;
    const auto group = static_cast<std::int32_t>(lane_[number] / kLanes);
    for (const std::int32_t node : cell.node) {
      mass_[static_cast<std::size_t>(node)] +=
          static_cast<float>(density * cell.fill * std::pow(options_.edge_m, 3) / kCubeCorners);
      auto& of_node = groups_of_node_[static_cast<std::size_t>(node)];
      if (of_node.empty() || of_node.back() != group) of_node.push_back(group);
    }
  }
}

void SoftSolid::sever(std::span<const std::int32_t> node_parent, std::span<const SoftCellChange> cells) {
  const std::size_t before = node_count();
  const auto insert = [&](auto& values) {  // the last one stays that of lanes without a cell
    values.resize(rest_.size() - 1 + node_parent.size() + 1);
    values.back() = values[before];
    for (std::size_t i = 0; i < node_parent.size(); ++i)
      values[before + i] = values[static_cast<std::size_t>(node_parent[i])];
  };
  for (auto* values : {&position_, &velocity_, &velocity_before_, &velocity_next_, &change_, &guess_, &load_})
    insert(*values);
  insert(support_);
  insert(rest_);
  for (const std::int32_t parent : node_parent) root_.push_back(root_[static_cast<std::size_t>(parent)]);
  elastic_.assign(rest_.size(), Vec3f::Zero());
  resize_rows();

  const std::size_t known = cells_.size();
  for (const SoftCellChange& change : cells) {
    const auto number = static_cast<std::size_t>(change.number);
    if (number >= cells_.size()) {
      cells_.push_back(cells_[static_cast<std::size_t>(change.parent)]);
      places_.push_back(places_[static_cast<std::size_t>(change.parent)]);
      lane_.push_back(cells_.size() - 1);
    }
    cells_[number].node = change.node;
    cells_[number].fill = change.fill;
  }
  add_groups();
  for (const SoftCellChange& change : cells) {
    const auto number = static_cast<std::size_t>(change.number);
    if (number >= known) copy_lane(lane_[static_cast<std::size_t>(change.parent)], lane_[number]);
    fill_lane(number);
  }
  spread_cells();
  // Supports and loads of a node are shared with those severed from it, by mass.
  std::vector<float> together(before, 0);
  for (std::size_t n = 0; n < node_count(); ++n)
    if (n < before || node_parent[n - before] >= 0) {
      const std::size_t of = n < before ? n : static_cast<std::size_t>(node_parent[n - before]);
      together[of] += mass_[n];
    }
  for (std::size_t n = 0; n < node_count(); ++n) {
    const std::size_t of = n < before ? n : static_cast<std::size_t>(node_parent[n - before]);
    if (!(together[of] > 0)) continue;
    support_[n] *= mass_[n] / together[of];
    load_[n] *= mass_[n] / together[of];
  }
  release();
  find_levels();
  prepare();
}

void SoftSolid::copy_lane(std::size_t from, std::size_t to) {
  const auto copy = [&](auto& groups) {
    constexpr std::size_t kRow = kLanes * sizeof(float), kSize = sizeof groups.front();
    static_assert(kSize % kRow == 0, "a group is rows of one number a lane");
    const auto* source = reinterpret_cast<const char*>(&groups[from / kLanes]) + from % kLanes * sizeof(float);
    auto* target = reinterpret_cast<char*>(&groups[to / kLanes]) + to % kLanes * sizeof(float);
    for (std::size_t at = 0; at < kSize; at += kRow) std::memcpy(target + at, source + at, sizeof(float));
  };
  copy(groups_);
  copy(histories_);
}

void SoftSolid::release() {
  // A cell under the tension s draws its corners together with s fill edge^2 / 4 along every axis.
  std::vector<Vec3> drawn(node_count(), Vec3::Zero());
  // All that was one node turns with the cell that has most tissue: were each half to turn with its own, a loose one
  // could be driven round and round.
  std::vector<std::size_t> lane_of(node_count(), 0);
  std::vector<double> most(node_count(), 0);
  std::vector<int> severed(node_count(), 0);
  for (const std::int32_t root : root_) ++severed[static_cast<std::size_t>(root)];
  for (std::size_t number = 0; number < cells_.size(); ++number) {
    const SoftCell& cell = cells_[number];
    const TissueSolid& material = materials_[static_cast<std::size_t>(cell.material)];
    const double force =
        material.residual_strain * material.young_pa * cell.fill * options_.edge_m * options_.edge_m / 4;
    for (std::size_t a = 0; a < kCubeCorners; ++a) {
      const auto node = static_cast<std::size_t>(cell.node[a]);
      for (std::size_t axis = 0; axis < kAxes; ++axis)
        drawn[node][static_cast<Eigen::Index>(axis)] += (a >> axis & 1) != 0 ? -force : force;
      const auto root = static_cast<std::size_t>(root_[node]);
      if (cell.fill > most[root]) most[root] = cell.fill, lane_of[root] = lane_[number];
    }
  }
  std::vector<Vec3> whole(node_count(), Vec3::Zero());
  std::vector<double> mass(node_count(), 0);
  for (std::size_t n = 0; n < node_count(); ++n) {
    whole[static_cast<std::size_t>(root_[n])] += drawn[n];
    mass[static_cast<std::size_t>(root_[n])] += static_cast<double>(mass_[n]);
  }
  released_.clear();
  for (std::size_t n = 0; n < node_count(); ++n) {
    const auto root = static_cast<std::size_t>(root_[n]);
    if (severed[root] < 2 || !(mass[root] > 0)) continue;
    const Vec3 force = drawn[n] - static_cast<double>(mass_[n]) / mass[root] * whole[root];
    released_.push_back({n, lane_of[root], force.cast<float>()});
  }
}

void SoftSolid::hold(std::int32_t node, double stiffness_n_per_m) {
  support_[static_cast<std::size_t>(node)] += static_cast<float>(stiffness_n_per_m);
  shift_[static_cast<std::size_t>(node)] += static_cast<float>(stiffness_n_per_m);
}
double SoftSolid::carry(const Vec3& shift) {
  const Vec3f before = carried_, further = shift.cast<float>() - before;
  if (further.isZero(0)) return 0;
  carried_ += further;
  double work = 0;
  for (std::size_t n = 0; n < node_count(); ++n)
    work += static_cast<double>(support_[n] * further.dot(rest_[n] - position_[n] + before + 0.5F * further));
  return work;
}
void SoftSolid::load(std::int32_t node, const Vec3& force_n) {
  load_[static_cast<std::size_t>(node)] += force_n.cast<float>();
}

void SoftSolid::place(std::span<const Vec3f> position) {
  std::copy(position.begin(), position.end(), position_.begin());
  for (auto* values : {&velocity_, &velocity_before_, &change_})
    std::fill(values->begin(), values->end(), Vec3f::Zero());
  prepare();
}

/// What the branches hold grows by what the cell was strained since, and decays. In modes. @return what pulls: the
/// strain and what is still held of it at the end of the step
TROCAR_INLINE Lane relax(Lane now, Lane& before, Lane* held, const Lane* gain, const Lane* keep) {
  const Lane change = now - before;
  before = now;
  TROCAR_UNROLLED
  for (int i = 0; i < 2; ++i) {
    held[i] = keep[i] * (held[i] + gain[i] * change);
    now += keep[i] * held[i];
  }
  return now;
}

/// Of strain stiffening, from the equivalent strain by the energy of the change of shape: w = mu/2 u K u / V = 3/2 mu
/// e^2.
TROCAR_INLINE Lane stiffer(const FloatCube& cube, const Lane (*u)[kCubeCorners], Lane stiffening, float edge_m) {
  Lane f[kAxes][kCubeCorners], strain{};
  stiffen(cube, u, all(1), f);
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int m = 1; m < kCubeCorners; ++m) strain += u[c][m] * f[c][m];
  }
  for (int l = 0; l < kLanes; ++l) strain[l] = std::sqrt(std::max(0.0F, strain[l]) / (3 * edge_m * edge_m));
  const Lane exponent = stiffening * strain, most = all(kMostExponent);
  return 1.0F + exponential_less_one(exponent < most ? exponent : most);
}

TROCAR_LANES_CLONED void SoftSolid::prepare_groups() {
  const FloatCube& cube = float_cube();
  const auto edge = static_cast<float>(options_.edge_m);
  const float quarter = 4 * edge, per_quarter = 1 / quarter;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    History& history = histories_[g];
    Lane v[kAxes][kCubeCorners], f[kAxes][kCubeCorners], F[kAxes][kAxes];
    gather(solution_.data(), group.node, v);
    for (auto& component : v) to_modes(component);
    const auto find_gradient = [&] {
      TROCAR_UNROLLED
      for (int i = 0; i < kAxes * kAxes; ++i) F[i / kAxes][i % kAxes] = v[i / kAxes][1 << i % kAxes] * per_quarter;
    };
    find_gradient();
    follow_rotation(F, group.rotation);
    turn_back(group.rotation, v);
    for (int c = 0; c < kAxes; ++c) {
      v[c][0] = Lane{};
      v[c][1 << c] -= quarter;
    }
    find_gradient();
    const Lane gain[2] = {history.share[0] * history.instant, history.share[1] * history.instant};
    const Lane swollen =
        relax(quarter * volume_change(F, group.growth), history.swollen, history.held_swollen, gain, history.keep);
    const Lane factor = stiffer(cube, v, history.stiffening, edge);
    for (int c = 0; c < kAxes; ++c) {
      TROCAR_UNROLLED
      for (int m = 1; m < kCubeCorners; ++m)
        v[c][m] = relax(v[c][m], history.strain[c][m], history.held[c][m], gain, history.keep);
    }
    const Lane mu = history.mu * factor, kappa = history.kappa * factor;
    const Lane lasting = history.instant * (1.0F - history.share[0] - history.share[1]);
    const Lane algorithmic = lasting + gain[0] * history.keep[0] + gain[1] * history.keep[1];
    group.step_mu = mu * algorithmic;
    group.step_kappa = kappa * algorithmic;
    stiffen(cube, v, -mu, f);
    press(group.growth, -cube.dilatation * kappa * swollen, f);
    turn(group.rotation, f);
    for (auto& component : f) to_corners(component);
    scatter(f, group.node, product_.data());
  }
}

void SoftSolid::prepare() {
  for (std::size_t n = 0; n < rest_.size(); ++n) {
    solution_[n] = {{position_[n][0], position_[n][1], position_[n][2], 0}};
    product_[n] = {};
  }
  prepare_groups();
  for (std::size_t n = 0; n < rest_.size(); ++n) elastic_[n] = as_vector(product_[n]);
  for (const Release& r : released_) elastic_[r.node] += turned(r);
  set_diagonal();
}

Vec3f SoftSolid::turned(const Release& release) const {
  const Group& group = groups_[release.lane / kLanes];
  const std::size_t l = release.lane % kLanes;
  Vec3f force = Vec3f::Zero();
  for (std::size_t c = 0; c < kAxes; ++c)
    for (std::size_t k = 0; k < kAxes; ++k)
      force[static_cast<Eigen::Index>(c)] += group.rotation[c][k][l] * release.force[static_cast<Eigen::Index>(k)];
  return force;
}

void SoftSolid::set_diagonal() {
  // Mean of the element's diagonal: the same for every corner and, being isotropic, in every rotation.
  static const std::array<float, 2> mean = [] {
    const auto of = [](double mu, double kappa) { return static_cast<float>(cube_matrix(1, mu, kappa).trace() / 24); };
    return std::array<float, 2>{of(1, 0), of(0, 1)};
  }();
  std::fill(stiffness_diagonal_.begin(), stiffness_diagonal_.end(), 0.0F);
  for (const Group& group : groups_)
    for (int l = 0; l < kLanes; ++l) {
      const float value = mean[0] * group.step_mu[l] + mean[1] * group.step_kappa[l];
      for (const auto& corner : group.node) stiffness_diagonal_[static_cast<std::size_t>(corner[l])] += value;
    }
  const float weight = statics_ ? 0.0F : inertia();
  for (std::size_t n = 0; n < rest_.size(); ++n) shift_[n] = support_[n] + weight * mass_[n];
  levels_.set_diagonals(stiffness_diagonal_, shift_);
}

float SoftSolid::inertia() const {
  const double h = options_.step_s;
  return static_cast<float>((1 + h * options_.mass_damping_per_s) / (h * h));
}

TROCAR_LANES_CLONED void SoftSolid::add_product(std::span<const NodeRow> in, std::span<NodeRow> out,
                                                std::span<const std::int32_t> groups) const {
  const FloatCube& cube = float_cube();
  for (const std::int32_t g : groups) {
    const Group& group = groups_[static_cast<std::size_t>(g)];
    Lane v[kAxes][kCubeCorners], f[kAxes][kCubeCorners];
    gather(in.data(), group.node, v);
    for (auto& component : v) to_modes(component);
    turn_back(group.rotation, v);
    stiffen(cube, v, group.step_mu, f);
    press(group.growth, cube.dilatation * group.step_kappa * swelling(group.growth, v), f);
    turn(group.rotation, f);
    for (auto& component : f) to_corners(component);
    scatter(f, group.node, out.data());
  }
}

namespace {

template <class Value>
Vec3f at(const NodeShares& place, const std::vector<Value>& value) {
  Vec3f sum = Vec3f::Zero();
  for (std::size_t i = 0; i < place.node.size(); ++i)
    sum += place.share[i] * as_vector(value[static_cast<std::size_t>(place.node[i])]);
  return sum;
}
void spread(const NodeShares& place, const Vec3f& value, std::vector<NodeRow>& to) {
  for (std::size_t i = 0; i < place.node.size(); ++i)
    for (Eigen::Index c = 0; c < kAxes; ++c)
      to[static_cast<std::size_t>(place.node[i])].at[c] += place.share[i] * value[c];
}

using Sum = double __attribute__((vector_size(4 * sizeof(double))));

/// Components of two rows multiplied: exact, as the factors are floats.
TROCAR_INLINE Sum squares(Row a, Row b) { return __builtin_convertvector(a, Sum) * __builtin_convertvector(b, Sum); }
TROCAR_INLINE double sum_of(Row a) { return static_cast<double>(a[0] + a[1] + a[2]); }
TROCAR_INLINE double together(Sum sum) { return (sum[0] + sum[1]) + sum[2]; }

TROCAR_LANES_CLONED double dot(const std::vector<NodeRow>& a, const std::vector<NodeRow>& b) {
  Sum even{}, odd{};
  std::size_t n = 0;
  for (; n + 2 <= a.size(); n += 2) {
    even += squares(row(a[n]), row(b[n]));
    odd += squares(row(a[n + 1]), row(b[n + 1]));
  }
  if (n < a.size()) even += squares(row(a[n]), row(b[n]));
  return together(even + odd);
}

/// Each row times its own factor.
TROCAR_LANES_CLONED void scale(const std::vector<float>& factor, const std::vector<NodeRow>& of,
                               std::vector<NodeRow>& to) {
  for (std::size_t n = 0; n < of.size(); ++n) set(to[n], factor[n] * row(of[n]));
}

struct Remainder {
  double residual = 0, scaled = 0;  ///< r . r and r . z
};
/// x += alpha d, r -= alpha q. @param inverse z = inverse r
TROCAR_LANES_CLONED Remainder go_along(float alpha, const std::vector<NodeRow>& d, const std::vector<NodeRow>& q,
                                       const std::vector<float>& inverse, std::vector<NodeRow>& x,
                                       std::vector<NodeRow>& r) {
  Sum residual{}, scaled{};
  for (std::size_t n = 0; n < d.size(); ++n) {
    set(x[n], row(x[n]) + alpha * row(d[n]));
    const Row next = row(r[n]) - alpha * row(q[n]);
    set(r[n], next);
    residual += squares(next, next);
    scaled += squares(next, inverse[n] * next);
  }
  return {together(residual), together(scaled)};
}

}  // namespace

void SoftSolid::add_ties(const std::vector<NodeRow>& in, std::vector<NodeRow>& out) const {
  for (const SoftTie& tie : ties_) {
    if (tie.all_n_per_m == 0 && tie.along_n_per_m == 0) continue;
    Row apart{};
    for (std::size_t i = 0; i < SoftTie::kNodes; ++i)
      apart += tie.share[i] * row(in[static_cast<std::size_t>(tie.node[i])]);
    const Row normal{tie.normal[0], tie.normal[1], tie.normal[2], 0};
    const Row across = normal * apart;
    const Row force = tie.all_n_per_m * apart + tie.along_n_per_m * (across[0] + across[1] + across[2]) * normal;
    for (std::size_t i = 0; i < SoftTie::kNodes; ++i) {
      NodeRow& to = out[static_cast<std::size_t>(tie.node[i])];
      set(to, row(to) + tie.share[i] * force);
    }
  }
}

Vec3f SoftSolid::apart(const SoftTie& tie) const {
  Vec3f sum = Vec3f::Zero();
  for (std::size_t i = 0; i < SoftTie::kNodes; ++i)
    sum += tie.share[i] * position_[static_cast<std::size_t>(tie.node[i])];
  return sum;
}

void SoftSolid::add_stiffness(std::span<const SoftSpring> springs, const std::vector<bool>& active,
                              const std::vector<NodeRow>& in, std::vector<NodeRow>& out) const {
  add_product(in, out, all_groups_);
  add_ties(in, out);
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!active[s]) continue;
    const Vec3f direction = springs[s].direction.cast<float>();
    const float force = static_cast<float>(springs[s].stiffness_n_per_m) * direction.dot(at(springs[s].place, in));
    spread(springs[s].place, force * direction, out);
  }
}

void SoftSolid::set_right(std::span<const SoftSpring> springs, const std::vector<bool>& active) {
  const float per_step = 1 / static_cast<float>(options_.step_s), weight = statics_ ? 0 : per_step * per_step;
  for (std::size_t n = 0; n < rest_.size(); ++n) {
    const Vec3f value = weight * mass_[n] * velocity_[n] +
                        per_step * (elastic_[n] + load_[n] + support_[n] * (rest_[n] - position_[n] + carried_));
    right_[n] = {{value[0], value[1], value[2], 0}};
  }
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!active[s]) continue;
    const auto force = static_cast<float>(-springs[s].stiffness_n_per_m * springs[s].stretch_m);
    spread(springs[s].place, per_step * force * springs[s].direction.cast<float>(), right_);
  }
  for (const SoftTie& tie : ties_)
    for (std::size_t i = 0; i < SoftTie::kNodes; ++i)
      for (Eigen::Index c = 0; c < kAxes; ++c)
        right_[static_cast<std::size_t>(tie.node[i])].at[c] += per_step * tie.share[i] * tie.force_n[c];
}

void SoftSolid::set_inverse(std::span<const SoftSpring> springs, const std::vector<bool>& active) {
  std::fill(tie_diagonal_.begin(), tie_diagonal_.end(), 0.0F);
  for (const SoftTie& tie : ties_) {
    const float stiffness = tie.all_n_per_m + tie.along_n_per_m / kAxes;
    for (std::size_t i = 0; i < SoftTie::kNodes; ++i)
      tie_diagonal_[static_cast<std::size_t>(tie.node[i])] += stiffness * tie.share[i] * tie.share[i];
  }
  for (std::size_t n = 0; n < rest_.size(); ++n) inverse_[n] = stiffness_diagonal_[n] + shift_[n] + tie_diagonal_[n];
  levels_.reset();
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!active[s]) continue;
    const NodeShares& place = springs[s].place;
    const auto stiffness = static_cast<float>(springs[s].stiffness_n_per_m);
    for (std::size_t i = 0; i < place.node.size(); ++i)
      inverse_[static_cast<std::size_t>(place.node[i])] += stiffness * place.share[i] * place.share[i];
    levels_.add_spring(place.node, place.share, stiffness);
  }
  for (float& value : inverse_) value = value > 0 ? 1 / value : 0;
}

void SoftSolid::solve(std::span<SoftSpring> springs, const std::vector<bool>& active) {
  set_right(springs, active);
  set_inverse(springs, active);
  for (std::size_t n = 0; n < rest_.size(); ++n) solution_[n] = {{guess_[n][0], guess_[n][1], guess_[n][2], 0}};
  scale(shift_, solution_, product_);
  add_stiffness(springs, active, solution_, product_);
  residual_ = right_;
  direction_.assign(rest_.size(), NodeRow{});
  const double enough = options_.tolerance * options_.tolerance * dot(right_, right_);
  // The first move, along nothing, only takes the product off the right-hand side.
  Remainder left = go_along(1, direction_, product_, inverse_, solution_, residual_);
  double rho = 0;
  for (int iteration = 0; iteration < options_.most_iterations && left.residual > enough; ++iteration) {
    const double next = left.scaled + levels_.coarsen(residual_);
    levels_.advance(inverse_, residual_, rho > 0 ? static_cast<float>(next / rho) : 0.0F, shift_, direction_, product_);
    rho = next;
    add_stiffness(springs, active, direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(rho > 0 && curvature > 0)) break;
    ++iterations_;
    left = go_along(static_cast<float>(rho / curvature), direction_, product_, inverse_, solution_, residual_);
  }
  for (std::size_t n = 0; n < rest_.size(); ++n) velocity_next_[n] = as_vector(solution_[n]);
}

void SoftSolid::predict() {
  // The velocity is taken to change on as it did, by as much of that as would have been right one step ago.
  double along = 0, change = 0;
  for (std::size_t n = 0; n < rest_.size(); ++n) {
    const Vec3f last = velocity_[n] - velocity_before_[n];
    along += static_cast<double>(last.dot(change_[n]));
    change += static_cast<double>(change_[n].squaredNorm());
    change_[n] = last;
  }
  const float share = change > 0 ? static_cast<float>(std::clamp(along / change, 0.0, 1.0)) : 0.0F;
  for (std::size_t n = 0; n < rest_.size(); ++n) guess_[n] = velocity_[n] + share * change_[n];
}

void SoftSolid::step(std::span<SoftSpring> springs) {
  const auto h = static_cast<float>(options_.step_s);
  predict();
  iterations_ = 0;
  // What the guess says: a contact that it has off the tissue would cost a solve to let go.
  std::vector<bool> active(springs.size());
  for (std::size_t s = 0; s < springs.size(); ++s)
    active[s] = !springs[s].pushes_only ||
                springs[s].stretch_m + h * springs[s].direction.cast<float>().dot(at(springs[s].place, guess_)) > 0;
  for (int pass = 0; pass < kActiveSetPasses; ++pass) {
    solve(springs, active);
    bool changed = false;
    for (std::size_t s = 0; s < springs.size(); ++s) {
      SoftSpring& spring = springs[s];
      const double gained = h * spring.direction.cast<float>().dot(at(spring.place, velocity_next_));
      spring.force_n = active[s] ? spring.stiffness_n_per_m * (spring.stretch_m + gained) : 0;
      const bool wanted = !spring.pushes_only || spring.stretch_m + gained > 0;
      if (wanted != active[s]) {
        active[s] = wanted;
        changed = true;
      }
    }
    if (!changed) break;
    guess_ = velocity_next_;
  }
  for (SoftSpring& spring : springs)
    if (spring.pushes_only) spring.force_n = std::max(0.0, spring.force_n);
  for (SoftTie& tie : ties_) {
    Vec3f gained = Vec3f::Zero();
    for (std::size_t i = 0; i < SoftTie::kNodes; ++i)
      gained += h * tie.share[i] * velocity_next_[static_cast<std::size_t>(tie.node[i])];
    tie.force_n -= tie.all_n_per_m * gained + tie.along_n_per_m * tie.normal.dot(gained) * tie.normal;
  }
  for (std::size_t n = 0; n < rest_.size(); ++n) position_[n] += h * velocity_next_[n];
  velocity_before_ = velocity_;
  velocity_ = velocity_next_;
  if (statics_) std::fill(velocity_.begin(), velocity_.end(), Vec3f::Zero());
  prepare();
}

int SoftSolid::settle(std::span<SoftSpring> springs, double still_m, int most_steps) {
  statics_ = true;
  set_diagonal();
  int steps = 0;
  float moved = 1;
  while (steps < most_steps && moved > still_m) {
    const std::vector<Vec3f> before = position_;
    step(springs);
    for (SoftSpring& spring : springs) spring.stretch_m = spring.force_n / spring.stiffness_n_per_m;
    moved = 0;
    for (std::size_t n = 0; n < rest_.size(); ++n) moved = std::max(moved, (position_[n] - before[n]).norm());
    ++steps;
  }
  statics_ = false;
  set_diagonal();
  return steps;
}

double SoftSolid::energy_j() const {
  const FloatCube& cube = float_cube();
  double energy = 0;
  for (const History& history : histories_) {
    Lane f[kAxes][kCubeCorners];
    stiffen(cube, history.strain, history.mu, f);
    for (int l = 0; l < kLanes; ++l) {
      energy += 0.5 * static_cast<double>(cube.dilatation * history.kappa[l]) *
                static_cast<double>(history.swollen[l]) * static_cast<double>(history.swollen[l]);
      for (int c = 0; c < kAxes; ++c)
        for (int m = 1; m < kCubeCorners; ++m)
          energy += 0.5 * static_cast<double>(history.strain[c][m][l]) * static_cast<double>(f[c][m][l]);
    }
  }
  for (std::size_t n = 0; n < rest_.size(); ++n) {
    energy += 0.5 * static_cast<double>(support_[n]) *
              static_cast<double>((position_[n] - rest_[n] - carried_).squaredNorm());
    energy += 0.5 * static_cast<double>(mass_[n]) * static_cast<double>(velocity_[n].squaredNorm());
  }
  for (const Release& r : released_) energy -= static_cast<double>(turned(r).dot(position_[r.node] - rest_[r.node]));
  return energy;
}

std::vector<Vec3f> SoftSolid::elastic_force() const { return elastic_; }

double SoftSolid::mass_kg() const { return std::accumulate(mass_.begin(), mass_.end(), 0.0); }

double SoftSolid::volume_m3() const {
  double volume = 0;
  std::vector<NodeRow> rows(rest_.size());
  for (std::size_t n = 0; n < rest_.size(); ++n) rows[n] = {{position_[n][0], position_[n][1], position_[n][2], 0}};
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Lane v[kAxes][kCubeCorners];
    gather(rows.data(), groups_[g].node, v);
    for (auto& component : v) to_modes(component);
    for (int l = 0; l < kLanes; ++l) {
      Mat3 F;
      for (int c = 0; c < kAxes; ++c)
        for (int k = 0; k < kAxes; ++k) F(c, k) = v[c][1 << k][l] / (4 * options_.edge_m);
      volume += static_cast<double>(histories_[g].volume[l]) * F.determinant();
    }
  }
  return volume;
}

double SoftSolid::compliance(const NodeShares& place, const Vec3& direction, double radius_m, bool inertia) const {
  const Vec3f centre = at(place, position_);
  std::vector<std::int32_t> nodes, groups;
  for (std::size_t n = 0; n + 1 < rest_.size(); ++n)
    if ((position_[n] - centre).norm() < static_cast<float>(radius_m)) {
      nodes.push_back(static_cast<std::int32_t>(n));
      groups.insert(groups.end(), groups_of_node_[n].begin(), groups_of_node_[n].end());
    }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  const float weight = inertia ? this->inertia() : 0;
  const auto index = [&](std::int32_t n) { return static_cast<std::size_t>(n); };
  // Only what the groups touch is ever read or written.
  std::vector<NodeRow> u(rest_.size()), r = u, d = u, product = u;
  std::vector<float> shift(nodes.size()), inverse(nodes.size());
  spread(place, direction.cast<float>(), r);
  double rho = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t n = index(nodes[i]);
    shift[i] = support_[n] + weight * mass_[n];
    inverse[i] = 1 / (stiffness_diagonal_[n] + shift[i] + tie_diagonal_[n]);
    set(d[n], inverse[i] * row(r[n]));
    rho += sum_of(row(r[n]) * row(d[n]));
  }
  const double first = rho;
  for (int iteration = 0; iteration < kMostLocal && rho > kLocalTolerance * first && rho > 0; ++iteration) {
    for (const std::int32_t g : groups)
      for (const auto& corner : groups_[index(g)].node)
        for (const std::int32_t n : corner) product[index(n)] = {};
    add_product(d, product, groups);
    add_ties(d, product);
    double curvature = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t n = index(nodes[i]);
      set(product[n], row(product[n]) + shift[i] * row(d[n]));
      curvature += sum_of(row(d[n]) * row(product[n]));
    }
    const auto alpha = static_cast<float>(rho / curvature);
    double next = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t n = index(nodes[i]);
      set(u[n], row(u[n]) + alpha * row(d[n]));
      set(r[n], row(r[n]) - alpha * row(product[n]));
      next += sum_of(inverse[i] * row(r[n]) * row(r[n]));
    }
    const auto beta = static_cast<float>(next / rho);
    rho = next;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t n = index(nodes[i]);
      set(d[n], inverse[i] * row(r[n]) + beta * row(d[n]));
    }
  }
  return direction.cast<float>().dot(at(place, u));
}

double SoftSolid::held_stiffness(const NodeShares& place) const {
  double gives = 0;
  for (std::size_t i = 0; i < place.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(place.node[i]);
    const double share = static_cast<double>(place.share[i]);
    if (share == 0) continue;
    const double resists = static_cast<double>(stiffness_diagonal_[node] + support_[node]);
    if (!(resists > 0)) return 0;
    gives += share * share / resists;
  }
  return gives > 0 ? 1 / gives : 0;
}

}  // namespace trocar
