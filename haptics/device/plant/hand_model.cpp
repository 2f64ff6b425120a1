#include "haptics/device/plant/hand_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/device/plant/plant_random.h"

namespace trocar {
namespace {

// Rotation vector of a unit quaternion, the short way round.
Vec3 rotation_vector(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  if (sine < 1e-9) return 2.0 * sign * q.vec();
  return (2.0 * sign * std::atan2(sine, sign * q.w()) / sine) * q.vec();
}

Eigen::Quaterniond turn_by(const Vec3& v) {
  const double angle = v.norm();
  const double scale = angle < 1e-9 ? 0.5 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = scale * v;
  return q;
}

Vec3 limited(const Vec3& v, double limit) {
  const double size = v.norm();
  return size > limit ? Vec3(v * (limit / size)) : v;
}

bool finite(const Pose& X) { return X.R.allFinite() && X.p.allFinite(); }

}  // namespace

HandParameters hand_parameters(GripPreset grip) {
  HandParameters p;
  switch (grip) {
    case GripPreset::kFingertip:
      p.grip_stiffness = 60, p.grip_damping = 0.3;
      p.turn_stiffness = 1.0, p.turn_damping = 0.035;
      break;
    case GripPreset::kLight:
      p.grip_stiffness = 150, p.grip_damping = 0.7;
      p.turn_stiffness = 1.2, p.turn_damping = 0.038;
      break;
    case GripPreset::kNormal:
      break;
    case GripPreset::kFirm:  // middle of the published ranges
      p.grip_stiffness = 900, p.grip_damping = 5;
      p.hand_mass = 0.5, p.arm_damping = 7, p.arm_stiffness = 215;
      p.turn_stiffness = 2.0, p.turn_damping = 0.049;
      break;
  }
  return p;
}

HandParameters draw_hand_parameters(GripPreset grip, std::uint64_t seed) {
  HandParameters p = hand_parameters(grip);
  PlantRandom random(seed);
  for (double* value : {&p.grip_stiffness, &p.grip_damping, &p.hand_mass, &p.arm_damping, &p.arm_stiffness,
                        &p.turn_stiffness, &p.turn_damping, &p.finger_stiffness, &p.finger_damping}) {
    *value *= random.log_normal(0.3);
  }
  return p;
}

HandModel::HandModel(const HandParameters& parameters, std::uint64_t tremor_seed)
    : p_(parameters), acting_(parameters), reaction_(parameters.reaction) {
  PlantRandom random(tremor_seed);
  for (auto& axis : waves_) {
    for (Wave& wave : axis) {
      const double hertz = 10.0 + random.symmetric(2.0);
      wave = {2.0 * std::numbers::pi * hertz, 2.0 * std::numbers::pi * random.unit(), 1.0 / kWaves};
    }
  }
}

void HandModel::set_parameters(const HandParameters& parameters) noexcept {
  p_ = acting_ = parameters;
  reaction_.set_parameters(parameters.reaction);
}

void HandModel::let_go() noexcept {
  intent_ = Intent::kNone;
  reaction_.reset();
  acting_ = p_;
}

void HandModel::set_intent(const Pose& X_BS, double jaw_opening_m, double period_s) noexcept {
  if (!finite(X_BS) || !std::isfinite(jaw_opening_m) || !(period_s > 0)) {
    intent_ = Intent::kBroken;
    return;
  }
  wanted_ = X_BS.p;
  wanted_turn_ = Eigen::Quaterniond(X_BS.R).normalized();
  wanted_jaw_ = jaw_opening_m;
  wanted_period_ = period_s;
  if (intent_ != Intent::kHolding) {
    intent_ = Intent::kTaking;  // starts at the stylus, which the next update shows
    return;
  }
  const double share = std::min(1.0, elapsed_ / period_);
  from_ += share * step_;
  from_turn_ = (turn_by(share * turn_step_) * from_turn_).normalized();
  jaw_from_ += share * jaw_step_;
  plan();
}

void HandModel::plan() noexcept {
  step_ = wanted_ - from_;
  turn_step_ = rotation_vector(wanted_turn_ * from_turn_.conjugate());
  jaw_step_ = wanted_jaw_ - jaw_from_;
  period_ = std::max({wanted_period_, step_.norm() / p_.speed_limit, turn_step_.norm() / p_.turn_speed_limit,
                      std::abs(jaw_step_) / p_.finger_speed_limit});
  elapsed_ = 0;
}

void HandModel::take_hold(const StylusMotion& tool) noexcept {
  hand_ = tool.X_BS.p;
  hand_rate_ = tool.V_BS.linear;
  from_ = tool.X_BS.p;
  from_turn_ = Eigen::Quaterniond(tool.X_BS.R).normalized();
  jaw_from_ = tool.jaw;
  plan();
  intent_ = Intent::kHolding;
}

void HandModel::tremble(Vec3& displacement, Vec3& velocity) const noexcept {
  displacement.setZero();
  velocity.setZero();
  if (p_.tremor_m == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Wave& wave : waves_[axis]) {
      const double angle = wave.rate * time_ + wave.phase;
      displacement[axis] += p_.tremor_m * wave.amplitude * std::sin(angle);
      velocity[axis] += p_.tremor_m * wave.amplitude * wave.rate * std::cos(angle);
    }
  }
}

Vec3 HandModel::pull(const StylusMotion& tool, double share, double moving, double dt) noexcept {
  Vec3 shake, shake_rate;
  tremble(shake, shake_rate);
  const Vec3 grip = acting_.grip_stiffness * (hand_ + shake - tool.X_BS.p) +
                    acting_.grip_damping * (hand_rate_ + shake_rate - tool.V_BS.linear);
  const Vec3 force = limited(grip, p_.force_limit_n);
  const Vec3 goal = from_ + share * step_;
  const Vec3 goal_rate = (moving / period_) * step_;
  // Semi-implicit: damping of the arm at the new rate, position with the new rate.
  const Vec3 drive = acting_.arm_stiffness * (goal - hand_) + acting_.arm_damping * goal_rate - force;
  hand_rate_ = (p_.hand_mass * hand_rate_ + dt * drive) / (p_.hand_mass + dt * acting_.arm_damping);
  hand_ += dt * hand_rate_;
  return force;
}

Vec3 HandModel::turn(const StylusMotion& tool, double share, double moving) const noexcept {
  const Eigen::Quaterniond goal = turn_by(share * turn_step_) * from_turn_;
  const Eigen::Quaterniond now(tool.X_BS.R);
  const Vec3 error = rotation_vector(goal * now.conjugate());
  const Vec3 rate_error = (moving / period_) * turn_step_ - tool.V_BS.angular;
  return limited(acting_.turn_stiffness * error + acting_.turn_damping * rate_error, p_.moment_limit_nm);
}

void HandModel::react(const Vec3& force, double dt) noexcept {
  reaction_.feel(force, dt);
  const double reflex = 1 + (p_.reaction.reflex_gain - 1) * reaction_.reflex(), closed = reaction_.firmness();
  const HandParameters firm = hand_parameters(GripPreset::kFirm);
  const auto towards = [&](double own, double stiff) { return own + closed * std::max(0.0, stiff - own); };
  acting_.grip_stiffness = towards(p_.grip_stiffness, firm.grip_stiffness);
  acting_.grip_damping = towards(p_.grip_damping, firm.grip_damping);
  acting_.turn_stiffness = towards(p_.turn_stiffness, firm.turn_stiffness);
  acting_.turn_damping = towards(p_.turn_damping, firm.turn_damping);
  acting_.arm_stiffness = std::max(reflex * p_.arm_stiffness, towards(p_.arm_stiffness, firm.arm_stiffness));
  acting_.arm_damping = std::max(reflex * p_.arm_damping, towards(p_.arm_damping, firm.arm_damping));
}

ExternalLoad HandModel::update(const StylusMotion& tool, double dt) noexcept {
  time_ += dt;
  if (!holding()) return {};
  if (intent_ == Intent::kTaking) take_hold(tool);
  elapsed_ += dt;
  const double share = std::min(1.0, elapsed_ / period_);
  const double moving = elapsed_ <= period_ * (1 + 1e-9) ? 1.0 : 0.0;
  ExternalLoad load;
  load.stylus_B.force = pull(tool, share, moving, dt);
  if (p_.reaction.on) react(load.stylus_B.force, dt);
  load.stylus_B.moment = turn(tool, share, moving);
  const double squeeze = p_.finger_stiffness * (jaw_from_ + share * jaw_step_ - tool.jaw) +
                         p_.finger_damping * (moving / period_ * jaw_step_ - tool.jaw_rate);
  load.jaw_force_n = std::clamp(squeeze, -p_.finger_limit_n, p_.finger_limit_n);
  return load;
}

}  // namespace trocar
