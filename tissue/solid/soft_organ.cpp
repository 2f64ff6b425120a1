#include "tissue/solid/soft_organ.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kLeastContact = 1e-3;  // m, radius of a contact that has just begun
constexpr double kLeastSubCell = 0.1;   // share of a half-space's compliance that the sub-cell law keeps
constexpr double kTangential = 0.8;     // friction's spring over the normal one (haptics/contact/contact_friction.cpp)
constexpr double kFarShare = 1.0;       // gamma: what lies beyond a clamped ball of radius R takes gamma / (pi E* R)
constexpr double kNoForce = 1e-6;       // N
constexpr int kShiftRounds = 12;

double plane_modulus(const TissueSolid& material) {
  return material.young_pa / (1 - material.poisson * material.poisson);
}

std::vector<Vec3> node_places(const Lattice& lattice) {
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < lattice.nodes.size(); ++n) out.push_back(lattice.node_m(n));
  return out;
}

std::vector<SoftCell> soft_cells(const Lattice& lattice) {
  std::vector<SoftCell> out;
  for (const LatticeCell& cell : lattice.cells) out.push_back({cell.corners, cell.fill, 0});
  return out;
}

Lattice lattice_of(const TriangleSurface& surface, double cell_m) {
  LatticeOptions options;
  options.cell_m = cell_m;
  return std::move(build_lattice(surface, options).lattice);
}

double relaxed_share(const TissueSolid& material, double step_s) {
  double left = 1, instant = 1;
  for (const PronyBranch& branch : material.prony) {
    instant -= branch.share;
    left -= branch.share * step_s / (branch.tau_s + step_s);  // g_inf + sum g a
  }
  return instant / left;
}

}  // namespace

struct SoftOrgan::Pressed {
  MaterialPoint place;
  NodeShares shares;
  Vec3 normal, tool;
  double share = 1, stiffness = 0;
  double force = 0;  ///< before, then after the solve
  Vec3 tangential = Vec3::Zero();
};

SoftOrgan::SoftOrgan(const TriangleSurface& rest_T, const TissueSolid& material, const SoftOrganOptions& options)
    : rest_(rest_T),
      material_(material),
      options_(options),
      lattice_(lattice_of(rest_T, options.solid.edge_m)),
      solid_(node_places(lattice_), soft_cells(lattice_), std::span(&material, 1), options.solid),
      deformed_(rest_.vertices),
      felt_(rest_.vertices),
      correction_(solid_.node_count(), Vec3f::Zero()),
      relaxed_share_(relaxed_share(material, options.solid.step_s)) {
  for (const auto& triangle : rest_.triangles) {
    const Vec3 a = rest_.vertices[static_cast<std::size_t>(triangle[0])];
    const Vec3 twice = (rest_.vertices[static_cast<std::size_t>(triangle[1])] - a)
                           .cross(rest_.vertices[static_cast<std::size_t>(triangle[2])] - a);
    if (twice.z() >= options.bed_cosine * twice.norm()) continue;
    for (const std::int32_t vertex : triangle) {
      const Embedding& e = lattice_.embedding[static_cast<std::size_t>(vertex)];
      const LatticeCell& cell = lattice_.cells[static_cast<std::size_t>(e.cell)];
      for (std::size_t k = 0; k < 8; ++k)
        solid_.hold(cell.corners[k], options.bed_n_per_m3 * twice.norm() / 6 * static_cast<double>(e.weights[k]));
    }
  }
  stiffness_ = 1 / half_space_compliance(0);
}

NodeShares SoftOrgan::shares_of(const MaterialPoint& place) const {
  NodeShares out;
  const auto& triangle = rest_.triangles[static_cast<std::size_t>(place.triangle)];
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Embedding& e = lattice_.embedding[static_cast<std::size_t>(triangle[corner])];
    const LatticeCell& cell = lattice_.cells[static_cast<std::size_t>(e.cell)];
    for (std::size_t k = 0; k < 8; ++k) {
      out.node.push_back(cell.corners[k]);
      out.share.push_back(static_cast<float>(place.weight[corner]) * e.weights[k]);
    }
  }
  return out;
}

Vec3 SoftOrgan::place_at(const MaterialPoint& place, std::span<const Vec3> vertices) const {
  const auto& [a, b, c] = rest_.triangles[static_cast<std::size_t>(place.triangle)];
  return interpolate(place.weight, {vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)],
                                    vertices[static_cast<std::size_t>(c)]});
}

double SoftOrgan::half_space_compliance(double force_n) const {
  const double modulus = plane_modulus(material_), radius = options_.tool_radius_m;
  const double contact = std::cbrt(0.75 * std::max(0.0, force_n) * radius / modulus);
  return 1 / (2 * modulus * std::clamp(contact, kLeastContact, std::max(kLeastContact, radius)));
}

double SoftOrgan::half_space_depth(double force_n) const {
  const double modulus = plane_modulus(material_), radius = options_.tool_radius_m;
  const double contact = std::cbrt(0.75 * std::max(0.0, force_n) * radius / modulus);
  // Linear below the least and above the greatest contact, tangent to Hertz' law at both.
  const double bounded = std::clamp(contact, kLeastContact, std::max(kLeastContact, radius));
  const double there = 4.0 / 3 * modulus * bounded * bounded * bounded / radius;
  return bounded * bounded / radius + (force_n - there) / (2 * modulus * bounded);
}

std::vector<SoftOrgan::Pressed> SoftOrgan::press(const SolvedContacts& contacts) const {
  std::vector<Pressed> pressed;
  for (int i = 0; i < contacts.count; ++i) {
    const SolvedContact& contact = contacts.at[static_cast<std::size_t>(i)];
    const bool known =
        contact.place.triangle >= 0 && contact.place.triangle < static_cast<std::int32_t>(rest_.triangles.size());
    if (!known || contact.share <= 0 || !contact.force_T.allFinite() || !contact.tool_T.allFinite()) continue;
    Pressed p{contact.place, shares_of(contact.place), contact.normal_T, contact.tool_T};
    p.share = contact.share;
    p.force = std::max(0.0, contact.force_T.dot(contact.normal_T));
    p.tangential = contact.force_T - contact.force_T.dot(contact.normal_T) * contact.normal_T;
    const double whole = p.force / p.share;
    const double compliance =
        std::max(kLeastSubCell * half_space_compliance(whole), half_space_compliance(whole) - sub_cell_);
    p.stiffness = p.share / compliance;
    pressed.push_back(std::move(p));
  }
  return pressed;
}

void SoftOrgan::step(const SolvedContacts& contacts, std::uint64_t topology, const Vec3* tip_T) {
  std::vector<Pressed> pressed;
  if (tip_T != nullptr && contacts.topology == topology) pressed = press(contacts);
  std::vector<SoftSpring> springs;
  for (const Pressed& p : pressed) {
    // Linear about the force of the last tick: k (d - d0) + F0.
    const double whole = p.force / p.share, slope = p.stiffness / p.share;
    const double depth0 = half_space_depth(whole) - whole * (half_space_compliance(whole) - 1 / slope);
    const double depth = p.normal.dot(place_at(p.place, deformed_) - p.tool);
    springs.push_back({p.shares, p.normal, p.stiffness, depth - depth0 + whole / slope, true, 0});
  }
  for (const Pressed& p : pressed) {
    const double drag = p.tangential.norm();
    if (drag < kNoForce) continue;
    const double stiffness = kTangential * p.stiffness;
    springs.push_back({p.shares, p.tangential / drag, stiffness, drag / stiffness, false, 0});
  }
  const double before = solid_.energy_j();
  solid_.step(springs);
  given_ = std::max(0.0, before - solid_.energy_j());
  force_ = 0;
  for (std::size_t i = 0; i < pressed.size(); ++i) force_ += pressed[i].force = springs[i].force_n;
  embed_surface();
  find_felt(pressed, tip_T);
}

void SoftOrgan::embed_surface() {
  const auto position = solid_.position();
  for (std::size_t v = 0; v < deformed_.size(); ++v) {
    const Embedding& e = lattice_.embedding[v];
    const auto& corners = lattice_.cells[static_cast<std::size_t>(e.cell)].corners;
    Vec3f sum = Vec3f::Zero();
    for (std::size_t k = 0; k < 8; ++k) sum += e.weights[k] * position[static_cast<std::size_t>(corners[k])];
    deformed_[v] = sum.cast<double>();
  }
}

void SoftOrgan::find_felt(std::span<const Pressed> pressed, const Vec3* tip_T) {
  felt_ = deformed_;
  if (tip_T == nullptr) return;
  double total = 0, compliance = 0;
  std::fill(correction_.begin(), correction_.end(), Vec3f::Zero());
  const auto take = [&](const NodeShares& place, const Vec3& direction, double whole, double weight) {
    const double answer = solid_.compliance(place, direction, options_.neighbourhood_m, true, &field_);
    const double still = solid_.compliance(place, direction, options_.neighbourhood_m, false) / relaxed_share_;
    sub_cell_ = still + kFarShare / (std::numbers::pi * plane_modulus(material_) * options_.neighbourhood_m);
    const double half_space = half_space_compliance(whole);
    compliance += weight * (std::max(kLeastSubCell * half_space, half_space - sub_cell_) + answer);
    total += weight;
  };
  for (const Pressed& p : pressed) {
    if (p.force < kNoForce) continue;
    take(p.shares, p.normal, p.force / p.share, p.force);
    const auto force = static_cast<float>(p.force);
    for (std::size_t n = 0; n < correction_.size(); ++n) correction_[n] += force * field_[n];
  }
  if (total == 0) {
    const auto nearest = std::min_element(deformed_.begin(), deformed_.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - *tip_T).squaredNorm() < (b - *tip_T).squaredNorm();
    });
    const Vec3 way = *tip_T - *nearest;
    const Embedding& e = lattice_.embedding[static_cast<std::size_t>(nearest - deformed_.begin())];
    const auto& corners = lattice_.cells[static_cast<std::size_t>(e.cell)].corners;
    take({{corners.begin(), corners.end()}, {e.weights.begin(), e.weights.end()}},
         way.norm() > kLeastContact ? Vec3(way.normalized()) : Vec3::UnitZ(), 0, 1);
    stiffness_ = std::min(options_.most_stiffness_n_per_m, total / compliance);
    return;
  }
  stiffness_ = std::min(options_.most_stiffness_n_per_m, total / compliance);
  for (std::size_t v = 0; v < felt_.size(); ++v) {
    const Embedding& e = lattice_.embedding[v];
    const auto& corners = lattice_.cells[static_cast<std::size_t>(e.cell)].corners;
    Vec3f sum = Vec3f::Zero();
    for (std::size_t k = 0; k < 8; ++k) sum += e.weights[k] * correction_[static_cast<std::size_t>(corners[k])];
    felt_[v] += sum.cast<double>();
  }
  // Where the loop's linear law would give another force at the tool's place, all of it moves by the difference.
  Vec3 displaced = Vec3::Zero(), shift = Vec3::Zero();
  for (const Pressed& p : pressed) displaced += p.force / stiffness_ * p.normal;
  for (int round = 0; round < kShiftRounds; ++round)
    for (const Pressed& p : pressed)
      if (p.force >= kNoForce)
        shift += (p.normal.dot(displaced + p.tool - place_at(p.place, felt_)) - p.normal.dot(shift)) * p.normal;
  for (Vec3& vertex : felt_) vertex += shift;
}

}  // namespace trocar
