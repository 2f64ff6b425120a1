#include "tissue/interaction/suture_needle.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kTakesWire = 0.1;        // N of squeeze, as SoftGrip
constexpr double kCatchOpens = 0.0005;    // m over the wire: until then the catch of the driver holds it (a choice)
constexpr double kWireReach = 0.001;      // m beyond the pads
constexpr double kWireSampling = 0.0005;  // m
constexpr double kSteepEnough = 0.17;     // cosine to the inward normal from which a point does not slide off
constexpr double kDeepestTouch = 0.004;   // m under the surface: what is deeper has got there without touching
constexpr double kTouchEnds = 2e-4;       // m over the surface
constexpr double kPressed = 5e-4;         // m round the surface in which the wire lies in its dent (a choice)
constexpr double kLies = 50;              // N/m of the surface under a free needle (a choice)
constexpr double kFreeDamping = 5;        // 1/s, of a free needle's motion (a choice)
constexpr double kLeans = 0.002;  // N of a thread on a needle that nothing else holds (a choice): thrice its weight
constexpr double kMostWay = 0.02, kMostTurn = 0.5, kMostSlipTurn = 0.05;  // m, rad in a step
constexpr double kLeastNeedleHold = 1;                                    // N/m of what the hand feels
constexpr std::uint64_t kLooksEvery = 4;  // steps between looks at what the organ has of the needle's places
constexpr double kThreadHold = 250;       // N/m, most of the thread alone

Mat3 cross_matrix(const Vec3& v) {
  Mat3 out;
  out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return out;
}

Mat3 turn_by(const Vec3& angle) {
  const double size = angle.norm();
  return size > 0 ? Eigen::AngleAxisd(size, angle / size).toRotationMatrix() : Mat3::Identity();
}

Vec3 no_longer(const Vec3& v, double most) { return v.norm() > most ? Vec3(v * (most / v.norm())) : v; }

/// A body's step: what pulls on a place of it, by its motion (way of the middle, turn).
struct BodyStep {
  Vec3 middle;
  Mat6 K = Mat6::Zero();
  Vec6 f = Vec6::Zero();

  /// Force at a place, that changes by -stiffness times the place's way.
  void add(const Vec3& place, const Vec3& force, const Mat3& stiffness) {
    Eigen::Matrix<double, 3, 6> J;
    J << Mat3::Identity(), -cross_matrix(place - middle);
    f += J.transpose() * force;
    K += J.transpose() * stiffness * J;
  }
};

}  // namespace

SutureNeedle::SutureNeedle(const NeedleShape& shape, const Pose& X_TN, const NeedleTissueOptions& tissue,
                           const NeedleDriverOptions& driver)
    : shape_(shape), tissue_(tissue), driver_(driver), X_TN_(X_TN) {}

void SutureNeedle::place(const Pose& X_TN) {
  X_TN_ = X_TN;
  speed_ = {};
  swage_way_ = Vec3::Zero();
}

void SutureNeedle::load(const Pose& X_TI, const Pose& X_IN) {
  place(X_TI * X_IN);
  X_IN_ = X_IN;
  const std::vector<double> arcs = arcs_between(X_TI, 2 * shape_.wire_radius_m);
  held_arc_ = arcs.empty() ? shape_.length_m / 2 : arcs[arcs.size() / 2];
  state_ = GripState::kHolding;
}

std::vector<double> SutureNeedle::arcs_between(const Pose& X_TI, double opening_m) const {
  std::vector<double> found;
  const Pose X_IN = X_TI.inverse() * X_TN_;
  for (double arc = 0; arc <= shape_.length_m; arc += kWireSampling) {
    const Vec3 p = X_IN * shape_.place(arc);
    if (std::abs(p.x()) < driver_.pad_width_m / 2 + kWireReach &&
        std::abs(p.y()) < opening_m / 2 + shape_.wire_radius_m + kWireReach && p.z() < kWireReach &&
        p.z() > -driver_.pad_length_m - kWireReach)
      found.push_back(arc);
  }
  return found;
}

void SutureNeedle::use_jaws(const std::optional<DriverJaws>& jaws) {
  const bool was_held = held();
  const auto let_go = [&](GripState now) {
    if (was_held) events_.push_back({NeedleEvent::Kind::kLetGo});
    state_ = now;
    squeeze_n_ = 0;
    if (now == GripState::kEmpty) block_ = {};
  };
  if (!jaws) return let_go(GripState::kEmpty);
  if (was_held) X_TN_ = jaws->X_TI * X_IN_;  // it goes along, however quick they are
  // Pads that close on the wire leave no way out beside it: what is held stays between them as long as it is as thick.
  const double room = was_held ? std::max(jaws->opening_m, 2 * shape_.wire_radius_m) : jaws->opening_m;
  const std::vector<double> arcs = arcs_between(jaws->X_TI, room);
  if (!was_held) {
    const bool enters = state_ == GripState::kAround || jaws->opening_m > 2 * shape_.wire_radius_m;
    if (arcs.empty() || !enters) return let_go(GripState::kEmpty);
    state_ = GripState::kAround;
  }
  block_ = {2 * shape_.wire_radius_m, driver_.wire_n_per_m};
  squeeze_n_ = driver_.wire_n_per_m * std::max(0.0, 2 * shape_.wire_radius_m - jaws->opening_m);
  if (was_held && (jaws->opening_m > 2 * shape_.wire_radius_m + kCatchOpens || arcs.empty()))
    return let_go(arcs.empty() ? GripState::kEmpty : GripState::kAround);
  if (!was_held && squeeze_n_ >= kTakesWire) {
    X_IN_ = jaws->X_TI.inverse() * X_TN_;
    state_ = GripState::kHolding;
    events_.push_back({NeedleEvent::Kind::kTaken});
  }
  if (!arcs.empty()) held_arc_ = arcs[arcs.size() / 2];
}

void SutureNeedle::find_touch(const OrganView& view) {
  // While a way has not come out, its end is where the point works.
  const bool inside = std::any_of(paths_.begin(), paths_.end(), [](const NeedlePath& p) { return !p.through(); });
  if (!held() || inside) {
    touch_.reset();
    return;
  }
  const SurfaceSnapshot& now = *view.organ.surface();
  const SurfaceFoot foot = view.walk.foot(now.vertices, tip_T(), tip_vertex_);
  if (touch_) {
    touch_->normal = foot.normal;
    if (foot.normal.dot(tip_T() - view.organ.place_T(touch_->shares)) > kTouchEnds) touch_.reset();
    return;
  }
  const double steep = -foot.normal.dot(X_TN_.R * shape_.tangent(shape_.length_m));
  if (foot.height_m >= 0 || foot.height_m < -kDeepestTouch || steep < kSteepEnough) return;
  const Vec3 rest = view.organ.rest_place(foot.place);
  touch_ = Touch{rest, view.organ.shares_within(rest), foot.normal};
  if (touch_->shares.node.empty()) touch_.reset();
}

void SutureNeedle::add_springs(const OrganView& view, std::vector<NeedleSpring>& springs) {
  springs.clear();
  path_springs_.clear();
  for (NeedlePath& path : paths_) {
    const std::size_t first = springs.size();
    path.add_springs(view, shape_, tissue_, X_TN_, held() ? 1 : tissue_.free_share, springs);
    path_springs_.push_back(springs.size() - first);
  }
  if (!touch_) return;
  const Vec3 off = view.organ.place_T(touch_->shares) - tip_T(), across = touch_->normal.unitOrthogonal();
  for (const Vec3& direction : {touch_->normal, across, Vec3(touch_->normal.cross(across))})
    springs.push_back({{touch_->shares, direction, tissue_.tip_n_per_m, direction.dot(off), false, 0}, tip_T()});
  springs[springs.size() - 3].soft.pushes_only = true;
}

Vec3 SutureNeedle::middle_N() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < kMasses; ++i)
    sum += shape_.place(shape_.length_m * (static_cast<double>(i) + 0.5) / kMasses) / kMasses;
  return sum;
}

void SutureNeedle::go_free(const OrganView& view, const ThreadPull& thread) {
  const double h = view.organ.solid().options().step_s, mass = shape_.mass_kg() / kMasses;
  BodyStep step{.middle = X_TN_ * middle_N()};
  for (std::size_t i = 0; i < kMasses; ++i) {
    const Vec3 place = X_TN_ * shape_.place(shape_.length_m * (static_cast<double>(i) + 0.5) / kMasses);
    const Vec3 speed = speed_.linear + speed_.angular.cross(place - step.middle);
    step.add(place, mass * (speed / h + Vec3(0, 0, -kGravity)),
             mass * (1 + h * kFreeDamping) / (h * h) * Mat3::Identity());
  }
  std::vector<NeedleSpring> springs;
  add_springs(view, springs);
  for (const NeedleSpring& spring : springs) {
    const SoftSpring& s = spring.soft;
    if (s.pushes_only && s.stretch_m <= 0) continue;
    step.add(spring.at_T, s.stiffness_n_per_m * s.stretch_m * s.direction,
             s.stiffness_n_per_m * s.direction * s.direction.transpose());
  }
  // Off the tissue the needle is so light that a taut thread would throw it about: the tether keeps it, the thread only
  // leans on it.
  const Vec3 pull = thread.force + thread.stiffness * thread.way;
  const double share = paths_.empty() ? std::min(1.0, kLeans / std::max(kLeans, pull.norm())) : 1;
  step.add(swage_T(), share * pull, share * thread.stiffness);
  if (paths_.empty()) {
    for (std::size_t i = 0; i < lies_on_.size(); ++i) {
      const Vec3 place = X_TN_ * shape_.place(shape_.length_m * static_cast<double>(i) / 2);
      if (const double under = view.floor_m - place.z(); under > 0)
        step.add(place, kLies * under * Vec3::UnitZ(), kLies * Mat3::Identity());
      const SurfaceFoot foot = view.walk.foot(view.organ.surface()->vertices, place, lies_on_[i]);
      const double deep = shape_.wire_radius_m - foot.height_m;
      if (deep <= 0 || deep > swing_m()) continue;
      step.add(place, kLies * deep * foot.normal, kLies * foot.normal * foot.normal.transpose());
    }
  }
  const Vec6 way = step.K.ldlt().solve(step.f);
  if (!way.allFinite()) return;
  const Vec3 moved = no_longer(way.head<3>(), kMostWay), turned = no_longer(way.tail<3>(), kMostTurn);
  const Mat3 turn = turn_by(turned);
  X_TN_.p = step.middle + moved + turn * (X_TN_.p - step.middle);
  X_TN_.R = Eigen::Quaterniond(turn * X_TN_.R).normalized().toRotationMatrix();
  speed_ = {moved / h, turned / h};
}

/// Goes back, and goes on without the part of its speed that leads away.
void SutureNeedle::keep_tethered() {
  const Vec3 way = tether_->place_T - swage_T();
  const double over = way.norm() - tether_->most_m;
  if (over <= 0) return;
  const Vec3 back = way.normalized();
  X_TN_.p += over * back;
  speed_.linear += std::max(0.0, -back.dot(speed_.linear)) * back;
}

void SutureNeedle::before(const OrganView& view, const std::optional<DriverJaws>& jaws, const ThreadPull& thread,
                          std::vector<SoftSpring>& springs) {
  events_.clear();
  const Vec3 swage = swage_T();
  use_jaws(jaws);
  if (held()) {
    X_TN_ = jaws->X_TI * X_IN_;
    speed_ = {};
    stands_ = false;
  } else if (!stands_) {
    go_free(view, thread);
    if (tether_ && paths_.empty()) keep_tethered();
  }
  tether_.reset();
  swage_way_ = swage_T() - swage;
  find_touch(view);
  add_springs(view, springs_);
  for (const NeedleSpring& spring : springs_) springs.push_back(spring.soft);
}

void SutureNeedle::after(const OrganView& view, const std::optional<DriverJaws>& jaws, const ThreadPull& thread,
                         std::span<const SoftSpring> springs) {
  for (std::size_t s = 0; s < springs.size(); ++s) springs_[s].soft.force_n = springs[s].force_n;
  load_ = {};
  const Vec3 about = X_TN_ * shape_.place(held_arc_);
  for (const NeedleSpring& spring : springs_)
    load_ = load_ + Wrench{spring.on_needle(), (spring.at_T - about).cross(spring.on_needle())};
  tissue_n_ = load_.force.norm();
  load_ = load_ + Wrench{thread.force, (swage_T() - about).cross(thread.force)};
  std::size_t of_paths = 0;
  for (const std::size_t count : path_springs_) of_paths += count;
  feel_paths(view, std::span(springs_).first(of_paths));
  feel_touch(view, std::span<const NeedleSpring>(springs_).subspan(of_paths));
  hold_ = {};
  if (held()) feel_jaws(view, *jaws, thread);
}

void SutureNeedle::feel_touch(const OrganView& view, std::span<const NeedleSpring> springs) {
  touch_n_ = touch_area_ = 0;
  if (!touch_ || springs.size() != 3) return;
  touch_n_ = springs[0].soft.force_n;
  // The wire lies in the dent as far as it is near the surface: next to nothing when it stands upright.
  const double steep = std::max(1e-3, -touch_->normal.dot(X_TN_.R * shape_.tangent(shape_.length_m)));
  const double lies = std::min(kPressed / steep, shape_.length_m);
  touch_area_ = 2 * shape_.radius_at(shape_.length_m - lies) * lies;
  if (touch_n_ >= puncture_force(view.organ.material(), shape_, tissue_) && touch_area_ < tissue_.most_contact_m2) {
    paths_.emplace_back(view, shape_, touch_->rest, X_TN_.R * shape_.tangent(shape_.length_m), next_path_++);
    tell(NeedleEvent::Kind::kPuncture, paths_.back(), touch_n_);
    touch_.reset();
    return;
  }
  const Vec3 drag = springs[1].on_needle() + springs[2].on_needle();
  const double most = tissue_.touch_friction * touch_n_, size = drag.norm();
  if (size <= most) return;
  // The point is dragged along on the surface.
  const Vec3 way = -(1 - most / size) / tissue_.tip_n_per_m * drag;
  touch_->rest += view.organ.gradient_within(touch_->rest).inverse() * way;
  std::int32_t vertex = tip_vertex_;
  touch_->rest = view.walk.foot(view.organ.rest()->vertices, touch_->rest, vertex).point;
  touch_->shares = view.organ.shares_within(touch_->rest);
  if (touch_->shares.node.empty()) touch_.reset();
}

void SutureNeedle::feel_paths(const OrganView& view, std::span<const NeedleSpring> springs) {
  std::vector<NeedlePath> left;
  std::size_t first = 0;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    NeedlePath& path = paths_[i];
    const NeedlePath::Event event = path.feel(view, shape_, tissue_, X_TN_, springs.subspan(first, path_springs_[i]));
    first += path_springs_[i];
    if (event == NeedlePath::Event::kTore) {
      tell(NeedleEvent::Kind::kTorn, path, path.load_n());
    } else if (path.through() && path.end_arc_m() < 0) {
      tell(NeedleEvent::Kind::kThrough, path, 0);
    } else if (path.entry_arc_m() > shape_.length_m) {
      tell(NeedleEvent::Kind::kWithdrawn, path, 0);
    } else {
      if (event == NeedlePath::Event::kCameOut) tell(NeedleEvent::Kind::kExit, path, path.end_force_n());
      left.push_back(std::move(path));
    }
  }
  paths_ = std::move(left);
}

void SutureNeedle::feel_jaws(const OrganView& view, const DriverJaws& jaws, const ThreadPull& thread) {
  const double most = 2 * driver_.friction * (squeeze_n_ + driver_.catch_n), pull = load_.force.norm();
  const double kept = pull > most ? most / pull : 1, most_turn = most * driver_.lever_m, turn = load_.moment.norm();
  double stiffness = 0, turning = 0;
  const Vec3 about = X_TN_ * shape_.place(held_arc_);
  for (const NeedleSpring& spring : springs_) {
    stiffness += spring.soft.stiffness_n_per_m;
    turning += spring.soft.stiffness_n_per_m * (spring.at_T - about).squaredNorm();
  }
  const double of_tissue = stiffness;
  stiffness += thread.stiffness.trace() / 3;
  turning += thread.stiffness.trace() / 3 * (swage_T() - about).squaredNorm();
  state_ = GripState::kHolding;
  if (stiffness > 0 && kept < 1) {
    state_ = GripState::kSlipping;
    X_TN_.p += no_longer((1 - kept) / stiffness * load_.force, kWireReach);
    load_.force *= kept;
  }
  if (turning > 0 && turn > most_turn) {
    state_ = GripState::kSlipping;
    const Mat3 by = turn_by(std::min((turn - most_turn) / turning, kMostSlipTurn) / turn * load_.moment);
    X_TN_ = {Eigen::Quaterniond(by * X_TN_.R).normalized().toRotationMatrix(), about + by * (X_TN_.p - about)};
    load_.moment *= most_turn / turn;
  }
  X_IN_ = jaws.X_TI.inverse() * X_TN_;
  if (load_.force.norm() <= 0) return;
  const Vec3 direction = load_.force.normalized();
  hold_.point_I = X_IN_ * shape_.place(held_arc_);
  hold_.stiffness_n_per_m = springs_.empty()
                                ? std::clamp(direction.dot(thread.stiffness * direction), kLeastNeedleHold, kThreadHold)
                                : loop_stiffness(view.organ, direction, of_tissue);
  hold_.anchor_T = jaws.X_TI * hold_.point_I + load_.force / hold_.stiffness_n_per_m;
}

double SutureNeedle::loop_stiffness(const SoftOrgan& organ, const Vec3& direction, double spring_n_per_m) {
  if (looks_++ % kLooksEvery != 0 && looked_springs_ == springs_.size()) return looked_;
  NodeShares all;
  for (const NeedleSpring& spring : springs_) {
    all.node.insert(all.node.end(), spring.soft.place.node.begin(), spring.soft.place.node.end());
    for (const float share : spring.soft.place.share) all.share.push_back(share / static_cast<float>(springs_.size()));
  }
  looked_springs_ = springs_.size();
  return looked_ = organ.loop_stiffness(all, direction, spring_n_per_m);
}

void SutureNeedle::follow_cut(const SoftOrgan& organ) {
  for (NeedlePath& path : paths_) path.follow_cut(organ);
  if (touch_) touch_->shares = organ.shares_within(touch_->rest);
  tip_vertex_ = -1;
  lies_on_ = {-1, -1, -1};
}

void SutureNeedle::tell(NeedleEvent::Kind kind, const NeedlePath& path, double force_n) {
  events_.push_back({kind, path.entry_rest_T(), path.end_rest_T(), force_n, path.number(), path.end_arc_m()});
}

}  // namespace trocar
