#include "app/studies/tissue/xpbd_solid.h"

#include <algorithm>
#include <span>

#include "app/studies/tissue/tetrahedra_lanes.h"

namespace trocar {
namespace {

/// Colour by colour, each filled up to whole vectors with -1.
std::vector<std::int32_t> by_colour(const TetrahedraMesh& mesh) {
  std::vector<std::vector<std::int32_t>> members;
  std::vector<std::vector<bool>> met;  // of each colour: nodes
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    std::size_t colour = 0;
    const auto meets = [&] {
      return std::any_of(mesh.tetrahedra[t].begin(), mesh.tetrahedra[t].end(),
                         [&](std::int32_t node) { return met[colour][static_cast<std::size_t>(node)]; });
    };
    while (colour < met.size() && meets()) ++colour;
    if (colour == met.size()) {
      met.emplace_back(mesh.nodes.size(), false);
      members.emplace_back();
    }
    for (const std::int32_t node : mesh.tetrahedra[t]) met[colour][static_cast<std::size_t>(node)] = true;
    members[colour].push_back(static_cast<std::int32_t>(t));
  }
  std::vector<std::int32_t> order;
  for (const auto& of_colour : members) {
    order.insert(order.end(), of_colour.begin(), of_colour.end());
    order.resize((order.size() + kLanes - 1) / kLanes * kLanes, -1);
  }
  return order;
}

/// det (1 + G) - 1 and cof (1 + G).
TROCAR_INLINE Lane growth_of(const Lane (*G)[kAxes], Lane (*cofactor)[kAxes]) {
  Lane F[kAxes][kAxes];
  for (int i = 0; i < kAxes * kAxes; ++i) F[i / kAxes][i % kAxes] = G[i / kAxes][i % kAxes];
  for (int c = 0; c < kAxes; ++c) F[c][c] += 1.0F;
  TROCAR_UNROLLED
  for (int i = 0; i < kAxes * kAxes; ++i) {
    const int c = i / kAxes, k = i % kAxes;
    const int d = (c + 1) % kAxes, e = (c + 2) % kAxes, m = (k + 1) % kAxes, n = (k + 2) % kAxes;
    cofactor[c][k] = F[d][m] * F[e][n] - F[d][n] * F[e][m];
  }
  Lane growth = G[0][0] + G[1][1] + G[2][2];
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
    growth += G[d][d] * G[e][e] - G[d][e] * G[e][d] + G[0][c] * (G[1][d] * G[2][e] - G[1][e] * G[2][d]);
  }
  return growth;
}

TROCAR_INLINE Lane square_root(Lane value) {
  for (int l = 0; l < kLanes; ++l) value[l] = __builtin_sqrtf(value[l]);
  return value;
}

TROCAR_INLINE Lane inverse_masses(const NodeRow* u, const std::int32_t* n) {
  return Lane{u[n[0]].at[3], u[n[1]].at[3], u[n[2]].at[3], u[n[3]].at[3],
              u[n[4]].at[3], u[n[5]].at[3], u[n[6]].at[3], u[n[7]].at[3]};
}

/// One pass over all tetrahedra. @param u displacements with inverse masses
TROCAR_LANES_CLONED void pass_over(std::span<const TetrahedraGroup> groups, float step_s, NodeRow* u) {
  const float per_h2 = 1 / (step_s * step_s);
  for (const TetrahedraGroup& group : groups) {
    Lane G[kAxes][kAxes], cofactor[kAxes][kAxes], shape[kAxes][kAxes];
    displacement_gradient(u, group, G);
    const Lane volume_change = growth_of(G, cofactor);
    Lane square = all(3.0F);
    TROCAR_UNROLLED
    for (int i = 0; i < kAxes * kAxes; ++i) {
      const int c = i / kAxes, k = i % kAxes;
      square += G[c][k] * (G[c][k] + (c == k ? 2.0F : 0.0F));
    }
    const Lane length = square_root(square), per_length = 1.0F / length;
    TROCAR_UNROLLED
    for (int i = 0; i < kAxes * kAxes; ++i) {
      const int c = i / kAxes, k = i % kAxes;
      shape[c][k] = (G[c][k] + (c == k ? 1.0F : 0.0F)) * per_length;
    }
    Lane g_D[kTetrahedronCorners][kAxes], g_H[kTetrahedronCorners][kAxes];
    corners_of(shape, group, g_D);
    corners_of(cofactor, group, g_H);
    Lane DD{}, DH{}, HH{};
    TROCAR_UNROLLED
    for (int a = 0; a < kTetrahedronCorners; ++a) {
      const Lane w = inverse_masses(u, group.node[a]);
      DD += w * (g_D[a][0] * g_D[a][0] + g_D[a][1] * g_D[a][1] + g_D[a][2] * g_D[a][2]);
      DH += w * (g_D[a][0] * g_H[a][0] + g_D[a][1] * g_H[a][1] + g_D[a][2] * g_H[a][2]);
      HH += w * (g_H[a][0] * g_H[a][0] + g_H[a][1] * g_H[a][1] + g_H[a][2] * g_H[a][2]);
    }
    // Multiplied by the stiffness, so that a lane without tissue is no division by nothing.
    const Lane k_D = group.mu * group.volume, k_H = (group.lambda + group.mu) * group.volume;
    const Lane a_DD = k_D * DD + per_h2, a_DH = k_D * DH, a_HD = k_H * DH, a_HH = k_H * HH + per_h2;
    const Lane right_D = -k_D * length, right_H = group.mu * group.volume - k_H * volume_change;
    const Lane per_determinant = 1.0F / (a_DD * a_HH - a_DH * a_HD);
    const Lane by_D = (a_HH * right_D - a_DH * right_H) * per_determinant;
    const Lane by_H = (a_DD * right_H - a_HD * right_D) * per_determinant;
    TROCAR_UNROLLED
    for (int a = 0; a < kTetrahedronCorners; ++a) {
      const Lane w = inverse_masses(u, group.node[a]);
      TROCAR_UNROLLED
      for (int c = 0; c < kAxes; ++c) g_D[a][c] = w * (by_D * g_D[a][c] + by_H * g_H[a][c]);
    }
    add_to_corners(g_D, group, u);
  }
}

}  // namespace

XpbdSolid::~XpbdSolid() = default;

XpbdSolid::XpbdSolid(const PeerBody& body, const XpbdOptions& options) : options_(options) {
  groups_ = grouped(body, by_colour(body.mesh));
  inverse_mass_ = masses(body);
  for (float& mass : inverse_mass_) mass = mass > 0 ? 1 / mass : 0;
  support_.assign(inverse_mass_.size(), 0);
  for (auto* rows : {&displacement_, &before_, &velocity_, &load_}) rows->assign(inverse_mass_.size(), NodeRow{});
  for (std::size_t n = 0; n < inverse_mass_.size(); ++n) displacement_[n].at[3] = inverse_mass_[n];
}

void XpbdSolid::hold(std::int32_t node, double stiffness_n_per_m) {
  support_[static_cast<std::size_t>(node)] += static_cast<float>(stiffness_n_per_m);
}
void XpbdSolid::load(std::int32_t node, const Vec3& force_n) {
  for (std::size_t c = 0; c < kAxes; ++c)
    load_[static_cast<std::size_t>(node)].at[c] += static_cast<float>(force_n[static_cast<Eigen::Index>(c)]);
}

void XpbdSolid::step() {
  for (int substep_number = 0; substep_number < options_.substeps; ++substep_number) substep();
}

void XpbdSolid::substep() {
  const auto h = static_cast<float>(options_.step_s / options_.substeps);
  const float kept = 1 / (1 + h * static_cast<float>(options_.mass_damping_per_s)), per_h = 1 / h;
  for (std::size_t n = 0; n < displacement_.size(); ++n) {
    before_[n] = displacement_[n];
    const Row u = row(displacement_[n]);
    const float w = inverse_mass_[n];
    Row moved = u + h * kept * (row(velocity_[n]) + h * w * row(load_[n]));
    const float yielded = support_[n] * h * h * w;
    moved *= 1 / (1 + yielded);
    moved[3] = w;
    set(displacement_[n], moved);
  }
  pass_over(groups_, h, displacement_.data());
  for (std::size_t n = 0; n < displacement_.size(); ++n)
    set(velocity_[n], per_h * (row(displacement_[n]) - row(before_[n])));
}

Vec3 XpbdSolid::displacement(std::int32_t node) const {
  const NodeRow& u = displacement_[static_cast<std::size_t>(node)];
  return Eigen::Vector3f(u.at[0], u.at[1], u.at[2]).cast<double>();
}

double XpbdSolid::energy_j() const {
  double energy = 0;
  for (const TetrahedraGroup& group : groups_) {
    Lane G[kAxes][kAxes], cofactor[kAxes][kAxes], square{};
    displacement_gradient(displacement_.data(), group, G);
    const Lane growth = growth_of(G, cofactor);
    for (const auto& of_row : G)
      for (const Lane& value : of_row) square += value * value;
    // mu / 2 (tr F^T F - 3) - mu (det F - 1) + lambda' / 2 (det F - 1)^2, without what cancels in it.
    const Lane beyond = growth - (G[0][0] + G[1][1] + G[2][2]);
    const Lane density = group.mu * (0.5F * square - beyond) + 0.5F * (group.lambda + group.mu) * growth * growth;
    for (int l = 0; l < kLanes; ++l) energy += static_cast<double>(group.volume[l] * density[l]);
  }
  for (std::size_t n = 0; n < node_count(); ++n)
    for (int c = 0; c < kAxes; ++c) {
      const auto u = static_cast<double>(displacement_[n].at[c]), v = static_cast<double>(velocity_[n].at[c]);
      energy += 0.5 * (static_cast<double>(support_[n]) * u * u + v * v / static_cast<double>(inverse_mass_[n]));
    }
  return energy;
}

}  // namespace trocar
