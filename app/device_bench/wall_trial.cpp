#include "app/device_bench/wall_trial.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "haptics/device/plant/plant_parameters.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kToPoseS = 1.2, kRestS = 0.3;
constexpr double kShortRunUp = 0.030, kLongRunUp = 0.075;     // m before the wall; the long one where kFast is asked
constexpr double kFast = 0.55;                                // m/s
constexpr double kQuickestReach = 0.04, kSlowestReach = 4.0;  // s
constexpr double kSpeedTolerance = 0.03;                      // of the speed
constexpr double kLongestApproach = 6.0;                      // s until the wall must have been met
constexpr int kHalfWindow = 25;                               // periods at 1 kHz to either side: 50 ms
constexpr double kEndWindow = 0.3;                            // s before the end in which the displayed share is taken
constexpr double kJointMargin = 8 * kDegree, kLeastDet = 0.35;

double run_up(double speed) { return speed > kFast ? kLongRunUp : kShortRunUp; }

SimulatedDaqConfig device_of(const WallCase& c) {
  SimulatedDaqConfig device = nominal_device();
  for (ChannelParameters& channel : device.plant->channel) channel.amplifier_gain *= c.gain;
  device.rate_hz = c.rate_hz;
  device.extra_delay_periods = c.extra_delay;
  device.hand = hand_parameters(GripPreset::kFirm);  // leads the arm to its pose; then the case's grip
  device.hand.tremor_m = 0;
  return device;
}

HapticLoopConfig loop_of(const WallCase& c) {
  HapticLoopConfig loop;
  loop.tool.shaft_length_m = 1e-3;  // a ball
  loop.known_delay_periods = c.extra_delay;
  loop.carry_weight = c.compensated;
  if (!c.compensated) loop.friction.share = 0;
  return loop;
}

HandParameters grip_of(GripPreset grip) {
  HandParameters hand = hand_parameters(grip);
  hand.tremor_m = 0;
  return hand;
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

/// What one press adds up to, tick by tick.
class Tally {
 public:
  Tally(const WallCase& c, const PlantBench& bench, const Vec3& wall) : case_(c), bench_(bench), wall_(wall) {}

  bool touched() const { return touched_; }
  double since_touch() const { return bench_.time_s() - touch_s_; }

  void add() {
    const StylusState& s = bench_.record().stylus;
    const StylusMotion motion = bench_.daq().plant().motion();
    const double speed = motion.V_BS.linear.dot(case_.direction);
    if (!touched_ && s.contact) {
      touched_ = true;
      touch_s_ = bench_.time_s();
      observed_before_ = s.energy_j;
      true_before_ = bench_.true_absorbed_j();
      out.touched_at_m_s = speed;
      out.k_max = bench_.record().k_max_n_per_m;
    }
    if (!touched_) return;
    keep(s, (motion.X_BS.p - wall_).dot(case_.direction), speed);
    if (s.contact && !in_contact_) {
      ++out.contacts;
      if (since_touch() > kSettleLimit) ++out.late_contacts;
    }
    in_contact_ = s.contact;
    contact_ticks_ += s.contact;
    active_ticks_ += s.contact && s.passivity_active;
    if (s.contact) out.k_max = std::min(out.k_max, bench_.record().k_max_n_per_m);
  }

  void finish(double seconds) {
    WallTrace& trace = out.trace;
    const std::vector<double> mean = slow_part(trace.force_n, case_.rate_hz);
    for (std::size_t i = 0; i < trace.t.size(); ++i) {
      if (std::abs(trace.force_n[i] - mean[i]) >= kSettledBand) out.settled_s = trace.t[i];
      if (i > 0) out.largest_step_n = std::max(out.largest_step_n, std::abs(trace.force_n[i] - trace.force_n[i - 1]));
      out.least_true_j = std::min(out.least_true_j, trace.true_j[i]);
      out.observer_gap_j = std::max(out.observer_gap_j, std::abs(trace.true_j[i] - trace.observed_j[i]));
    }
    if (contact_ticks_ > 0) out.passive_share = static_cast<double>(active_ticks_) / contact_ticks_;
    double shown = 0, force = 0, depth = 0;
    int count = 0;
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      if (trace.t[i] < seconds - kEndWindow || std::isnan(shown_[i])) continue;
      shown += shown_[i];
      force += trace.force_n[i];
      depth += trace.position_m[i];
      ++count;
    }
    out.displayed = count > 0 ? shown / count : 0;
    out.shown_stiffness = depth > 0 ? force / depth : 0;
  }

  WallOutcome out;

 private:
  void keep(const StylusState& s, double position, double speed) {
    out.trace.t.push_back(since_touch());
    out.trace.position_m.push_back(position);
    out.trace.speed_m_s.push_back(speed);
    out.trace.force_n.push_back(-s.rendered_force_T.dot(case_.direction));
    out.trace.observed_j.push_back(s.energy_j - observed_before_);
    out.trace.true_j.push_back(bench_.true_absorbed_j() - true_before_);
    const double share = bench_.record().contact_scale < 1 ? 1.0 : s.delivered_share;
    shown_.push_back(s.contact ? share : std::nan(""));
  }

  const WallCase& case_;
  const PlantBench& bench_;
  Vec3 wall_;
  bool touched_ = false, in_contact_ = false;
  double touch_s_ = 0, observed_before_ = 0, true_before_ = 0;
  long contact_ticks_ = 0, active_ticks_ = 0;
  std::vector<double> shown_;
};

}  // namespace

bool WallOutcome::stable() const { return !faulted && settled_s <= kSettleLimit && late_contacts <= 2; }

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

WallRig::WallRig(const WallCase& c) : case_(c), start_(arm_state(c.pose).X_WS), run_up_m_(run_up(c.speed)) {
  if (!comfortable(c.pose, c.direction, run_up_m_ + 2 * c.past_wall_m)) {
    throw std::invalid_argument("wall trial: the way into the wall leaves the comfortable workspace");
  }
  ready_.emplace(device_of(c), loop_of(c));
  ready_->start();
  ready_->move(start_, kToPoseS);
  ready_->daq().set_hand_parameters(grip_of(c.grip));
  ready_->run(kRestS);
  // Quicker reaches meet the wall faster: bisect on the logarithm.
  double quick = kQuickestReach, slow = kSlowestReach;
  reach_s_ = quick;
  if (speed_at_wall(quick) < c.speed) return;
  for (int i = 0; i < 30; ++i) {
    reach_s_ = std::sqrt(quick * slow);
    const double speed = speed_at_wall(reach_s_);
    if (std::abs(speed - c.speed) <= kSpeedTolerance * c.speed) return;
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
  bench.loop().set_stiffness_clamp(how.clamp);
  ContactMaterial material;
  material.stiffness_n_per_m = how.stiffness.value_or(case_.stiffness);
  material.damping_s_per_m = how.damping_n_s_per_m / (1.5 * material.stiffness_n_per_m * kDampingDepth);
  bench.put_wall(wall_point(), -case_.direction, material);
  Tally tally(case_, bench, wall_point());
  const double begun = bench.time_s();
  bool firm = false;
  try {
    for (double t = 0; t < kLongestApproach + seconds; t = bench.time_s() - begun) {
      bench.goal() = goal_at(t / reach_s_);
      bench.tick();
      tally.add();
      if (!tally.touched()) continue;
      if (tally.since_touch() >= seconds) break;
      if (!firm && case_.stiffens_s && tally.since_touch() >= *case_.stiffens_s) {
        firm = true;
        bench.daq().set_hand_parameters(grip_of(GripPreset::kFirm));
      }
    }
  } catch (const BenchFault&) {
    tally.out.faulted = true;
  }
  tally.finish(seconds);
  return tally.out;
}

}  // namespace trocar
