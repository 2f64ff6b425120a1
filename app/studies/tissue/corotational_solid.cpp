#include "app/studies/tissue/corotational_solid.h"

#include <algorithm>
#include <utility>

#include "app/studies/tissue/tetrahedra_lanes.h"

namespace trocar {
namespace {

/// Along Morton's curve by the place of the middle, filled up to whole vectors with -1.
std::vector<std::int32_t> by_place(const TetrahedraMesh& mesh) {
  constexpr unsigned kBits = 16;
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const Vec3& node : mesh.nodes) low = low.cwiseMin(node), high = high.cwiseMax(node);
  const double scale = ((1U << kBits) - 1) / (high - low).maxCoeff();
  std::vector<std::pair<std::uint64_t, std::int32_t>> keyed;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t node : mesh.tetrahedra[t]) middle += mesh.nodes[static_cast<std::size_t>(node)] / 4;
    std::uint64_t key = 0;
    for (unsigned axis = 0; axis < kAxes; ++axis) {
      const Eigen::Index a = axis;
      const auto at = static_cast<std::uint64_t>(scale * (middle[a] - low[a]));
      for (unsigned bit = 0; bit < kBits; ++bit) key |= (at >> bit & 1) << (kAxes * bit + axis);
    }
    keyed.emplace_back(key, static_cast<std::int32_t>(t));
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::int32_t> order;
  for (const auto& [key, t] : keyed) order.push_back(t);
  order.resize((order.size() + kLanes - 1) / kLanes * kLanes, -1);
  return order;
}

/// R^T G in place of G.
TROCAR_INLINE void turn_gradient_back(const Lane (*R)[kAxes], Lane (*G)[kAxes]) {
  TROCAR_UNROLLED
  for (int k = 0; k < kAxes; ++k) {
    const Lane x = G[0][k], y = G[1][k], z = G[2][k];
    TROCAR_UNROLLED
    for (int c = 0; c < kAxes; ++c) G[c][k] = R[0][c] * x + R[1][c] * y + R[2][c] * z;
  }
}
/// V R (2 mu e + lambda tr e) for e the symmetric part of G.
TROCAR_INLINE void turned_stress(const TetrahedraGroup& group, const Lane (*R)[kAxes], const Lane (*G)[kAxes],
                                 Lane (*P)[kAxes]) {
  const Lane mu = group.volume * group.mu;
  const Lane pressure = group.volume * group.lambda * (G[0][0] + G[1][1] + G[2][2]);
  Lane S[kAxes][kAxes];
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) S[c][k] = mu * (G[c][k] + G[k][c]);
    S[c][c] += pressure;
  }
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) P[c][k] = R[c][0] * S[0][k] + R[c][1] * S[1][k] + R[c][2] * S[2][k];
  }
}
/// R^T F - 1 in place of G = F - 1.
TROCAR_INLINE void strain_of(const Lane (*R)[kAxes], Lane (*G)[kAxes]) {
  turn_gradient_back(R, G);
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) G[c][k] += c == k ? R[k][c] - 1.0F : R[k][c];
  }
}

using Sum = double __attribute__((vector_size(4 * sizeof(double))));

TROCAR_LANES_CLONED double inner(const std::vector<NodeRow>& a, const std::vector<NodeRow>& b) {
  Sum sum{};
  for (std::size_t n = 0; n < a.size(); ++n)
    sum += __builtin_convertvector(row(a[n]), Sum) * __builtin_convertvector(row(b[n]), Sum);
  return (sum[0] + sum[1]) + sum[2];
}
/// to += factor of
TROCAR_LANES_CLONED void add_scaled(float factor, const std::vector<NodeRow>& of, std::vector<NodeRow>& to) {
  for (std::size_t n = 0; n < of.size(); ++n) set(to[n], row(to[n]) + factor * row(of[n]));
}
/// r . inverse r
TROCAR_LANES_CLONED double preconditioned(const std::vector<NodeRow>& inverse, const std::vector<NodeRow>& r) {
  Sum sum{};
  for (std::size_t n = 0; n < r.size(); ++n)
    sum += __builtin_convertvector(row(r[n]), Sum) * __builtin_convertvector(row(inverse[n]) * row(r[n]), Sum);
  return (sum[0] + sum[1]) + sum[2];
}
/// d <- inverse r + beta d
TROCAR_LANES_CLONED void next_direction(const std::vector<NodeRow>& inverse, const std::vector<NodeRow>& r, float beta,
                                        std::vector<NodeRow>& d) {
  for (std::size_t n = 0; n < r.size(); ++n) set(d[n], row(inverse[n]) * row(r[n]) + beta * row(d[n]));
}

}  // namespace

/// Of eight tetrahedra.
struct alignas(kLanes * sizeof(float)) CorotationalSolid::Turned {
  Lane rotation[kAxes][kAxes];
};

CorotationalSolid::~CorotationalSolid() = default;

TROCAR_LANES_CLONED void CorotationalSolid::prepare() {
  std::fill(elastic_.begin(), elastic_.end(), NodeRow{});
  std::fill(diagonal_.begin(), diagonal_.end(), NodeRow{});
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const TetrahedraGroup& group = groups_[g];
    Lane(*R)[kAxes] = turned_[g].rotation;
    Lane G[kAxes][kAxes], F[kAxes][kAxes], P[kAxes][kAxes], f[kTetrahedronCorners][kAxes];
    displacement_gradient(displacement_.data(), group, G);
    TROCAR_UNROLLED
    for (int i = 0; i < kAxes * kAxes; ++i)
      F[i / kAxes][i % kAxes] = G[i / kAxes][i % kAxes] + (i % (kAxes + 1) == 0 ? 1.0F : 0.0F);
    follow_rotation(F, R);
    strain_of(R, G);
    turned_stress(group, R, G, P);
    TROCAR_UNROLLED
    for (int i = 0; i < kAxes * kAxes; ++i) P[i / kAxes][i % kAxes] = -P[i / kAxes][i % kAxes];
    corners_of(P, group, f);
    add_to_corners(f, group, elastic_.data());
    // Of V ((lambda + mu) b b^T + mu |b|^2) for b = R grad N of each corner.
    Lane b[kTetrahedronCorners][kAxes];
    corners_of(R, group, b);
    TROCAR_UNROLLED
    for (int a = 0; a < kTetrahedronCorners; ++a) {
      const Lane square = b[a][0] * b[a][0] + b[a][1] * b[a][1] + b[a][2] * b[a][2];
      TROCAR_UNROLLED
      for (int c = 0; c < kAxes; ++c)
        f[a][c] = group.volume * ((group.lambda + group.mu) * b[a][c] * b[a][c] + group.mu * square);
    }
    add_to_corners(f, group, diagonal_.data());
  }
}

CorotationalSolid::CorotationalSolid(const PeerBody& body, const CorotationalOptions& options)
    : options_(options), groups_(grouped(body, by_place(body.mesh))), mass_(masses(body)) {
  turned_.resize(groups_.size());
  for (Turned& turned : turned_)
    for (int i = 0; i < kAxes * kAxes; ++i) turned.rotation[i / kAxes][i % kAxes] = all(i % (kAxes + 1) == 0 ? 1 : 0);
  support_.assign(mass_.size(), 0);
  for (auto* rows : {&displacement_, &velocity_, &load_, &elastic_, &diagonal_, &inverse_, &right_, &residual_,
                     &direction_, &product_})
    rows->assign(mass_.size(), NodeRow{});
  prepare();
}

void CorotationalSolid::hold(std::int32_t node, double stiffness_n_per_m) {
  support_[static_cast<std::size_t>(node)] += static_cast<float>(stiffness_n_per_m);
}
void CorotationalSolid::load(std::int32_t node, const Vec3& force_n) {
  for (std::size_t c = 0; c < kAxes; ++c)
    load_[static_cast<std::size_t>(node)].at[c] += static_cast<float>(force_n[static_cast<Eigen::Index>(c)]);
}

TROCAR_LANES_CLONED void CorotationalSolid::add_product(const std::vector<NodeRow>& in,
                                                        std::vector<NodeRow>& out) const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const TetrahedraGroup& group = groups_[g];
    const Lane(*R)[kAxes] = turned_[g].rotation;
    Lane G[kAxes][kAxes], P[kAxes][kAxes], f[kTetrahedronCorners][kAxes];
    displacement_gradient(in.data(), group, G);
    turn_gradient_back(R, G);
    turned_stress(group, R, G, P);
    corners_of(P, group, f);
    add_to_corners(f, group, out.data());
  }
}

void CorotationalSolid::step() {
  solve();
  const auto h = static_cast<float>(options_.step_s);
  add_scaled(h, velocity_, displacement_);
  prepare();
}

/// All divided by h^2.
void CorotationalSolid::solve() {
  const auto h = static_cast<float>(options_.step_s);
  const float inertia = (1 + h * static_cast<float>(options_.mass_damping_per_s)) / (h * h);
  const auto shifted = [&](const std::vector<NodeRow>& in, std::vector<NodeRow>& out) {
    for (std::size_t n = 0; n < in.size(); ++n) set(out[n], (support_[n] + inertia * mass_[n]) * row(in[n]));
    add_product(in, out);
  };
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    const Row force = row(elastic_[n]) + row(load_[n]) - support_[n] * row(displacement_[n]);
    set(right_[n], mass_[n] / (h * h) * row(velocity_[n]) + 1 / h * force);
    for (int c = 0; c < kAxes; ++c) {
      const float value = diagonal_[n].at[c] + support_[n] + inertia * mass_[n];
      inverse_[n].at[c] = value > 0 ? 1 / value : 0;
    }
  }
  shifted(velocity_, product_);
  residual_ = right_;
  add_scaled(-1, product_, residual_);
  direction_.assign(mass_.size(), NodeRow{});
  const double enough = options_.tolerance * options_.tolerance * inner(right_, right_);
  double rho = 0;
  for (int i = 0; i < options_.most_iterations && inner(residual_, residual_) > enough; ++i) {
    const double next = preconditioned(inverse_, residual_);
    next_direction(inverse_, residual_, rho > 0 ? static_cast<float>(next / rho) : 0.0F, direction_);
    rho = next;
    shifted(direction_, product_);
    const auto alpha = static_cast<float>(rho / inner(direction_, product_));
    add_scaled(alpha, direction_, velocity_);
    add_scaled(-alpha, product_, residual_);
  }
}

Vec3 CorotationalSolid::displacement(std::int32_t node) const {
  const NodeRow& u = displacement_[static_cast<std::size_t>(node)];
  return Eigen::Vector3f(u.at[0], u.at[1], u.at[2]).cast<double>();
}

double CorotationalSolid::energy_j() const {
  double energy = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const TetrahedraGroup& group = groups_[g];
    Lane G[kAxes][kAxes], square{};
    displacement_gradient(displacement_.data(), group, G);
    strain_of(turned_[g].rotation, G);
    for (int c = 0; c < kAxes; ++c)
      for (int k = 0; k < kAxes; ++k) square += (G[c][k] + G[k][c]) * (G[c][k] + G[k][c]);
    const Lane trace = G[0][0] + G[1][1] + G[2][2];
    const Lane density = 0.25F * group.mu * square + 0.5F * group.lambda * trace * trace;
    for (int l = 0; l < kLanes; ++l) energy += static_cast<double>(group.volume[l] * density[l]);
  }
  for (std::size_t n = 0; n < node_count(); ++n)
    for (int c = 0; c < kAxes; ++c) {
      const auto u = static_cast<double>(displacement_[n].at[c]), v = static_cast<double>(velocity_[n].at[c]);
      energy += 0.5 * (static_cast<double>(support_[n]) * u * u + static_cast<double>(mass_[n]) * v * v);
    }
  return energy;
}

}  // namespace trocar
