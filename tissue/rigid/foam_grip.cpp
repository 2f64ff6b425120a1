#include "tissue/rigid/foam_grip.h"

#include <algorithm>
#include <cmath>

#include "tissue/rigid/body_contact.h"

namespace trocar {
namespace {

constexpr double kHoldFrom = 0.10, kHoldUntil = 0.05;  // N
constexpr double kPadHalf = 0.008;                     // m along the hinge axis from the pads' middle to a block's
constexpr double kBehindTips = 0.016;                  // m: how deep a block's middle may lie between the pads
constexpr double kBeyondTips = 0.009;                  // m: how far beyond the pads' ends it may lie
constexpr double kAside = 0.001;       // m that a block may lie off between the pads and still be guided in
constexpr double kSquare = 0.82;       // least cosine between the pads' normal and the block's: 35 degrees askew
constexpr double kSlipSpeed = 0.040;   // m/s of a block that is not squeezed at all [D]
constexpr double kPadFriction = 0.83;  // profiled jaws (pull held per pinch, tissue notes section 3)
constexpr int kTurnSteps = 24;         // thirds of the angle: to a thousandth of a degree
constexpr double kMet = 1e-5;          // m that a held ring is kept from where the jaws would have it
constexpr double kSupport = 1e-4;      // m above what carries it

/// The block's own axis across the pads.
int pinched_axis(const RigidBody& body, const Mat3& R_TI) {
  Eigen::Index axis = 0;
  (body.X_TB.R.transpose() * R_TI.col(1)).cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

double thickness(const RigidBody& body, const Mat3& R_TI) { return 2 * body.half[pinched_axis(body, R_TI)]; }

/// Of the pads' normal with that of the sides between them.
double squareness(const RigidBody& body, const Mat3& R_TI) {
  const Vec3 across = body.X_TB.R.transpose() * R_TI.col(1);
  if (body.is_ring()) return std::max(std::abs(across.z()), across.head<2>().norm());
  return across.cwiseAbs().maxCoeff();
}

/// Turn of a block about its middle that would lay its lowest side flat.
Eigen::AngleAxisd levelling(const Mat3& R_TB) {
  Eigen::Index axis = 0;
  R_TB.row(2).cwiseAbs().maxCoeff(&axis);
  const Vec3 upright = R_TB.col(axis) * (R_TB(2, axis) > 0 ? 1.0 : -1.0);
  const Vec3 about = upright.cross(Vec3::UnitZ());
  const double sine = about.norm();
  if (sine < 1e-9) return {0, Vec3::UnitX()};
  return {std::atan2(sine, upright.z()), about / sine};
}

/// How far the board turns a held block towards flat: least of the energies of the board and of the foam in the pads.
void lay_on_board(RigidBody& body, double floor_z_m, double board_n_per_m, double turn_nm_per_rad) {
  if (lowest(body) >= floor_z_m) return;
  const Mat3 R_held = body.X_TB.R;
  const Eigen::AngleAxisd flat = levelling(R_held);
  const auto energy = [&](double angle) {
    body.X_TB.R = Eigen::AngleAxisd(angle, flat.axis()) * R_held;
    const double sunk = std::max(0.0, floor_z_m - lowest(body));
    return (board_n_per_m * sunk * sunk + turn_nm_per_rad * angle * angle) / 2;
  };
  double low = 0, high = flat.angle();
  for (int i = 0; i < kTurnSteps; ++i) {  // by thirds
    const double third = (high - low) / 3;
    if (energy(low + third) > energy(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  energy((low + high) / 2);  // leaves it so turned
}

/// Does the block's middle lie between the pads, seen along them?
bool in_reach(const Vec3& middle_I) {
  return std::abs(middle_I.x()) <= kPadHalf && middle_I.z() >= -kBehindTips && middle_I.z() <= kBeyondTips;
}

/// Does another block carry body `index`?
bool carried_by_other(const std::vector<RigidBody>& bodies, std::size_t index) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (i == index) continue;
    const RigidContacts touch = body_body(bodies[index], bodies[i], 0);
    for (int c = 0; c < touch.count; ++c) {
      if (touch.at[static_cast<std::size_t>(c)].normal_T.z() > 0.5) return true;
    }
  }
  return false;
}

}  // namespace

void FoamGrip::look_for_block(const JawReading& jaws, const std::vector<RigidBody>& bodies) {
  const int before = object_;
  object_ = -1;
  double nearest = 1e9;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec3 middle = jaws.X_TI.inverse() * bodies[i].X_TB.p;
    const double h = thickness(bodies[i], jaws.X_TI.R);
    const bool known = static_cast<int>(i) == before;
    const double aside = known ? h / 2 : std::max(0.0, jaws.opening_m - h) / 2 + kAside;
    const bool open = known || jaws.opening_m > h - kAside;
    const bool square = squareness(bodies[i], jaws.X_TI.R) >= kSquare;
    if (!open || !square || !in_reach(middle) || std::abs(middle.y()) > aside || middle.norm() >= nearest) continue;
    nearest = middle.norm();
    object_ = static_cast<int>(i);
  }
  state_ = object_ >= 0 ? GripState::kAround : GripState::kEmpty;
}

/// The pads push a block that stands nearer to one of them, until both touch it.
void FoamGrip::centre(const JawReading& jaws, const std::vector<PegPost>& pegs, RigidBody& body) const {
  const Vec3 across = jaws.X_TI.R.col(1);
  const double offset = across.dot(body.X_TB.p - jaws.X_TI.p);
  const double room = std::max(0.0, jaws.opening_m - thickness(body, jaws.X_TI.R)) / 2;
  const double excess = offset - std::clamp(offset, -room, room);
  const Vec3 level(across.x(), across.y(), 0);
  if (excess == 0 || level.norm() < 0.5) return;
  carry_past(pegs, body.X_TB.p - level * (excess / level.dot(across)), body);
  body.wake();
}

void FoamGrip::grasp(const JawReading& jaws, std::vector<RigidBody>& bodies) {
  for (RigidBody& body : bodies) body.wake();  // what leant on it may fall
  RigidBody& body = bodies[static_cast<std::size_t>(object_)];
  body.carried = true;
  X_IO_ = jaws.X_TI.inverse() * body.X_TB;
  slipped_m_ = board_force_n_ = 0;
  state_ = GripState::kHolding;
}

void FoamGrip::let_go(const Twist& V_TI_T, const Vec3& tip_T, std::vector<RigidBody>& bodies) {
  RigidBody& body = bodies[static_cast<std::size_t>(object_)];
  body.carried = false;
  body.wake();
  body.velocity_T = V_TI_T.linear + V_TI_T.angular.cross(body.X_TB.p - tip_T);
  body.spin_T = V_TI_T.angular;
  state_ = GripState::kAround;
  board_force_n_ = 0;
}

void FoamGrip::squeeze(const JawReading& jaws, RigidBody& body, Foam& foam) const {
  if (foam.crushed || jaws.grip_n <= foam.spec.crush_above_n) return;
  foam.crushed = true;
  foam.stiffness_n_per_m *= foam.spec.crushed_stiffness;
  body.half[pinched_axis(body, jaws.X_TI.R)] *= foam.spec.crushed_thickness;
}

void FoamGrip::carry(const JawReading& jaws, const RigidMaterial& board, double floor_z_m,
                     const std::vector<PegPost>& pegs, double dt_s, std::vector<RigidBody>& bodies, const Foam& foam) {
  const auto index = static_cast<std::size_t>(object_);
  RigidBody& body = bodies[index];
  const Vec3 seen = body.X_TB.p;
  body.X_TB = jaws.X_TI * X_IO_;
  body.velocity_T = jaws.V_TI_T.linear + jaws.V_TI_T.angular.cross(body.X_TB.p - jaws.X_TI.p);
  body.spin_T = jaws.V_TI_T.angular;
  const Mat3 R_held = body.X_TB.R;
  const double pad = thickness(body, jaws.X_TI.R);  // as long as the block is thick
  lay_on_board(body, floor_z_m, board.stiffness_n_per_m, foam.stiffness_n_per_m * pad * pad / 12);
  double sunk = std::max(0.0, floor_z_m - lowest(body));
  const double most = 2 * kPadFriction * jaws.grip_n / board.stiffness_n_per_m;
  if (sunk > most) {  // the board pushes it up through the pads
    body.X_TB.p.z() += sunk - most;
    sunk = most;
  }
  board_force_n_ = sunk * board.stiffness_n_per_m;
  const bool supported = lowest(body) < floor_z_m + kSupport || carried_by_other(bodies, index);
  const bool light = !supported && jaws.grip_n < foam.spec.slip_below_n;
  if (light) {
    const Vec3 across = jaws.X_TI.R.col(1);
    const Vec3 down = (-Vec3::UnitZ() + across * across.z()).normalized();
    const double way = kSlipSpeed * (1 - jaws.grip_n / foam.spec.slip_below_n) * dt_s;
    body.X_TB.p += way * down;
    slipped_m_ += way;
  }
  state_ = light ? GripState::kSlipping : GripState::kHolding;
  const Vec3 wanted = body.X_TB.p;
  body.X_TB.p.z() += sunk;  // shown, and met by others, on the board and not in it
  Vec3 through = Vec3::Zero();
  if (!pegs.empty()) {
    const Vec3 free = body.X_TB.p;
    turn_on_pegs(pegs, body);
    body.X_TB.p = seen;
    carry_past(pegs, free, body);
    const Vec3 off = body.X_TB.p - free;
    if (off.norm() > most) through = off * (1 - most / off.norm());
  }
  X_IO_ = jaws.X_TI.inverse() * Pose{R_held, wanted + through};
  met_ = (body.X_TB.p - wanted).norm() > kMet;
}

void FoamGrip::update(const JawReading& jaws, const RigidMaterial& board, double floor_z_m,
                      const std::vector<PegPost>& pegs, double dt_s, std::vector<RigidBody>& bodies,
                      std::vector<Foam>& foams) {
  const bool holding = state_ == GripState::kHolding || state_ == GripState::kSlipping;
  if (!holding) {
    look_for_block(jaws, bodies);
    if (object_ < 0) return;
    centre(jaws, pegs, bodies[static_cast<std::size_t>(object_)]);
    if (jaws.grip_n >= kHoldFrom) grasp(jaws, bodies);
  }
  if (state_ != GripState::kHolding && state_ != GripState::kSlipping) return;
  const auto index = static_cast<std::size_t>(object_);
  squeeze(jaws, bodies[index], foams[index]);
  if (jaws.grip_n < kHoldUntil) return let_go(jaws.V_TI_T, jaws.X_TI.p, bodies);
  carry(jaws, board, floor_z_m, pegs, dt_s, bodies, foams[index]);
  if (!in_reach(X_IO_.p)) {
    let_go(jaws.V_TI_T, jaws.X_TI.p, bodies);
    object_ = -1;
    state_ = GripState::kEmpty;
  }
}

void FoamGrip::reset(std::vector<RigidBody>& bodies) {
  if (state_ == GripState::kHolding || state_ == GripState::kSlipping) let_go({}, Vec3::Zero(), bodies);
  object_ = -1;
  state_ = GripState::kEmpty;
}

GripBlock FoamGrip::block(const std::vector<RigidBody>& bodies, const std::vector<Foam>& foams,
                          const Pose& X_TI) const {
  if (object_ < 0) return {};
  const auto index = static_cast<std::size_t>(object_);
  return {thickness(bodies[index], X_TI.R), foams[index].stiffness_n_per_m};
}

HeldObject FoamGrip::held(const std::vector<RigidBody>& bodies) const {
  if (state_ != GripState::kHolding && state_ != GripState::kSlipping) return {};
  if (bodies[static_cast<std::size_t>(object_)].is_ring()) return {};
  const Vec3 half = bodies[static_cast<std::size_t>(object_)].half;
  Eigen::Index along = 0;
  half.maxCoeff(&along);
  const double radius = std::min(half[(along + 1) % 3], half[(along + 2) % 3]);
  const Vec3 reach = X_IO_.R.col(along) * (half[along] - radius);
  return {X_IO_.p + reach, X_IO_.p - reach, radius};
}

GripHold FoamGrip::hold(const std::vector<RigidBody>& bodies, double stiffness_n_per_m) const {
  if (state_ != GripState::kHolding && state_ != GripState::kSlipping) return {};
  const RigidBody& body = bodies[static_cast<std::size_t>(object_)];
  if (!body.is_ring() || !met_) return {};
  return {X_IO_.p, body.X_TB.p, stiffness_n_per_m};
}

}  // namespace trocar
