#include "app/studies/device/force_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

#include <Eigen/LU>

#include "app/device_bench/plant_bench.h"
#include "app/session/calibration/amplifier_calibration.h"
#include "app/studies/contact/bare_control_loop.h"
#include "app/studies/device/bar_drawing.h"
#include "app/studies/study_files.h"
#include "haptics/force_sensor/ati/fake_sensor.h"
#include "haptics/force_sensor/simulated_force_sensor.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

struct Case {
  const char* name;
  Vec3 axis_S;        ///< in the stylus frame
  bool moment;        ///< 1 N m about it instead of 1 N along it
  double thesis_deg;  ///< figures 3.38 and 3.39
};

const std::array<Case, 6>& cases() {
  static const std::array<Case, 6> all{{{"+Z6", Vec3::UnitZ(), false, 4.29},
                                        {"-Z6", -Vec3::UnitZ(), false, 6.91},
                                        {"+Y6", Vec3::UnitY(), false, 7.85},
                                        {"-Y6", -Vec3::UnitY(), false, 11.43},
                                        {"+X6", Vec3::UnitX(), true, 2.11},
                                        {"-X6", -Vec3::UnitX(), true, 1.32}}};
  return all;
}

constexpr double kAside = 2.5 * kDegree;  // every joint, from where the fixture comes
constexpr double kWay_s = 0.8, kRest_s = 0.4, kRead_s = 1.0;
constexpr int kHands = 10;
constexpr double kHeldMoment = 0.1;    // N m
constexpr double kMomentNoise = 5e-4;  // N m [assumed, with the sensor's 20 mN]

/// Stiffer than any hand: 0.2 mm under 1 N, 1 deg under 1 N m.
HandParameters fixture() {
  HandParameters p;
  p.grip_stiffness = 5000, p.grip_damping = 30;
  p.hand_mass = 0.5, p.arm_stiffness = 2e4, p.arm_damping = 200;
  p.turn_stiffness = 60, p.turn_damping = 0.3;
  p.moment_limit_nm = 5;
  p.tremor_m = 0;
  return p;
}

/// The device without friction and without any error of its electronics: what the static map alone does.
PlantParameters ideal() {
  PlantParameters p = nominal_parameters();
  for (ChannelParameters& c : p.channel) c.friction.coulomb = 0;
  return p;
}

/// Weight and inertia of what hangs on the sensor, in the stylus frame, sample by sample.
class FixtureLoad {
 public:
  /// @param X of the stylus in W'; its acceleration by its last two differences.
  Wrench at(const Pose& X, double period_s) {
    const Vec3 v = known_ > 0 ? Vec3((X.p - p_) / period_s) : Vec3::Zero();
    const Vec3 a = known_ > 1 ? Vec3((v - v_) / period_s) : Vec3::Zero();
    p_ = X.p, v_ = v, known_ = std::min(2, known_ + 1);
    const Vec3 force = X.R.transpose() * (kFixture_kg * (Vec3(0, 0, -kGravity) - a));
    return {force, kFixtureCom_S.cross(force)};
  }

 private:
  static constexpr double kFixture_kg = 0.08;          // [assumed]
  static inline const Vec3 kFixtureCom_S{0, 0, 0.02};  // m [assumed]
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();
  int known_ = 0;
};

/// The fixture with its sensor, and the device that renders a wrench against it.
class ForceBench {
 public:
  /// @param line "net-ft", "serial": the readings come through that sensor's driver; empty: as they are.
  ForceBench(const PlantParameters& truth, const DeviceModel& model, const ForceSensorConfig& sensor,
             const ForceSensorConfig& moments, std::uint64_t seed, const HandParameters& holds = fixture(),
             const std::string& line = "")
      : line_(line.empty() ? nullptr : std::make_unique<SensorLine>(line)),
        daq_(config(truth, holds)),
        force_(sensor, seed),
        moment_(moments, seed + 1),
        home_(daq_.sense()),
        loop_(
            daq_, [this](const ArmState& arm) { return torque(arm); }, home_angles(), model) {
    run(
        kRest_s, [](double) { return 0.0; }, nullptr);
    if (line_) line_->bias();
  }

  int taken() const { return taken_; }        ///< readings that counted
  int left_out() const { return left_out_; }  ///< of the readings asked for, those that the sensor did not vouch for

  /// Mean reading from both sides, in the stylus frame. @param wrench whether the device renders the case.
  Wrench read(const Case& c, bool wrench) {
    wanted_ = &c, on_ = wrench;
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

  /// Mean reading where the stylus is held, without coming from anywhere: friction hides what it can.
  Wrench read_as_held(const Case& c, double share) {
    wanted_ = &c, on_ = share > 0, share_ = share;
    return read_at_rest();
  }

 private:
  static SimulatedDaqConfig config(const PlantParameters& truth, const HandParameters& holds) {
    SimulatedDaqConfig c;
    c.plant = truth;
    c.hand = holds;
    return c;
  }
  JointVector torque(const ArmState& arm) const {
    if (!on_ || !wanted_) return JointVector::Zero();
    Vec6 w = Vec6::Zero();
    (wanted_->moment ? w.tail<3>() : w.head<3>()) = share_ * (arm.X_WS.R * wanted_->axis_S);
    return arm.J_WS.transpose() * w;
  }
  Wrench read_at_rest() {
    Wrench sum;
    double samples = 0;
    run(
        kRest_s, [](double) { return 0.0; }, nullptr);
    run(
        kRead_s, [](double) { return 0.0; }, [&](const Wrench& reading) { sum = sum + reading, samples += 1; });
    return sum * (1 / samples);
  }
  /// @param aside share of kAside of the joints at which the fixture holds, by the share of time.
  template <class Place>
  void run(double seconds, Place aside, std::function<void(const Wrench&)> take) {
    const double rate = daq_.capabilities().rate_hz;
    const long n = std::lround(seconds * rate), every = std::lround(rate / force_.config().rate_hz);
    for (long k = 1; k <= n; ++k) {
      const double way = aside(static_cast<double>(k) / static_cast<double>(n));
      const Pose from_home =
          home_pose().inverse() * arm_state(home_angles() + JointVector::Constant(kAside * way)).X_WS;
      daq_.set_hand_intent(home_.X_BS * from_home, home_.jaw_opening_m);
      loop_.tick();
      if (k % every != 0) continue;
      const HandSense now = daq_.sense();
      const Mat3 R = now.X_BS.R.transpose();
      if (!line_) {
        const Wrench reading{force_.sample(R * now.force_on_hand).force, moment_.sample(R * now.moment_on_hand).force};
        if (take) take(reading), ++taken_;
        continue;
      }
      const double period_s = 1 / force_.config().rate_hz;
      const Wrench hung = true_.at(now.X_BS, period_s);
      const Wrench acting{force_.sample(R * now.force_on_hand + hung.force).force,
                          moment_.sample(R * now.moment_on_hand + hung.moment).force};
      const std::optional<Wrench> reading = line_->pass(acting);
      const Wrench then = remembered(believed_.at(loop_.arm().X_WS, period_s));
      if (!take) continue;
      if (reading)
        take(*reading + then * -1), ++taken_;
      else
        ++left_out_;
    }
  }

  /// What hangs on the sensor, as the loop knew it when the reading was true.
  Wrench remembered(const Wrench& now) {
    hung_.push_back(now);
    const std::size_t back = force_.delay();
    return hung_[hung_.size() > back ? hung_.size() - 1 - back : 0];
  }

  std::unique_ptr<SensorLine> line_;
  FixtureLoad true_, believed_;
  std::vector<Wrench> hung_;
  int taken_ = 0, left_out_ = 0;
  SimulatedDaq daq_;
  SimulatedForceSensor force_, moment_;
  HandSense home_;
  const Case* wanted_ = nullptr;
  bool on_ = false;
  double share_ = 1;  ///< of the case's wrench
  BareControlLoop loop_;
};

struct Error {
  double direction_deg = 0, magnitude = 0;  ///< the latter as a share
};

Error error_of(const Case& c, const Wrench& reading) {
  const Vec3 measured = c.moment ? reading.moment : reading.force;
  const double angle = std::atan2(measured.cross(c.axis_S).norm(), measured.dot(c.axis_S)) / kDegree;
  return {angle < 1e-9 ? 0 : angle, measured.norm() - 1};  // rounding is no finding
}

Error measured_error(ForceBench& bench, const Case& c) {
  const Wrench with = bench.read(c, true), without = bench.read(c, false);
  return error_of(c, with + without * -1);
}

/// What the plant makes of the torques that the controller asks for, at home, codes and all: two kinematics that were
/// written apart.
Error map_error(const Case& c) {
  const DeviceModel model;
  DevicePlant plant(nominal_parameters());
  const ArmState arm = arm_state(home_angles());
  plant.place(arm.q, 0.02);
  Vec6 w = Vec6::Zero();
  (c.moment ? w.tail<3>() : w.head<3>()) = arm.X_WS.R * c.axis_S;
  ChannelVector torque = ChannelVector::Zero();
  torque.head<kArmJoints>() = arm.J_WS.transpose() * w;
  constexpr int kBits = 16;
  const JointVector asked = torques_of(model, dac_codes(model, torque, kBits), kBits).head<kArmJoints>();
  const Vec6 made = plant.joint_jacobian().transpose().partialPivLu().solve(asked);
  const Mat3 R = plant.motion().X_BS.R.transpose();
  return error_of(c, {R * made.head<3>(), R * made.tail<3>()});
}

/// The model with gains and offsets found on the bench rig, as `trocar device calibrate` finds them.
DeviceModel calibrated_model(const PlantParameters& truth, std::uint64_t seed) {
  SimulatedDaqConfig config;
  config.plant = truth;
  TorqueRig rig(config, {}, seed);
  return calibrated({}, calibrate_amplifiers(rig, {}));
}

/// As the thesis measured: the stylus in a hand, amplifiers as they come, the wrench switched on where the hand is.
/// Mean direction over drawn arms and hands; a hand holds no more than kHeldMoment.
Error held_error(const Case& c, const StudyRequest& request, const ForceSensorConfig& moments) {
  Error mean;
  const int hands = request.quick ? 2 : kHands;
  const double share = c.moment ? kHeldMoment : 1;
  for (int i = 0; i < hands; ++i) {
    const std::uint64_t seed = request.seed + static_cast<std::uint64_t>(i);
    ForceBench bench(draw_parameters(seed), {}, {}, moments, seed, draw_hand_parameters(GripPreset::kNormal, seed));
    const Wrench without = bench.read_as_held(c, 0), with = bench.read_as_held(c, share);
    const Error one = error_of(c, (with + without * -1) * (1 / share));
    mean.direction_deg += one.direction_deg / hands;
    mean.magnitude += one.magnitude / hands;
  }
  return mean;
}

struct Errors {
  std::array<Error, 6> map, quantised, chain, uncalibrated, held;
  std::array<Error, 6> through;  ///< the whole chain, read through the sensor's line
  int taken = 0, left_out = 0;   ///< readings of that
};

Errors measure(const StudyRequest& request) {
  Errors e;
  ForceSensorConfig clean;
  clean.noise_n = clean.drift_n_per_h = 0;
  ForceSensorConfig moments;
  moments.noise_n = kMomentNoise, moments.drift_n_per_h = 0;
  const PlantParameters truth = draw_parameters(request.seed);
  const DeviceModel model = calibrated_model(truth, request.seed);
  for (std::size_t i = 0; i < cases().size(); ++i) {
    const Case& c = cases()[i];
    e.map[i] = map_error(c);
    ForceBench whole(truth, model, {}, moments, request.seed + 10 * i);
    e.chain[i] = measured_error(whole, c);
    e.held[i] = held_error(c, request, moments);
    if (!request.sensor.empty()) {
      ForceBench line(truth, model, {}, moments, request.seed + 10 * i, fixture(), request.sensor);
      e.through[i] = measured_error(line, c);
      e.taken += line.taken(), e.left_out += line.left_out();
    }
    if (request.quick) continue;
    ForceBench without_friction(ideal(), {}, clean, clean, request.seed);
    e.quantised[i] = measured_error(without_friction, c);
    ForceBench raw(truth, {}, {}, moments, request.seed + 10 * i);
    e.uncalibrated[i] = measured_error(raw, c);
  }
  return e;
}

void add_force_cases(StudyResult& study, const Errors& e) {
  const auto add = [&](const std::string& how, const std::array<Error, 6>& errors, double most_deg, double most_share,
                       const std::string& definition) {
    for (std::size_t i = 0; i < cases().size(); ++i) {
      const Case& c = cases()[i];
      const std::string name = std::string(c.moment ? "1 N m about " : "1 N along ") + c.name + ", " + how;
      const double share = std::abs(errors[i].magnitude);
      const auto bar = [](double limit, const char* unit) {
        const std::string digits = std::to_string(limit);
        return "< " +
               digits.substr(
                   0, digits.find_last_not_of('0') + (digits.find_last_not_of('0') == digits.find('.') ? 0 : 1)) +
               unit;
      };
      study.cases.push_back({name + ": direction", "deg", errors[i].direction_deg, c.thesis_deg, bar(most_deg, " deg"),
                             errors[i].direction_deg < most_deg, definition});
      study.cases.push_back({name + ": magnitude", "%", 100 * share, std::nullopt, bar(100 * most_share, " %"),
                             share < most_share, definition});
    }
  };
  add("static map", e.map, 0.1, 0.01,
      "Wrench that the plant's own Jacobian makes of the torques in the controller's DAC codes, at the exact home "
      "angles.");
  add("whole chain", e.chain, 2, 0.05,
      "Reading of a fixture that holds the stylus less its reading without a wrench, on the drawn device with "
      "friction, "
      "amplifiers as calibrated on the bench rig, quantised encoders, sensor with noise and lag: mean of approaches by "
      "every joint from both sides, "
      "1 s of readings each.");
}

void add_held_cases(StudyResult& study, const Errors& e) {
  for (std::size_t i = 0; i < cases().size(); ++i) {
    const Case& c = cases()[i];
    const std::string wrench = c.moment ? "0.1 N m about " : "1 N along ";
    std::ostringstream bar;
    bar << "<= " << c.thesis_deg << " deg, the thesis'";
    study.cases.push_back({wrench + c.name + ", held by a hand: direction", "deg", e.held[i].direction_deg,
                           c.thesis_deg, bar.str(), e.held[i].direction_deg <= c.thesis_deg,
                           "In the thesis' own conditions: the stylus in a hand, amplifiers as they come, the wrench "
                           "switched on where the hand is; mean over drawn arms and hands."});
  }
}

/// The same chain read through the sensor's bytes, beside its readings as they are.
void add_line_cases(StudyResult& study, const Errors& e, const std::string& sensor) {
  const std::string how = " through " + sensor;
  const std::string definition =
      "The whole chain again, each reading with the weight and inertia of an 80 g fixture on it, as counts through the "
      "driver of the sensor and its byte-level peer; bias at the start, the fixture's share taken away by the loop's "
      "own "
      "pose as it was one lag before.";
  for (std::size_t i = 0; i < cases().size(); ++i) {
    const Case& c = cases()[i];
    const std::string name = std::string(c.moment ? "1 N m about " : "1 N along ") + c.name + "," + how;
    study.cases.push_back({name + ": direction", "deg", e.through[i].direction_deg, c.thesis_deg, "< 2 deg",
                           e.through[i].direction_deg < 2, definition});
    study.cases.push_back({name + ": differs from the reading itself", "deg",
                           std::abs(e.through[i].direction_deg - e.chain[i].direction_deg), std::nullopt, "< 0.5 deg",
                           std::abs(e.through[i].direction_deg - e.chain[i].direction_deg) < 0.5, definition});
    const double share = std::abs(e.through[i].magnitude);
    study.cases.push_back({name + ": magnitude", "%", 100 * share, std::nullopt, "< 5 %", share < 0.05, definition});
  }
  study.cases.push_back({"readings" + how + " left out of " + std::to_string(e.taken + e.left_out), "",
                         static_cast<double>(e.left_out), std::nullopt, "none", e.left_out == 0,
                         "Silent or saturated: they are in no mean."});
}

void draw_forces(StudyResult& study, const Errors& e, bool whole) {
  StudyCurves c{"direction", "Direction error of six wrenches at home (simulated plant)",
                "wrench",    "direction error, deg",
                {},          {{"thesis, measured", {}}, {"whole chain", {}}, {"held by a hand", {}}}};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cases().size(); ++i) {
    const Case& one = cases()[i];
    names.push_back(std::string(one.moment ? "1 N m, " : "1 N, ") + one.name);
    c.x.push_back(static_cast<double>(i + 1));
    c.series[0].y.push_back(one.thesis_deg);
    c.series[1].y.push_back(e.chain[i].direction_deg);
    c.series[2].y.push_back(e.held[i].direction_deg);
  }
  study.files.push_back({"direction.svg", grouped_bars_svg(c, names)});
  c.x_label = "case";
  const auto add = [&](const char* name, const std::array<Error, 6>& errors) {
    c.series.push_back({name, {}});
    for (const Error& one : errors) c.series.back().y.push_back(one.direction_deg);
  };
  if (whole) {
    add("whole chain, not calibrated", e.uncalibrated);
    add("static map", e.map);
    add("without friction", e.quantised);
  }
  study.files.push_back({"direction.csv", curves_csv(c)});
}

}  // namespace

StudyResult force_study(const StudyRequest& request) {
  StudyResult study{"force", "simulated plant of seed " + std::to_string(request.seed), {}, {}};
  const Errors e = measure(request);
  add_force_cases(study, e);
  add_held_cases(study, e);
  if (!request.sensor.empty()) add_line_cases(study, e, request.sensor);
  draw_forces(study, e, !request.quick);
  return study;
}

}  // namespace trocar
