#include "app/studies/device/held_stylus.h"

#include <algorithm>
#include <cmath>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kAside = 2.5 * kDegree;  // every joint, from where the fixture comes
constexpr double kWay_s = 0.8, kRest_s = 0.4, kRead_s = 1.0;
constexpr double kMomentNoise = 5e-4;  // N m
constexpr double kFixture_kg = 0.08;   // [assumed]
const Vec3 kFixtureCom_S{0, 0, 0.02};  // m [assumed]

double stay(double) { return 0; }

SimulatedDaqConfig device_of(const HeldStylusConfig& config) {
  SimulatedDaqConfig c;
  c.plant = config.truth;
  c.hand = config.holds;
  return c;
}

}  // namespace

HandParameters stiff_fixture() {
  HandParameters p;
  p.grip_stiffness = 5000, p.grip_damping = 30;
  p.hand_mass = 0.5, p.arm_stiffness = 2e4, p.arm_damping = 200;
  p.turn_stiffness = 60, p.turn_damping = 0.3;
  p.moment_limit_nm = 5;
  p.tremor_m = 0;
  return p;
}

JointVector torques_of_wrench(const ArmState& arm, const Wrench& w_S) {
  Vec6 w;
  w << arm.X_WS.R * w_S.force, arm.X_WS.R * w_S.moment;
  return arm.J_WS.transpose() * w;
}

ForceSensorConfig moment_sensor() {
  ForceSensorConfig c;
  c.noise_n = kMomentNoise, c.drift_n_per_h = 0;
  return c;
}

Wrench HeldStylus::FixtureLoad::at(const Pose& X, double period_s) {
  const Vec3 v = known_ > 0 ? Vec3((X.p - p_) / period_s) : Vec3::Zero();
  const Vec3 a = known_ > 1 ? Vec3((v - v_) / period_s) : Vec3::Zero();
  p_ = X.p, v_ = v, known_ = std::min(2, known_ + 1);
  const Vec3 force = X.R.transpose() * (kFixture_kg * (Vec3(0, 0, -kGravity) - a));
  return {force, kFixtureCom_S.cross(force)};
}

HeldStylus::HeldStylus(const HeldStylusConfig& config)
    : line_(config.line.empty() ? nullptr : std::make_unique<SensorLine>(config.line)),
      daq_(device_of(config)),
      force_(config.force, config.seed),
      moment_(config.moment, config.seed + 1),
      home_(daq_.sense()),
      loop_(
          daq_, [this](const ArmState& arm) { return law_ ? law_(arm) : JointVector(JointVector::Zero()); },
          home_angles(), config.model) {
  run(kRest_s, stay, nullptr);
  if (line_) line_->bias();
}

Wrench HeldStylus::read(const TorqueLaw& law) {
  law_ = law;
  const auto from = [&](double sign) {
    run(
        kWay_s, [&](double s) { return sign * minimum_jerk(s); }, nullptr);
    run(
        kWay_s, [&](double s) { return sign * (1 - minimum_jerk(s)); }, nullptr);
    return read_at_rest();
  };
  const Wrench above = from(1);
  return (above + from(-1)) * 0.5;
}

Wrench HeldStylus::read_as_held(const TorqueLaw& law) {
  law_ = law;
  return read_at_rest();
}

Wrench HeldStylus::read_at_rest() {
  Wrench sum;
  double samples = 0;
  run(kRest_s, stay, nullptr);
  run(kRead_s, stay, [&](const Wrench& reading) { sum = sum + reading, samples += 1; });
  return sum * (1 / samples);
}

void HeldStylus::run(double seconds, const std::function<double(double)>& aside,
                     const std::function<void(const Wrench&)>& take) {
  const double rate = daq_.capabilities().rate_hz;
  const long n = std::lround(seconds * rate), every = std::lround(rate / force_.config().rate_hz);
  for (long k = 1; k <= n; ++k) {
    const double way = aside(static_cast<double>(k) / static_cast<double>(n));
    const Pose from_home = home_pose().inverse() * arm_state(home_angles() + JointVector::Constant(kAside * way)).X_WS;
    daq_.set_hand_intent(home_.X_BS * from_home, home_.jaw_opening_m);
    loop_.tick();
    if (k % every == 0) sample(take);
  }
}

void HeldStylus::sample(const std::function<void(const Wrench&)>& take) {
  const HandSense now = daq_.sense();
  const Mat3 R = now.X_BS.R.transpose();
  if (!line_) {
    const Wrench reading{force_.sample(R * now.force_on_hand).force, moment_.sample(R * now.moment_on_hand).force};
    if (take) take(reading), ++taken_;
    return;
  }
  const double period_s = 1 / force_.config().rate_hz;
  const Wrench hung = true_.at(now.X_BS, period_s);
  const Wrench acting{force_.sample(R * now.force_on_hand + hung.force).force,
                      moment_.sample(R * now.moment_on_hand + hung.moment).force};
  const std::optional<Wrench> reading = line_->pass(acting);
  const Wrench then = remembered(believed_.at(loop_.arm().X_WS, period_s));
  if (!take) return;
  if (reading)
    take(*reading + then * -1), ++taken_;
  else
    ++left_out_;
}

Wrench HeldStylus::remembered(const Wrench& now) {
  hung_.push_back(now);
  const std::size_t back = force_.delay();
  return hung_[hung_.size() > back ? hung_.size() - 1 - back : 0];
}

}  // namespace trocar
