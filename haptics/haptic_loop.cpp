#include "haptics/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "haptics/control/gravity.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/loop_check.h"

namespace trocar {

DacFrame HapticLoop::tick(const DaqSample& in, const ContactPatch& patch, TickRecord& record) noexcept {
  const Motion motion = measure(in);                                // counts -> angles -> ArmState -> rates -> twist
  Contact contact = feel(motion, patch);                            // instrument -> tissue, pinch -> tau = J^T F
  TorqueShares shares = hold_up(motion, contact);                   // limit springs and weight, and the room they leave
  shares.contact = make_passive(motion, contact);                   // budget, fed with what was applied
  const LimitedTorque torque = share_out(motion, contact, shares);  // then friction, alignment; rate and size limited
  if (config_.daq.motors) watch(motion, contact, torque);           // faults, heat, warnings
  const DacFrame out = to_codes(torque);                            // volts -> DAC codes; zero unless powered
  publish(in, motion, contact, torque, out, record);
  safety_log_.add(record);
  ++tick_;
  return out;
}

PassivityParameters HapticLoopConfig::pinch_defaults() {
  PassivityParameters p;
  p.viscous_n_s_per_m = 1.0;  // slide and finger pads [assumed]
  p.most_stiffness_n_per_m =
      550;  // [chosen in pinch_budget_test.cpp: more swings between soft fingers, less shows less]
  p.recovery_s = 0.1;
  p.effective_mass_kg = 0.02;  // jaw and finger [assumed]
  return p;
}

namespace {

PassivityParameters with_period(PassivityParameters p, double period_s, int known_delay_periods) {
  p.period_s = period_s;
  p.delay_s = (1 + known_delay_periods) * period_s;  // the seam's own: codes act at the next SYNC
  return p;
}

constexpr double kSmallForce_n = 0.5;  // from which on a contact that was there at arming waits

const HapticLoopConfig& checked(const HapticLoopConfig& config) {
  if (const std::string wrong = loop_refusal(config); !wrong.empty())
    throw std::invalid_argument("haptic loop: " + wrong);
  return config;
}

/// No more is fed forward than friction surely takes.
FrictionFeedForward safe(FrictionFeedForward friction, const DeviceModel& model) {
  friction.share = std::min(friction.share, FrictionFeedForward::kOfSure * model.friction_sure());
  return friction;
}

SureFriction sure_friction(const HapticLoopConfig& config) {
  ChannelVector coulomb, viscous, play;
  coulomb << config.device.coulomb, config.pinch_coulomb_n;
  viscous << config.device.viscous, kSlideAlone;
  play << JointVector::Constant(config.friction.play_rad), config.pinch_play_m;
  return {config.device.friction_sure() * coulomb, config.device.friction_sure() * viscous, play};
}

ChannelVector torque_rates(const HapticLoopConfig& config) {
  ChannelVector rate = ChannelVector::Constant(config.torque_rate);
  rate[kPinchChannel] = config.pinch_force_rate;
  return rate;
}

/// Most counts that each channel can honestly make in one period.
std::array<std::int32_t, kChannels> count_limits(const HapticLoopConfig& config) {
  std::array<std::int32_t, kChannels> limit;
  for (int i = 0; i < kChannels; ++i) {
    const double fastest = i == kPinchChannel ? config.safety.max_pinch_speed : config.safety.max_encoder_rate;
    limit[i] = static_cast<std::int32_t>(
        std::ceil(fastest / (config.daq.rate_hz * count_size(config.device.transmission[i]))));
  }
  return limit;
}

/// A potentiometer trembles where an encoder stands.
SafetyLimits with_noise(const HapticLoopConfig& config) {
  SafetyLimits limits = config.safety;
  limits.homing.still_counts[kPinchChannel] = config.device.pinch.noise_counts;
  return limits;
}

/// NaN or infinity anywhere in the patch: comparisons would swallow it and the force would silently vanish. The same
/// for a material or a vertex that its table does not have, or for more of them than there can be.
bool is_sound(const ContactPatch& patch, bool triangles) {
  if (patch.count < 0 || patch.count > kMaxPatchTriangles) return false;
  if (patch.vertex_count < 0 || patch.vertex_count > kMaxPatchVertices) return false;
  double sum = patch.glide_s + patch.given_j + patch.reach_m + patch.grip.thickness_m + patch.grip.stiffness_n_per_m +
               (patch.held.from_I + patch.held.to_I).sum() + patch.held.radius_m +
               (patch.hold.point_I + patch.hold.anchor_T).sum() + patch.hold.stiffness_n_per_m;
  for (const ContactMaterial& m : patch.material) {
    sum += m.stiffness_n_per_m + m.damping_s_per_m + m.mu_static + m.mu_dynamic + m.stribeck_m_s;
  }
  const RingOnWire& ring = patch.ring;
  if (ring.count < 0 || ring.count > RingOnWire::kMostPoints) return false;
  sum += (ring.centre_I + ring.normal_I).sum() + ring.play_m + ring.stiffness_n_per_m + ring.damping_s_per_m;
  for (std::int32_t i = 0; i < ring.count; ++i) sum += ring.point_T[static_cast<std::size_t>(i)].sum();
  for (int i = 0; triangles && i < patch.count; ++i) {
    const PatchTriangle& t = patch.triangle[i];
    if (t.material < 0 || t.material >= kMaxPatchMaterials) return false;
    for (const std::int16_t corner : t.corner) {
      if (corner < 0 || corner >= patch.vertex_count) return false;
    }
    sum += t.normal.sum();
  }
  for (int i = 0; triangles && i < patch.vertex_count; ++i) {
    sum += patch.vertex[i].sum();
    if (patch.moving) sum += patch.velocity[i].sum();
  }
  return std::isfinite(sum);
}

}  // namespace

HapticLoop::HapticLoop(const HapticLoopConfig& config)
    : config_(checked(config)),
      period_s_(1 / config.daq.rate_hz),
      instrument_(config.map),
      exchange_(std::max<std::int32_t>(1, static_cast<std::int32_t>(config.tools.size()))),
      port_(config.port),
      contact_(config.contact_law, config.tool, {.period_s = period_s_}),
      arm_passivity_(with_period(config.passivity, period_s_, config.known_delay_periods)),
      pinch_(with_period(config.pinch_passivity, period_s_, config.known_delay_periods)),
      pinch_passivity_(pinch_),
      sure_friction_(sure_friction(config)),
      peak_(config.peak, config.device, config.heat),
      limiter_(peak_.most(), torque_rates(config), period_s_),
      supervisor_(with_noise(config), count_limits(config), period_s_, config.device.homing),
      watch_(config.safety, config.device, config.heat, period_s_, config.motors),
      safety_log_(config.daq.rate_hz),
      friction_rates_(config.friction, period_s_) {
  config_.friction = safe(config.friction, config.device);
  jig_ << home_angles(), config.device.pinch_home_m;
  home_ = jig_;
  for (int i = 0; i < kChannels; ++i) {
    count_[i] = count_size(config.device.transmission[i]);
    velocity_.emplace_back(config.velocity, count_[i], period_s_);
  }
  gravity_torque(config_.device, arm_state(home_.head<kArmJoints>()));  // makes the constants of both models now
}

void HapticLoop::reset_fault() noexcept { supervisor_.reset_fault(); }

void HapticLoop::set_passivity_law(PassivityLaw law) noexcept {
  config_.passivity.law = config_.pinch_passivity.law = pinch_.law = law;
  arm_passivity_.set_law(law);
  pinch_passivity_.set_law(law);
}

HapticLoop::Motion HapticLoop::measure(const DaqSample& in) noexcept {
  if (!counting_) {
    counts_.reset(in.counts);
    counting_ = true;
  }
  const auto delta = counts_.advance(in.counts);
  supervisor_.observe(tick_, in, delta);
  if (supervisor_.just_homed()) {
    counts_.reset(in.counts);
    home_ = jig_ + supervisor_.homing().offset().cwiseProduct(count_);
    take_home();
  }
  Motion motion;
  motion.delta = delta;
  motion.periods = std::max<double>(1, in.elapsed_periods);
  motion.q = joint_positions(config_.device, counts_.total(), home_);
  ChannelVector between_counts = ChannelVector::Constant(std::nan(""));
  for (int i = 0; i < kChannels; ++i) {
    motion.qd[i] = velocity_[i].update(counts_.total()[i], in.elapsed_periods, in.edge_age_us[i]);
    if (config_.velocity != VelocityMethod::kEdges || in.edge_age_us[i] == 0) continue;
    between_counts[i] = velocity_[i].position();
    motion.q[i] += count_[i] * (between_counts[i] - 0.5 - static_cast<double>(counts_.total()[i]));
  }
  motion.travel =
      fine_.advance(counts_.total(), motion.qd.cwiseQuotient(count_), motion.periods * period_s_, between_counts)
          .cwiseProduct(count_);
  motion.arm = arm_state(motion.q.head<kArmJoints>());
  const Vec6 twist = motion.arm.J_WS * motion.qd.head<kArmJoints>();
  motion.tip_speed = twist.head<3>().norm();
  const bool clutch = (in.digital_in & kClutch) != 0;
  instrument_.update(motion.arm.X_WS, {twist.head<3>(), twist.tail<3>()}, clutch, motion.periods * period_s_);
  if (exchange_.update((in.digital_in & kExchange) != 0, motion.periods * period_s_))
    contact_.take(config_.tools[static_cast<std::size_t>(exchange_.index())].shape);
  motion.X_TI = instrument_.X_TI();
  motion.V_TI_T = instrument_.V_TI_T();
  periods_ += static_cast<std::uint64_t>(motion.periods);
  return motion;
}

void HapticLoop::take_home() noexcept {
  for (ChannelVelocity& channel : velocity_) channel.reset();
  instrument_.reset();
  port_.reset();
  contact_.reset();
  arm_passivity_.reset();
  pinch_passivity_.reset();
  sure_friction_.reset();
  fine_.reset(counts_.total());
  friction_rates_.reset();
}

HapticLoop::Contact HapticLoop::feel(const Motion& motion, const ContactPatch& patch) noexcept {
  Contact contact;
  if (supervisor_.state() != LoopState::kActive) {
    contact_.reset();
    port_.reset();
    last_port_j_ = patch_age_s_ = 0;
    arm_waits_ = jaws_wait_ = true;
    return contact;
  }
  const bool new_patch = patch.stamp != checked_stamp_;
  patch_age_s_ = new_patch ? 0 : patch_age_s_ + motion.periods * period_s_;
  checked_stamp_ = patch.stamp;
  if (!is_sound(patch, new_patch)) {
    supervisor_.raise(FaultCode::kNonFinite, tick_, -1, patch.material[0].stiffness_n_per_m);
    contact_.reset();
    return contact;
  }
  contact.tissue = contact_.update(motion.X_TI, motion.V_TI_T, patch, motion.q[kPinchChannel] * exchange_.share(),
                                   exchange_.drawn_m());
  contact.grip = grip_block(patch.grip, motion.q[kPinchChannel]);
  const auto torque_of = [&](const Wrench& F) -> JointVector {
    Vec6 w;
    w << F.force, F.moment;
    return motion.arm.J_WS.transpose() * w;
  };
  contact.jaw_share = rendered_share(motion.arm.det_a) * exchange_.share();
  contact.port_share =
      contact.jaw_share * instrument_.share();  // the clutch parts the arm from the scene, not the fingers
  const Wrench whole = instrument_.stylus_wrench(contact.tissue.F_I_T);
  const Wrench spring = instrument_.stylus_wrench(contact.tissue.spring_I_T);
  const JointVector spring_torque = torque_of(spring);
  contact.spring_n = spring.force.norm();
  const double stored_j = config_.map.force_scale * contact.tissue.stored_j;
  if (contact.spring_n > 0 && stored_j > 0) {
    contact.stiffness = contact.spring_n * contact.spring_n / (2 * stored_j);
    contact.limit = stiffness_limit(config_.device, spring_torque / contact.spring_n, contact.stiffness, period_s_,
                                    (1 + config_.known_delay_periods) * period_s_);
  }
  arm_waits_ = arm_waits_ && contact.spring_n > kSmallForce_n;
  jaws_wait_ = jaws_wait_ && contact.grip.force_n > kSmallForce_n;
  if (jaws_wait_) contact.jaw_share = 0;
  contact.share = arm_waits_ ? 0 : contact.port_share * (config_.clamp_stiffness ? contact.limit.share : 1);
  contact.commanded_W = whole.force;
  contact.torque.head<kArmJoints>() = contact.share * torque_of(whole);
  if (config_.clamp_stiffness) {
    contact.jaw_share *=
        pinch_stiffness_limit(pinch_, config_.pinch_coulomb_n, count_[kPinchChannel], patch.grip.stiffness_n_per_m)
            .share;
  }
  contact.torque[kPinchChannel] = contact.jaw_share * contact.grip.force_n;
  contact.spring_torque = contact.share * spring_torque;
  feel_port(motion, contact);
  return contact;
}

void HapticLoop::feel_port(const Motion& motion, Contact& contact) noexcept {
  const InstrumentMap& map = instrument_.map();
  if (!map.fulcrum) return;
  const Vec3 u = motion.X_TI.R.col(2);
  const double depth_m = (motion.X_TI.p - map.fulcrum->port_T).dot(u);
  const double roll_rad = motion.V_TI_T.angular.dot(u) * motion.periods * period_s_;
  const Wrench friction = instrument_.stylus_wrench(port_.friction(depth_m, roll_rad, u));
  const double stiffness = config_.port.alignment_n_m_per_rad;
  const Wrench alignment = alignment_wrench(map, instrument_.X_WS(), stiffness);
  Vec6 w;
  w << friction.force, friction.moment;
  contact.port.head<kArmJoints>() = contact.port_share * (motion.arm.J_WS.transpose() * w);
  w << alignment.force, alignment.moment;
  contact.alignment.head<kArmJoints>() = contact.port_share * motion.arm.J_WS.transpose() * w;
  contact.port_stored_j = map.force_scale * port_.stored_j() + alignment_energy_j(map, instrument_.X_WS(), stiffness);
}

double HapticLoop::rendered_share(double det_a) const noexcept {
  if (!config_.daq.motors) return 0;
  return std::min(supervisor_.ramp() * singularity_share(det_a), watch_.contact_share());
}

TorqueShares HapticLoop::hold_up(const Motion& motion, Contact& contact) noexcept {
  TorqueShares shares;
  if (!supervisor_.powered() || !config_.daq.motors) return shares;
  const JointVector qd = motion.qd.head<kArmJoints>();
  shares.springs =
      supervisor_.ramp() * limit_spring_torque(motion.q.head<kArmJoints>(), qd) + watch_.damping(motion.qd);
  if (config_.carry_weight) {
    shares.gravity.head<kArmJoints>() = supervisor_.ramp() * gravity_torque(config_.device, motion.arm);
  }
  shares.contact = contact.torque + contact.port;
  contact.room = limiter_.room(shares);
  return shares;
}

ChannelVector HapticLoop::make_passive(const Motion& motion, const Contact& contact) noexcept {
  const ChannelVector& dq = motion.travel;
  const ChannelVector acted = asked_contact_.acted(static_cast<int>(motion.periods), config_.known_delay_periods);
  const ChannelVector friction_j = sure_friction_.update(dq, motion.qd);
  ContactWork arm;
  // The spring as the motors can render it: beyond their limit its force stays the same and it stores less,
  // E (2 s - s^2) where s of the force is left.
  const double room = contact.room, stored_room = room * (2 - room);
  arm.wanted_n = room * contact.share * contact.spring_n;
  // What the port's springs hold is returned later: only what they lose is absorbed.
  const double port_j = contact.port_share * (contact.port_stored_j - last_port_j_);
  arm.absorbed_j = -acted.head<kArmJoints>().dot(dq.head<kArmJoints>()) - port_j;
  last_port_j_ = contact.port_stored_j;
  arm.friction_j = friction_j.head<kArmJoints>().sum();
  arm.stored_j = stored_room * contact.share * config_.map.force_scale * contact.tissue.stored_j;
  if (arm.wanted_n > 0) {
    const JointVector unit = contact.spring_torque / (contact.share * contact.spring_n);
    arm.dx_m = -unit.dot(dq.head<kArmJoints>());
    arm.speed_m_s = -unit.dot(motion.qd.head<kArmJoints>());
    arm.stiffness = contact.stiffness;
  }
  ContactWork pinch;
  pinch.wanted_n = room * contact.jaw_share * contact.grip.force_n;
  pinch.absorbed_j = -acted[kPinchChannel] * dq[kPinchChannel];
  pinch.friction_j = friction_j[kPinchChannel];
  pinch.dx_m = -dq[kPinchChannel];
  pinch.speed_m_s = -motion.qd[kPinchChannel];
  pinch.stored_j = stored_room * contact.jaw_share * contact.grip.stored_j;

  ChannelVector passive = room * contact.torque;
  const double bounded = arm_passivity_.update(arm), force = compared_law_ ? compared_law_(arm) : bounded;
  if (arm.wanted_n > 0) passive.head<kArmJoints>() *= force / arm.wanted_n;
  passive[kPinchChannel] = pinch_passivity_.update(pinch);
  return passive + contact.port;
}

LimitedTorque HapticLoop::share_out(const Motion& motion, const Contact& contact, TorqueShares shares) noexcept {
  if (!supervisor_.powered() || !config_.daq.motors) {
    limiter_.reset();
    return {};
  }
  const JointVector qd = friction_rates_.update(motion.qd.head<kArmJoints>());
  shares.alignment = contact.alignment;
  // Where the law holds a contact down, friction pays for it: none is fed forward.
  const bool held_down = contact.tissue.contact && !arm_passivity_.leaves_alone(contact.stiffness);
  if (!held_down && arm_passivity_.budget_j() >= -config_.friction.debt_j) {
    shares.friction.head<kArmJoints>() = supervisor_.ramp() * friction_torque(config_.device, config_.friction, qd);
  }
  const LimitedTorque limited = limiter_.update(shares);
  arm_passivity_.delivered(limited.contact_scale);
  pinch_passivity_.delivered(limited.contact_scale);
  return limited;
}

void HapticLoop::watch(const Motion& motion, const Contact& contact, const LimitedTorque& torque) noexcept {
  WatchedTick now;
  now.tick = tick_;
  now.periods = motion.periods;
  now.delta = motion.delta;
  now.qd = motion.qd;
  now.tip_speed = motion.tip_speed;
  now.det_a = motion.arm.det_a;
  now.torque = torque.total;
  now.touching = contact.tissue.contact || contact.grip.force_n > 0;
  now.saturated = now.touching && contact.room * torque.contact_scale < 1;
  now.debt = arm_passivity_.debt_faded() || pinch_passivity_.debt_faded();
  now.patch_age_s = patch_age_s_;
  watch_.update(now, supervisor_);
  limiter_.set_limit(peak_.update(torque.total, watch_.winding_c(), motion.periods * period_s_));
  if (arm_passivity_.debt_fault()) supervisor_.raise(FaultCode::kEnergyDebt, tick_, -1, arm_passivity_.budget_j());
  if (pinch_passivity_.debt_fault()) {
    supervisor_.raise(FaultCode::kEnergyDebt, tick_, kPinchChannel, pinch_passivity_.budget_j());
  }
}

DacFrame HapticLoop::to_codes(const LimitedTorque& torque) noexcept {
  if (!supervisor_.armed()) {
    asked_contact_.clear();
    limiter_.reset();
    return {};
  }
  const DacFrame out = dac_codes(config_.device, torque.total, config_.daq.dac_bits);
  // The observer sees the codes, not the wish, and all in them but weight and limit springs.
  asked_contact_.add(torques_of(config_.device, out, config_.daq.dac_bits) - torque.carried);
  return out;
}

void HapticLoop::publish(const DaqSample& in, const Motion& motion, const Contact& contact, const LimitedTorque& torque,
                         const DacFrame& out, TickRecord& record) const noexcept {
  record.in = in;
  record.out = out;
  record.amplifiers_armed = supervisor_.armed();
  record.q = motion.q;
  record.qd = motion.qd;
  record.torque = supervisor_.armed() ? torque.total : ChannelVector::Zero();
  record.contact_torque = supervisor_.armed() ? torque.contact : ChannelVector::Zero();
  record.det_a = motion.arm.det_a;
  record.k_max_n_per_m = contact.limit.k_max;
  record.stiffness_share = contact.limit.share;
  record.stiffness_n_per_m = contact.stiffness;
  record.winding_c = watch_.hottest_c();
  record.warnings = watch_.warnings();
  if (supervisor_.state() == LoopState::kActive && (arm_waits_ || jaws_wait_))
    record.warnings = static_cast<WarningBits>(record.warnings | bit(LoopWarning::kContactWaits));
  record.contact_scale = contact.room * torque.contact_scale;
  record.stored_j = contact.tissue.stored_j;
  record.min_energy_j = arm_passivity_.min_energy_j();

  StylusState& s = record.stylus;
  s.tick = tick_;
  s.period = periods_;
  s.t_s = static_cast<double>(periods_) * period_s_;
  s.loop = supervisor_.state();
  s.fault = supervisor_.fault();
  s.homing = supervisor_.homing().report();
  s.X_TI = motion.X_TI;
  s.V_TI_T = motion.V_TI_T;
  s.F_I_T = contact.tissue.F_I_T;
  s.jaw_opening_m = motion.q[kPinchChannel];
  s.grip_force_n = contact.grip.force_n;
  s.rendered_grip_n = torque.contact[kPinchChannel];
  publish_instrument(contact, torque, s);
  s.instrument = exchange_.index();
  s.pedal = (in.digital_in & kPedal) != 0 && s.loop == LoopState::kActive && exchange_.in_hand();
  s.contact = contact.tissue.contact;
  s.tip_contact = contact.tissue.tip_contact;
  s.contact_point_T = contact.tissue.point_T;
  s.contact_normal_T = contact.tissue.normal_T;
  s.depth_m = contact.tissue.depth_m;
  s.saturated = record.contact_scale < 1 && s.contact;
  s.passivity_active = arm_passivity_.active();
  s.energy_j = arm_passivity_.energy_j();
}

void HapticLoop::publish_instrument(const Contact& contact, const LimitedTorque& torque,
                                    StylusState& s) const noexcept {
  s.clutched = instrument_.clutched();
  s.port_held = instrument_.held();
  s.registration = instrument_.map().registration;
  if (config_.map.fulcrum) s.depth_in_port_m = (s.X_TI.p - config_.map.fulcrum->port_T).dot(s.X_TI.R.col(2));
  s.commanded_force_T = config_.map.X_TW.R * contact.commanded_W;
  // Of the torque that the scene's contact was to have; the port's friction shares it but is not the scene's contact.
  const double asked = contact.torque.head<kArmJoints>().norm();
  const double left = (torque.contact - torque.contact_scale * contact.port).head<kArmJoints>().norm();
  s.delivered_share = asked > 0 ? contact.share * left / asked : 0;
  s.rendered_force_T = s.delivered_share * s.commanded_force_T;
}

}  // namespace trocar
