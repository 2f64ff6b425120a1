#include "app/studies/contact/contact_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/studies/device/identified_device.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/force_sensor/simulated_wrench_sensor.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kToRestS = 1.2, kSettleS = 0.4;
constexpr double kEase = 0.2, kEaseS = 0.3;  // share of the depth, s
constexpr int kMovesPerContact = 3;          // in, ease, out
constexpr std::uint64_t kIdentifiedBy = 1;   // seed of the poses and movements
constexpr int kWaySteps = 50;                // of a move, when its joints are looked at

Pose between(const Pose& from, const Pose& to, double share) {
  const Eigen::AngleAxisd turn(Mat3(to.R * from.R.transpose()));
  return {Eigen::AngleAxisd(share * turn.angle(), turn.axis()) * from.R, from.p + share * (to.p - from.p)};
}

/// Share of its time at which a minimum-jerk move from rest to `deep` meets the face.
double touch_share(const ContactExperiment& e, const ContactFace& face, const Pose& deep) {
  if (clearance(e, e.rest, face) <= 0 || clearance(e, deep, face) >= 0) {
    throw std::invalid_argument("contact experiment: the way from rest does not lead into the face");
  }
  double out = 0, in = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (out + in);
    (clearance(e, between(e.rest, deep, minimum_jerk(middle)), face) > 0 ? out : in) = middle;
  }
  return out;
}

/// Share of its time at which a minimum-jerk move has left all but `rest` of its way behind.
double leave_share(double rest) {
  double early = 0, late = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (early + late);
    (1 - minimum_jerk(middle) > rest ? early : late) = middle;
  }
  return early;
}

SimulatedDaqConfig device_of(const ContactSetting& setting) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  for (ChannelParameters& channel : device.plant->channel) channel.amplifier_gain *= setting.gain;
  device.hand = draw_hand_parameters(GripPreset::kNormal, setting.seed);
  device.seed = setting.seed;
  return device;
}

/// What identification finds about the device of these studies.
const DeviceModel& identified_nominal() {
  static const DeviceModel found =
      identify_simulated(nominal_parameters(), seeded_identification(kIdentifiedBy, false)).device;
  return found;
}

HapticLoopConfig loop_of(const ContactExperiment& experiment, const ContactSetting& setting) {
  HapticLoopConfig loop;
  loop.tool = experiment.tool;
  loop.map.X_SI = experiment.X_SI;
  loop.passivity.law = setting.law;
  loop.carry_weight = setting.compensation;
  if (setting.compensation)
    loop.device = identified_nominal();
  else
    loop.friction.share = 0;
  return loop;
}

WrenchSensorConfig sensor_of(const ContactSetting& setting) {
  WrenchSensorConfig sensor;
  sensor.fixture_kg = setting.fixture_kg;
  sensor.gravity = nominal_parameters().gravity;
  return sensor;
}

void add_sample(double t, const HandSense& sense, SimulatedWrenchSensor& sensor, ContactRecording& out) {
  const WrenchSample sample = sensor.sample(sense.X_BS.R, {sense.force_on_hand, sense.moment_on_hand});
  if (!sample.valid) return;
  out.sensor_t.push_back(t);
  out.read.push_back(sample.read);
  out.measured.push_back(sample.without_fixture);
}

/// What the environment asks for in this tick, in stylus axes.
void add_tick(double t, const PlantBench& bench, ContactRecording& out) {
  const TickRecord& record = bench.record();
  const Pose X_WS = arm_state(record.q.head<kArmJoints>()).X_WS;
  const Mat3 R_SW = X_WS.R.transpose();
  const Wrench F_W = bench.loop_config().map.stylus_wrench(X_WS, record.stylus.F_I_T);
  const Vec3 lever = record.stylus.contact ? Vec3(X_WS.p - record.stylus.contact_point_T) : Vec3::Zero();
  out.t.push_back(t);
  out.desired.push_back({R_SW * F_W.force, R_SW * F_W.moment});
  out.printed_moment.push_back(R_SW * lever.cross(F_W.force));
  out.rendered_n.push_back(record.stylus.rendered_force_T.norm());
}

}  // namespace

void add_rectangle(std::vector<SurfaceTriangle>& surface, const Vec3& centre, const Vec3& u, const Vec3& v) {
  const Vec3 a = centre - u - v, b = centre + u - v, c = centre + u + v, d = centre - u + v;
  surface.push_back({a, b, c});
  surface.push_back({a, c, d});
}

void add_cube(std::vector<SurfaceTriangle>& surface, const Pose& X_WC, double side_m) {
  const double h = 0.5 * side_m;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 n = h * X_WC.R.col(axis), u = h * X_WC.R.col((axis + 1) % 3), v = h * X_WC.R.col((axis + 2) % 3);
    add_rectangle(surface, X_WC.p + n, u, v);
    add_rectangle(surface, X_WC.p - n, v, u);
  }
}

double clearance(const ContactExperiment& experiment, const Pose& X_WS, const ContactFace& face) {
  const Pose X_WI = X_WS * experiment.X_SI;
  const Vec3 tip = X_WI.p, end = X_WI * Vec3(0, 0, -experiment.tool.shaft_length_m);
  return std::min(face.normal.dot(tip - face.point), face.normal.dot(end - face.point)) - experiment.tool.radius_m;
}

void add_contact(ContactExperiment& experiment, const ContactFace& face, const Pose& deep, double touch_s,
                 double leave_s, double travel_s) {
  const double share = touch_share(experiment, face, deep);
  const double set_out = touch_s - share * travel_s, in = set_out + travel_s;
  const double eased = 1 - kEase * (1 - minimum_jerk(share));
  const double back = leave_s - leave_share(minimum_jerk(share) / eased) * travel_s, ease = 0.5 * (in + back - kEaseS);
  const double free_from = experiment.moves.empty() ? experiment.begins_s : experiment.moves.back().to_s;
  if (set_out < free_from || ease < in) {
    throw std::invalid_argument("contact experiment: a contact overlaps the one before or itself");
  }
  experiment.moves.push_back({set_out, in, deep});
  experiment.moves.push_back({ease, ease + kEaseS, between(experiment.rest, deep, eased)});
  experiment.moves.push_back({back, back + travel_s, experiment.rest});
}

std::vector<Spell> holds(const ContactExperiment& experiment, const std::vector<Spell>& touched, double late_s) {
  std::vector<Spell> found;
  for (const Spell& spell : touched) {
    for (std::size_t i = kMovesPerContact - 1; i < experiment.moves.size(); i += kMovesPerContact) {
      const double back = experiment.moves[i].from_s;
      if (back > spell.from_s && back < spell.to_s) found.push_back({spell.from_s + late_s, back});
    }
  }
  return found;
}

Pose goal_at(const ContactExperiment& e, double t) {
  Pose goal = e.rest;
  for (const ContactMove& move : e.moves) {
    if (t >= move.from_s) goal = between(goal, move.goal, minimum_jerk((t - move.from_s) / (move.to_s - move.from_s)));
  }
  return goal;
}

double least_joint_margin(const ContactExperiment& experiment) {
  double least = std::numeric_limits<double>::infinity();
  JointVector near = home_angles();
  const auto look_at = [&](const Pose& goal) {
    const auto q = inverse_within_limits(goal, near);
    if (q) near = *q;
    least = std::min(least, q ? joint_limit_margin(*q) : -1.0);
  };
  look_at(experiment.rest);
  for (const ContactMove& move : experiment.moves) {
    for (int i = 0; i <= kWaySteps; ++i) {
      look_at(goal_at(experiment, move.from_s + i * (move.to_s - move.from_s) / kWaySteps));
    }
  }
  return least;
}

ContactRecording record_contacts(const ContactExperiment& experiment, const ContactSetting& setting) {
  PlantBench bench(device_of(setting), loop_of(experiment, setting));
  bench.start();
  bench.move(experiment.rest, kToRestS);
  bench.run(kSettleS);
  ContactMaterial material;
  material.stiffness_n_per_m = setting.stiffness;
  material.damping_s_per_m = 0;  // a spring, as in the thesis
  bench.put_surface(experiment.surface, material);
  SimulatedWrenchSensor sensor(sensor_of(setting), setting.seed);
  const long every = std::lround(1 / (bench.period_s() * sensor.config().force.rate_hz));
  const long ticks = std::lround((experiment.ends_s - experiment.begins_s) / bench.period_s());
  ContactRecording out;
  for (long k = 0; k < ticks; ++k) {
    const double t = experiment.begins_s + static_cast<double>(k) * bench.period_s();
    bench.goal() = goal_at(experiment, t);
    bench.tick();
    add_tick(t, bench, out);
    if (k % every == 0) add_sample(t, bench.daq().sense(), sensor, out);
  }
  return out;
}

double component(const Wrench& wrench, Component which) {
  const int i = static_cast<int>(which);
  return i < 3 ? wrench.force[i] : wrench.moment[i - 3];
}

const char* component_name(Component which) {
  constexpr std::array kNames{"force along X6",  "force along Y6",  "force along Z6",
                              "torque about X6", "torque about Y6", "torque about Z6"};
  return kNames[static_cast<std::size_t>(which)];
}

Curve curve_of(const std::vector<double>& t, const std::vector<Wrench>& wrenches, Component which) {
  Curve curve{t, {}};
  for (const Wrench& wrench : wrenches) curve.y.push_back(component(wrench, which));
  return curve;
}

}  // namespace trocar
