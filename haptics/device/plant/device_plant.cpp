#include "haptics/device/plant/device_plant.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <type_traits>
#include <utility>

namespace trocar {
namespace {

/// What drives the pinch's motor instead of an amplifier, where there is such a thing.
PlantParameters behind_servo_driver(PlantParameters p) {
  if (p.options.pinch.driver_lag > 0) p.amplifier_time_constant = p.options.pinch.driver_lag;
  return p;
}

template <class T, std::size_t... I>
std::array<T, kChannels> per_channel(const PlantParameters& p, std::index_sequence<I...>) {
  if constexpr (std::is_same_v<T, PlantMotor>) {
    return {T(p.channel[I], I == kPinchChannel ? behind_servo_driver(p) : p)...};
  } else {
    return {T(I < kArmJoints ? friction_behind_cable(p.channel[I].friction, p.options.cable[I % kArmJoints])
                             : p.channel[I].friction)...};
  }
}

double rotor_at_joint(const ChannelParameters& c) { return c.rotor_inertia / (c.ratio * c.ratio); }

template <std::size_t... I>
std::array<PlantCable, kArmJoints> cables(const PlantParameters& p, std::index_sequence<I...>) {
  return {PlantCable(p.options.cable[I], rotor_at_joint(p.channel[I]), p.channel[I].friction)...};
}

Mat3 point_inertia(double mass, const Vec3& r) {
  return mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
}

bool finite(const ExternalLoad& load) {
  return load.stylus_B.force.allFinite() && load.stylus_B.moment.allFinite() && std::isfinite(load.jaw_force_n);
}

}  // namespace

DevicePlant::DevicePlant(const PlantParameters& parameters)
    : p_(parameters),
      gravity_W_(-p_.gravity * base_rotation_WB().col(2)),
      stylus_inertia_(stylus_inertia_tensor(p_)),
      cable_(cables(p_, std::make_index_sequence<kArmJoints>{})),
      friction_(per_channel<PlantFriction>(p_, std::make_index_sequence<kChannels>{})),
      motor_(per_channel<PlantMotor>(p_, std::make_index_sequence<kChannels>{})),
      gear_(p_) {
  const JointVector home = home_joint_angles(p_.link1, p_.link2);
  const Mat3 R_PB = configuration_at(home).q_WP.toRotationMatrix().transpose() * base_rotation_WB();
  platform_inertia_P_ = p_.platform_inertia * Mat3::Identity();
  for (const PlatformMass& m : p_.platform_masses) {
    const Vec3 r_P = R_PB * m.position_home;
    platform_moment_P_ += m.mass * r_P;
    platform_inertia_P_ += point_inertia(m.mass, r_P);
  }
  for (int i = 0; i < kArmJoints; ++i) {
    if (!cable_[i].elastic()) rotor_[i] = rotor_at_joint(p_.channel[i]);
  }
  place(home, p_.jig_jaw_opening);
}

void DevicePlant::place(const JointVector& q, double jaw_opening) noexcept {
  configuration_ = configuration_at(q);
  nu_.setZero();
  nu_dot_.setZero();
  jaw_ = jaw_opening;
  jaw_rate_ = 0;
  for (PlantFriction& f : friction_) f.reset();
  for (PlantMotor& m : motor_) m.cut();
  refresh();
  for (int i = 0; i < kArmJoints; ++i) cable_[i].place(q[i]);
  gear_.place(jaw_);
}

void DevicePlant::set_joint_rates(const JointVector& qd) noexcept {
  nu_.head<3>() = kinematics_.Sp.inverse() * qd.head<3>();
  nu_.tail<3>() = qd.tail<3>();
  nu_dot_.setZero();
  for (int i = 0; i < kArmJoints; ++i) cable_[i].place(cable_[i].angle(), qd[i]);
}

void DevicePlant::clamp(bool held) noexcept {
  clamped_ = held;
  if (held) {
    nu_.setZero();
    nu_dot_.setZero();
    jaw_rate_ = 0;
  }
}

void DevicePlant::enable_amplifiers(bool enabled) noexcept {
  enabled_ = enabled;
  if (!enabled) {
    for (PlantMotor& m : motor_) m.cut();
  }
}

PlantStatus DevicePlant::step(double dt, const ExternalLoad& load) noexcept {
  const bool usable = finite(load);
  const ExternalLoad accepted = usable ? load : ExternalLoad{};
  if (clamped_) {
    hold(dt);
  } else {
    drift(0.5 * dt);
    refresh();
    kick(dt, accepted);
    drift(0.5 * dt);
    refresh();
    step_pinch(dt, accepted.jaw_force_n);
  }
  return usable ? PlantStatus::kOk : PlantStatus::kNonFiniteLoad;
}

/// Load of one motor at its output over the coming step.
double DevicePlant::drive(int channel, double rate, double dt) noexcept {
  if (enabled_) return motor_[channel].advance(volts_[channel], rate, dt);
  motor_[channel].rest(dt);
  return 0.0;
}

/// One step in the jig: joints and jaw stand; the rotors behind elastic cables still turn against them.
void DevicePlant::hold(double dt) noexcept {
  const JointVector q = angles();
  for (int i = 0; i < kChannels; ++i) {
    if (i == kPinchChannel || !cable_[i].elastic()) {
      drive(i, 0.0, dt);
      continue;
    }
    PlantCable& cable = cable_[i];
    cable.drift(0.5 * dt);
    cable.linearise(q[i], 0.0, drive(i, cable.rate(), dt), dt);
    cable.advance(0.0, dt);
    cable.drift(0.5 * dt);
  }
}

void DevicePlant::drift(double dt) noexcept {
  for (PlantCable& cable : cable_) {
    if (cable.elastic()) cable.drift(dt);
  }
  const Vec3 half = 0.5 * dt * nu_.head<3>();  // (1, w dt/2) normalised: third-order error in w dt
  const Eigen::Quaterniond turn(1.0, half[0], half[1], half[2]);
  configuration_.q_WP = (turn * configuration_.q_WP).normalized();
  configuration_.serial += dt * nu_.tail<3>();
}

void DevicePlant::refresh() noexcept { kinematics_ = evaluate_kinematics(configuration_, p_.link1, p_.link2); }

Mat6 DevicePlant::rigid_mass(const PlantKinematics& k) const noexcept {
  const Vec3 com = k.p6 + k.R_W6 * p_.stylus_com;
  const NuJacobian Jv = stylus_point_jacobian(k, com);
  const NuJacobian Jw = stylus_angular_jacobian(k);
  const Mat3 I6 = k.R_W6 * stylus_inertia_ * k.R_W6.transpose();
  Mat6 M = p_.stylus_mass * Jv.transpose() * Jv + Jw.transpose() * I6 * Jw;
  M.topLeftCorner<3, 3>() += k.R_WP * platform_inertia_P_ * k.R_WP.transpose();
  M.topLeftCorner<3, 3>() += k.Sp.transpose() * rotor_.head<3>().asDiagonal() * k.Sp;
  for (int i = 3; i < kArmJoints; ++i) M(i, i) += rotor_[i];
  return M;
}

Vec6 DevicePlant::bias(const PlantKinematics& k, const Vec6& nu) const noexcept {
  const Vec3 w = nu.head<3>();
  Vec6 h = Vec6::Zero();
  // Platform group about O.
  const Mat3 I_P = k.R_WP * platform_inertia_P_ * k.R_WP.transpose();
  h.head<3>() = w.cross(I_P * w) - (k.R_WP * platform_moment_P_).cross(gravity_W_);
  h.head<3>() += k.Sp.transpose() * rotor_.head<3>().cwiseProduct(shoulder_bias(k, w));
  // Stylus group: accelerations that remain when nu' = 0.
  const Vec3 link = k.p6 - k.p4, swing = nu[3] * k.z4.cross(link);
  const Vec3 a6 = w.cross(w.cross(k.p6)) + 2.0 * w.cross(swing) + nu[3] * k.z4.cross(swing);
  const double flex = nu[3] + nu[4];
  const Vec3 w5 = w + flex * k.z4;
  const Vec3 w6 = w5 + nu[5] * k.z6;
  const Vec3 alpha6 = flex * w.cross(k.z4) + nu[5] * w5.cross(k.z6);
  const Vec3 offset = k.R_W6 * p_.stylus_com;
  const Vec3 a_com = a6 + alpha6.cross(offset) + w6.cross(w6.cross(offset));
  const Mat3 I6 = k.R_W6 * stylus_inertia_ * k.R_W6.transpose();
  h += stylus_point_jacobian(k, k.p6 + offset).transpose() * (p_.stylus_mass * (a_com - gravity_W_));
  h += stylus_angular_jacobian(k).transpose() * (I6 * alpha6 + w6.cross(I6 * w6));
  return h;
}

Vec6 DevicePlant::to_joint_rates(const PlantKinematics& k, const Vec6& nu) const noexcept {
  Vec6 qd = nu;
  qd.head<3>() = k.Sp * nu.head<3>();
  return qd;
}

Vec6 DevicePlant::from_joint_loads(const PlantKinematics& k, const Vec6& tau) const noexcept {
  Vec6 load = tau;
  load.head<3>() = k.Sp.transpose() * tau.head<3>();
  return load;
}

DevicePlant::Resistances DevicePlant::resist(const JointVector& q, const JointVector& qd, double dt) noexcept {
  Resistances r;
  for (int i = 0; i < kArmJoints; ++i) {
    const ResistanceLine& rub = r.friction[i] = friction_[i].linearise(qd[i], dt);
    const ResistanceLine stop = stop_resistance(p_.channel[i].stop, q[i], qd[i]);
    r.constant[i] = rub.constant + stop.constant;
    r.slope[i] = rub.slope + stop.slope;
  }
  return r;
}

void DevicePlant::kick(double dt, const ExternalLoad& load) noexcept {
  const PlantKinematics& k = kinematics_;
  const JointVector qd = to_joint_rates(k, nu_), q = joint_angles(configuration_, k);
  Resistances r = resist(q, qd, dt);
  JointVector tau = -r.constant;
  for (int i = 0; i < kArmJoints; ++i) {
    if (!cable_[i].elastic()) {
      tau[i] += drive(i, qd[i], dt);
      continue;
    }
    const ResistanceLine pull = cable_[i].linearise(q[i], qd[i], drive(i, cable_[i].rate(), dt), dt);
    tau[i] -= pull.constant;
    r.slope[i] += pull.slope;
  }
  const Mat3& R_WB = base_rotation_WB();
  Vec6 load_nu = from_joint_loads(k, tau) - bias(k, nu_ + 0.5 * dt * nu_dot_);
  load_nu += stylus_point_jacobian(k, k.p6).transpose() * (R_WB * load.stylus_B.force);
  load_nu += stylus_angular_jacobian(k).transpose() * (R_WB * load.stylus_B.moment);

  const Mat6 M = rigid_mass(k);
  Mat6 A = M;  // M + dt S^T D S
  A.topLeftCorner<3, 3>() += dt * (k.Sp.transpose() * r.slope.head<3>().asDiagonal() * k.Sp);
  for (int i = 3; i < kArmJoints; ++i) A(i, i) += dt * r.slope[i];
  const Eigen::LLT<Mat6> factor(A);
  const Vec6 nu_old = nu_;
  nu_ = factor.solve(M * nu_old + dt * load_nu);
  const bool elastic = advance_cables(to_joint_rates(k, nu_), dt);  // what pulled the joint pulls the rotor
  // The blow of a leg is shorter than any swing of a cable: it meets the bare mass.
  stop_legs(elastic ? Eigen::LLT<Mat6>(M) : factor);
  nu_dot_ = (nu_ - nu_old) / dt;
  const JointVector qd_new = to_joint_rates(k, nu_);
  for (int i = 0; i < kArmJoints; ++i) {
    friction_[i].advance(qd_new[i], dt);
    dissipated_j_ += dt * r.friction[i].at(qd_new[i]) * qd_new[i];
    if (cable_[i].elastic()) dissipated_j_ += dt * cable_[i].taken_w(qd_new[i]);
  }
}

bool DevicePlant::advance_cables(const JointVector& qd_new, double dt) noexcept {
  bool any = false;
  for (int i = 0; i < kArmJoints; ++i) {
    if (!cable_[i].elastic()) continue;
    cable_[i].advance(qd_new[i], dt);
    any = true;
  }
  return any;
}

void DevicePlant::stop_legs(const Eigen::LLT<Mat6>& mass) noexcept {
  const PlantKinematics& k = kinematics_;
  for (int pass = 0; pass < 2; ++pass) {  // two legs can meet at once
    for (int i = 0; i < 3; ++i) {
      if (k.b[i] > p_.leg_stop) continue;
      Vec6 n = Vec6::Zero();  // b_i' = n . nu
      n.head<3>() = k.R_WP.col(i).cross(k.UxW.col(i));
      const double closing = n.dot(nu_);
      if (closing >= 0) continue;
      const Vec6 kick_back = mass.solve(n);
      nu_ -= kick_back * (closing / n.dot(kick_back));
    }
  }
}

void DevicePlant::step_pinch(double dt, double force) noexcept {
  const ChannelParameters& c = p_.channel[kPinchChannel];
  jaw_ += 0.5 * dt * jaw_rate_;
  const ResistanceLine rub = friction_[kPinchChannel].linearise(jaw_rate_, dt);
  const ResistanceLine stop = stop_resistance(c.stop, jaw_, jaw_rate_);
  const double motor = drive(kPinchChannel, gear_.loose() ? gear_.rate() : jaw_rate_, dt);
  const double push = force - rub.constant - stop.constant + (gear_.loose() ? 0 : motor);
  const double mass = p_.jaw_mass + (gear_.loose() ? 0 : c.rotor_inertia / (c.ratio * c.ratio));
  const double moved = mass + dt * (rub.slope + stop.slope);
  jaw_rate_ = (mass * jaw_rate_ + dt * push) / moved;
  if (gear_.loose()) jaw_rate_ = gear_.advance(motor, jaw_, jaw_rate_, moved, dt);
  friction_[kPinchChannel].advance(jaw_rate_, dt);
  jaw_ += 0.5 * dt * jaw_rate_;
}

JointVector DevicePlant::rates() const noexcept { return to_joint_rates(kinematics_, nu_); }

StylusMotion DevicePlant::motion() const noexcept {
  const PlantKinematics& k = kinematics_;
  const Mat3 R_BW = base_rotation_WB().transpose();
  StylusMotion m;
  m.X_BS = stylus_pose(k);
  const Vec3 w = nu_.head<3>();
  m.V_BS.linear = R_BW * (w.cross(k.p6) + nu_[3] * k.z4.cross(k.p6 - k.p4));
  m.V_BS.angular = R_BW * (w + (nu_[3] + nu_[4]) * k.z4 + nu_[5] * k.z6);
  m.jaw = jaw_;
  m.jaw_rate = jaw_rate_;
  return m;
}

ChannelVector DevicePlant::outputs() const noexcept {
  ChannelVector out;
  out << angles(), jaw_;
  return out;
}

ChannelVector DevicePlant::motor_outputs() const noexcept {
  ChannelVector out = outputs();
  for (int i = 0; i < kArmJoints; ++i) {
    if (cable_[i].elastic()) out[i] = cable_[i].angle();
  }
  if (gear_.loose()) out[kPinchChannel] = gear_.at();
  return out;
}

ChannelVector DevicePlant::windings_c() const noexcept {
  ChannelVector out;
  for (int i = 0; i < kChannels; ++i) out[i] = motor_[i].heat().winding_c();
  return out;
}

ChannelVector DevicePlant::cases_c() const noexcept {
  ChannelVector out;
  for (int i = 0; i < kChannels; ++i) out[i] = motor_[i].heat().case_c();
  return out;
}

ChannelVector DevicePlant::motor_loads() const noexcept {
  ChannelVector loads;
  for (int i = 0; i < kChannels; ++i) loads[i] = motor_[i].output_load();
  return loads;
}

Mat6 DevicePlant::mass_matrix() const noexcept { return rigid_mass(kinematics_); }

double DevicePlant::energy() const noexcept {
  const PlantKinematics& k = kinematics_;
  const Vec3 moment = k.R_WP * platform_moment_P_ + p_.stylus_mass * (k.p6 + k.R_W6 * p_.stylus_com);
  double energy = 0.5 * nu_.dot(rigid_mass(k) * nu_) - gravity_W_.dot(moment);
  const JointVector q = angles();
  for (int i = 0; i < kArmJoints; ++i) {
    if (cable_[i].elastic()) energy += cable_[i].energy(q[i]);
  }
  return energy;
}

double DevicePlant::cable_loss() const noexcept {
  const JointVector qd = rates();
  double loss = 0;
  for (int i = 0; i < kArmJoints; ++i) {
    if (cable_[i].elastic()) loss += cable_[i].loss(qd[i]);
  }
  return loss;
}

JointVector DevicePlant::holding_torque() const {
  JointVector tau = bias(kinematics_, Vec6::Zero());
  tau.head<3>() = kinematics_.Sp.transpose().partialPivLu().solve(tau.head<3>().eval());
  return tau;
}

Mat6 DevicePlant::joint_jacobian() const {
  const Mat3 R_BW = base_rotation_WB().transpose();
  Mat6 J;
  J << R_BW * stylus_point_jacobian(kinematics_, kinematics_.p6), R_BW * stylus_angular_jacobian(kinematics_);
  J.leftCols<3>() = (J.leftCols<3>() * kinematics_.Sp.inverse()).eval();
  return J;
}

}  // namespace trocar
