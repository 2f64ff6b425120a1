#include "app/studies/contact/transparency_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/device_bench/plant_bench.h"
#include "app/studies/device/identified_device.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

constexpr std::array kMotionSpeeds{0.05, 0.1, 0.2, 0.3};  // m/s
constexpr std::array<const char*, 3> kForceAxisNames{"X6", "Y6", "Z6"};
constexpr double kMeasured_m = 0.015;  // to either side of the pose
constexpr double kRunUp_m = 0.020;     // before and after, from rest to speed
constexpr double kFrictionBar = 3, kWeightBar = 5;

enum Compensation : std::size_t { kNothing, kGravityOnly, kGravityAndFriction, kCompensations };

/// Where the device works: well inside limits, det A 0.9.
Pose working_pose() { return arm_state(kDegree * (JointVector() << 45, 45, 45, -60, -75, 0).finished()).X_WS; }

/// A rail, not a hand: 0.1 mm under the largest force here.
HandParameters rail() {
  HandParameters p;
  p.grip_stiffness = 2e4, p.grip_damping = 80;
  p.hand_mass = 2, p.arm_stiffness = 1e5, p.arm_damping = 900;
  p.turn_stiffness = 60, p.turn_damping = 0.3;
  p.moment_limit_nm = 10;
  p.tremor_m = 0;
  return p;
}

HapticLoopConfig loop_with(Compensation compensation, const DeviceModel& identified) {
  HapticLoopConfig config;
  config.device = identified;
  if (compensation != kGravityAndFriction) config.friction.share = 0;
  // On a rail a joint that carries weight may stand still while others travel far: no encoder is stuck.
  config.safety.stuck_pushed_travel = config.safety.stuck_travel = std::numeric_limits<std::int32_t>::max();
  if (compensation == kNothing) config.device.identified_gravity = IdentifiedGravity{};
  return config;
}

SimulatedDaqConfig plant_with(const PlantParameters& truth) {
  SimulatedDaqConfig config = nominal_device();
  config.plant = truth;
  config.hand = rail();
  return config;
}

/// Mean force of the rail against the motion and along it, on the way forth and back.
struct Pull {
  double forth = 0, back = 0;  ///< N, along the motion: positive is a resistance
  /// The part that keeps its sign: weight, and what the geometry accelerates.
  double weight() const { return 0.5 * std::abs(forth - back); }
  /// The part that turns with the motion.
  double friction() const { return 0.5 * (forth + back); }
  double both() const { return 0.5 * (std::abs(forth) + std::abs(back)); }
};

/// Constant speed between run-ups; the way at time t, from 0.
struct Stroke {
  double speed, run_up_s = 2 * kRunUp_m / speed, middle_s = 2 * kMeasured_m / speed;
  double seconds() const { return 2 * run_up_s + middle_s; }
  double way(double t) const {
    const auto ramp = [&](double s) {
      return run_up_s * speed * (s * s * s - 0.5 * s * s * s * s);
    };  // smooth to speed
    if (t < run_up_s) return ramp(t / run_up_s);
    if (t < run_up_s + middle_s) return kRunUp_m + (t - run_up_s) * speed;
    return 2 * kRunUp_m + 2 * kMeasured_m - ramp(std::max(0.0, (seconds() - t) / run_up_s));
  }
  bool measured(double t) const { return t >= run_up_s && t <= run_up_s + middle_s; }
};

class Rail {
 public:
  Rail(const PlantParameters& truth, const HapticLoopConfig& loop) : bench_(plant_with(truth), loop) {
    bench_.start();
    bench_.move(working_pose(), 2.0);
  }
  Pull pull(const Vec3& axis, double speed) {
    const Stroke stroke{speed};
    const double half = kRunUp_m + kMeasured_m;
    bench_.move({centre_.R, centre_.p - half * axis}, 0.6);
    bench_.run(0.4);
    Pull pull;
    pull.forth = go(stroke, axis, 1);
    bench_.run(0.4);
    pull.back = go(stroke, axis, -1);
    return pull;
  }
  /// rms of the error of the rates that the feed-forward uses while the stylus moves, worst arm joint, rad/s. Beside
  /// true rates that lag as much: a knee has to lie above the noise, not above the lag.
  double rate_noise() const { return std::sqrt((squares_ / std::max(1.0, samples_)).maxCoeff()); }
  /// Largest motion of the stylus at rest in an open hand, m: a limit cycle would show.
  double hunting() {
    HandParameters open = rail();
    for (double* k : {&open.grip_stiffness, &open.grip_damping, &open.arm_stiffness, &open.turn_stiffness,
                      &open.turn_damping, &open.finger_stiffness, &open.finger_damping}) {
      *k = 0;
    }
    bench_.move(centre_, 0.6);
    bench_.run(0.4);
    bench_.daq().set_hand_parameters(open);
    bench_.run(1.0);
    Vec3 low = bench_.daq().sense().X_BS.p, high = low;
    for (int k = 0; k < 2000; ++k) {
      bench_.tick();
      low = low.cwiseMin(bench_.daq().sense().X_BS.p), high = high.cwiseMax(bench_.daq().sense().X_BS.p);
    }
    return (high - low).norm();
  }

 private:
  double go(const Stroke& stroke, const Vec3& axis, double way) {
    const Pose from = bench_.goal();
    double sum = 0, samples = 0;
    const double dt = bench_.period_s();
    for (double t = dt; t <= stroke.seconds() + 0.5 * dt; t += dt) {
      bench_.goal().p = from.p + way * stroke.way(t) * axis;
      bench_.tick();
      const JointVector error =
          estimated_.update(bench_.record().qd.head<kArmJoints>()) - true_.update(bench_.daq().plant().rates());
      if (!stroke.measured(t)) continue;
      sum -= way * axis.dot(bench_.daq().sense().force_on_hand);
      samples += 1;
      squares_ += error.cwiseAbs2();
      samples_ += 1;
    }
    return sum / samples;
  }

  PlantBench bench_;
  Pose centre_ = working_pose();
  SmoothedRates estimated_{bench_.loop_config().friction, bench_.period_s()}, true_ = estimated_;
  JointVector squares_ = JointVector::Zero();
  double samples_ = 0;
};

bool carries_weight(const std::array<Pull, kCompensations>& by) {
  return by[kNothing].weight() > by[kNothing].friction();
}

/// What a person has to overcome, N.
double resistance(const Pull& pull, bool weighty) { return weighty ? pull.both() : pull.friction(); }

using Table = std::array<std::array<std::array<Pull, kCompensations>, kMotionSpeeds.size()>, 3>;

void add_cases(StudyResult& study, const Table& table, const std::vector<std::size_t>& speeds) {
  for (std::size_t a = 0; a < 3; ++a) {
    for (const std::size_t s : speeds) {
      const auto& by = table[a][s];
      const bool weighty = carries_weight(by);
      const double bar = weighty ? kWeightBar : kFrictionBar;
      const double ratio = resistance(by[kNothing], weighty) / resistance(by[kGravityAndFriction], weighty);
      study.cases.push_back(
          {std::string(kForceAxisNames[a]) + " at " + std::to_string(kMotionSpeeds[s]).substr(0, 4) +
               " m/s: less resistance by",
           "times", ratio, std::nullopt, weighty ? ">= 5 (carries weight)" : ">= 3 (friction alone)", ratio >= bar,
           "Mean pull of the rail along the axis, without any compensation over with weight and friction compensation. "
           "Where "
           "weight is the larger part: magnitude, both directions; else the part that turns with the motion."});
    }
  }
}

void draw(StudyResult& study, const Table& table, const std::vector<std::size_t>& speeds) {
  for (std::size_t a = 0; a < 3; ++a) {
    StudyCurves c{std::string("resistance_") + kForceAxisNames[a],
                  std::string("Moving along ") + kForceAxisNames[a] + " in free air (simulated plant)",
                  "speed, m/s",
                  "mean pull at the stylus, N",
                  {},
                  {{"nothing", {}}, {"gravity", {}}, {"gravity + friction", {}}}};
    for (const std::size_t s : speeds) {
      const bool weighty = carries_weight(table[a][s]);
      c.x.push_back(kMotionSpeeds[s]);
      for (std::size_t k = 0; k < kCompensations; ++k) c.series[k].y.push_back(resistance(table[a][s][k], weighty));
    }
    study.curves.push_back(c);
  }
}

}  // namespace

StudyResult transparency_study(const StudyRequest& request) {
  StudyResult study{"transparency", "simulated plant of " + request.device_words(), {}, {}};
  const PlantParameters truth = request.true_device();
  const DeviceModel identified = identify_simulated(truth, seeded_identification(request.seed, request.quick)).device;
  const std::vector<std::size_t> speeds =
      request.quick ? std::vector<std::size_t>{1, 3} : std::vector<std::size_t>{0, 1, 2, 3};
  Table table;
  double noise = 0, hunting = 0;
  for (std::size_t k = 0; k < kCompensations; ++k) {
    Rail rail(truth, loop_with(static_cast<Compensation>(k), identified));
    for (std::size_t a = 0; a < 3; ++a) {
      for (const std::size_t s : speeds)
        table[a][s][k] = rail.pull(working_pose().R.col(static_cast<Eigen::Index>(a)), kMotionSpeeds[s]);
    }
    noise = std::max(noise, rail.rate_noise());
    if (k == kGravityAndFriction) hunting = rail.hunting();
  }
  add_cases(study, table, speeds);
  study.cases.push_back(
      {"motion at rest, compensated, open hand", "mm", hunting * 1e3, std::nullopt, "< 0.2 (one count)", hunting < 2e-4,
       "Extent of the stylus' motion over 2 s, a second after the hand has opened: a limit cycle would show."});
  const double knee = FrictionFeedForward{}.knee_rad_s;
  study.cases.push_back(
      {"knee of the feed-forward over rate noise", "times", knee / noise, std::nullopt, ">= 3", knee >= 3 * noise,
       "v0 of the loop over the rms error of the smoothed joint rates while the stylus moves, worst joint."});
  draw(study, table, speeds);
  return study;
}

}  // namespace trocar
