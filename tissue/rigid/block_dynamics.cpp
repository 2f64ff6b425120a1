#include "tissue/rigid/block_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissue/rigid/body_contact.h"

namespace trocar {
namespace {

constexpr double kSubStep = 1e-3;  // s
constexpr int kSweeps = 12;
constexpr double kSlop = 2e-5;                           // m of overlap left alone, so that resting contacts persist
constexpr double kPushOut = 0.2;                         // of the overlap a sub-step
constexpr double kFastestPushOut = 0.1;                  // m/s
constexpr double kQuietSpeed = 0.004, kQuietSpin = 0.4;  // m/s, rad/s: slower counts as rest
constexpr double kQuietTime = 0.05;                      // s of rest before sleep

}  // namespace

void BlockDynamics::step(std::vector<RigidBody>& bodies, const std::vector<Pusher>& pushers, double dt_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kSubStep - 1e-9)));
  const double h = dt_s / steps;
  for (int k = 0; k < steps; ++k) {
    for (RigidBody& body : bodies) {
      if (body.moves()) body.half_kick(h);
    }
    collect(bodies, pushers, (steps - 1 - k) * h, h);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (Joint& joint : joints_) solve(bodies, joint, h);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      RigidBody& body = bodies[i];
      if (!body.moves()) continue;
      body.drift(h);
      settle(body, static_cast<int>(i), h);
      if (body.moves()) body.half_kick(h);
    }
  }
}

void BlockDynamics::collect(std::vector<RigidBody>& bodies, const std::vector<Pusher>& pushers, double ahead_s,
                            double dt_s) {
  joints_.clear();
  const int count = static_cast<int>(bodies.size());
  for (int i = 0; i < count; ++i) {
    RigidBody& body = bodies[static_cast<std::size_t>(i)];
    if (!body.carried) collect_pushes(body, i, pushers, ahead_s, dt_s);
  }
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) collect_pair(bodies, i, j, dt_s);
    const RigidBody& body = bodies[static_cast<std::size_t>(i)];
    if (!body.moves()) continue;
    collect_pegs(body, i);
    const RigidContacts floor = body_plane(body, settings_.floor_z_m + kSlop);
    for (int c = 0; c < floor.count; ++c) {
      Joint joint{i, -1, floor.at[static_cast<std::size_t>(c)]};
      joint.friction = settings_.friction;
      joint.most = std::numeric_limits<double>::infinity();
      joints_.push_back(joint);
    }
  }
}

void BlockDynamics::collect_pegs(const RigidBody& body, int index) {
  const double reach = body.half.norm() + body.half.x();
  for (const PegPost& peg : settings_.pegs) {
    if ((peg.foot_T - body.X_TB.p).head<2>().norm() > reach) continue;
    const RigidContacts touch = capsule_body(capsule_of(peg), body);
    for (int c = 0; c < touch.count; ++c) {
      Joint joint{index, -1, touch.at[static_cast<std::size_t>(c)]};
      joint.contact.normal_T = -joint.contact.normal_T;  // from the peg to the body
      joint.friction = settings_.peg_friction;
      joint.most = std::numeric_limits<double>::infinity();
      joints_.push_back(joint);
    }
  }
}

void BlockDynamics::collect_pushes(RigidBody& body, int index, const std::vector<Pusher>& pushers, double ahead_s,
                                   double dt_s) {
  for (const Pusher& pusher : pushers) {
    if (pusher.spares == index) continue;
    const auto back = [&](const Vec3& point) -> Vec3 {  // where the point was `ahead_s` before the end of the step
      return point - ahead_s * (pusher.velocity_T + pusher.spin_T.cross(point - pusher.about_T));
    };
    const CapsuleShape shape{back(pusher.shape.from_T), back(pusher.shape.to_T), pusher.shape.radius_m};
    RigidContacts touch = capsule_body(shape, body);
    if (touch.count == 0) continue;
    body.wake();
    RigidContact& contact = touch.at[0];
    contact.normal_T = -contact.normal_T;  // from the pusher to the block
    Joint joint{index, -1, contact};
    joint.friction = settings_.friction;
    joint.other_T = pusher.velocity_T + pusher.spin_T.cross(contact.point_T - pusher.about_T);
    joint.most = settings_.push_stiffness_n_per_m * contact.depth_m * dt_s;
    joints_.push_back(joint);
  }
}

void BlockDynamics::collect_pair(std::vector<RigidBody>& bodies, int a, int b, double dt_s) {
  RigidBody &first = bodies[static_cast<std::size_t>(a)], &second = bodies[static_cast<std::size_t>(b)];
  const bool still = !first.moves() && !second.moves();
  if (still && !first.carried && !second.carried) return;
  const RigidContacts touch = body_body(first, second, kSlop);  // keeps resting contacts, as the slop of the floor does
  for (int c = 0; c < touch.count; ++c) {
    Joint joint{a, b, touch.at[static_cast<std::size_t>(c)]};
    joint.friction = settings_.friction;
    joint.most = std::numeric_limits<double>::infinity();
    const bool kinematic = first.carried || second.carried;
    if (kinematic) joint.most = settings_.push_stiffness_n_per_m * joint.contact.depth_m * dt_s;
    joints_.push_back(joint);
  }
  if (touch.count == 0) return;
  const auto rouse = [](RigidBody& sleeper, const RigidBody& other) {
    const bool settling = other.moves() && other.quiet_s > 0;  // what comes to rest on a sleeper lets it sleep
    if (sleeper.asleep && !sleeper.carried && !settling) sleeper.wake();
  };
  rouse(first, second);
  rouse(second, first);
}

void BlockDynamics::solve(std::vector<RigidBody>& bodies, Joint& joint, double dt_s) const {
  RigidBody& a = bodies[static_cast<std::size_t>(joint.a)];
  RigidBody* b = joint.b < 0 ? nullptr : &bodies[static_cast<std::size_t>(joint.b)];
  const Vec3 point = joint.contact.point_T, n = joint.contact.normal_T;
  const auto relative = [&]() -> Vec3 { return a.velocity_at(point) - (b ? b->velocity_at(point) : joint.other_T); };
  const auto yielding = [&](const Vec3& direction) {  // speed change per impulse along the direction
    double sum = 0;
    for (const RigidBody* body : {static_cast<const RigidBody*>(&a), static_cast<const RigidBody*>(b)}) {
      if (!body || !body->moves()) continue;
      const Vec3 lever = (point - body->X_TB.p).cross(direction);
      sum += 1 / body->mass_kg + lever.dot(body->inverse_inertia() * lever);
    }
    return sum;
  };
  const auto apply = [&](const Vec3& impulse) {
    if (a.moves()) a.apply(impulse, point);
    if (b && b->moves()) b->apply(-impulse, point);
  };
  const double give = yielding(n);
  if (give <= 0) return;
  const double out = std::min(kFastestPushOut, kPushOut * std::max(0.0, joint.contact.depth_m - kSlop) / dt_s);
  const double wanted = joint.pushed + (out - relative().dot(n)) / give;
  const double pushed = std::clamp(wanted, 0.0, joint.most);
  apply((pushed - joint.pushed) * n);
  joint.pushed = pushed;

  const Vec3 sliding = relative() - relative().dot(n) * n;
  const double speed = sliding.norm();
  if (speed < 1e-9) return;
  const Vec3 direction = sliding / speed;
  Vec3 rubbed = joint.rubbed - direction * (speed / yielding(direction));
  const double limit = joint.friction * joint.pushed;
  if (rubbed.norm() > limit) rubbed *= limit / rubbed.norm();
  apply(rubbed - joint.rubbed);
  joint.rubbed = rubbed;
}

void BlockDynamics::settle(RigidBody& body, int index, double dt_s) const {
  const bool quiet = body.velocity_T.norm() < kQuietSpeed && body.spin_T.norm() < kQuietSpin;
  const bool supported = std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    return (joint.a == index || joint.b == index) && joint.pushed > 0 && std::abs(joint.contact.normal_T.z()) > 0.5;
  });
  body.quiet_s = quiet && supported ? body.quiet_s + dt_s : 0;
  if (body.quiet_s < kQuietTime) return;
  body.asleep = true;
  body.velocity_T.setZero();
  body.spin_T.setZero();
}

}  // namespace trocar
