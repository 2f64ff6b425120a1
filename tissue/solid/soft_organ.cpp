#include "tissue/solid/soft_organ.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/SVD>

namespace trocar {
namespace {

constexpr double kLeastContact = 1e-3;  // m, radius of a contact that has just begun
constexpr double kLeastSubCell = 0.03;  // share of a half-space's compliance that the sub-cell law keeps
// What is pressed: a disc of this times the contact's radius under a pressure as Hertz', sqrt(1 - r^2 / a^2). Its mean
// displacement is 0.6 / (E* a) a newton; so it is that of the flat punch which the law's slope is of, 1 / (2 E* a).
constexpr double kSpread = 1.2;
constexpr int kParts = 3;             // of a triangle's edge: points of that pressure
constexpr double kTangential = 0.8;   // friction's spring over the normal one (haptics/contact/contact_friction.cpp)
constexpr double kOtherPlace = 5e-3;  // m at rest between contacts that share no past
constexpr double kNoForce = 1e-6;     // N
constexpr int kShiftRounds = 12;
constexpr int kStillEvery = 4;  // steps between looks at what the lattice has of a place: it changes as the tool slides
constexpr double kWholeDent = 0.7, kShellEnd = 1.3;  // of the neighbourhood: undone as a whole, and no longer
constexpr double kLeastVolume = 0.2;     // of a cell, below which and above whose inverse its gradient is not trusted
constexpr double kBelowBottom = 1.3;     // of a groove's depth: so much of it must still lie in the tissue
constexpr int kShortenings = 4;          // halvings of a depth that goes through
constexpr std::size_t kFewestNodes = 8;  // that a motion is read from

// Read off the lattice itself: on cells of 5 mm a clamped ball of 60 mm in a half-space is softer than one of 30 mm by
// gamma / (pi E*) (1 / R1 - 1 / R2); cells of 4 mm give 1-2 % more. A ball that only bore the far field of a point
// force, u = F / (pi E* R), would have 1; that its edge holds fast costs more, most where volume cannot give way.
constexpr std::array<std::array<double, 2>, 7> kFarShare{
    {{0, 1.30}, {0.2, 1.37}, {0.3, 1.50}, {0.4, 1.80}, {0.45, 2.10}, {0.47, 2.28}, {0.495, 2.57}}};

double plane_modulus(const TissueSolid& material) {
  return material.young_pa / (1 - material.poisson * material.poisson);
}

std::vector<Vec3> node_places(const Lattice& lattice) {
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < lattice.nodes.size(); ++n) out.push_back(lattice.node_m(n));
  return out;
}

std::vector<SoftCell> soft_cells(const Lattice& lattice, std::span<const StiffBall> balls) {
  std::vector<SoftCell> out;
  for (const LatticeCell& cell : lattice.cells)
    out.push_back({cell.corners, cell.fill, cell.part, cell_stiffness(lattice, cell, balls)});
  return out;
}

Vec3 place_at_corners(const Barycentric& weight, const std::array<std::int32_t, 3>& corner,
                      std::span<const Vec3> vertices) {
  return interpolate(weight,
                     {vertices[static_cast<std::size_t>(corner[0])], vertices[static_cast<std::size_t>(corner[1])],
                      vertices[static_cast<std::size_t>(corner[2])]});
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

double far_share(double poisson) {
  std::size_t upper = 1;
  while (upper + 1 < kFarShare.size() && kFarShare[upper][0] < poisson) ++upper;
  const auto& [x0, y0] = kFarShare[upper - 1];
  const auto& [x1, y1] = kFarShare[upper];
  return y0 + std::clamp((poisson - x0) / (x1 - x0), 0.0, 1.0) * (y1 - y0);
}

struct SoftOrgan::Pressed {
  MaterialPoint place;
  NodeShares shares;
  Vec3 normal, tool;
  double share = 1, stiffness = 0;
  double modulus_pa = 0;  ///< of the half-space that the tool feels there
  double force = 0;       ///< before, then after the solve
  Vec3 tangential = Vec3::Zero();
};

SoftOrgan::SoftOrgan(const Lattice& lattice, const SurfacePtr& rest_T, const TissueSolid& material,
                     const SoftOrganOptions& options)
    : SoftOrgan(lattice, rest_T, std::span(&material, 1), options) {}

SoftOrgan::SoftOrgan(const Lattice& lattice, const SurfacePtr& rest_T, std::span<const TissueSolid> materials,
                     const SoftOrganOptions& options, const std::optional<BedOptions>& bed)
    : options_(options),
      lattice_(lattice, rest_T),
      embedded_(lattice, rest_T),
      solid_(node_places(lattice), soft_cells(lattice, options.balls), materials, options.solid),
      surface_(embedded_.at(solid_.position())),
      felt_(surface_->vertices) {
  for (const TissueSolid& material : materials) {
    Part& made = parts_.emplace_back(Part{material, relaxed_share(material, options.solid.step_s)});
    const double left = 1 - material.prony[0].share - material.prony[1].share;
    for (std::size_t i = 0; i < made.gain.size(); ++i) {
      const PronyBranch& branch = material.prony[i];
      made.gain[i] = branch.share / left;
      made.keep[i] = branch.tau_s / (branch.tau_s + options.solid.step_s);
    }
  }
  part_of_node_.assign(lattice.nodes.size(), 0);
  for (const LatticeCell& cell : lattice.cells)
    for (const std::int32_t node : cell.corners) part_of_node_[static_cast<std::size_t>(node)] = cell.part;
  support();
  if (bed && materials.size() > 1) bed_.emplace(lattice_, *bed, std::min(materials[0].young_pa, materials[1].young_pa));
  stiffness_ = 1 / half_space_compliance(plane_modulus(parts_.front().material), 0);
  energy_ = solid_.energy_j();
}

void SoftOrgan::support() {
  for (const auto& triangle : rest()->triangles) {
    const Vec3 a = rest()->vertices[static_cast<std::size_t>(triangle[0])];
    const Vec3 ab = rest()->vertices[static_cast<std::size_t>(triangle[1])] - a;
    const Vec3 ac = rest()->vertices[static_cast<std::size_t>(triangle[2])] - a;
    const Vec3 twice = ab.cross(ac);
    longest_edge_m_ = std::max({longest_edge_m_, ab.norm(), ac.norm()});
    const bool first = lattice_.part_of(triangle[0]) == 0;
    if (first && twice.z() >= options_.bed_cosine * twice.norm()) continue;
    const double per_area = first ? options_.bed_n_per_m3 : options_.tether_n_per_m3;
    for (const std::int32_t vertex : triangle) {
      const Embedding& e = lattice_.lattice().embedding[static_cast<std::size_t>(vertex)];
      const LatticeCell& cell = lattice_.lattice().cells[static_cast<std::size_t>(e.cell)];
      for (std::size_t k = 0; k < 8; ++k)
        solid_.hold(cell.corners[k], per_area * twice.norm() / 6 * static_cast<double>(e.weights[k]));
    }
  }
}

template <class Take>
void SoftOrgan::each_share(const MaterialPoint& place, Take take) const {
  const Lattice& lattice = lattice_.lattice();
  const auto& triangle = rest()->triangles[static_cast<std::size_t>(place.triangle)];
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Embedding& e = lattice.embedding[static_cast<std::size_t>(triangle[corner])];
    const auto weight = static_cast<float>(e.other < 0 ? place.weight[corner] : place.weight[corner] / 2);
    for (const std::int32_t number : {e.cell, e.other}) {
      if (number < 0) continue;
      const LatticeCell& cell = lattice.cells[static_cast<std::size_t>(number)];
      for (std::size_t k = 0; k < 8; ++k) take(cell.corners[k], weight * e.weights[k]);
    }
  }
}

NodeShares SoftOrgan::shares_of(const MaterialPoint& place) const {
  NodeShares out;
  each_share(place, [&](std::int32_t node, float share) {
    out.node.push_back(node);
    out.share.push_back(share);
  });
  return out;
}

NodeShares SoftOrgan::shares_within(const Vec3& rest_T) const {
  const std::int32_t number = lattice_.cell_for(rest_T);
  if (number < 0) return {};
  const Lattice& lattice = lattice_.lattice();
  const LatticeCell& cell = lattice.cells[static_cast<std::size_t>(number)];
  const Vec3 at =
      (rest_T - lattice.origin_m) / lattice.cell_m - Vec3(cell.place[0], cell.place[1], cell.place[2]);  // 0..1 inside
  NodeShares out;
  for (std::size_t k = 0; k < 8; ++k) {
    double share = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = at[static_cast<Eigen::Index>(axis)];
      share *= (k >> axis & 1) != 0 ? along : 1 - along;
    }
    out.node.push_back(cell.corners[k]);
    out.share.push_back(static_cast<float>(share));
  }
  return out;
}

Mat3 SoftOrgan::gradient_within(const Vec3& rest_T) const {
  const std::int32_t number = lattice_.cell_for(rest_T);
  return number < 0 ? Mat3::Identity() : mean_gradient(number);
}

Vec3 SoftOrgan::place_T(const NodeShares& place) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < place.node.size(); ++i)
    sum +=
        static_cast<double>(place.share[i]) * solid_.position()[static_cast<std::size_t>(place.node[i])].cast<double>();
  return sum;
}

MaterialPoint SoftOrgan::place_now(const MaterialPoint& before, const SurfaceSnapshot& old) const {
  // Vertices keep their numbers: of a triangle that was divided the piece is taken in which the place lies.
  if (before.triangle < 0 || before.triangle >= static_cast<std::int32_t>(old.triangles.size())) return {};
  const auto was = old.triangles[static_cast<std::size_t>(before.triangle)];
  if (was == rest()->triangles[static_cast<std::size_t>(before.triangle)]) return before;
  const Vec3 place = place_at_corners(before.weight, was, rest()->vertices);
  MaterialPoint best;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](std::size_t t) {
    if (!rest()->inside.empty() && rest()->inside[t]) return;
    const auto& [a, b, c] = rest()->triangles[t];
    const std::array<Vec3, 3> corner{rest()->vertices[static_cast<std::size_t>(a)],
                                     rest()->vertices[static_cast<std::size_t>(b)],
                                     rest()->vertices[static_cast<std::size_t>(c)]};
    Barycentric weight = barycentric_of(place, corner);
    double sum = 0;
    for (double& w : weight) sum += w = std::max(0.0, w);
    for (double& w : weight) w /= sum;
    const double distance = (interpolate(weight, corner) - place).squaredNorm();
    if (distance < least) least = distance, best = {static_cast<std::int32_t>(t), weight};
  };
  look(static_cast<std::size_t>(before.triangle));
  for (std::size_t t = old.triangles.size(); t < rest()->triangles.size(); ++t) look(t);
  return best;
}

Vec3 SoftOrgan::turned_to_rest(const MaterialPoint& place, const Vec3& vector_T) const {
  const auto vertex = static_cast<std::size_t>(rest()->triangles[static_cast<std::size_t>(place.triangle)][0]);
  return mean_gradient(lattice_.lattice().embedding[vertex].cell).inverse() * vector_T;
}

Mat3 SoftOrgan::mean_gradient(std::int32_t number) const {
  const Lattice& lattice = lattice_.lattice();
  const LatticeCell& cell = lattice.cells[static_cast<std::size_t>(number)];
  Mat3 F = Mat3::Zero();
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      F.col(static_cast<Eigen::Index>(axis)) +=
          ((k >> axis & 1) != 0 ? 1 : -1) / (4 * lattice.cell_m) *
          solid_.position()[static_cast<std::size_t>(cell.corners[k])].cast<double>();
  const double det = F.determinant();
  return det > kLeastVolume && det < 1 / kLeastVolume ? F : Mat3::Identity();
}

OrganCut SoftOrgan::cut(const Blade& blade, const CutTracingOptions& options) {
  TracedCut traced = trace_cut(*surface_, blade, options);
  OrganCut out{traced.refusal, traced.length_m, traced.depth_m, traced.area_m2};
  if (out.refusal != CutRefusal::kNone) return out;
  const std::int32_t part = lattice_.part_of(traced.cut.crossings.front().left);
  for (CutCrossing& crossing : traced.cut.crossings) {
    crossing.depth_m = turned_to_rest({crossing.triangle, {1, 0, 0}}, crossing.depth_m);
    const Vec3 left = rest()->vertices[static_cast<std::size_t>(crossing.left)];
    const Vec3 lip = left + crossing.share * (rest()->vertices[static_cast<std::size_t>(crossing.right)] - left);
    // No deeper than the organ: a groove has a bottom.
    int shortenings = 0;
    while (!lattice_.holds(lip + kBelowBottom * crossing.depth_m, part) && shortenings++ < kShortenings)
      crossing.depth_m /= 2;
    if (shortenings > kShortenings) return out.refusal = CutRefusal::kThrough, out;
    out.middle_rest_T += (lip + crossing.depth_m) / static_cast<double>(traced.cut.crossings.size());
  }
  out.first_vertex = static_cast<std::int32_t>(rest()->vertices.size());
  LatticeChange change;
  if (!lattice_.cut(traced.cut, change)) {
    const bool beside = runs_beside_wound(*surface_, surface_->inside, traced.cut);
    return out.refusal = beside ? CutRefusal::kBesideCut : CutRefusal::kPieceOff, out;
  }
  std::vector<SoftCellChange> cells;
  for (const auto& [number, parent] : change.cells) {
    const LatticeCell& cell = lattice_.lattice().cells[static_cast<std::size_t>(number)];
    cells.push_back({number, parent, cell.corners, cell.fill});
  }
  if (!cells.empty()) solid_.sever(change.node_parent, cells);
  part_of_node_.resize(part_of_node_.size() + change.node_parent.size(), part);
  if (bed_) bed_->follow_cut(lattice_);
  if (beside_) beside_->follow_cut(lattice_);
  cuts_.push_back(cut_bytes(traced.cut));
  added_ = std::move(change.added);
  embedded_ = EmbeddedSurface(lattice_.lattice(), lattice_.rest());
  for (ShapeField& field : fields_) grow_values(field.value, added_);
  surface_ = embedded_.at(solid_.position(), fields_);
  const std::size_t known = felt_.size();
  felt_.resize(surface_->vertices.size());
  std::copy(surface_->vertices.begin() + static_cast<std::ptrdiff_t>(known), surface_->vertices.end(),
            felt_.begin() + static_cast<std::ptrdiff_t>(known));
  energy_ = energy_j();
  return out;
}

double SoftOrgan::energy_j() const {
  return solid_.energy_j() + (bed_ ? bed_->energy_j() : 0) + (beside_ ? beside_->energy_j() : 0);
}

Vec3 SoftOrgan::place_at(const MaterialPoint& place, std::span<const Vec3> vertices) const {
  return place_at_corners(place.weight, rest()->triangles[static_cast<std::size_t>(place.triangle)], vertices);
}

double SoftOrgan::contact_radius(double modulus_pa, double force_n) const {
  const double radius = options_.tool_radius_m;
  return std::clamp(std::cbrt(0.75 * std::max(0.0, force_n) * radius / modulus_pa), kLeastContact,
                    std::max(kLeastContact, radius));
}

NodeShares SoftOrgan::shares_of(const MaterialPoint& place, double force_n) const {
  const std::int32_t own = part_of(place.triangle);
  const double reach = kSpread * contact_radius(plane_modulus(part(place.triangle).material), force_n),
               whole = 2.0 / 3 * std::numbers::pi * reach * reach;
  const std::vector<Vec3>& vertices = rest()->vertices;
  const auto& triangles = rest()->triangles;
  const Vec3 middle = place_at(place, vertices);
  std::vector<std::pair<std::int32_t, double>> sum;
  double given = 0;
  const auto add = [&](const MaterialPoint& at, double share) {
    each_share(
        at, [&](std::int32_t node, float of_point) { sum.emplace_back(node, share * static_cast<double>(of_point)); });
    given += share;
  };
  const double near = (reach + longest_edge_m_) * (reach + longest_edge_m_);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<Vec3, 3> corner;
    if ((vertices[static_cast<std::size_t>(triangles[t][0])] - middle).squaredNorm() > near) continue;
    if (part_of(static_cast<std::int32_t>(t)) != own) continue;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = vertices[static_cast<std::size_t>(triangles[t][k])];
    const double area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm() / (kParts * kParts);
    // The centres of the triangle's equal parts, those that stand and those that hang.
    for (int i = 0; i < kParts; ++i)
      for (int j = 0; i + j < kParts; ++j)
        for (int hanging = 0; hanging < (i + j + 1 < kParts ? 2 : 1); ++hanging) {
          const double a = (i + (1 + hanging) / 3.0) / kParts, b = (j + (1 + hanging) / 3.0) / kParts;
          const MaterialPoint at{static_cast<std::int32_t>(t), {1 - a - b, a, b}};
          const double left = 1 - (interpolate(at.weight, corner) - middle).squaredNorm() / (reach * reach);
          if (left > 0) add(at, area * std::sqrt(left) / whole);
        }
  }
  if (given < 1) add(place, 1 - given);
  // Summed node by node, in the order of the points: a sort of all of them costs more than all the rest.
  NodeShares out;
  std::vector<float> of_node(solid_.node_count(), 0);
  std::vector<bool> met(solid_.node_count(), false);
  for (const auto& [node, share] : sum) {
    const auto n = static_cast<std::size_t>(node);
    if (!met[n]) out.node.push_back(node);
    met[n] = true;
    of_node[n] += static_cast<float>(share / given);
  }
  std::sort(out.node.begin(), out.node.end());
  for (const std::int32_t node : out.node) out.share.push_back(of_node[static_cast<std::size_t>(node)]);
  return out;
}

double SoftOrgan::modulus_at(const MaterialPoint& place) const {
  const double even = plane_modulus(part(place.triangle).material);
  if (options_.balls.empty() || part_of(place.triangle) != 0) return even;
  const auto& corner = rest()->triangles[static_cast<std::size_t>(place.triangle)];
  const auto at = [&](std::size_t k) { return rest()->vertices[static_cast<std::size_t>(corner[k])]; };
  const Vec3 inward = (at(2) - at(0)).cross(at(1) - at(0)).normalized();
  return even * stiffer_under(place_at(place, rest()->vertices), inward, options_.tool_radius_m, options_.balls);
}

double SoftOrgan::half_space_compliance(double modulus_pa, double force_n) const {
  return 1 / (2 * modulus_pa * contact_radius(modulus_pa, force_n));
}

double SoftOrgan::half_space_depth(double modulus_pa, double force_n) const {
  const double radius = options_.tool_radius_m;
  // Linear below the least and above the greatest contact, tangent to Hertz' law at both.
  const double bounded = contact_radius(modulus_pa, force_n);
  const double there = 4.0 / 3 * modulus_pa * bounded * bounded * bounded / radius;
  return bounded * bounded / radius + (force_n - there) / (2 * modulus_pa * bounded);
}

double SoftOrgan::sub_cell_compliance(double modulus_pa, double force_n) const {
  const double half_space = half_space_compliance(modulus_pa, force_n);
  return std::max(
      {kLeastSubCell * half_space, half_space - sub_cell_, 1 / options_.most_stiffness_n_per_m - sub_cell_});
}

double SoftOrgan::elastic_part(double force_n) const {
  return std::max(0.0, force_n - memory_.held[0] - memory_.held[1]);
}

double SoftOrgan::Memory::carried(const Part& of) const {
  double sum = 0;
  for (std::size_t i = 0; i < held.size(); ++i) sum += of.keep[i] * (held[i] - of.gain[i] * elastic_n);
  return sum;
}

void SoftOrgan::remember(std::span<const Pressed> pressed) {
  const auto strongest = std::max_element(pressed.begin(), pressed.end(),
                                          [](const Pressed& a, const Pressed& b) { return a.force < b.force; });
  const bool touching = strongest != pressed.end() && strongest->force > 0;
  if (touching) {
    const Vec3 rest = place_at(strongest->place, lattice_.rest()->vertices);
    const std::int32_t on = part_of(strongest->place.triangle);
    if ((rest - memory_.rest_T).norm() > kOtherPlace || on != memory_.part) memory_.held = {}, memory_.elastic_n = 0;
    memory_.rest_T = rest;
    memory_.part = on;
  }
  const Part& of = parts_[static_cast<std::size_t>(memory_.part)];
  const double elastic =
      touching ? std::max(0.0, of.relaxed_share * (strongest->force / strongest->share - memory_.carried(of))) : 0;
  for (std::size_t i = 0; i < memory_.held.size(); ++i)
    memory_.held[i] = of.keep[i] * (memory_.held[i] + of.gain[i] * (elastic - memory_.elastic_n));
  memory_.elastic_n = elastic;
}

std::optional<MaterialPoint> SoftOrgan::place_of(const SolvedContacts& contacts, int contact) const {
  MaterialPoint place = contacts.at[static_cast<std::size_t>(contact)].place;
  const SurfacePtr told_of = lattice_.rest_of(contacts.topology);
  if (!told_of) return std::nullopt;
  for (const double weight : place.weight)
    if (!std::isfinite(weight)) return std::nullopt;
  if (told_of != rest()) place = place_now(place, *told_of);
  if (place.triangle < 0 || place.triangle >= static_cast<std::int32_t>(rest()->triangles.size())) return std::nullopt;
  return place;
}

std::vector<SoftOrgan::Pressed> SoftOrgan::press(const SolvedContacts& contacts) const {
  std::vector<Pressed> pressed;
  for (int i = 0; i < contacts.count; ++i) {
    const SolvedContact& contact = contacts.at[static_cast<std::size_t>(i)];
    const std::optional<MaterialPoint> place = place_of(contacts, i);
    const bool sound =
        contact.share > 0 && contact.force_T.allFinite() && contact.tool_T.allFinite() && contact.normal_T.allFinite();
    if (!place || !sound) continue;
    Pressed p{*place, {}, contact.normal_T, contact.tool_T};
    p.share = contact.share;
    p.force = std::max(0.0, contact.force_T.dot(contact.normal_T));
    p.shares = shares_of(*place, elastic_part(p.force / p.share));
    p.tangential = contact.force_T - contact.force_T.dot(contact.normal_T) * contact.normal_T;
    p.modulus_pa = modulus_at(*place);
    p.stiffness = p.share / sub_cell_compliance(p.modulus_pa, elastic_part(p.force / p.share));
    pressed.push_back(std::move(p));
  }
  return pressed;
}

void SoftOrgan::step(const SolvedContacts& contacts, const Vec3* tip_T, std::span<SoftSpring> more) {
  std::vector<Pressed> pressed;
  if (tip_T != nullptr) pressed = press(contacts);
  std::vector<SoftSpring> springs;
  for (const Pressed& p : pressed) {
    // Elastic force linear about that of the last tick, k (d - d0) + F0; with what the branches take of its change.
    const double whole = elastic_part(p.force / p.share), slope = p.stiffness / p.share;
    const Part& of = part(p.place.triangle);
    const double carried = part_of(p.place.triangle) == memory_.part ? memory_.carried(of) : 0;
    const double depth0 =
        half_space_depth(p.modulus_pa, whole) - whole * (half_space_compliance(p.modulus_pa, whole) - 1 / slope);
    // The place as the middle of all that is pressed has moved.
    Vec3 there = place_at(p.place, rest()->vertices);
    for (std::size_t i = 0; i < p.shares.node.size(); ++i) {
      const auto n = static_cast<std::size_t>(p.shares.node[i]);
      there += static_cast<double>(p.shares.share[i]) * (solid_.position()[n] - solid_.rest()[n]).cast<double>();
    }
    const double depth = p.normal.dot(there - p.tool);
    springs.push_back({p.shares, p.normal, p.stiffness / of.relaxed_share,
                       depth - depth0 + whole / slope + of.relaxed_share * carried / slope, true, 0});
  }
  for (const Pressed& p : pressed) {
    const double drag = p.tangential.norm();
    if (drag < kNoForce) continue;
    const double stiffness = kTangential * p.stiffness;
    springs.push_back({p.shares, p.tangential / drag, stiffness, drag / stiffness, false, 0});
  }
  const std::size_t own = springs.size();
  springs.insert(springs.end(), more.begin(), more.end());
  solid_.ties().clear();
  if (bed_) bed_->bind(lattice_, *surface_, solid_);
  if (beside_) beside_->press(lattice_, *surface_, solid_);
  solid_.step(springs);
  if (bed_) bed_->wear(solid_, options_.solid.step_s);
  if (beside_) beside_->bear(solid_);
  for (std::size_t s = own; s < springs.size(); ++s) more[s - own].force_n = springs[s].force_n;
  const double before = std::exchange(energy_, energy_j());
  given_ = std::max(0.0, before - energy_);
  force_ = 0;
  for (std::size_t i = 0; i < pressed.size(); ++i) force_ += pressed[i].force = springs[i].force_n;
  remember(pressed);
  surface_ = embedded_.at(solid_.position(), fields_);
  find_felt(pressed, tip_T);
}

Pose SoftOrgan::motion_round(const Vec3& rest_T, std::int32_t part) const {
  // Weighted by a shell at the neighbourhood's edge, where the dent has died away (Kabsch 1976).
  const auto rest = solid_.rest(), position = solid_.position();
  double sum = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  std::vector<std::pair<std::size_t, double>> shell;
  for (std::size_t n = 0; n < lattice_.lattice().nodes.size(); ++n) {
    const double r = (rest[n].cast<double>() - rest_T).norm() / options_.neighbourhood_m;
    if (r >= kShellEnd || part_of_node_[n] != part) continue;
    const double weight = r * r * (kShellEnd - r);
    shell.emplace_back(n, weight);
    from += weight * rest[n].cast<double>();
    to += weight * position[n].cast<double>();
    sum += weight;
  }
  if (shell.size() < kFewestNodes) return {Mat3::Identity(), Vec3::Zero()};
  from /= sum;
  to /= sum;
  Mat3 spread = Mat3::Zero();
  for (const auto& [n, weight] : shell)
    spread += weight * (position[n].cast<double>() - to) * (rest[n].cast<double>() - from).transpose();
  const Eigen::JacobiSVD<Mat3> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 mirror = Mat3::Identity();
  mirror(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Mat3 R = svd.matrixU() * mirror * svd.matrixV().transpose();
  return {R, to - R * from};
}

void SoftOrgan::undo_dents(std::span<const MaterialPoint> places) {
  felt_ = surface_->vertices;
  struct Dent {
    Vec3 rest;
    std::int32_t part;
    Pose motion;
  };
  std::vector<Dent> dents;
  for (const MaterialPoint& place : places) {
    const Vec3 rest = place_at(place, lattice_.rest()->vertices);
    const std::int32_t part = part_of(place.triangle);
    dents.push_back({rest, part, motion_round(rest, part)});
  }
  const double inner = kWholeDent * options_.neighbourhood_m, outer = kShellEnd * options_.neighbourhood_m;
  for (std::size_t v = 0; v < felt_.size(); ++v) {
    const Vec3& rest = lattice_.rest()->vertices[v];
    const std::int32_t part = parts_.size() > 1 ? lattice_.part_of(static_cast<std::int32_t>(v)) : 0;
    const Dent* nearest = nullptr;
    for (const Dent& dent : dents)
      if (dent.part == part &&
          (nearest == nullptr || (dent.rest - rest).squaredNorm() < (nearest->rest - rest).squaredNorm()))
        nearest = &dent;
    if (nearest == nullptr) continue;
    const double along = std::clamp((outer - (nearest->rest - rest).norm()) / (outer - inner), 0.0, 1.0);
    if (along > 0) felt_[v] += along * along * (3 - 2 * along) * (nearest->motion * rest - felt_[v]);
  }
}

double SoftOrgan::compliance_at(const Part& of, double modulus_pa, const NodeShares& place, const Vec3& direction,
                                double force_n) {
  const double answer = solid_.compliance(place, direction, options_.neighbourhood_m, true);
  if (looks_++ % kStillEvery == 0) {
    const double still = solid_.compliance(place, direction, options_.neighbourhood_m, false) / of.relaxed_share;
    sub_cell_ = still + far_share(of.material.poisson) /
                            (std::numbers::pi * plane_modulus(of.material) * options_.neighbourhood_m);
  }
  return of.relaxed_share * sub_cell_compliance(modulus_pa, elastic_part(force_n)) + answer;
}

double SoftOrgan::loop_stiffness(const NodeShares& place, const Vec3& direction, double spring_n_per_m) const {
  const double answer = solid_.compliance(place, direction, options_.neighbourhood_m, true);
  return std::min(options_.most_stiffness_n_per_m, 1 / (1 / spring_n_per_m + answer));
}

MaterialPoint SoftOrgan::nearest_place(const Vec3& tip_T) const {
  MaterialPoint place{0, {1, 0, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < rest()->triangles.size(); ++t) {
    const double distance =
        (surface_->vertices[static_cast<std::size_t>(rest()->triangles[t][0])] - tip_T).squaredNorm();
    if (distance < least) least = distance, place.triangle = static_cast<std::int32_t>(t);
  }
  return place;
}

void SoftOrgan::find_felt(std::span<const Pressed> pressed, const Vec3* tip_T) {
  if (tip_T == nullptr) {
    felt_ = surface_->vertices;
    return;
  }
  const auto strongest = std::max_element(pressed.begin(), pressed.end(),
                                          [](const Pressed& a, const Pressed& b) { return a.force < b.force; });
  std::vector<MaterialPoint> places;
  for (const Pressed& p : pressed)
    if (p.force >= kNoForce) places.push_back(p.place);
  const bool touching = !places.empty();
  if (!touching) places.push_back(nearest_place(*tip_T));
  undo_dents(places);
  const Vec3 way = *tip_T - place_at(places.front(), surface_->vertices);
  const Vec3 direction = touching ? strongest->normal : way.norm() > kLeastContact ? way.normalized() : Vec3::UnitZ();
  const MaterialPoint& place = touching ? strongest->place : places.front();
  if (part_of(place.triangle) != looked_at_) looks_ = 0, looked_at_ = part_of(place.triangle);
  const Part& of = part(place.triangle);
  const double compliance = touching ? compliance_at(of, strongest->modulus_pa, strongest->shares, direction,
                                                     strongest->force / strongest->share)
                                     : compliance_at(of, modulus_at(place), shares_of(place, 0), direction, 0);
  stiffness_ = std::min(options_.most_stiffness_n_per_m, 1 / compliance);
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
