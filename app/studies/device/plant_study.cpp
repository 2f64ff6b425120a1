#include "app/studies/device/plant_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/device_bench/plant_bench.h"
#include "app/device_bench/wall_trial.h"
#include "haptics/device/plant/plant_heat.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {
namespace {

constexpr double kPlantStep = 50e-6;  // s, of the plant
constexpr double kWall = 300;         // N/m
constexpr double kRunUp = 0.015, kBeyond = 0.015, kReachS = 0.25, kWatchedS = 1.5;
constexpr double kLimitC = 125;
constexpr double kRippleBar = 0.2;  // N, of the Z-width protocol
constexpr double kRippleWindow = 0.5;

PlantParameters elastic(PlantParameters p, double damping) {
  for (CableParameters& cable : p.options.cable) cable = {kNominalCable, damping, 0.5};
  return p;
}

PlantParameters without_friction(PlantParameters p) {
  for (ChannelParameters& c : p.channel) {
    c.friction.coulomb = c.friction.viscous = 0;
    c.stop.lower = -std::numeric_limits<double>::infinity();
    c.stop.upper = std::numeric_limits<double>::infinity();
  }
  return p;
}

/// Largest change of energy over the motion's own, a second.
double energy_drift(const PlantParameters& p, double seconds) {
  DevicePlant plant(p);
  const double rest = plant.energy();
  JointVector qd;
  qd << 1.0, -0.8, 0.7, 1.5, -2.0, 3.0;
  plant.set_joint_rates(qd);
  const double start = plant.energy();
  double worst = 0;
  for (long n = std::lround(seconds / kPlantStep); n > 0; --n) {
    plant.step(kPlantStep, {});
    worst = std::max(worst, std::abs(plant.energy() - start));
  }
  return worst / (start - rest) / seconds;
}

void add_energy(StudyResult& study, const StudyRequest& request) {
  const double seconds = request.quick ? 0.2 : 0.5;  // before a leg can strike, which takes energy
  const PlantParameters p = without_friction(request.true_device());
  const auto add = [&](const std::string& name, double drift) {
    study.cases.push_back(
        {name, "1/s", drift, std::nullopt, "< 1e-4", drift < 1e-4,
         "Largest change of the energy of a free swing from home, over the motion's own energy and the "
         "time; no friction, steps of 50 us."});
  };
  add("energy drift, rigid cables", energy_drift(p, seconds));
  add("energy drift, cables of 100 N m/rad without damping", energy_drift(elastic(p, 0), seconds));
}

/// Upward crossings of a rotor that swings against its held joint, Hz.
double rotor_hz(const PlantParameters& p) {
  const ChannelParameters& c = p.channel[0];
  PlantCable cable({kNominalCable, 0, 0}, c.rotor_inertia / (c.ratio * c.ratio), {});
  cable.place(0, 1);
  double last = 0, first_s = -1, last_s = 0;
  int swings = -1;
  for (int n = 1; n <= 4000; ++n) {
    cable.drift(kPlantStep / 2);
    cable.linearise(0, 0, 0, kPlantStep);
    cable.advance(0, kPlantStep);
    cable.drift(kPlantStep / 2);
    if (last < 0 && cable.angle() >= 0) {
      last_s = (n - cable.angle() / (cable.angle() - last)) * kPlantStep;
      if (++swings == 0) first_s = last_s;
    }
    last = cable.angle();
  }
  return swings / (last_s - first_s);
}

void add_cable(StudyResult& study) {
  const PlantParameters p = nominal_parameters();
  const ChannelParameters& c = p.channel[0];
  const double rotor = c.rotor_inertia / (c.ratio * c.ratio);
  const double theory = std::sqrt(kNominalCable / rotor) / (2 * std::numbers::pi), measured = rotor_hz(p);
  study.cases.push_back({"rotor behind a cable of 100 N m/rad", "Hz", measured, std::nullopt,
                         "sqrt(k/Jr)/2 pi within 0.5 %", std::abs(measured / theory - 1) < 5e-3,
                         "Swings of the rotor against a held joint over 0.2 s, no damping."});
}

double seconds_to_limit(double current) {
  PlantHeat heat({.on = true}, nominal_parameters().channel[0].resistance);
  double t = 0;
  for (; heat.winding_c() < kLimitC && t < 3600; t += 1e-3) heat.advance(current, 1e-3);
  return t;
}

void add_heat(StudyResult& study) {
  const double full = seconds_to_limit(4.31);
  study.cases.push_back({"winding from 25 to 125 C at 4.31 A", "s", full, std::nullopt, "10.5 to 11.5",
                         full > 10.5 && full < 11.5, "+-10 V at the DAC; two-node model, remembered thermal values."});
  StudyCurves curves{"heat", "Windings on the simulated plant, 25 C around", "time, s", "temperature, C", {}, {}};
  const std::pair<double, const char*> currents[] = {{4.31, "4.31 A"}, {2.0, "2 A"}, {1.2, "1.2 A"}};
  for (const auto& [current, name] : currents) {
    PlantHeat heat({.on = true}, nominal_parameters().channel[0].resistance);
    StudyCurves::Series winding{std::string("winding at ") + name, {}};
    for (int s = 0; s <= 120; ++s) {
      if (curves.x.size() <= static_cast<std::size_t>(s)) curves.x.push_back(s);
      winding.y.push_back(heat.winding_c() <= 1.2 * kLimitC ? heat.winding_c() : std::nan(""));
      for (int n = 0; n < 1000; ++n) heat.advance(current, 1e-3);
    }
    curves.series.push_back(winding);
  }
  curves.series.push_back({"limit of the motor", std::vector<double>(curves.x.size(), kLimitC)});
  study.curves.push_back(curves);
  PlantHeat hour({.on = true}, nominal_parameters().channel[0].resistance);
  for (int n = 0; n < 360000; ++n) hour.advance(1.2, 0.01);
  study.cases.push_back({"winding after an hour at 1.2 A", "C", hour.winding_c(), std::nullopt, "97 to 99",
                         hour.winding_c() > 97 && hour.winding_c() < 99, "Two-node model, 25 C around."});
}

struct Press {
  std::vector<double> force_n;
  double ripple_n = 0, least_n = 0, hottest_c = 0;  ///< of the last half second; end
  bool faulted = false;
};

Press press_plant(const PlantParameters& p) {
  SimulatedDaqConfig device = nominal_device();
  device.plant = p;
  HapticLoopConfig loop;
  loop.tool.shaft_length_m = 1e-3;  // a ball
  PlantBench bench(device, loop);
  Press out;
  try {
    bench.start();
    const Pose start = arm_state(near_home(kRunUp + kBeyond)).X_WS;
    bench.move(start, 1.2);
    bench.run(0.3);
    const Vec3 into = -start.R.col(1);
    ContactMaterial wall;
    wall.stiffness_n_per_m = kWall;
    wall.damping_s_per_m = 0;
    bench.put_wall(start.p + kRunUp * into, -into, wall);
    for (long k = 0; k < std::lround(kWatchedS / bench.period_s()); ++k) {
      const double share = std::min(1.0, static_cast<double>(k) * bench.period_s() / kReachS);
      const double s = share * share * share * (10 + share * (6 * share - 15));
      bench.goal() = {start.R, start.p + s * (kRunUp + kBeyond) * into};
      out.force_n.push_back(bench.tick().stylus.rendered_force_T.norm());
    }
  } catch (const BenchFault&) {
    out.faulted = true;
  }
  const auto late = out.force_n.end() - std::min<long>(static_cast<long>(out.force_n.size()),
                                                       std::lround(kRippleWindow / bench.period_s()));
  if (late != out.force_n.end()) {
    const auto [least, most] = std::minmax_element(late, out.force_n.end());
    out.ripple_n = *most - *least;
    out.least_n = *least;
  }
  out.hottest_c = bench.daq().plant().windings_c().maxCoeff();
  return out;
}

void add_wall(StudyResult& study, const StudyRequest& request) {
  const PlantParameters plain = request.true_device();
  StudyCurves curves{"wall", "Press into a wall of 300 N/m on the simulated plant", "time, s", "rendered force, N", {},
                     {}};
  const auto add = [&](const std::string& name, const std::string& curve, const PlantParameters& p) {
    const Press pressed = press_plant(p);
    if (curves.x.empty()) {
      for (std::size_t k = 0; k < pressed.force_n.size(); ++k) curves.x.push_back(static_cast<double>(k) * 1e-3);
    }
    std::vector<double> force = pressed.force_n;
    force.resize(curves.x.size(), std::nan(""));
    if (!curve.empty()) curves.series.push_back({curve, force});
    study.cases.push_back(
        {"ripple at a wall of 300 N/m, " + name, "N", pressed.ripple_n, std::nullopt, "< 0.2, in contact, no fault",
         pressed.ripple_n < kRippleBar && pressed.least_n > 0 && !pressed.faulted,
         "Peak to peak of the rendered force over the last 0.5 s of a press of 1.5 s; default law, normal "
         "grip, the hand aims 15 mm past the wall; least force then " +
             std::to_string(pressed.least_n).substr(0, 5) + " N, hottest winding " +
             std::to_string(pressed.hottest_c).substr(0, 5) + " C."});
  };
  add("options as given", "plant as given", plain);
  PlantParameters all = elastic(plain, 0.02);
  all.options.jitter_periods = 2;
  all.options.heat.on = true;
  add("elastic cables, jitter, heat", "elastic cables, jitter, heat", all);
  all.options.encoder = {1e-3, 100e3};
  add("the same and missed counts", "", all);
  study.curves.push_back(curves);
}

}  // namespace

StudyResult plant_study(const StudyRequest& request) {
  StudyResult study{"plant", "simulated plant of " + request.device_words(), {}, {}};
  add_energy(study, request);
  add_cable(study);
  add_heat(study);
  add_wall(study, request);
  return study;
}

}  // namespace trocar
