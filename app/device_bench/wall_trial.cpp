#include "app/device_bench/wall_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "haptics/control/gravity.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kToPoseS = 1.2, kRestS = 0.3;
constexpr double kShortRunUp = 0.030, kLongRunUp = 0.075;     // m before the wall; the long one where kFast is asked
constexpr double kFast = 0.55;                                // m/s
constexpr double kQuickestReach = 0.04, kSlowestReach = 4.0;  // s
constexpr double kLongestApproach = 6.0;                      // s until the wall must have been met
constexpr int kHalfWindow = 25;                               // periods at 1 kHz to either side: 50 ms
constexpr double kEndWindow = 0.3;                            // s before the hand leaves in which the display is taken
constexpr double kLeaveS = 0.6, kAfterS = 0.2;                // the way out, and beyond
constexpr double kBesideIdeal = 0.1;                          // s
constexpr double kJointMargin = 8 * kDegree, kLeastDet = 0.35;

double run_up(double speed) { return speed > kFast ? kLongRunUp : kShortRunUp; }

SimulatedDaqConfig device_of(const WallCase& c) {
  SimulatedDaqConfig device = c.device;
  for (ChannelParameters& channel : device.plant->channel) channel.amplifier_gain *= c.gain;
  for (int i = 0; i < kArmJoints; ++i) device.plant->channel[static_cast<std::size_t>(i)].amplifier_gain *= c.peak;
  device.hand = hand_parameters(GripPreset::kFirm);  // leads the arm to its pose; then the case's grip
  device.hand.tremor_m = 0;
  return device;
}

HapticLoopConfig loop_of(const WallCase& c) {
  HapticLoopConfig loop;
  loop.tool.shaft_length_m = 1e-3;  // a ball
  loop.known_delay_periods = c.device.extra_delay_periods;
  if (c.device.edge_times) loop.velocity = VelocityMethod::kEdges;
  for (int i = 0; i < kArmJoints; ++i) {
    Transmission& t = loop.device.transmission[static_cast<std::size_t>(i)];
    t.amps_per_volt *= c.peak, t.max_motor_torque *= c.peak;
  }
  loop.carry_weight = c.compensated;
  if (!c.compensated) loop.friction.share = 0;
  return loop;
}

/// The hand of the case with its grip closed.
HandParameters stiffened(const HandParameters& hand) {
  HandParameters firm = hand_parameters(GripPreset::kFirm);
  firm.tremor_m = hand.tremor_m;
  return firm;
}

/// Centred mean over 50 ms, shorter at the ends.
std::vector<double> slow_part(const std::vector<double>& force, double rate_hz) {
  const int half = static_cast<int>(kHalfWindow * rate_hz / 1000), n = static_cast<int>(force.size());
  std::vector<double> sum(force.size() + 1, 0.0), mean(force.size());
  for (int i = 0; i < n; ++i)
    sum[static_cast<std::size_t>(i) + 1] = sum[static_cast<std::size_t>(i)] + force[static_cast<std::size_t>(i)];
  for (int i = 0; i < n; ++i) {
    const int from = std::max(0, i - half), to = std::min(n, i + half + 1);
    mean[static_cast<std::size_t>(i)] =
        (sum[static_cast<std::size_t>(to)] - sum[static_cast<std::size_t>(from)]) / (to - from);
  }
  return mean;
}

/// What of `value` stands out of the span between `a` and `b`.
double outside(double value, double a, double b) {
  return std::max({0.0, value - std::max(a, b), std::min(a, b) - value});
}

/// RMS of what two first-order high-passes of 30 Hz leave.
double rms_above_30_hz(const std::vector<double>& force, double rate_hz, double seconds) {
  const double gain = 1 / (1 + 2 * std::numbers::pi * 30 / rate_hz);
  const auto n = std::min(force.size(), static_cast<std::size_t>(seconds * rate_hz));
  double once = 0, twice = 0, last = 0, sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = once;
    once = gain * (once + force[i] - last);
    twice = gain * (twice + once - before);
    last = force[i];
    sum += twice * twice;
  }
  return n > 0 ? std::sqrt(sum / static_cast<double>(n)) : 0;
}

/// What one press adds up to, tick by tick.
class Tally {
 public:
  /// @param seconds since touch at which the hand sets out to leave.
  Tally(const WallCase& c, const PlantBench& bench, const Vec3& wall, bool ideal, double seconds)
      : case_(c), bench_(bench), wall_(wall), ideal_(ideal), seconds_(seconds) {}

  bool touched() const { return touched_; }
  double since_touch() const { return bench_.time_s() - touch_s_; }

  void add() {
    const StylusState& s = bench_.record().stylus;
    const StylusMotion motion = bench_.daq().plant().motion();
    const double speed = motion.V_BS.linear.dot(case_.direction);
    const bool contact = ideal_ ? bench_.daq().ideal_wall_n() > 0 : s.contact;
    if (!touched_ && contact) {
      touched_ = true;
      touch_s_ = bench_.time_s();
      observed_before_ = s.energy_j;
      true_before_ = bench_.true_absorbed_j();
      net_before_ = bench_.net_absorbed_j();
      out.touched_at_m_s = speed;
      out.k_max = bench_.record().k_max_n_per_m;
    }
    if (!touched_) return;
    keep(s, (motion.X_BS.p - wall_).dot(case_.direction), speed);
    if (contact && !in_contact_) {
      ++out.contacts;
      if (since_touch() > kSettleLimit && since_touch() < seconds_) ++out.late_contacts;
    }
    in_contact_ = contact;
    contact_ticks_ += contact;
    active_ticks_ += contact && s.passivity_active;
    if (contact) out.k_max = std::min(out.k_max, bench_.record().k_max_n_per_m);
  }

  void finish() {
    WallTrace& trace = out.trace;
    const double rate_hz = case_.device.rate_hz;
    const std::vector<double> mean = slow_part(trace.force_n, rate_hz);
    for (std::size_t i = 0; i < trace.t.size(); ++i) {
      const bool held = trace.t[i] < seconds_ - kHalfWindow * 1e-3;
      if (held && std::abs(trace.force_n[i] - mean[i]) >= kSettledBand) out.settled_s = trace.t[i];
      if (i > 0) {
        const double step = trace.force_n[i] - trace.force_n[i - 1];
        out.largest_step_n = std::max(out.largest_step_n, std::abs(step));
        const double rendered = trace.wanted_n[i] - trace.wanted_n[i - 1], whole = spring_n_[i] - spring_n_[i - 1];
        // What the limiter's rate held back, the force makes up for.
        const double late = std::min(0.0, trace.wanted_n[i - 1] - trace.force_n[i - 1]);
        const double out_of = outside(step, std::min({0.0, rendered, whole}) + late, std::max({0.0, rendered, whole}));
        out.law_step_n = std::max(out.law_step_n, out_of);
      }
      out.least_true_j = std::min(out.least_true_j, trace.true_j[i]);
      out.least_net_j = std::min(out.least_net_j, trace.net_j[i]);
      out.overclaimed_j = std::max(out.overclaimed_j, trace.observed_j[i] - trace.net_j[i]);
    }
    out.shaking_n = rms_above_30_hz(trace.force_n, rate_hz, 1.0);
    if (contact_ticks_ > 0) out.passive_share = static_cast<double>(active_ticks_) / contact_ticks_;
    display();
  }

  WallOutcome out;

 private:
  void keep(const StylusState& s, double position, double speed) {
    WallTrace& trace = out.trace;
    trace.t.push_back(since_touch());
    trace.position_m.push_back(position);
    trace.speed_m_s.push_back(speed);
    trace.force_n.push_back(ideal_ ? bench_.daq().ideal_wall_n() : -s.rendered_force_T.dot(case_.direction));
    trace.wanted_n.push_back(ideal_ ? trace.force_n.back()
                                    : -bench_.record().contact_scale * s.commanded_force_T.dot(case_.direction));
    spring_n_.push_back(ideal_ ? trace.force_n.back() : -s.commanded_force_T.dot(case_.direction));
    trace.observed_j.push_back(s.energy_j - observed_before_);
    trace.true_j.push_back(bench_.true_absorbed_j() - true_before_);
    trace.net_j.push_back(bench_.net_absorbed_j() - net_before_);
    saturated_.push_back(bench_.record().contact_scale < 1);
  }

  void display() {
    const WallTrace& trace = out.trace;
    double shown = 0, wanted = 0, force = 0, depth = 0, saturated = 0;
    int count = 0;
    for (std::size_t i = 0; i < trace.t.size(); ++i) {
      if (trace.t[i] < seconds_ - kEndWindow || trace.t[i] >= seconds_ || trace.wanted_n[i] <= 0) continue;
      shown += std::min(trace.force_n[i], trace.wanted_n[i]);
      wanted += trace.wanted_n[i];
      force += trace.force_n[i];
      depth += trace.position_m[i];
      saturated += saturated_[i];
      ++count;
    }
    out.displayed = wanted > 0 ? shown / wanted : 1;
    out.saturated = count > 0 ? saturated / count : 0;
    out.shown_stiffness = depth > 0 ? force / depth : 0;
    out.held_n = count > 0 ? force / count : 0;
  }

  const WallCase& case_;
  const PlantBench& bench_;
  Vec3 wall_;
  bool ideal_;
  double seconds_;
  bool touched_ = false, in_contact_ = false;
  double touch_s_ = 0, observed_before_ = 0, true_before_ = 0, net_before_ = 0;
  long contact_ticks_ = 0, active_ticks_ = 0;
  std::vector<bool> saturated_;
  std::vector<double> spring_n_;  ///< commanded, whatever the motors can
};

/// Force against `direction` that the motors of this device can give beside its weight, N.
double most_force(const PlantBench& bench, const Vec3& direction) {
  const DeviceModel& model = bench.loop_config().device;
  const ArmState arm = arm_state(bench.daq().plant().angles());
  const JointVector lever = -arm.J_WS.topRows<3>().transpose() * direction;
  const JointVector weight = gravity_torque(model, arm);
  double most = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kArmJoints; ++i) {
    const double left = max_joint_torque(model.transmission[static_cast<std::size_t>(i)]) -
                        std::copysign(1.0, lever[i]) * (bench.loop_config().carry_weight ? weight[i] : 0);
    if (lever[i] != 0) most = std::min(most, std::max(0.0, left) / std::abs(lever[i]));
  }
  return most;
}

}  // namespace

bool WallOutcome::stable() const { return !faulted && settled_s <= kSettleLimit && late_contacts <= 2; }

bool stable_beside(const WallOutcome& ours, const WallOutcome& ideal) {
  return !ours.faulted && ours.settled_s <= std::max(kSettleLimit, ideal.settled_s + kBesideIdeal) &&
         ours.late_contacts <= std::max(2, ideal.late_contacts);
}

bool comfortable(const JointVector& pose, const Vec3& direction, double travel_m) {
  Pose X = arm_state(pose).X_WS;
  const Vec3 from = X.p;
  JointVector near = pose;
  for (double way = 0; way <= travel_m + 1e-9; way += 0.005) {
    X.p = from + way * direction;
    const auto q = inverse_within_limits(X, near);
    if (!q || joint_limit_margin(*q) < kJointMargin || arm_state(*q).det_a < kLeastDet) return false;
    near = *q;
  }
  return true;
}

JointVector near_home(double travel_m) {
  const JointVector home = home_angles();
  Pose X = arm_state(home).X_WS;
  for (double back = 0; back < 0.08; back += 0.005) {
    const auto q = inverse_within_limits(X, home);
    if (q && comfortable(*q, X.R.col(1), travel_m) && comfortable(*q, -X.R.col(1), travel_m)) return *q;
    X.p.z() += 0.005;
  }
  throw std::invalid_argument("wall trial: no pose near home leaves room for such a press");
}

double press_travel(const WallCase& c) { return run_up(c.speed) + 2 * c.past_wall_m; }

WallRig::WallRig(const WallCase& c) : case_(c), start_(arm_state(c.pose).X_WS), run_up_m_(run_up(c.speed)) {
  if (!comfortable(c.pose, c.direction, press_travel(c))) {
    throw std::invalid_argument("wall trial: the way into the wall leaves the comfortable workspace");
  }
  ready_.emplace(device_of(c), loop_of(c));
  ready_->start();
  ready_->move(start_, kToPoseS);
  ready_->daq().set_hand_parameters(c.device.hand);
  ready_->run(kRestS);
  // Quicker reaches meet the wall faster: bisect on the logarithm.
  double quick = kQuickestReach, slow = kSlowestReach;
  reach_s_ = quick;
  if (speed_at_wall(quick) < c.speed) return;
  for (int i = 0; i < 30; ++i) {
    reach_s_ = std::sqrt(quick * slow);
    const double speed = speed_at_wall(reach_s_);
    if (std::abs(speed - c.speed) <= c.speed_tolerance * c.speed) return;
    (speed > c.speed ? quick : slow) = reach_s_;
  }
}

Vec3 WallRig::wall_point() const { return start_.p + run_up_m_ * case_.direction; }

Pose WallRig::goal_at(double share) const {
  return {start_.R, start_.p + minimum_jerk(share) * (run_up_m_ + case_.past_wall_m) * case_.direction};
}

double WallRig::speed_at_wall(double reach_s) const {
  PlantBench bench(*ready_);
  const double begun = bench.time_s();
  try {
    for (double t = 0; t < kLongestApproach; t = bench.time_s() - begun) {
      bench.goal() = goal_at(t / reach_s);
      bench.tick();
      const StylusMotion motion = bench.daq().plant().motion();
      if ((motion.X_BS.p - wall_point()).dot(case_.direction) >= 0) return motion.V_BS.linear.dot(case_.direction);
    }
  } catch (const BenchFault&) {
    return 10;  // overspeed: far too quick
  }
  return 0;
}

WallOutcome WallRig::press(const WallPress& how, double seconds) const {
  PlantBench bench(*ready_);
  bench.loop().set_passivity_law(how.law);
  if (how.instead) {
    PassivityParameters seam;
    seam.period_s = bench.period_s();
    seam.delay_s = (1 + case_.device.extra_delay_periods) * seam.period_s;
    bench.loop().compare_with(comparison_law(*how.instead, seam));
  }
  bench.loop().set_stiffness_clamp(how.clamp);
  ContactMaterial material;
  material.stiffness_n_per_m = how.stiffness.value_or(case_.stiffness);
  material.damping_s_per_m = how.damping_n_s_per_m / (1.5 * material.stiffness_n_per_m * kDampingDepth);
  bench.put_wall(wall_point(), -case_.direction, material);
  return press(bench, false, seconds);
}

WallOutcome WallRig::press_ideal(double seconds) const {
  PlantBench bench(*ready_);
  return press(bench, true, seconds);
}

WallOutcome WallRig::press(PlantBench& bench, bool ideal, double seconds) const {
  Tally tally(case_, bench, wall_point(), ideal, seconds);
  const double begun = bench.time_s();
  bool firm = false;
  try {
    for (double t = 0; t < kLongestApproach + seconds; t = bench.time_s() - begun) {
      if (ideal) {
        bench.daq().set_ideal_wall(
            {wall_point(), case_.direction, case_.stiffness, most_force(bench, case_.direction)});
      }
      const double held = tally.touched() ? tally.since_touch() - seconds : 0;
      if (held >= kLeaveS + kAfterS) break;
      bench.goal() = goal_at(held > 0 ? 1 - held / kLeaveS : t / reach_s_);
      bench.tick();
      tally.add();
      if (!firm && case_.stiffens_s && tally.touched() && tally.since_touch() >= *case_.stiffens_s) {
        firm = true;
        bench.daq().set_hand_parameters(stiffened(case_.device.hand));
      }
    }
  } catch (const BenchFault&) {
    tally.out.faulted = true;
  }
  tally.finish();
  return tally.out;
}

}  // namespace trocar
