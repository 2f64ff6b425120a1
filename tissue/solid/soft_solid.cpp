#include "tissue/solid/soft_solid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

#include "haptics/input_error.h"
#include "tissue/solid/cube_element.h"

// The vector path and the portable one do the same operations in the same order: eight lanes are one register or two.
#if defined(TROCAR_LANES_CLONED)
#elif defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TROCAR_LANES_CLONED __attribute__((target_clones("default", "avx2")))
#else
#define TROCAR_LANES_CLONED
#endif
#define TROCAR_INLINE [[gnu::always_inline]] inline

namespace trocar {
namespace {

constexpr int kLanes = 8;
constexpr int kAxes = 3;
constexpr int kRotationSteps = 4;      // warm-started: each leaves of the error its square and half the strain of it
constexpr float kMostStiffening = 8;   // times the small-strain modulus
constexpr float kMostGradient = 0.5F;  // up to which the volume is that of the cell; beyond, as it grows from there on
constexpr float kNoGradient = 1e-9F;   // keeps the division of a collapsed cell defined
constexpr int kActiveSetPasses = 3;
constexpr int kMostLocal = 80;            // iterations of a clamped neighbourhood
constexpr double kLocalTolerance = 1e-6;  // of its energy: 0.1 % of the displacement
constexpr double kLooseFit = 1e-3;        // of the edge, between a cell's corners and a cube

using Lane = float __attribute__((vector_size(kLanes * sizeof(float))));

TROCAR_INLINE Lane all(float value) { return Lane{} + value; }

/// Corners to modes and back but for the factor 8: the same butterflies, the sign at the lower corner.
TROCAR_INLINE void to_modes(Lane* v) {
  for (int bit = 1; bit < kCubeCorners; bit <<= 1)
    for (int a = 0; a < kCubeCorners; ++a)
      if ((a & bit) == 0) {
        const Lane low = v[a], high = v[a | bit];
        v[a] = low + high;
        v[a | bit] = high - low;
      }
}
TROCAR_INLINE void to_corners(Lane* v) {
  for (int bit = 1; bit < kCubeCorners; bit <<= 1)
    for (int a = 0; a < kCubeCorners; ++a)
      if ((a & bit) == 0) {
        const Lane mean = v[a], difference = v[a | bit];
        v[a] = mean - difference;
        v[a | bit] = mean + difference;
      }
}

/// The element's constants as floats.
struct FloatCube {
  float deviatoric[kCubeCorners][kAxes][kAxes];
  float dilatation;  ///< the same for every pair of axes
};
const FloatCube& float_cube() {
  static const FloatCube cube = [] {
    FloatCube out{};
    const CubeStiffness& exact = cube_stiffness();
    for (int c = 0; c < kAxes; ++c)
      for (int d = 0; d < kAxes; ++d)
        for (std::size_t p = 0; p < kCubeCorners; ++p)
          out.deviatoric[p][c][d] = static_cast<float>(exact.deviatoric[p](c, d));
    out.dilatation = static_cast<float>(exact.dilatation(0, 0));
    return out;
  }();
  return cube;
}

/// f = mu deviatoric u in modes; u and f by component and mode. Stiffness with edge and fill.
TROCAR_INLINE void stiffen(const FloatCube& cube, const Lane (*u)[kCubeCorners], Lane mu, Lane (*f)[kCubeCorners]) {
  for (int p = 0; p < kCubeCorners; ++p)
    for (int c = 0; c < kAxes; ++c) {
      Lane sum{};
      for (int d = 0; d < kAxes; ++d) sum += cube.deviatoric[p][c][d] * u[d][mode_of(p, d)];
      f[c][mode_of(p, c)] = mu * sum;
    }
}
/// How the volume grows with u: growth : grad u. In the small the trace.
TROCAR_INLINE Lane swelling(const Lane (*growth)[kAxes], const Lane (*u)[kCubeCorners]) {
  Lane sum{};
  for (int c = 0; c < kAxes; ++c)
    for (int k = 0; k < kAxes; ++k) sum += growth[c][k] * u[c][1 << k];
  return sum;
}
/// f += the pressure against that. @param pressure with dilatation, edge and fill
TROCAR_INLINE void press(const Lane (*growth)[kAxes], Lane pressure, Lane (*f)[kCubeCorners]) {
  for (int c = 0; c < kAxes; ++c)
    for (int k = 0; k < kAxes; ++k) f[c][1 << k] += pressure * growth[c][k];
}

/// Volume of a cell less that at rest, over that at rest, from the mean gradient 1 + e of its turned corners, and how
/// it grows with e: the cofactors.
TROCAR_INLINE Lane volume_change(const Lane (*e)[kAxes], Lane (*growth)[kAxes]) {
  Lane g[kAxes][kAxes], beyond{};
  for (int c = 0; c < kAxes; ++c)
    for (int k = 0; k < kAxes; ++k)
      for (int l = 0; l < kLanes; ++l) g[c][k][l] = std::clamp(e[c][k][l], -kMostGradient, kMostGradient);
  Lane change = g[0][0] + g[1][1] + g[2][2];
  for (int c = 0; c < kAxes; ++c) {
    const int d = (c + 1) % kAxes, f = (c + 2) % kAxes;
    change += g[d][d] * g[f][f] - g[d][f] * g[f][d];
    change += g[0][c] * (g[1][d] * g[2][f] - g[1][f] * g[2][d]);
  }
  for (int c = 0; c < kAxes; ++c) g[c][c] += 1.0F;
  for (int c = 0; c < kAxes; ++c)
    for (int k = 0; k < kAxes; ++k) {
      const int d = (c + 1) % kAxes, f = (c + 2) % kAxes, m = (k + 1) % kAxes, n = (k + 2) % kAxes;
      growth[c][k] = g[d][m] * g[f][n] - g[d][n] * g[f][m];
      beyond += growth[c][k] * (e[c][k] - (c == k ? g[c][k] - 1.0F : g[c][k]));
    }
  return change + beyond;
}

TROCAR_INLINE void gather(const Vec3f* from, const std::int32_t (*node)[kLanes], Lane (*v)[kCubeCorners]) {
  for (int a = 0; a < kCubeCorners; ++a)
    for (int l = 0; l < kLanes; ++l) {
      const float* at = from[node[a][l]].data();
      for (int c = 0; c < kAxes; ++c) v[c][a][l] = at[c];
    }
}
TROCAR_INLINE void scatter(const Lane (*v)[kCubeCorners], const std::int32_t (*node)[kLanes], Vec3f* to) {
  for (int l = 0; l < kLanes; ++l)
    for (int a = 0; a < kCubeCorners; ++a) {
      float* at = to[node[a][l]].data();
      for (int c = 0; c < kAxes; ++c) at[c] += v[c][a][l];
    }
}

/// v <- R^T v, by mode.
TROCAR_INLINE void turn_back(const Lane (*R)[kAxes], Lane (*v)[kCubeCorners]) {
  for (int m = 0; m < kCubeCorners; ++m) {
    const Lane x = v[0][m], y = v[1][m], z = v[2][m];
    for (int c = 0; c < kAxes; ++c) v[c][m] = R[0][c] * x + R[1][c] * y + R[2][c] * z;
  }
}
TROCAR_INLINE void turn(const Lane (*R)[kAxes], Lane (*v)[kCubeCorners]) {
  for (int m = 0; m < kCubeCorners; ++m) {
    const Lane x = v[0][m], y = v[1][m], z = v[2][m];
    for (int c = 0; c < kAxes; ++c) v[c][m] = R[c][0] * x + R[c][1] * y + R[c][2] * z;
  }
}

/// The rotation nearest to a gradient F, from a guess: turns R by the torque that its columns feel towards F's.
TROCAR_INLINE void follow_rotation(const Lane (*F)[kAxes], Lane (*R)[kAxes]) {
  for (int step = 0; step < kRotationSteps; ++step) {
    Lane w[kAxes]{}, weight{};
    for (int k = 0; k < kAxes; ++k) {
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
        w[c] += R[d][k] * F[e][k] - R[e][k] * F[d][k];
      }
      weight += R[0][k] * F[0][k] + R[1][k] * F[1][k] + R[2][k] * F[2][k];
    }
    for (int l = 0; l < kLanes; ++l) weight[l] = std::fabs(weight[l]) + kNoGradient;
    Lane q[kAxes];
    // Half the angle, for the Cayley map. Near a stretch S the torque of a turn v is (tr S - S) v, 2/3 of tr S v at
    // rest: with that and not with all of tr S nothing is left of a turn of an undeformed cell.
    for (int c = 0; c < kAxes; ++c) q[c] = 0.75F * w[c] / weight;
    const Lane scale = 2.0F / (1.0F + q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    for (int k = 0; k < kAxes; ++k) {
      const Lane r[kAxes] = {R[0][k], R[1][k], R[2][k]};
      Lane t[kAxes];
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
        t[c] = r[c] + (q[d] * r[e] - q[e] * r[d]);
      }
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
        R[c][k] = r[c] + scale * (q[d] * t[e] - q[e] * t[d]);
      }
    }
  }
}

double dot(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  const float* x = a.front().data();
  const float* y = b.front().data();
  const std::size_t count = kAxes * a.size();
  std::array<double, kLanes> sum{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) sum[l] += static_cast<double>(x[i + l]) * static_cast<double>(y[i + l]);
  for (; i < count; ++i) sum[i % kLanes] += static_cast<double>(x[i]) * static_cast<double>(y[i]);
  return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

/// Spreads the bits of a lattice index: cells of one neighbourhood stand together.
std::uint64_t interleaved(const std::array<std::uint32_t, 3>& at) {
  std::uint64_t key = 0;
  for (unsigned bit = 0; bit < 21; ++bit)
    for (unsigned axis = 0; axis < kAxes; ++axis)
      key |= static_cast<std::uint64_t>(at[axis] >> bit & 1U) << (kAxes * bit + axis);
  return key;
}

}  // namespace

struct alignas(kLanes * sizeof(float)) SoftSolid::Group {
  std::int32_t node[kCubeCorners][kLanes];
  Lane rotation[kAxes][kAxes];
  Lane strain[kAxes][kCubeCorners];   ///< R^T x - X, in modes
  Lane held[2][kAxes][kCubeCorners];  ///< strain that the branches still hold, in modes
  Lane growth[kAxes][kAxes];          ///< cofactors of R^T F
  Lane swollen, held_swollen[2];      ///< change of volume, as strain is in modes, and what the branches hold of it
  Lane mu, kappa;                     ///< long-term, with fill and edge
  Lane instant;                       ///< instantaneous over long-term
  Lane share[2], keep[2];             ///< g_i and a_i
  Lane stiffening;                    ///< c
  Lane factor;                        ///< of strain stiffening, at the present place
  Lane step_mu, step_kappa;           ///< of the step's matrix
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
  elastic_ = load_ = right_ = residual_ = direction_ = product_ = preconditioned_ = velocity_;
  support_.assign(count, 0);
  diagonal_.assign(count, 0);
  stiffness_diagonal_.assign(count, 0);
  root_.resize(count - 1);
  std::iota(root_.begin(), root_.end(), 0);

  Vec3 low = Vec3::Constant(1e9);
  for (const Vec3& node : nodes) low = low.cwiseMin(node);
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
    const Vec3 place = (first - low) / options.edge_m + Vec3::Constant(0.5);
    order.emplace_back(interleaved({static_cast<std::uint32_t>(place[0]), static_cast<std::uint32_t>(place[1]),
                                    static_cast<std::uint32_t>(place[2])}),
                       i);
  }
  std::sort(order.begin(), order.end());
  lane_.resize(cells.size());
  for (std::size_t at = 0; at < order.size(); ++at) lane_[order[at].second] = at;
  add_groups();
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) fill_lane(cell);
  spread_cells();
  prepare();
}

void SoftSolid::add_groups() {
  while (groups_.size() * kLanes < cells_.size()) {
    all_groups_.push_back(static_cast<std::int32_t>(groups_.size()));
    Group& group = groups_.emplace_back();
    std::memset(&group, 0, sizeof group);
    for (std::size_t l = 0; l < kLanes; ++l) {
      for (std::size_t c = 0; c < kAxes; ++c) group.rotation[c][c][l] = 1;
      group.factor[l] = 1;
    }
  }
  // Lanes without a cell stand behind all others and hang on the last node.
  for (std::size_t at = cells_.size(); at < groups_.size() * kLanes; ++at)
    for (auto& corner : groups_[at / kLanes].node) corner[at % kLanes] = static_cast<std::int32_t>(rest_.size() - 1);
}

void SoftSolid::fill_lane(std::size_t number) {
  Group& group = groups_[lane_[number] / kLanes];
  const std::size_t l = lane_[number] % kLanes;
  const SoftCell& cell = cells_[number];
  const TissueSolid& material = materials_[static_cast<std::size_t>(cell.material)];
  const double shear = material.young_pa / (2 * (1 + material.poisson));
  const double bulk = material.young_pa / (3 * (1 - 2 * material.poisson));
  group.mu[l] = static_cast<float>(cell.fill * options_.edge_m * shear);
  group.kappa[l] = static_cast<float>(cell.fill * options_.edge_m * bulk);
  group.volume[l] = static_cast<float>(cell.fill * std::pow(options_.edge_m, 3));
  group.instant[l] = static_cast<float>(1 / (1 - material.prony[0].share - material.prony[1].share));
  for (std::size_t i = 0; i < 2; ++i) {
    const double tau = material.prony[i].tau_s;
    group.share[i][l] = static_cast<float>(material.prony[i].share);
    group.keep[i][l] = static_cast<float>(tau / (tau + options_.step_s));
  }
  group.stiffening[l] = static_cast<float>(material.stiffening);
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
  for (auto* values : {&position_, &velocity_, &load_}) insert(*values);
  insert(support_);
  insert(rest_);
  for (const std::int32_t parent : node_parent) root_.push_back(root_[static_cast<std::size_t>(parent)]);
  for (auto* values : {&elastic_, &right_, &residual_, &direction_, &product_, &preconditioned_})
    values->assign(rest_.size(), Vec3f::Zero());
  for (auto* values : {&diagonal_, &stiffness_diagonal_}) values->assign(rest_.size(), 0);

  const std::size_t known = cells_.size();
  for (const SoftCellChange& change : cells) {
    const auto number = static_cast<std::size_t>(change.number);
    if (number >= cells_.size()) {
      cells_.push_back(cells_[static_cast<std::size_t>(change.parent)]);
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
  const std::vector<float> mass_before = mass_;
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
  prepare();
}

void SoftSolid::copy_lane(std::size_t from, std::size_t to) {
  static_assert(sizeof(Group) % (kLanes * sizeof(float)) == 0, "a group is rows of one number a lane");
  const auto* source = reinterpret_cast<const char*>(&groups_[from / kLanes]) + from % kLanes * sizeof(float);
  auto* target = reinterpret_cast<char*>(&groups_[to / kLanes]) + to % kLanes * sizeof(float);
  for (std::size_t row = 0; row < sizeof(Group); row += kLanes * sizeof(float))
    std::memcpy(target + row, source + row, sizeof(float));
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
}
void SoftSolid::load(std::int32_t node, const Vec3& force_n) {
  load_[static_cast<std::size_t>(node)] += force_n.cast<float>();
}

void SoftSolid::place(std::span<const Vec3f> position) {
  std::copy(position.begin(), position.end(), position_.begin());
  std::fill(velocity_.begin(), velocity_.end(), Vec3f::Zero());
  prepare();
}

TROCAR_LANES_CLONED void SoftSolid::prepare() {
  const FloatCube& cube = float_cube();
  const auto quarter = static_cast<float>(4 * options_.edge_m);
  std::fill(elastic_.begin(), elastic_.end(), Vec3f::Zero());
  for (Group& group : groups_) {
    Lane v[kAxes][kCubeCorners], f[kAxes][kCubeCorners];
    gather(position_.data(), group.node, v);
    for (auto& component : v) to_modes(component);
    Lane F[kAxes][kAxes];
    for (int c = 0; c < kAxes; ++c)
      for (int k = 0; k < kAxes; ++k) F[c][k] = v[c][1 << k] / quarter;
    follow_rotation(F, group.rotation);
    turn_back(group.rotation, v);
    for (int c = 0; c < kAxes; ++c) v[c][1 << c] -= quarter;
    for (int c = 0; c < kAxes; ++c)
      for (int k = 0; k < kAxes; ++k) F[c][k] = v[c][1 << k] / quarter;
    const Lane swollen = quarter * volume_change(F, group.growth);
    // What the branches hold grows by what the cell was strained since, and decays.
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < kAxes; ++c)
        for (int m = 0; m < kCubeCorners; ++m)
          group.held[i][c][m] =
              group.keep[i] * (group.held[i][c][m] + group.share[i] * group.instant * (v[c][m] - group.strain[c][m]));
    for (int i = 0; i < 2; ++i)
      group.held_swollen[i] =
          group.keep[i] * (group.held_swollen[i] + group.share[i] * group.instant * (swollen - group.swollen));
    std::memcpy(group.strain, v, sizeof v);
    group.swollen = swollen;
    // Equivalent strain from the energy of the change of shape: w = mu/2 u K u / V = 3/2 mu e^2.
    stiffen(cube, v, all(1), f);
    Lane shape{};
    for (int c = 0; c < kAxes; ++c)
      for (int m = 1; m < kCubeCorners; ++m) shape += v[c][m] * f[c][m];
    const auto square = static_cast<float>(options_.edge_m * options_.edge_m);
    for (int l = 0; l < kLanes; ++l) {
      const float strain = std::sqrt(std::max(0.0F, shape[l]) / (3 * square));
      group.factor[l] = std::min(kMostStiffening, std::exp(group.stiffening[l] * strain));
    }
    const Lane algorithmic = group.instant * (1.0F - group.share[0] - group.share[1] + group.share[0] * group.keep[0] +
                                              group.share[1] * group.keep[1]);
    const Lane mu = group.mu * group.factor, kappa = group.kappa * group.factor;
    group.step_mu = mu * algorithmic;
    group.step_kappa = kappa * algorithmic;
    for (int c = 0; c < kAxes; ++c)
      for (int m = 0; m < kCubeCorners; ++m)
        v[c][m] = -(v[c][m] + group.keep[0] * group.held[0][c][m] + group.keep[1] * group.held[1][c][m]);
    stiffen(cube, v, mu, f);
    press(group.growth,
          -cube.dilatation * kappa *
              (swollen + group.keep[0] * group.held_swollen[0] + group.keep[1] * group.held_swollen[1]),
          f);
    turn(group.rotation, f);
    for (auto& component : f) to_corners(component);
    scatter(f, group.node, elastic_.data());
  }
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
  const auto h = static_cast<float>(options_.step_s);
  const auto inertia = static_cast<float>(statics_ ? 0 : 1 + options_.step_s * options_.mass_damping_per_s);
  for (std::size_t n = 0; n < diagonal_.size(); ++n)
    diagonal_[n] = inertia * mass_[n] + h * h * (stiffness_diagonal_[n] + support_[n]);
}

TROCAR_LANES_CLONED void SoftSolid::add_product(const std::vector<Vec3f>& in, std::vector<Vec3f>& out,
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

Vec3f at(const NodeShares& place, const std::vector<Vec3f>& value) {
  Vec3f sum = Vec3f::Zero();
  for (std::size_t i = 0; i < place.node.size(); ++i)
    sum += place.share[i] * value[static_cast<std::size_t>(place.node[i])];
  return sum;
}
void spread(const NodeShares& place, const Vec3f& value, std::vector<Vec3f>& to) {
  for (std::size_t i = 0; i < place.node.size(); ++i)
    to[static_cast<std::size_t>(place.node[i])] += place.share[i] * value;
}

}  // namespace

void SoftSolid::solve(std::span<SoftSpring> springs, const std::vector<bool>& active) {
  const auto h = static_cast<float>(options_.step_s);
  const auto inertia = static_cast<float>(statics_ ? 0 : 1 + options_.step_s * options_.mass_damping_per_s);
  const std::size_t count = rest_.size();
  const auto multiply = [&](const std::vector<Vec3f>& in, std::vector<Vec3f>& out) {
    std::fill(out.begin(), out.end(), Vec3f::Zero());
    add_product(in, out, all_groups_);
    for (std::size_t n = 0; n < count; ++n)
      out[n] = h * h * (out[n] + support_[n] * in[n]) + inertia * mass_[n] * in[n];
    for (std::size_t s = 0; s < springs.size(); ++s) {
      if (!active[s]) continue;
      const Vec3f direction = springs[s].direction.cast<float>();
      const float force =
          h * h * static_cast<float>(springs[s].stiffness_n_per_m) * direction.dot(at(springs[s].place, in));
      spread(springs[s].place, force * direction, out);
    }
  };
  for (std::size_t n = 0; n < count; ++n)
    right_[n] = (statics_ ? 0.0F : mass_[n]) * velocity_[n] +
                h * (elastic_[n] + load_[n] + support_[n] * (rest_[n] - position_[n]));
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!active[s]) continue;
    const auto force = static_cast<float>(-springs[s].stiffness_n_per_m * springs[s].stretch_m);
    spread(springs[s].place, h * force * springs[s].direction.cast<float>(), right_);
  }
  // Springs in the preconditioner: their share of each node's own row.
  inverse_ = diagonal_;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!active[s]) continue;
    for (std::size_t i = 0; i < springs[s].place.node.size(); ++i)
      inverse_[static_cast<std::size_t>(springs[s].place.node[i])] +=
          h * h * static_cast<float>(springs[s].stiffness_n_per_m) * springs[s].place.share[i] *
          springs[s].place.share[i];
  }
  for (float& value : inverse_) value = value > 0 ? 1 / value : 0;

  std::vector<Vec3f>& v = velocity_next_;
  v = guess_;
  multiply(v, product_);
  for (std::size_t n = 0; n < count; ++n) residual_[n] = right_[n] - product_[n];
  const double enough = options_.tolerance * options_.tolerance * dot(right_, right_);
  for (std::size_t n = 0; n < count; ++n) direction_[n] = inverse_[n] * residual_[n];
  preconditioned_ = direction_;
  double rho = dot(residual_, preconditioned_);
  for (int iteration = 0; iteration < options_.most_iterations; ++iteration) {
    if (!(dot(residual_, residual_) > enough && rho > 0)) break;
    multiply(direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(curvature > 0)) break;
    const auto alpha = static_cast<float>(rho / curvature);
    for (std::size_t n = 0; n < count; ++n) {
      v[n] += alpha * direction_[n];
      residual_[n] -= alpha * product_[n];
      preconditioned_[n] = inverse_[n] * residual_[n];
    }
    const double next = dot(residual_, preconditioned_);
    const auto beta = static_cast<float>(next / rho);
    rho = next;
    for (std::size_t n = 0; n < count; ++n) direction_[n] = preconditioned_[n] + beta * direction_[n];
  }
}

void SoftSolid::step(std::span<SoftSpring> springs) {
  const auto h = static_cast<float>(options_.step_s);
  std::vector<bool> active(springs.size(), true);
  guess_ = velocity_;
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
  for (std::size_t n = 0; n < rest_.size(); ++n) position_[n] += h * velocity_next_[n];
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
  for (const Group& group : groups_) {
    Lane f[kAxes][kCubeCorners];
    stiffen(cube, group.strain, group.mu, f);
    for (int l = 0; l < kLanes; ++l) {
      energy += 0.5 * static_cast<double>(cube.dilatation * group.kappa[l]) * static_cast<double>(group.swollen[l]) *
                static_cast<double>(group.swollen[l]);
      for (int c = 0; c < kAxes; ++c)
        for (int m = 1; m < kCubeCorners; ++m)
          energy += 0.5 * static_cast<double>(group.strain[c][m][l]) * static_cast<double>(f[c][m][l]);
    }
  }
  for (std::size_t n = 0; n < rest_.size(); ++n) {
    energy += 0.5 * static_cast<double>(support_[n]) * static_cast<double>((position_[n] - rest_[n]).squaredNorm());
    energy += 0.5 * static_cast<double>(mass_[n]) * static_cast<double>(velocity_[n].squaredNorm());
  }
  for (const Release& r : released_) energy -= static_cast<double>(turned(r).dot(position_[r.node] - rest_[r.node]));
  return energy;
}

std::vector<Vec3f> SoftSolid::elastic_force() const { return elastic_; }

double SoftSolid::mass_kg() const { return std::accumulate(mass_.begin(), mass_.end(), 0.0); }

double SoftSolid::volume_m3() const {
  double volume = 0;
  for (const Group& group : groups_) {
    Lane v[kAxes][kCubeCorners];
    gather(position_.data(), group.node, v);
    for (auto& component : v) to_modes(component);
    for (int l = 0; l < kLanes; ++l) {
      Mat3 F;
      for (int c = 0; c < kAxes; ++c)
        for (int k = 0; k < kAxes; ++k) F(c, k) = v[c][1 << k][l] / (4 * options_.edge_m);
      volume += static_cast<double>(group.volume[l]) * F.determinant();
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
  const auto h = static_cast<float>(options_.step_s);
  const float weight = inertia ? (1 + h * static_cast<float>(options_.mass_damping_per_s)) / (h * h) : 0;
  const auto row = [&](std::int32_t n) { return static_cast<std::size_t>(n); };
  std::vector<Vec3f> u(rest_.size(), Vec3f::Zero()), r = u, d = u, product = u;
  spread(place, direction.cast<float>(), r);
  std::vector<float> inverse;
  for (const std::int32_t n : nodes)
    inverse.push_back(1 / (stiffness_diagonal_[row(n)] + support_[row(n)] + weight * mass_[row(n)]));
  double rho = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    d[row(nodes[i])] = inverse[i] * r[row(nodes[i])];
    rho += r[row(nodes[i])].dot(d[row(nodes[i])]);
  }
  const double first = rho;
  for (int iteration = 0; iteration < kMostLocal && rho > kLocalTolerance * first && rho > 0; ++iteration) {
    // Only what the groups touch is ever read or written.
    for (const std::int32_t g : groups)
      for (const auto& corner : groups_[row(g)].node)
        for (const std::int32_t n : corner) product[row(n)] = Vec3f::Zero();
    add_product(d, product, groups);
    double curvature = 0;
    for (const std::int32_t n : nodes) {
      product[row(n)] += (support_[row(n)] + weight * mass_[row(n)]) * d[row(n)];
      curvature += d[row(n)].dot(product[row(n)]);
    }
    const auto alpha = static_cast<float>(rho / curvature);
    double next = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t n = row(nodes[i]);
      u[n] += alpha * d[n];
      r[n] -= alpha * product[n];
      next += inverse[i] * r[n].squaredNorm();
    }
    const auto beta = static_cast<float>(next / rho);
    rho = next;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t n = row(nodes[i]);
      d[n] = inverse[i] * r[n] + beta * d[n];
    }
  }
  return direction.cast<float>().dot(at(place, u));
}

}  // namespace trocar
