#include "tissue/thin/elastic_rod.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kUnknowns = 4;      // of a node: place, turn of the segment behind it
constexpr double kNearestNodes = 1e-6;    // m, of a path
constexpr double kShortestOfRest = 0.05;  // of its length without force: no segment's bend is read as of a shorter one
constexpr double kSplintedBend = 50;      // times the bending stiffness
constexpr double kStaticInertia = 1e-5;   // of the inertia, left so that a free rod has an answer
constexpr double kSufficientDescent = 1e-4;  // Armijo
constexpr int kMostHalvings = 12;

bool acts(const RodSpring& spring) {
  return std::isfinite(spring.arc_m) && spring.direction.allFinite() && std::isfinite(spring.stiffness_n_per_m) &&
         spring.stiffness_n_per_m >= 0 && std::isfinite(spring.stretch_m);
}

/// w' and w of the stretch law, over E A: exponential in tension up to the largest stiffness, then straight.
double stretch_law(double strain, double c, double most) {
  if (strain <= 0 || c <= 0) return strain;
  const double bend = std::log(most) / c;
  return strain < bend ? std::expm1(c * strain) / c : (most - 1) / c + most * (strain - bend);
}

double stretch_slope(double strain, double c, double most) {
  return strain <= 0 || c <= 0 ? 1 : std::min(std::exp(std::min(c * strain, 50.0)), most);
}

double stretch_energy(double strain, double c, double most) {
  if (strain <= 0 || c <= 0) return 0.5 * strain * strain;
  const double bend = std::log(most) / c, low = std::min(strain, bend), over = strain - low;
  return (std::expm1(c * low) / c - low) / c + (most - 1) / c * over + 0.5 * most * over * over;
}

SegmentFrame frame_along(const Vec3& edge, const SegmentFrame& before, double turn) {
  SegmentFrame frame;
  frame.length_m = edge.norm();
  frame.t = frame.length_m > 1e-12 ? Vec3(edge / frame.length_m) : before.t;
  const Vec3 d1 = carried_over(before.d1, before.t, frame.t);
  frame.d1 = std::cos(turn) * d1 + std::sin(turn) * frame.t.cross(d1);
  frame.d2 = frame.t.cross(frame.d1);
  return frame;
}

/// As the gradient of a bend reads it: never shorter than a share of its rest.
SegmentFrame not_too_short(SegmentFrame frame, double rest_m) {
  frame.length_m = std::max(frame.length_m, kShortestOfRest * rest_m);
  return frame;
}

void check_rod(std::span<const Vec3> path, const RodOptions& o) {
  if (path.size() < 2) throw InputError("a rod needs at least two points");
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!path[i].allFinite()) throw InputError("a point of a rod is not finite");
    if (i > 0 && (path[i] - path[i - 1]).norm() < kNearestNodes) throw InputError("two points of a rod coincide");
  }
  const bool sizes = o.outer_radius_m > 0 && o.wall_m > 0 && o.wall_m <= o.outer_radius_m && o.least_segment_m > 0;
  const bool stuff = o.young_pa > 0 && o.poisson > -1 && o.poisson < 0.5 && o.density_kg_m3 > 0 &&
                     o.content_kg_m3 >= 0 && o.stiffening >= 0 && o.most_stiffening >= 1 && o.pre_strain > -0.5;
  double shares = 0;
  bool branches = true;
  for (const PronyBranch& branch : o.prony) {
    shares += branch.share;
    branches = branches && branch.share >= 0 && (branch.share == 0 || branch.tau_s > 0);
  }
  if (!sizes) throw InputError("radius, wall or least segment of a rod are none");
  if (!stuff || !branches || !(shares < 1)) throw InputError("the material of a rod is none");
  if (!(o.step_s > 0) || !(o.mass_damping_per_s >= 0) || o.most_iterations < 1 || !o.gravity_m_s2.allFinite())
    throw InputError("the options of a rod's step are none");
}

}  // namespace

RodOptions rod_options(const TissueSolid& tissue, double outer_radius_m, double wall_m) {
  RodOptions options;
  options.outer_radius_m = outer_radius_m;
  options.wall_m = wall_m;
  options.young_pa = tissue.young_pa;
  options.poisson = tissue.poisson;
  options.density_kg_m3 = tissue.density_kg_m3;
  options.stiffening = tissue.stiffening;
  options.prony = tissue.prony;
  options.avulsion_n = tissue.rupture_n_per_m * 2 * std::numbers::pi * outer_radius_m;
  return options;
}

std::vector<Vec3> evenly_spaced(std::span<const Vec3> path, double spacing_m) {
  assert(path.size() >= 2 && spacing_m > 0);
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  const auto pieces = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length / spacing_m)));
  std::vector<Vec3> points{path.front()};
  double passed = 0;
  std::size_t i = 1;
  for (std::size_t p = 1; p < pieces; ++p) {
    const double wanted = length * static_cast<double>(p) / static_cast<double>(pieces);
    while (i + 1 < path.size() && passed + (path[i] - path[i - 1]).norm() < wanted)
      passed += (path[i] - path[i - 1]).norm(), ++i;
    const Vec3 edge = path[i] - path[i - 1];
    points.push_back(path[i - 1] + (wanted - passed) / edge.norm() * edge);
  }
  points.push_back(path.back());
  return points;
}

ElasticRod::ElasticRod(std::span<const Vec3> path, const RodOptions& options) : options_(options) {
  check_rod(path, options);
  double shares = 0;
  for (const PronyBranch& branch : options_.prony) shares += branch.share;
  for (std::size_t b = 0; b < 2; ++b) {
    const PronyBranch& branch = options_.prony[b];
    branches_.gain[b] = branch.share / (1 - shares);
    branches_.keep[b] = branch.share > 0 ? branch.tau_s / (branch.tau_s + options_.step_s) : 0;
  }
  double arc = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) arc += (path[i] - path[i - 1]).norm();
    nodes_.push_back({.id = next_id_++, .arc_m = arc, .position = path[i], .drawn = path[i]});
  }
  SegmentFrame frame;
  const Vec3 first = (path[1] - path[0]).normalized();
  frame.t = first;
  frame.d1 = first.unitOrthogonal();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    frame = frame_along(path[i + 1] - path[i], frame, 0);
    RodSegment segment;
    segment.arc_from_m = nodes_[i].arc_m;
    segment.arc_to_m = nodes_[i + 1].arc_m;
    segment.rest_m = frame.length_m / (1 + options_.pre_strain);
    segment.frame = frame;
    segments_.push_back(segment);
  }
  memory_.assign(segments_.size(), {{}, options_.pre_strain, 0});
  spin_.assign(segments_.size(), 0);
  hung_[0].drawn = segments_.front().frame;
  hung_[1].drawn = segments_.back().frame;
  for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) {
    Bend bend;
    bend.node = i;
    bend.rest = bend.last = bend_strain(segments_[i - 1].frame, segments_[i].frame, 0);
    bends_.push_back(bend);
  }
  renew();
}

double ElasticRod::axial_stiffness() const {
  const double out = options_.outer_radius_m, in = options_.inner_radius_m();
  return options_.young_pa * std::numbers::pi * (out * out - in * in);
}

double ElasticRod::bend_stiffness() const {
  const double out = options_.outer_radius_m, in = options_.inner_radius_m();
  return options_.young_pa * std::numbers::pi / 4 * (std::pow(out, 4) - std::pow(in, 4));
}

double ElasticRod::twist_stiffness() const { return bend_stiffness() / (1 + options_.poisson); }

double ElasticRod::segment_mass(std::size_t segment) const {
  if (!segments_[segment].whole) return 0;
  const double out = options_.outer_radius_m, in = options_.inner_radius_m();
  const double per_length =
      std::numbers::pi * (options_.density_kg_m3 * (out * out - in * in) + options_.content_kg_m3 * in * in);
  return per_length * segments_[segment].rest_m;
}

void ElasticRod::renew_masses() {
  for (RodNode& node : nodes_) node.mass_kg = 0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    nodes_[i].mass_kg += segment_mass(i) / 2;
    nodes_[i + 1].mass_kg += segment_mass(i) / 2;
  }
  for (const Splint& splint : splints_) {
    const auto [segment, share] = spread((splint.from_m + splint.to_m) / 2);
    nodes_[segment].mass_kg += (1 - share) * splint.mass_kg;
    nodes_[segment + 1].mass_kg += share * splint.mass_kg;
  }
}

void ElasticRod::renew_bends() {
  std::vector<Bend> bends;
  const auto add = [&](std::size_t node, bool from_anchor, bool to_anchor) {
    const auto same = std::find_if(bends_.begin(), bends_.end(), [&](const Bend& b) {
      return b.node == node && b.from_anchor == from_anchor && b.to_anchor == to_anchor;
    });
    Bend bend = same != bends_.end() ? *same : Bend{};
    bend.node = node;
    bend.from_anchor = from_anchor;
    bend.to_anchor = to_anchor;
    const double before = from_anchor ? 0 : segments_[node - 1].rest_m, behind = to_anchor ? 0 : segments_[node].rest_m;
    const double arc = nodes_[node].arc_m;
    double factor = 1;
    for (const Splint& splint : splints_)
      if (arc >= splint.from_m && arc <= splint.to_m) factor = kSplintedBend;
    const double over = factor * 2 / (before + behind);
    bend.stiffness = {over * bend_stiffness(), over * bend_stiffness(), over * twist_stiffness()};
    bends.push_back(bend);
  };
  if (hung_[0].on && hung_[0].to.clamped && segments_.front().whole) add(0, true, false);
  for (std::size_t i = 1; i + 1 < nodes_.size(); ++i)
    if (segments_[i - 1].whole && segments_[i].whole) add(i, false, false);
  if (hung_[1].on && hung_[1].to.clamped && segments_.back().whole) add(nodes_.size() - 1, false, true);
  bends_ = std::move(bends);
}

void ElasticRod::renew() {
  renew_masses();
  renew_bends();
  parts_.clear();
  std::size_t first = 0;
  for (std::size_t i = 0; i <= segments_.size(); ++i)
    if (i == segments_.size() || !segments_[i].whole) {
      parts_.push_back({first, i, first == 0 && hung_[0].on, i == segments_.size() && hung_[1].on});
      first = i + 1;
    }
  factored_ = false;
}

void ElasticRod::anchor(RodEnd end, const RodAnchor& to) {
  Hung& at = hung(end);
  if (at.off_for_good || !to.position.allFinite() || !to.velocity.allFinite() || !to.rotation.allFinite() ||
      !(to.stiffness_n_per_m >= 0) || !std::isfinite(to.stiffness_n_per_m))
    return;
  const bool changed = !at.on || at.to.clamped != to.clamped;
  at.to = to;
  at.on = true;
  if (changed) renew();
}

void ElasticRod::let_go(RodEnd end) {
  Hung& at = hung(end);
  at.force = at.moment = Vec3::Zero();
  at.over_s = 0;
  if (!at.on) return;
  at.on = false;
  renew();
}

SegmentFrame ElasticRod::anchor_frame(RodEnd end) const {
  SegmentFrame frame = hung(end).drawn;
  frame.t = hung(end).to.rotation * frame.t;
  frame.d1 = hung(end).to.rotation * frame.d1;
  frame.d2 = hung(end).to.rotation * frame.d2;
  return frame;
}

Vec3 ElasticRod::anchor_target(RodEnd end) const {
  const RodAnchor& to = hung(end).to;
  return statics_ ? to.position : Vec3(to.position + options_.step_s * to.velocity);
}

void ElasticRod::hold(double from_m, double to_m, double stiffness_n_per_m) {
  for (RodNode& node : nodes_)
    if (node.arc_m >= from_m && node.arc_m <= to_m) node.hold_n_per_m += stiffness_n_per_m;
}

void ElasticRod::free(double from_m, double to_m) {
  for (RodNode& node : nodes_)
    if (node.arc_m >= from_m && node.arc_m <= to_m) node.hold_n_per_m = 0;
}

int ElasticRod::splint(double from_m, double to_m, double mass_kg) {
  splints_.push_back({next_splint_, from_m, to_m, mass_kg});
  renew();
  return next_splint_++;
}

void ElasticRod::take_splint(int number) {
  std::erase_if(splints_, [number](const Splint& splint) { return splint.number == number; });
  renew();
}

std::size_t ElasticRod::segment_at(double arc_m) const {
  const auto behind = std::upper_bound(segments_.begin(), segments_.end(), arc_m,
                                       [](double arc, const RodSegment& segment) { return arc < segment.arc_to_m; });
  const auto at = behind == segments_.end() ? segments_.end() - 1 : behind;
  return static_cast<std::size_t>(at - segments_.begin());
}

std::pair<std::size_t, double> ElasticRod::spread(double arc_m) const {
  const std::size_t at = segment_at(arc_m);
  const RodSegment& segment = segments_[at];
  return {at, std::clamp((arc_m - segment.arc_from_m) / (segment.arc_to_m - segment.arc_from_m), 0.0, 1.0)};
}

Vec3 ElasticRod::place_at(double arc_m) const {
  const auto [at, share] = spread(arc_m);
  return (1 - share) * nodes_[at].position + share * nodes_[at + 1].position;
}

Vec3 ElasticRod::velocity_at(double arc_m) const {
  const auto [at, share] = spread(arc_m);
  return (1 - share) * nodes_[at].velocity + share * nodes_[at + 1].velocity;
}

Mat3 ElasticRod::frame_at(double arc_m) const {
  const SegmentFrame& frame = segments_[segment_at(arc_m)].frame;
  Mat3 R;
  R << frame.d1, frame.d2, frame.t;
  return R;
}

double ElasticRod::axial_force(std::size_t segment, double strain) const {
  double law = stretch_law(strain, options_.stiffening, options_.most_stiffening);
  const Memory& memory = memory_[segment];
  for (std::size_t b = 0; b < 2; ++b) law += kept(b) * (memory.branch[b] + branches_.gain[b] * (strain - memory.last));
  return axial_stiffness() * law;
}

BendStrain ElasticRod::bend_stress(const Bend& bend, const BendStrain& strain) const {
  BendStrain answer = strain - bend.rest;
  for (std::size_t b = 0; b < 2; ++b) answer += kept(b) * (bend.branch[b] + branches_.gain[b] * (strain - bend.last));
  return bend.stiffness.cwiseProduct(answer);
}

std::pair<SegmentFrame, SegmentFrame> ElasticRod::sides(const Bend& bend, const Trial& trial) const {
  const auto side = [&](std::size_t segment) { return not_too_short(trial.frame[segment], segments_[segment].rest_m); };
  return {bend.from_anchor ? anchor_frame(RodEnd::kStart) : side(bend.node - 1),
          bend.to_anchor ? anchor_frame(RodEnd::kFinish) : side(bend.node)};
}

double ElasticRod::inertia_scale() const {
  const double h = options_.step_s;
  return (statics_ ? kStaticInertia : 1 + h * options_.mass_damping_per_s) / (h * h);
}

double ElasticRod::spring_stretch(const RodSpring& spring, const Trial& trial) const {
  const auto [at, share] = spread(spring.arc_m);
  const Vec3 moved =
      (1 - share) * (trial.place[at] - nodes_[at].position) + share * (trial.place[at + 1] - nodes_[at + 1].position);
  return spring.stretch_m + spring.direction.dot(moved);
}

double ElasticRod::inertia_objective(const Trial& trial) const {
  double sum = 0;
  const double scale = inertia_scale(), speed = statics_ ? 0 : 1 / options_.step_s;
  const double round = options_.outer_radius_m * options_.outer_radius_m;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const RodNode& node = nodes_[i];
    const Vec3 way = trial.place[i] - node.position;
    sum += node.mass_kg * (0.5 * scale * way.squaredNorm() - way.dot(speed * node.velocity + options_.gravity_m_s2)) +
           0.5 * node.hold_n_per_m * (trial.place[i] - node.drawn).squaredNorm();
  }
  for (std::size_t i = 0; i < segments_.size(); ++i)
    sum += segment_mass(i) * round * trial.turn[i] * (0.5 * scale * trial.turn[i] - speed * spin_[i]);
  return sum;
}

double ElasticRod::spring_objective(std::span<const RodSpring> springs, const Trial& trial) const {
  double sum = 0;
  for (const RodSpring& spring : springs) {
    if (!acts(spring)) continue;
    const double stretch = spring_stretch(spring, trial);
    if (!spring.pushes_only || stretch > 0) sum += 0.5 * spring.stiffness_n_per_m * stretch * stretch;
  }
  for (const RodEnd end : {RodEnd::kStart, RodEnd::kFinish})
    if (hung(end).on)
      sum += 0.5 * hung(end).to.stiffness_n_per_m * (trial.place[end_node(end)] - anchor_target(end)).squaredNorm();
  return sum;
}

void ElasticRod::evaluate(std::span<const RodSpring> springs, Trial& trial) const {
  trial.frame.resize(segments_.size());
  trial.bend.resize(bends_.size());
  double sum = inertia_objective(trial) + spring_objective(springs, trial);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const RodSegment& segment = segments_[i];
    if (!segment.whole) continue;
    trial.frame[i] = frame_along(trial.place[i + 1] - trial.place[i], segment.frame, trial.turn[i]);
    const double strain = trial.frame[i].length_m / segment.rest_m - 1;
    double energy = stretch_energy(strain, options_.stiffening, options_.most_stiffening);
    for (std::size_t b = 0; b < 2; ++b)
      if (const double gain = branches_.gain[b]; gain > 0) {
        const double held = memory_[i].branch[b] + gain * (strain - memory_[i].last);
        energy += 0.5 * kept(b) / gain * held * held;
      }
    sum += axial_stiffness() * segment.rest_m * energy;
  }
  for (std::size_t b = 0; b < bends_.size(); ++b) {
    const Bend& bend = bends_[b];
    const auto [before, behind] = sides(bend, trial);
    const BendStrain strain = bend_strain(before, behind, bend.last[2]);
    trial.bend[b] = strain;
    BendStrain energy = 0.5 * (strain - bend.rest).cwiseAbs2();
    for (std::size_t k = 0; k < 2; ++k)
      if (const double gain = branches_.gain[k]; gain > 0)
        energy += 0.5 * kept(k) / gain * (bend.branch[k] + gain * (strain - bend.last)).cwiseAbs2();
    sum += bend.stiffness.dot(energy);
  }
  trial.objective = sum;
}

void ElasticRod::add_inertia(const Trial& trial) {
  const double scale = inertia_scale(), speed = statics_ ? 0 : 1 / options_.step_s;
  const double round = options_.outer_radius_m * options_.outer_radius_m;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const RodNode& node = nodes_[i];
    const Vec3 force =
        node.mass_kg * (speed * node.velocity + options_.gravity_m_s2 - scale * (trial.place[i] - node.position)) -
        node.hold_n_per_m * (trial.place[i] - node.drawn);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t row = kUnknowns * i + c;
      right_[row] += force[static_cast<Eigen::Index>(c)];
      matrix_.at(row, row) += node.mass_kg * scale + node.hold_n_per_m;
    }
    const std::size_t turn = kUnknowns * i + 3;
    const double inertia = i < segments_.size() ? segment_mass(i) * round : 0;
    if (inertia > 0) {
      matrix_.at(turn, turn) += inertia * scale;
      right_[turn] += inertia * (speed * spin_[i] - scale * trial.turn[i]);
    } else {
      matrix_.at(turn, turn) = 1;  // a gap and the last node have no segment behind them
    }
  }
}

void ElasticRod::add_stretch(const Trial& trial) {
  double of_branches = 0;
  for (std::size_t b = 0; b < 2; ++b) of_branches += kept(b) * branches_.gain[b];
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (!segments_[i].whole) continue;
    const SegmentFrame& frame = trial.frame[i];
    const double strain = frame.length_m / segments_[i].rest_m - 1, force = axial_force(i, strain);
    const double slope =
        axial_stiffness() * (stretch_slope(strain, options_.stiffening, options_.most_stiffening) + of_branches);
    // What is pulled resists being turned; what is pushed would give way: left out, the matrix stays positive.
    const double across = std::max(force, 0.0) / std::max(frame.length_m, kShortestOfRest * segments_[i].rest_m);
    const Mat3 along = frame.t * frame.t.transpose();
    const Mat3 K = slope / segments_[i].rest_m * along + across * (Mat3::Identity() - along);
    const std::size_t a = kUnknowns * i, b = a + kUnknowns;
    for (std::size_t r = 0; r < 3; ++r) {
      const auto er = static_cast<Eigen::Index>(r);
      right_[a + r] += force * frame.t[er];
      right_[b + r] -= force * frame.t[er];
      for (std::size_t c = 0; c < 3; ++c) {
        const double k = K(er, static_cast<Eigen::Index>(c));
        if (c <= r) {
          matrix_.at(a + r, a + c) += k;
          matrix_.at(b + r, b + c) += k;
        }
        matrix_.at(b + r, a + c) -= k;
      }
    }
  }
}

void ElasticRod::add_bends(const Trial& trial) {
  constexpr std::size_t kLocal = 2 * kUnknowns + 3;  // place, turn; place, turn; place
  Vec3 scale = Vec3::Ones();
  for (std::size_t b = 0; b < 2; ++b) scale += kept(b) * branches_.gain[b] * Vec3::Ones();
  for (std::size_t i = 0; i < bends_.size(); ++i) {
    const Bend& bend = bends_[i];
    const auto [before, behind] = sides(bend, trial);
    const BendGradient gradient = bend_gradient(before, behind, trial.bend[i]);
    const BendStrain stress = bend_stress(bend, trial.bend[i]);
    const Vec3 stiffness = bend.stiffness.cwiseProduct(scale);
    Eigen::Matrix<double, 3, kLocal> rows = Eigen::Matrix<double, 3, kLocal>::Zero();
    if (!bend.from_anchor) {
      rows.middleCols<3>(0) = -gradient.by_a;
      rows.col(3) = gradient.by_turn_a;
      rows.middleCols<3>(4) += gradient.by_a;
    }
    if (!bend.to_anchor) {
      rows.middleCols<3>(4) -= gradient.by_b;
      rows.col(7) = gradient.by_turn_b;
      rows.middleCols<3>(8) = gradient.by_b;
    }
    const std::size_t from = bend.from_anchor ? kUnknowns : 0, to = bend.to_anchor ? kUnknowns + 3 : kLocal;
    const std::size_t global = kUnknowns * bend.node;  // of local row kUnknowns
    for (std::size_t r = from; r < to; ++r) {
      const Vec3 weighted = stiffness.cwiseProduct(rows.col(static_cast<Eigen::Index>(r)));
      const std::size_t row = global + r - kUnknowns;
      right_[row] -= stress.dot(rows.col(static_cast<Eigen::Index>(r)));
      for (std::size_t c = from; c <= r; ++c)
        matrix_.at(row, global + c - kUnknowns) += weighted.dot(rows.col(static_cast<Eigen::Index>(c)));
    }
  }
}

void ElasticRod::add_anchors(const Trial& trial) {
  for (const RodEnd end : {RodEnd::kStart, RodEnd::kFinish}) {
    if (!hung(end).on) continue;
    const std::size_t node = end_node(end);
    const double k = hung(end).to.stiffness_n_per_m;
    const Vec3 force = k * (anchor_target(end) - trial.place[node]);
    for (std::size_t c = 0; c < 3; ++c) {
      right_[kUnknowns * node + c] += force[static_cast<Eigen::Index>(c)];
      matrix_.at(kUnknowns * node + c, kUnknowns * node + c) += k;
    }
  }
}

void ElasticRod::add_springs(std::span<const RodSpring> springs, const Trial& trial) {
  for (const RodSpring& spring : springs) {
    if (!acts(spring)) continue;
    const double stretch = spring_stretch(spring, trial);
    if (spring.pushes_only && stretch <= 0) continue;
    const auto [at, share] = spread(spring.arc_m);
    const std::array<double, 2> part{1 - share, share};
    for (std::size_t n = 0; n < 2; ++n)
      for (std::size_t r = 0; r < 3; ++r) {
        const double row = part[n] * spring.direction[static_cast<Eigen::Index>(r)];
        const std::size_t global = kUnknowns * (at + n) + r;
        right_[global] -= spring.stiffness_n_per_m * stretch * row;
        for (std::size_t m = 0; m <= n; ++m)
          for (std::size_t c = 0; c < (m == n ? r + 1 : 3); ++c)
            matrix_.at(global, kUnknowns * (at + m) + c) +=
                spring.stiffness_n_per_m * row * part[m] * spring.direction[static_cast<Eigen::Index>(c)];
      }
  }
}

void ElasticRod::assemble(std::span<const RodSpring> springs, const Trial& trial) {
  matrix_.reset(kUnknowns * nodes_.size());
  right_.assign(kUnknowns * nodes_.size(), 0);
  add_inertia(trial);
  add_stretch(trial);
  add_bends(trial);
  add_anchors(trial);
  add_springs(springs, trial);
}

void ElasticRod::go(std::span<const RodSpring> springs, const std::vector<double>& way, double share) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = static_cast<Eigen::Index>(c);
      next_.place[i][at] = now_.place[i][at] + share * way[kUnknowns * i + c];
    }
    if (i < segments_.size()) next_.turn[i] = now_.turn[i] + share * way[kUnknowns * i + 3];
  }
  evaluate(springs, next_);
}

bool ElasticRod::search_line(std::span<const RodSpring> springs, const std::vector<double>& way, double slope) {
  double share = 1;
  for (int halving = 0; halving <= kMostHalvings; ++halving, share /= 2) {
    go(springs, way, share);
    if (next_.objective > now_.objective - kSufficientDescent * share * slope) continue;
    std::swap(now_, next_);
    return true;
  }
  return false;
}

void ElasticRod::step(std::span<RodSpring> springs) {
  events_.clear();
  now_.place.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) now_.place[i] = nodes_[i].position;
  now_.turn.assign(segments_.size(), 0);
  next_ = now_;
  evaluate(springs, now_);
  if (!std::isfinite(now_.objective)) return stand_still(springs);
  for (iterations_ = 0; iterations_ < options_.most_iterations;) {
    assemble(springs, now_);
    std::vector<double>& way = right_;
    const std::vector<double> downhill = right_;
    factored_ = matrix_.factor();
    if (!factored_) return stand_still(springs);
    matrix_.solve(way);
    ++iterations_;
    double slope = 0, largest = 0;
    for (std::size_t i = 0; i < way.size(); ++i) {
      slope += downhill[i] * way[i];
      largest = std::max(largest, std::abs(way[i]) * (i % kUnknowns == 3 ? options_.outer_radius_m : 1));
    }
    if (!std::isfinite(slope)) return stand_still(springs);
    if (largest < options_.tolerance_m) {
      go(springs, way, 1);
      std::swap(now_, next_);
      break;
    }
    if (!search_line(springs, way, slope)) break;
  }
  accept(springs);
  feel_anchors();
  give_way();
}

void ElasticRod::accept(std::span<RodSpring> springs) {
  for (RodSpring& spring : springs) {
    spring.force_n = 0;
    if (!acts(spring)) continue;
    const double stretch = spring_stretch(spring, now_);
    if (!spring.pushes_only || stretch > 0) spring.force_n = spring.stiffness_n_per_m * stretch;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec3 velocity = statics_ ? Vec3::Zero() : Vec3((now_.place[i] - nodes_[i].position) / options_.step_s);
    if (const double speed = velocity.norm(); speed > options_.most_speed_m_s)
      velocity *= options_.most_speed_m_s / speed;
    nodes_[i].velocity = velocity;
    nodes_[i].position = now_.place[i];
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    RodSegment& segment = segments_[i];
    if (!segment.whole) continue;
    const double strain = now_.frame[i].length_m / segment.rest_m - 1;
    segment.tension_n = axial_force(i, strain);
    for (std::size_t b = 0; b < 2; ++b)
      memory_[i].branch[b] = kept(b) * (memory_[i].branch[b] + branches_.gain[b] * (strain - memory_[i].last));
    memory_[i].last = strain;
    spin_[i] = statics_ ? 0 : now_.turn[i] / options_.step_s;
    segment.frame = now_.frame[i];
  }
  for (std::size_t b = 0; b < bends_.size(); ++b) {
    Bend& bend = bends_[b];
    for (std::size_t k = 0; k < 2; ++k)
      bend.branch[k] = kept(k) * (bend.branch[k] + branches_.gain[k] * (now_.bend[b] - bend.last));
    bend.last = now_.bend[b];
  }
}

void ElasticRod::stand_still(std::span<RodSpring> springs) {
  ++held_steps_;
  factored_ = false;
  for (RodSpring& spring : springs) spring.force_n = 0;
  for (RodNode& node : nodes_) node.velocity = Vec3::Zero();
  std::fill(spin_.begin(), spin_.end(), 0.0);
}

void ElasticRod::feel_anchors() {
  for (const RodEnd end : {RodEnd::kStart, RodEnd::kFinish}) {
    Hung& at = hung(end);
    if (at.on) at.force = at.to.stiffness_n_per_m * (nodes_[end_node(end)].position - anchor_target(end));
    at.moment = Vec3::Zero();
  }
  // A bend does not care how both sides turn together: what it does on the anchor is the opposite of what on the rod.
  for (const Bend& bend : bends_) {
    if (!bend.from_anchor && !bend.to_anchor) continue;
    const BendStrain branchless = bend.last - bend.rest + bend.branch[0] + bend.branch[1];
    const BendStrain stress = bend.stiffness.cwiseProduct(branchless);
    const auto [before, behind] = sides(bend, now_);
    const BendGradient gradient = bend_gradient(before, behind, bend.last);
    const SegmentFrame& side = bend.from_anchor ? behind : before;
    const Mat3& by_edge = bend.from_anchor ? gradient.by_b : gradient.by_a;
    const Vec3& by_turn = bend.from_anchor ? gradient.by_turn_b : gradient.by_turn_a;
    const Vec3 on_edge = -by_edge.transpose() * stress;
    hung(bend.from_anchor ? RodEnd::kStart : RodEnd::kFinish).moment =
        -(side.length_m * side.t.cross(on_edge) - by_turn.dot(stress) * side.t);
  }
}

void ElasticRod::give_way() {
  if (statics_) return;
  for (const RodEnd end : {RodEnd::kStart, RodEnd::kFinish}) {
    Hung& at = hung(end);
    const double pull = at.force.norm();
    at.over_s = at.on && pull > options_.avulsion_n ? at.over_s + options_.step_s : 0;
    if (at.over_s < options_.overload_s) continue;
    events_.push_back({RodEvent::Kind::kAvulsed, nodes_[end_node(end)].arc_m, pull});
    let_go(end);
    at.off_for_good = true;
  }
  const double most = options_.avulsion_n * options_.tear_over_avulsion;
  std::size_t worst = segments_.size();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const bool over = segments_[i].whole && segments_[i].tension_n > most;
    memory_[i].over_s = over ? memory_[i].over_s + options_.step_s : 0;
    if (memory_[i].over_s < options_.overload_s) continue;
    if (worst == segments_.size() || segments_[i].tension_n > segments_[worst].tension_n) worst = i;
  }
  if (worst == segments_.size()) return;
  const double pull = segments_[worst].tension_n;
  if (const auto arc = sever((segments_[worst].arc_from_m + segments_[worst].arc_to_m) / 2))
    events_.push_back({RodEvent::Kind::kTorn, *arc, pull});
}

int ElasticRod::settle(std::span<RodSpring> springs, double still_m, int most_steps) {
  statics_ = true;
  const std::vector<RodSpring> given(springs.begin(), springs.end());
  std::vector<Vec3> from;
  for (const RodNode& node : nodes_) from.push_back(node.position);
  int steps = 0;
  for (double largest = 1; steps < most_steps && largest > still_m; ++steps) {
    std::vector<Vec3> before;
    for (const RodNode& node : nodes_) before.push_back(node.position);
    // The springs' stretch is that of now.
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const auto [at, share] = spread(given[s].arc_m);
      springs[s].stretch_m = given[s].stretch_m + given[s].direction.dot((1 - share) * (before[at] - from[at]) +
                                                                         share * (before[at + 1] - from[at + 1]));
    }
    step(springs);
    largest = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      largest = std::max(largest, (nodes_[i].position - before[i]).norm());
  }
  statics_ = false;
  return steps;
}

std::optional<double> ElasticRod::sever(double arc_m) {
  if (!std::isfinite(arc_m)) return std::nullopt;
  const std::size_t at = segment_at(arc_m);
  const RodSegment whole = segments_[at];
  const double least = options_.least_segment_m / whole.rest_m;
  if (!whole.whole || least > 0.5) return std::nullopt;
  const double share = std::clamp((arc_m - whole.arc_from_m) / (whole.arc_to_m - whole.arc_from_m), least, 1 - least);
  const auto between = [share](const Vec3& from, const Vec3& to) { return Vec3((1 - share) * from + share * to); };
  RodNode node;
  node.arc_m = (1 - share) * whole.arc_from_m + share * whole.arc_to_m;
  node.position = between(nodes_[at].position, nodes_[at + 1].position);
  node.velocity = between(nodes_[at].velocity, nodes_[at + 1].velocity);
  node.drawn = between(nodes_[at].drawn, nodes_[at + 1].drawn);
  RodSegment before = whole, gap = whole, behind = whole;
  before.arc_to_m = gap.arc_from_m = gap.arc_to_m = behind.arc_from_m = node.arc_m;
  before.rest_m *= share;
  behind.rest_m *= 1 - share;
  before.frame.length_m *= share;
  behind.frame.length_m *= 1 - share;
  gap.whole = false;
  gap.tension_n = 0;
  for (const int side : {0, 1}) {
    node.id = next_id_ + 1 - side;  // the second one goes in first
    nodes_.insert(nodes_.begin() + static_cast<std::ptrdiff_t>(at) + 1, node);
  }
  next_id_ += 2;
  const auto place = static_cast<std::ptrdiff_t>(at);
  segments_[at] = before;
  segments_.insert(segments_.begin() + place + 1, {gap, behind});
  memory_.insert(memory_.begin() + place + 1, {Memory{}, memory_[at]});
  spin_.insert(spin_.begin() + place + 1, {0.0, spin_[at]});
  for (Bend& bend : bends_)
    if (bend.node > at) bend.node += 2;
  ++topology_;
  renew();
  return node.arc_m;
}

Mat3 ElasticRod::anchor_stiffness(RodEnd end) const {
  if (!hung(end).on) return Mat3::Zero();
  const double k = hung(end).to.stiffness_n_per_m;
  Mat3 stiffness = k * Mat3::Identity();
  if (!factored_) return stiffness;
  const std::size_t first = kUnknowns * end_node(end);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> unit(matrix_.size(), 0);
    unit[first + c] = 1;
    matrix_.solve(unit);
    for (std::size_t r = 0; r < 3; ++r)
      stiffness(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) -= k * k * unit[first + r];
  }
  return 0.5 * (stiffness + stiffness.transpose());
}

double ElasticRod::compliance(double arc_m, const Vec3& direction) const {
  if (!factored_) return 0;
  const auto [at, share] = spread(arc_m);
  std::vector<double> unit(matrix_.size(), 0);
  for (std::size_t c = 0; c < 3; ++c) {
    unit[kUnknowns * at + c] = (1 - share) * direction[static_cast<Eigen::Index>(c)];
    unit[kUnknowns * (at + 1) + c] = share * direction[static_cast<Eigen::Index>(c)];
  }
  const std::vector<double> row = unit;
  matrix_.solve(unit);
  double sum = 0;
  for (std::size_t i = 0; i < row.size(); ++i) sum += row[i] * unit[i];
  return sum;
}

void ElasticRod::place(std::span<const Vec3> position) {
  assert(position.size() == nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (position[i].allFinite()) nodes_[i].position = position[i];
    nodes_[i].velocity = Vec3::Zero();
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    RodSegment& segment = segments_[i];
    if (!segment.whole) continue;
    segment.frame = frame_along(nodes_[i + 1].position - nodes_[i].position, segment.frame, 0);
    memory_[i] = {{}, segment.frame.length_m / segment.rest_m - 1, 0};
  }
  std::fill(spin_.begin(), spin_.end(), 0.0);
  now_.frame.resize(segments_.size());
  for (std::size_t i = 0; i < segments_.size(); ++i) now_.frame[i] = segments_[i].frame;
  for (Bend& bend : bends_) {
    const auto [before, behind] = sides(bend, now_);
    bend.last = bend_strain(before, behind, bend.last[2]);
    bend.branch = {BendStrain::Zero(), BendStrain::Zero()};
  }
  factored_ = false;
}

double ElasticRod::energy_j() const {
  double sum = 0;
  const double round = options_.outer_radius_m * options_.outer_radius_m;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (!segments_[i].whole) continue;
    double energy = stretch_energy(memory_[i].last, options_.stiffening, options_.most_stiffening);
    for (std::size_t b = 0; b < 2; ++b)
      if (branches_.gain[b] > 0) energy += 0.5 * memory_[i].branch[b] * memory_[i].branch[b] / branches_.gain[b];
    sum += axial_stiffness() * segments_[i].rest_m * energy + 0.5 * segment_mass(i) * round * spin_[i] * spin_[i];
  }
  for (const Bend& bend : bends_) {
    BendStrain energy = 0.5 * (bend.last - bend.rest).cwiseAbs2();
    for (std::size_t k = 0; k < 2; ++k)
      if (branches_.gain[k] > 0) energy += 0.5 * bend.branch[k].cwiseAbs2() / branches_.gain[k];
    sum += bend.stiffness.dot(energy);
  }
  for (const RodNode& node : nodes_)
    sum += 0.5 * node.mass_kg * node.velocity.squaredNorm() +
           0.5 * node.hold_n_per_m * (node.position - node.drawn).squaredNorm();
  for (const Hung& at : hung_)
    if (at.on && at.to.stiffness_n_per_m > 0) sum += 0.5 * at.force.squaredNorm() / at.to.stiffness_n_per_m;
  return sum;
}

Vec3 ElasticRod::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const RodNode& node : nodes_) sum += node.mass_kg * node.velocity;
  return sum;
}

double ElasticRod::mass_kg() const {
  double sum = 0;
  for (const RodNode& node : nodes_) sum += node.mass_kg;
  return sum;
}

}  // namespace trocar
