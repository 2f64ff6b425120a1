#include "tissue/thin/elastic_sheet.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kStillInertia = 1e-5;  // of the inertia, left so that a free sheet has an answer
constexpr double kDescent = 1e-4;       // Armijo
constexpr int kHalvings = 12;
constexpr double kNoArea = 1e-18;  // m4: square of twice the area of a triangle without one
constexpr double kAcross = 4;      // how much longer a way of edges counts at `reach_m` from the line
constexpr double kSlit = 0.3;      // cosine beyond which an edge goes on in a tear's direction

SheetEdge edge_of(std::int32_t a, std::int32_t b) { return a < b ? SheetEdge{a, b} : SheetEdge{b, a}; }

std::size_t number(std::int32_t node) { return static_cast<std::size_t>(node); }

bool acts(const SheetSpring& spring, std::size_t triangles) {
  return spring.place.triangle >= 0 && number(spring.place.triangle) < triangles && spring.direction.allFinite() &&
         std::isfinite(spring.stiffness_n_per_m) && spring.stiffness_n_per_m >= 0 && std::isfinite(spring.stretch_m) &&
         std::all_of(spring.place.weight.begin(), spring.place.weight.end(), [](double w) { return std::isfinite(w); });
}

/// Turn between the two sides of a hinge, rad, and how it changes with its nodes (Bridson, Marino and Fedkiw 2003).
double fold(const std::array<Vec3, 4>& at, std::array<Vec3, 4>* gradient) {
  const Vec3 edge = at[1] - at[0];
  const Vec3 n1 = (at[2] - at[0]).cross(at[2] - at[1]), n2 = (at[3] - at[1]).cross(at[3] - at[0]);
  const double length = std::max(edge.norm(), 1e-12);
  if (gradient != nullptr) {
    const Vec3 along = edge / length;
    const Vec3 by1 = n1 / std::max(n1.squaredNorm(), kNoArea), by2 = n2 / std::max(n2.squaredNorm(), kNoArea);
    (*gradient)[2] = length * by1;
    (*gradient)[3] = length * by2;
    (*gradient)[0] = (at[2] - at[1]).dot(along) * by1 + (at[3] - at[1]).dot(along) * by2;
    (*gradient)[1] = -(at[2] - at[0]).dot(along) * by1 - (at[3] - at[0]).dot(along) * by2;
  }
  return -std::atan2(n1.cross(n2).dot(edge) / length, n1.dot(n2));
}

/// The turn nearest to one of before.
double unwound(double turn, double before) {
  return turn - 2 * std::numbers::pi * std::round((turn - before) / (2 * std::numbers::pi));
}

Eigen::Matrix2d green(const Eigen::Matrix<double, 3, 2>& F) {
  return 0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity());
}

/// The law of stretch, N/m.
struct Plane {
  explicit Plane(const SheetOptions& o)
      : shear(o.young_pa * o.thickness_m / (1 + o.poisson)),
        bulk(o.young_pa * o.thickness_m * o.poisson / (1 - o.poisson * o.poisson)) {}
  Eigen::Matrix2d tension(const Eigen::Matrix2d& strain) const {
    return shear * strain + bulk * strain.trace() * Eigen::Matrix2d::Identity();
  }
  double shear, bulk;
};

Eigen::Matrix2d pulling_part(const Eigen::Matrix2d& tension) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(tension);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).asDiagonal() * axes.eigenvectors().transpose();
}

double distance_to(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double share = way.squaredNorm() > 0 ? std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
  return (p - from - share * way).norm();
}

void check(const TriangleSurface& drawn, const SheetOptions& o) {
  if (drawn.triangles.empty()) throw InputError("a sheet needs triangles");
  for (const Vec3& vertex : drawn.vertices)
    if (!vertex.allFinite()) throw InputError("a point of a sheet is not finite");
  std::map<std::array<std::int32_t, 2>, int> uses;  // directed
  std::vector<char> used(drawn.vertices.size(), 0);
  for (const auto& corner : drawn.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (corner[i] < 0 || number(corner[i]) >= drawn.vertices.size()) throw InputError("a sheet's corner is none");
      used[number(corner[i])] = 1;
      if (++uses[{corner[i], corner[(i + 1) % 3]}] > 1) throw InputError("a sheet is not manifold");
    }
    const Vec3 &a = drawn.vertices[number(corner[0])], &b = drawn.vertices[number(corner[1])],
               &c = drawn.vertices[number(corner[2])];
    if (!((b - a).cross(c - a).squaredNorm() > kNoArea)) throw InputError("a triangle of a sheet has no area");
  }
  if (std::find(used.begin(), used.end(), 0) != used.end())
    throw InputError("a point of a sheet belongs to no triangle");
  const bool stuff = o.thickness_m > 0 && o.young_pa > 0 && o.poisson > -1 && o.poisson < 0.5 && o.density_kg_m3 > 0;
  const bool step = o.step_s > 0 && o.mass_damping_per_s >= 0 && o.bend_damping_s >= 0 && o.most_iterations >= 1 &&
                    o.tear_n_per_m > 0 && o.gravity_m_s2.allFinite();
  if (!stuff || !step) throw InputError("the options of a sheet are none");
}

}  // namespace

double SheetOptions::bending_j() const { return young_pa * std::pow(thickness_m, 3) / (12 * (1 - poisson * poisson)); }

SheetOptions sheet_options(const TissueSolid& tissue, double thickness_m) {
  SheetOptions options;
  options.thickness_m = thickness_m;
  options.young_pa = tissue.young_pa;
  options.poisson = tissue.poisson;
  options.density_kg_m3 = tissue.density_kg_m3;
  options.tear_n_per_m = tissue.rupture_n_per_m;
  return options;
}

TriangleSurface rectangular_sheet(double along_m, double across_m, double edge_m) {
  if (!(along_m > 0) || !(across_m > 0) || !(edge_m > 0) || !std::isfinite(along_m + across_m))
    throw InputError("a rectangle or the edge of its triangles is none");
  // Rows of nodes, every other one shifted by half an edge; its ends lie on the border all the same.
  const int columns = std::max(1, static_cast<int>(std::lround(along_m / edge_m)));
  const int rows = std::max(1, static_cast<int>(std::lround(across_m / (edge_m * std::sqrt(0.75)))));
  TriangleSurface sheet;
  std::vector<std::vector<std::int32_t>> row(static_cast<std::size_t>(rows) + 1);
  for (int r = 0; r <= rows; ++r) {
    const auto add = [&](double x) {
      row[static_cast<std::size_t>(r)].push_back(static_cast<std::int32_t>(sheet.vertices.size()));
      sheet.vertices.push_back({x * along_m / columns, r * across_m / rows, 0});
    };
    if (r % 2 == 0) {
      for (int c = 0; c <= columns; ++c) add(c);
    } else {
      add(0);
      for (int c = 0; c < columns; ++c) add(c + 0.5);
      add(columns);
    }
  }
  for (int r = 0; r < rows; ++r) {
    const auto &low = row[static_cast<std::size_t>(r)], &high = row[static_cast<std::size_t>(r) + 1];
    const bool even = r % 2 == 0;
    const auto& few = even ? low : high;
    const auto& many = even ? high : low;  // one more
    for (std::size_t c = 0; c + 1 < many.size(); ++c) {
      const std::size_t f = std::min(c, few.size() - 1);
      sheet.triangles.push_back(even ? std::array{few[f], many[c + 1], many[c]}
                                     : std::array{few[f], many[c], many[c + 1]});
      if (c + 1 < few.size())
        sheet.triangles.push_back(even ? std::array{few[c], few[c + 1], many[c + 1]}
                                       : std::array{few[c + 1], few[c], many[c + 1]});
    }
  }
  return sheet;
}

ElasticSheet::ElasticSheet(const TriangleSurface& drawn, const SheetOptions& options)
    : options_(options), drawn_(drawn.vertices), triangles_(drawn.triangles) {
  check(drawn, options);
  position_ = before_ = drawn_;
  velocity_.assign(drawn_.size(), Vec3::Zero());
  for (const auto& [a, b, c] : triangles_) {
    const Vec3 one = drawn_[number(b)] - drawn_[number(a)], two = drawn_[number(c)] - drawn_[number(a)];
    const Vec3 u = one.normalized(), v = one.cross(two).normalized().cross(u);
    Eigen::Matrix2d edges;
    edges << one.dot(u), two.dot(u), one.dot(v), two.dot(v);
    rest_.push_back({edges.inverse(), 0.5 * edges.determinant(), 0});
  }
  connect();
}

void ElasticSheet::connect() {
  mass_.assign(position_.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const std::int32_t node : triangles_[t])
      mass_[number(node)] += rest_[t].area_m2 * options_.thickness_m * options_.density_kg_m3 / 3;
  std::map<std::array<std::int32_t, 2>, std::pair<std::int32_t, std::size_t>>
      across;  // directed: the corner that faces it, its triangle
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      across[{triangles_[t][i], triangles_[t][(i + 1) % 3]}] = {triangles_[t][(i + 2) % 3], t};
  hinges_.clear();
  for (const auto& [edge, one] : across) {
    if (edge[0] > edge[1]) continue;
    const auto other = across.find({edge[1], edge[0]});
    if (other == across.end()) continue;
    Hinge hinge{{edge[0], edge[1], one.first, other->second.first}};
    std::array<Vec3, 4> drawn, now;
    for (std::size_t i = 0; i < 4; ++i) {
      drawn[i] = drawn_[number(hinge.node[i])];
      now[i] = position_[number(hinge.node[i])];
    }
    hinge.rest_rad = fold(drawn, nullptr);
    hinge.last_rad = unwound(fold(now, nullptr), hinge.rest_rad);
    hinge.stiffness_j = options_.bending_j() * (drawn[1] - drawn[0]).squaredNorm() /
                        (rest_[one.second].area_m2 + rest_[other->second.second].area_m2);
    hinges_.push_back(hinge);
  }
  lay_out_matrix();
}

void ElasticSheet::lay_out_matrix() {
  below_.assign(position_.size(), {});
  const auto share = [&](std::span<const std::int32_t> nodes) {
    for (const std::int32_t a : nodes)
      for (const std::int32_t b : nodes)
        if (a >= b) below_[number(b)].push_back(a);
  };
  for (const auto& corner : triangles_) share(corner);
  for (const Hinge& hinge : hinges_) share(hinge.node);
  std::vector<Eigen::Triplet<double>> places;
  for (std::size_t column = 0; column < below_.size(); ++column) {
    std::vector<std::int32_t>& rows = below_[column];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (const std::int32_t row : rows)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) places.emplace_back(3 * row + i, 3 * static_cast<std::int32_t>(column) + j, 0.0);
  }
  const auto size = static_cast<Eigen::Index>(3 * below_.size());
  matrix_.resize(size, size);
  matrix_.setFromTriplets(places.begin(), places.end());
  solver_->analyzePattern(matrix_);
  factored_ = false;
}

void ElasticSheet::add_block(Matrix& to, std::int32_t row, std::int32_t column, const Mat3& block) const {
  if (row < column) return;
  const std::vector<std::int32_t>& rows = below_[number(column)];
  const auto at = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
  for (int j = 0; j < 3; ++j) {
    double* value = to.valuePtr() + to.outerIndexPtr()[3 * column + j] + 3 * at;
    for (int i = 0; i < 3; ++i) value[i] += block(i, j);
  }
}

void ElasticSheet::anchor(const SheetAnchor& to) {
  if (to.node < 0 || number(to.node) >= position_.size() || !to.position.allFinite() || !to.velocity.allFinite() ||
      !(to.stiffness_n_per_m >= 0) || !std::isfinite(to.stiffness_n_per_m))
    return;
  const auto same =
      std::find_if(anchors_.begin(), anchors_.end(), [&](const SheetAnchor& a) { return a.node == to.node; });
  if (same != anchors_.end())
    *same = to;
  else
    anchors_.push_back(to);
}

void ElasticSheet::let_go(std::int32_t node) {
  std::erase_if(anchors_, [&](const SheetAnchor& a) { return a.node == node; });
}

Vec3 ElasticSheet::place_T(const MaterialPoint& place) const {
  const auto& corner = triangles_[number(place.triangle)];
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) sum += place.weight[i] * position_[number(corner[i])];
  return sum;
}

double ElasticSheet::stretch_of(const SheetSpring& spring, std::span<const Vec3> at) const {
  const auto& corner = triangles_[number(spring.place.triangle)];
  double way = 0;
  for (std::size_t i = 0; i < 3; ++i)
    way += spring.place.weight[i] * spring.direction.dot(at[number(corner[i])] - position_[number(corner[i])]);
  return spring.stretch_m + way;
}

Eigen::Matrix<double, 3, 2> ElasticSheet::gradient(std::size_t triangle, std::span<const Vec3> at) const {
  const auto& corner = triangles_[triangle];
  Eigen::Matrix<double, 3, 2> edges;
  edges.col(0) = at[number(corner[1])] - at[number(corner[0])];
  edges.col(1) = at[number(corner[2])] - at[number(corner[0])];
  return edges * rest_[triangle].inverse;
}

/// @param pull forces of the stretched triangle on its corners. @param stiffness 3 x 3 blocks are added
double ElasticSheet::stretch(std::size_t triangle, std::span<const Vec3> at, std::array<Vec3, 3>* pull,
                             Matrix* stiffness) const {
  const auto& corner = triangles_[triangle];
  const Rest& rest = rest_[triangle];
  const Eigen::Matrix<double, 3, 2> F = gradient(triangle, at);
  const Plane plane(options_);
  const Eigen::Matrix2d strain = green(F), tension = plane.tension(strain);
  if (pull != nullptr) {
    const Eigen::Matrix<double, 3, 2> H = -rest.area_m2 * F * tension * rest.inverse.transpose();
    *pull = {Vec3(-H.col(0) - H.col(1)), Vec3(H.col(0)), Vec3(H.col(1))};
  }
  if (stiffness != nullptr) {
    const Eigen::Matrix2d pulled = pulling_part(tension);
    std::array<Eigen::Vector2d, 3> g{Eigen::Vector2d(), rest.inverse.row(0).transpose(),
                                     rest.inverse.row(1).transpose()};
    g[0] = -g[1] - g[2];
    const Mat3 FF = F * F.transpose();
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        const Vec3 fa = F * g[a], fb = F * g[b];
        const Mat3 block =
            rest.area_m2 * (0.5 * plane.shear * (g[a].dot(g[b]) * FF + fb * fa.transpose()) +
                            plane.bulk * fa * fb.transpose() + g[a].dot(pulled * g[b]) * Mat3::Identity());
        add_block(*stiffness, corner[a], corner[b], block);
      }
  }
  return 0.5 * rest.area_m2 * (tension.array() * strain.array()).sum();
}

double ElasticSheet::objective(std::span<const SheetSpring> springs, std::span<const Vec3> at,
                               Eigen::VectorXd* downhill, Matrix* stiffness) const {
  const double h = options_.step_s, inertia = (statics_ ? kStillInertia : 1) / (h * h);
  if (downhill != nullptr) downhill->setZero(static_cast<Eigen::Index>(3 * at.size()));
  const auto push = [&](std::int32_t node, const Vec3& force) {
    if (downhill != nullptr) downhill->segment<3>(3 * node) += force;
  };
  const auto stiffen = [&](std::int32_t a, std::int32_t b, const Mat3& block) {
    if (stiffness != nullptr) add_block(*stiffness, a, b, block);
  };
  double sum = 0;
  for (std::size_t n = 0; n < at.size(); ++n) {
    const Vec3 kept =
        statics_ ? Vec3::Zero() : Vec3(h * velocity_[n] * std::max(0.0, 1 - h * options_.mass_damping_per_s));
    const Vec3 way = at[n] - position_[n] - kept;
    sum += mass_[n] * (0.5 * inertia * way.squaredNorm() - options_.gravity_m_s2.dot(at[n] - position_[n]));
    push(static_cast<std::int32_t>(n), mass_[n] * (options_.gravity_m_s2 - inertia * way));
    stiffen(static_cast<std::int32_t>(n), static_cast<std::int32_t>(n), mass_[n] * inertia * Mat3::Identity());
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    std::array<Vec3, 3> pull;
    sum += stretch(t, at, downhill != nullptr ? &pull : nullptr, stiffness);
    for (std::size_t i = 0; i < 3 && downhill != nullptr; ++i) push(triangles_[t][i], pull[i]);
  }
  for (const Hinge& hinge : hinges_) {
    std::array<Vec3, 4> corner, gradient;
    for (std::size_t i = 0; i < 4; ++i) corner[i] = at[number(hinge.node[i])];
    const double turn = unwound(fold(corner, downhill != nullptr ? &gradient : nullptr), hinge.last_rad);
    const double k = hinge.stiffness_j, drag = statics_ ? 0 : k * options_.bend_damping_s / h;
    const double bent = turn - hinge.rest_rad, since = turn - hinge.last_rad;
    sum += 0.5 * k * bent * bent + 0.5 * drag * since * since;
    for (std::size_t i = 0; i < 4 && downhill != nullptr; ++i) {
      push(hinge.node[i], -(k * bent + drag * since) * gradient[i]);
      for (std::size_t j = 0; j < 4 && stiffness != nullptr; ++j)
        stiffen(hinge.node[i], hinge.node[j], (k + drag) * gradient[i] * gradient[j].transpose());
    }
  }
  for (const SheetAnchor& anchor : anchors_) {
    const Vec3 way = at[number(anchor.node)] - anchor.position - (statics_ ? 0 : h) * anchor.velocity;
    sum += 0.5 * anchor.stiffness_n_per_m * way.squaredNorm();
    push(anchor.node, -anchor.stiffness_n_per_m * way);
    stiffen(anchor.node, anchor.node, anchor.stiffness_n_per_m * Mat3::Identity());
  }
  for (const SheetSpring& spring : springs) {
    if (!acts(spring, triangles_.size())) continue;
    const double way = stretch_of(spring, at);
    if (spring.pushes_only && way <= 0) continue;
    const double k = spring.stiffness_n_per_m;
    const auto& corner = triangles_[number(spring.place.triangle)];
    sum += 0.5 * k * way * way;
    for (std::size_t i = 0; i < 3; ++i) {
      push(corner[i], -k * way * spring.place.weight[i] * spring.direction);
      for (std::size_t j = 0; j < 3; ++j)
        stiffen(corner[i], corner[j],
                k * spring.place.weight[i] * spring.place.weight[j] * spring.direction * spring.direction.transpose());
    }
  }
  return sum;
}

void ElasticSheet::step(std::span<SheetSpring> springs) {
  now_ = before_ = position_;
  torn_.clear();
  Eigen::VectorXd downhill;
  bool sound = true, whole = false;  // whole: the last way was gone to its end
  for (iterations_ = 0; iterations_ < options_.most_iterations;) {
    // Factoring is three quarters of an iteration: one is kept for the step while it leads well.
    if (!whole) matrix_.coeffs().setZero();
    energy_now_ = objective(springs, now_, &downhill, whole ? nullptr : &matrix_);
    if (!whole) {
      solver_->factorize(matrix_);
      factored_ = solver_->info() == Eigen::Success;
    }
    const Eigen::VectorXd way = factored_ ? Eigen::VectorXd(solver_->solve(downhill)) : downhill;
    ++iterations_;
    const double slope = way.dot(downhill);
    sound = factored_ && std::isfinite(energy_now_) && std::isfinite(slope);
    if (!sound) break;
    const double gone = search_line(springs, way, slope);
    if (gone == 0) break;
    whole = gone == 1;
    if (way.cwiseAbs().maxCoeff() < options_.tolerance_m) break;
  }
  if (!sound) {
    ++held_steps_;
    for (Vec3& velocity : velocity_) velocity.setZero();
    for (SheetSpring& spring : springs) spring.force_n = 0;
    return;
  }
  accept(springs);
  tear();
}

double ElasticSheet::search_line(std::span<const SheetSpring> springs, const Eigen::VectorXd& way, double slope) {
  next_.resize(now_.size());
  double share = 1;
  for (int halving = 0; halving < kHalvings; ++halving, share /= 2) {
    for (std::size_t n = 0; n < now_.size(); ++n)
      next_[n] = now_[n] + share * way.segment<3>(static_cast<Eigen::Index>(3 * n));
    const double there = objective(springs, next_, nullptr, nullptr);
    if (!(there <= energy_now_ - kDescent * share * slope)) continue;
    std::swap(now_, next_);
    return share;
  }
  return 0;
}

void ElasticSheet::accept(std::span<SheetSpring> springs) {
  for (SheetSpring& spring : springs) {
    spring.force_n = 0;
    if (!acts(spring, triangles_.size())) continue;
    const double way = stretch_of(spring, now_);
    if (!spring.pushes_only || way > 0) spring.force_n = spring.stiffness_n_per_m * way;
  }
  for (SheetAnchor& anchor : anchors_)
    anchor.force = anchor.stiffness_n_per_m *
                   (now_[number(anchor.node)] - anchor.position - (statics_ ? 0 : options_.step_s) * anchor.velocity);
  for (std::size_t n = 0; n < now_.size(); ++n) {
    Vec3 velocity = statics_ ? Vec3::Zero() : Vec3((now_[n] - position_[n]) / options_.step_s);
    if (const double speed = velocity.norm(); speed > options_.most_speed_m_s)
      velocity *= options_.most_speed_m_s / speed;
    velocity_[n] = velocity;
    position_[n] = now_[n];
  }
  for (Hinge& hinge : hinges_) {
    std::array<Vec3, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) corner[i] = position_[number(hinge.node[i])];
    hinge.last_rad = unwound(fold(corner, nullptr), hinge.last_rad);
  }
}

int ElasticSheet::settle(std::span<SheetSpring> springs, double still_m, int most_steps) {
  statics_ = true;
  int steps = 0;
  for (double moved = still_m + 1; steps < most_steps && moved > still_m; ++steps) {
    const std::vector<Vec3> before = position_;
    step(springs);
    moved = 0;
    for (std::size_t n = 0; n < before.size(); ++n) moved = std::max(moved, (position_[n] - before[n]).norm());
    for (SheetSpring& spring : springs)  // told from where the sheet is now
      if (acts(spring, triangles_.size())) spring.stretch_m = 2 * spring.stretch_m - stretch_of(spring, before);
  }
  statics_ = false;
  return steps;
}

double ElasticSheet::tension_n_per_m(std::int32_t triangle) const {
  const Eigen::Matrix<double, 3, 2> F = gradient(number(triangle), position_);
  const Eigen::Matrix2d tension = Plane(options_).tension(green(F));
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(tension, Eigen::EigenvaluesOnly).eigenvalues()[1];
}

void ElasticSheet::tear() {
  if (statics_) return;
  std::vector<SheetEdge> edges;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Rest& rest = rest_[t];
    rest.over_s =
        tension_n_per_m(static_cast<std::int32_t>(t)) > options_.tear_n_per_m ? rest.over_s + options_.step_s : 0;
    if (rest.over_s < options_.overload_s) continue;
    rest.over_s = 0;
    // Across the pull: the edge that has been stretched least, and the one that goes on from it.
    const auto& corner = triangles_[t];
    SheetEdge least{};
    double stretched = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = number(corner[i]), b = number(corner[(i + 1) % 3]);
      const double ratio = (position_[a] - position_[b]).norm() / (drawn_[a] - drawn_[b]).norm();
      if (ratio < stretched) stretched = ratio, least = {corner[i], corner[(i + 1) % 3]};
    }
    edges.push_back(edge_of(least[0], least[1]));
    const Vec3 way = (drawn_[number(least[1])] - drawn_[number(least[0])]).normalized();
    double straightest = kSlit;
    SheetEdge on{-1, -1};
    for (const Hinge& hinge : hinges_)
      for (const std::size_t end : {0, 1}) {
        if (hinge.node[end] != least[1] || hinge.node[1 - end] == least[0]) continue;
        const double cosine =
            way.dot((drawn_[number(hinge.node[1 - end])] - drawn_[number(hinge.node[end])]).normalized());
        if (cosine > straightest) straightest = cosine, on = edge_of(hinge.node[0], hinge.node[1]);
      }
    if (on[0] >= 0) edges.push_back(on);
  }
  if (!edges.empty() && part(edges) > 0) torn_ = std::move(edges);
}

std::vector<SheetEdge> ElasticSheet::chain(const SheetCut& line) const {
  if (!line.from.allFinite() || !line.to.allFinite() || !(line.reach_m > 0)) return {};
  std::vector<double> off(position_.size());
  std::int32_t first = -1, last = -1;
  const auto nearer = [&](std::int32_t n, std::int32_t best, const Vec3& to) {
    return best < 0 || (position_[number(n)] - to).norm() < (position_[number(best)] - to).norm();
  };
  for (std::size_t n = 0; n < position_.size(); ++n) {
    off[n] = distance_to(position_[n], line.from, line.to) / line.reach_m;
    if (off[n] > 1) continue;
    const auto node = static_cast<std::int32_t>(n);
    if (nearer(node, first, line.from)) first = node;
    if (nearer(node, last, line.to)) last = node;
  }
  if (first < 0 || first == last) return {};
  // The shortest way over edges, those far from the line counted longer.
  std::vector<std::vector<std::int32_t>> beside(position_.size());
  for (const auto& corner : triangles_)
    for (std::size_t i = 0; i < 3; ++i) {
      beside[number(corner[i])].push_back(corner[(i + 1) % 3]);
      beside[number(corner[(i + 1) % 3])].push_back(corner[i]);
    }
  std::vector<double> way(position_.size(), std::numeric_limits<double>::infinity());
  std::vector<std::int32_t> from(position_.size(), -1);
  std::priority_queue<std::pair<double, std::int32_t>, std::vector<std::pair<double, std::int32_t>>, std::greater<>>
      open;
  way[number(first)] = 0;
  open.push({0, first});
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > way[number(node)]) continue;
    for (const std::int32_t next : beside[number(node)]) {
      const double there = off[number(next)];
      if (there > 1) continue;
      const double step = (position_[number(next)] - position_[number(node)]).norm() * (1 + kAcross * there);
      if (length + step >= way[number(next)]) continue;
      way[number(next)] = length + step;
      from[number(next)] = node;
      open.push({way[number(next)], next});
    }
  }
  std::vector<SheetEdge> edges;
  for (std::int32_t node = last; from[number(node)] >= 0; node = from[number(node)])
    edges.push_back(edge_of(node, from[number(node)]));
  return edges;
}

std::vector<std::int32_t> part_triangles(std::vector<std::array<std::int32_t, 3>>& triangles, std::int32_t nodes,
                                         std::span<const SheetEdge> edges) {
  const auto is_cut = [&](std::int32_t a, std::int32_t b) {
    return std::find(edges.begin(), edges.end(), edge_of(a, b)) != edges.end();
  };
  std::vector<std::int32_t> ends, copies;
  for (const SheetEdge& edge : edges) ends.insert(ends.end(), edge.begin(), edge.end());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const std::vector<std::array<std::int32_t, 3>> whole = triangles;
  for (const std::int32_t node : ends) {
    std::vector<std::size_t> round;
    for (std::size_t t = 0; t < whole.size(); ++t)
      if (std::find(whole[t].begin(), whole[t].end(), node) != whole[t].end()) round.push_back(t);
    // Fans that hang together by an edge that is not cut.
    std::vector<int> fan(round.size(), -1);
    int fans = 0;
    for (std::size_t i = 0; i < round.size(); ++i) {
      if (fan[i] >= 0) continue;
      fan[i] = fans;
      for (std::vector<std::size_t> reached{i}; !reached.empty();) {
        const auto& at = whole[round[reached.back()]];
        reached.pop_back();
        for (std::size_t j = 0; j < round.size(); ++j) {
          const auto& there = whole[round[j]];
          const bool joined = std::any_of(at.begin(), at.end(), [&](std::int32_t other) {
            return other != node && std::find(there.begin(), there.end(), other) != there.end() && !is_cut(node, other);
          });
          if (fan[j] >= 0 || !joined) continue;
          fan[j] = fans;
          reached.push_back(j);
        }
      }
      ++fans;
    }
    for (int f = 1; f < fans; ++f) {
      const auto copy = nodes + static_cast<std::int32_t>(copies.size());
      copies.push_back(node);
      for (std::size_t j = 0; j < round.size(); ++j)
        if (fan[j] == f) std::replace(triangles[round[j]].begin(), triangles[round[j]].end(), node, copy);
    }
  }
  return copies;
}

double ElasticSheet::part(std::span<const SheetEdge> edges) {
  double length = 0;
  for (const Hinge& hinge : hinges_)
    if (std::find(edges.begin(), edges.end(), edge_of(hinge.node[0], hinge.node[1])) != edges.end())
      length += (drawn_[number(hinge.node[0])] - drawn_[number(hinge.node[1])]).norm();
  const std::vector<std::int32_t> copies =
      part_triangles(triangles_, static_cast<std::int32_t>(position_.size()), edges);
  if (copies.empty()) return 0;
  for (const std::int32_t node : copies)
    for (std::vector<Vec3>* of : {&drawn_, &position_, &velocity_, &before_}) of->push_back(Vec3((*of)[number(node)]));
  copied_.insert(copied_.end(), copies.begin(), copies.end());
  ++topology_;
  connect();
  return length;
}

std::vector<Mat3> ElasticSheet::anchor_stiffness() const {
  std::vector<Mat3> out;
  for (const SheetAnchor& anchor : anchors_) out.push_back(anchor.stiffness_n_per_m * Mat3::Identity());
  if (!factored_ || anchors_.empty()) return out;
  const auto columns = static_cast<Eigen::Index>(3 * anchors_.size());
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * position_.size()), columns);
  for (std::size_t a = 0; a < anchors_.size(); ++a)
    for (Eigen::Index c = 0; c < 3; ++c) unit(3 * anchors_[a].node + c, static_cast<Eigen::Index>(3 * a) + c) = 1;
  const Eigen::MatrixXd moved = solver_->solve(unit);
  for (std::size_t a = 0; a < anchors_.size(); ++a) {
    const double k = anchors_[a].stiffness_n_per_m;
    const Mat3 gives = moved.block<3, 3>(3 * anchors_[a].node, static_cast<Eigen::Index>(3 * a));
    out[a] -= k * k / 2 * (gives + gives.transpose());
  }
  return out;
}

double ElasticSheet::compliance(const MaterialPoint& place, const Vec3& direction) const {
  if (!factored_) return 0;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(matrix_.rows());
  const auto& corner = triangles_[number(place.triangle)];
  for (std::size_t i = 0; i < 3; ++i) force.segment<3>(3 * corner[i]) += place.weight[i] * direction;
  return force.dot(Eigen::VectorXd(solver_->solve(force)));
}

void ElasticSheet::place(std::span<const Vec3> position) {
  for (std::size_t n = 0; n < std::min(position.size(), position_.size()); ++n)
    if (position[n].allFinite()) position_[n] = position[n];
  for (Vec3& velocity : velocity_) velocity.setZero();
  connect();
}

double ElasticSheet::energy_j() const {
  double sum = 0;
  for (std::size_t n = 0; n < position_.size(); ++n) sum += 0.5 * mass_[n] * velocity_[n].squaredNorm();
  for (std::size_t t = 0; t < triangles_.size(); ++t) sum += stretch(t, position_, nullptr, nullptr);
  for (const Hinge& hinge : hinges_) sum += 0.5 * hinge.stiffness_j * std::pow(hinge.last_rad - hinge.rest_rad, 2);
  for (const SheetAnchor& anchor : anchors_)
    sum += 0.5 * anchor.stiffness_n_per_m * (position_[number(anchor.node)] - anchor.position).squaredNorm();
  return sum;
}

Vec3 ElasticSheet::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < position_.size(); ++n) sum += mass_[n] * velocity_[n];
  return sum;
}

double ElasticSheet::mean_area_m2() const {
  double sum = 0;
  for (const Rest& rest : rest_) sum += rest.area_m2;
  return sum / static_cast<double>(rest_.size());
}

double ElasticSheet::mass_kg() const {
  double sum = 0;
  for (const double mass : mass_) sum += mass;
  return sum;
}

}  // namespace trocar
