#include "app/studies/device/force_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "app/device_bench/plant_bench.h"
#include "app/session/calibration/amplifier_calibration.h"
#include "app/studies/device/bar_drawing.h"
#include "app/studies/device/held_stylus.h"
#include "app/studies/study_files.h"
#include "haptics/force_sensor/simulated_force_sensor.h"
#include "haptics/kinematics/device_geometry.h"

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

constexpr int kHands = 10;
constexpr double kHeldMoment = 0.1;  // N m

/// The device without friction and without any error of its electronics: what the static map alone does.
PlantParameters ideal() {
  PlantParameters p = nominal_parameters();
  for (ChannelParameters& c : p.channel) c.friction.coulomb = 0;
  return p;
}

Wrench wrench_of(const Case& c) { return c.moment ? Wrench{Vec3::Zero(), c.axis_S} : Wrench{c.axis_S, Vec3::Zero()}; }

/// The torques that the device renders for a case. @param share of its wrench.
TorqueLaw law_of(const Case& c, double share = 1) {
  return [w_S = wrench_of(c) * share](const ArmState& arm) { return torques_of_wrench(arm, w_S); };
}

struct Error {
  double direction_deg = 0, magnitude = 0;  ///< the latter as a share
};

Error error_of(const Case& c, const Wrench& reading) {
  const Vec3 measured = c.moment ? reading.moment : reading.force;
  const double angle = std::atan2(measured.cross(c.axis_S).norm(), measured.dot(c.axis_S)) / kDegree;
  return {angle < 1e-9 ? 0 : angle, measured.norm() - 1};  // rounding is no finding
}

Error measured_error(HeldStylus& bench, const Case& c) {
  const Wrench with = bench.read(law_of(c)), without = bench.read({});
  return error_of(c, with + without * -1);
}

/// What the plant makes of the torques that the controller asks for, at home, codes and all: two kinematics that were
/// written apart.
Error map_error(const Case& c) {
  const DeviceModel model;
  DevicePlant plant(nominal_parameters());
  const ArmState arm = arm_state(home_angles());
  plant.place(arm.q, 0.02);
  ChannelVector torque = ChannelVector::Zero();
  torque.head<kArmJoints>() = torques_of_wrench(arm, wrench_of(c));
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
Error held_error(const Case& c, const StudyRequest& request) {
  Error mean;
  const int hands = request.quick ? 2 : kHands;
  const double share = c.moment ? kHeldMoment : 1;
  for (int i = 0; i < hands; ++i) {
    const std::uint64_t seed = request.seed + static_cast<std::uint64_t>(i);
    HeldStylus bench(
        {.truth = draw_parameters(seed), .seed = seed, .holds = draw_hand_parameters(GripPreset::kNormal, seed)});
    const Wrench without = bench.read_as_held({}), with = bench.read_as_held(law_of(c, share));
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
  const PlantParameters truth = draw_parameters(request.seed);
  const DeviceModel model = calibrated_model(truth, request.seed);
  for (std::size_t i = 0; i < cases().size(); ++i) {
    const Case& c = cases()[i];
    e.map[i] = map_error(c);
    const HeldStylusConfig chain{.truth = truth, .model = model, .seed = request.seed + 10 * i};
    HeldStylus whole(chain);
    e.chain[i] = measured_error(whole, c);
    e.held[i] = held_error(c, request);
    if (!request.sensor.empty()) {
      HeldStylusConfig through = chain;
      through.line = request.sensor;
      HeldStylus line(through);
      e.through[i] = measured_error(line, c);
      e.taken += line.taken(), e.left_out += line.left_out();
    }
    if (request.quick) continue;
    HeldStylus without_friction({.truth = ideal(), .force = clean, .moment = clean, .seed = request.seed});
    e.quantised[i] = measured_error(without_friction, c);
    HeldStylus raw({.truth = truth, .seed = chain.seed});
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
