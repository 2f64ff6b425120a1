#include "app/cli/device/device_plant.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>

#include "app/cli/command.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/plant/device_plant.h"
#include "haptics/input_error.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

constexpr double kPush = 1e-6;  // s: so short that nothing but inertia answers

/// Masses felt at the stylus at home along their principal directions, kg, lightest first: free of weight, friction and
/// cables, the stylus free to turn.
Vec3 felt_masses(PlantParameters p) {
  p.gravity = 0;
  p.options = {};
  for (ChannelParameters& c : p.channel) c.friction.coulomb = c.friction.viscous = 0;
  Mat3 mobility;  // m/s2 a newton
  for (int axis = 0; axis < 3; ++axis) {
    DevicePlant plant(p);
    plant.step(kPush, {{Vec3::Unit(axis), Vec3::Zero()}, 0});
    mobility.col(axis) = plant.motion().V_BS.linear / kPush;
  }
  const Mat3 symmetric = 0.5 * (mobility + mobility.transpose());
  const Vec3 light_last = Eigen::SelfAdjointEigenSolver<Mat3>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
  return light_last.reverse().cwiseInverse();
}

std::string option_words(const PlantOptions& o, const PlantParameters& p) {
  std::ostringstream out;
  for (int i = 0; i < kArmJoints; ++i) {
    const CableParameters& cable = o.cable[static_cast<std::size_t>(i)];
    if (cable.stiffness <= 0) continue;
    const ChannelParameters& c = p.channel[static_cast<std::size_t>(i)];
    const double rotor = c.rotor_inertia / (c.ratio * c.ratio);
    out << (out.str().empty() ? "elastic cables: rotor" : ",") << " th" << i + 1 << " at "
        << std::lround(std::sqrt(cable.stiffness / rotor) / (2 * std::numbers::pi)) << " Hz";
  }
  const auto add = [&](bool on, const std::string& what) {
    if (on) out << (out.str().empty() ? "" : "; ") << what;
  };
  add(o.encoder.missed_per_edge > 0 || o.encoder.limit_hz > 0, "encoders that miss counts");
  add(o.encoder.uneven_counts > 0, "uneven encoders");
  add(o.jitter_periods > 0, "jitter up to " + std::to_string(o.jitter_periods) + " periods");
  add(o.heat.on, "motors that warm up");
  return out.str().empty() ? "none" : out.str();
}

/// What tells at a glance whether this is a sensible arm.
void report(const PlantParameters& p, const std::string& what, std::ostream& err) {
  const JointVector hold = DevicePlant(p).holding_torque();
  double weight = p.stylus_mass, most = 0;
  for (const PlatformMass& m : p.platform_masses) weight += m.mass;
  for (int i = 0; i < kArmJoints; ++i) {
    const ChannelParameters& c = p.channel[static_cast<std::size_t>(i)];
    const double current = std::min(p.current_limit, c.amplifier_gain * p.dac_full_scale);
    most = std::max(most, std::abs(hold[i]) * c.ratio / (c.torque_constant * current));
  }
  const Vec3 felt = felt_masses(p);
  std::ostringstream text;
  text.precision(3);
  text << "trocar: " << what << ": weight of what moves " << weight * p.gravity << " N; at home its holding takes "
       << 100 * most << " % of the weakest joint's torque; mass felt at the stylus there " << felt[0] << ", " << felt[1]
       << " and " << felt[2] << " kg, lightest to heaviest direction; options: " << option_words(p.options, p) << '\n';
  err << text.str();
  if (most > 1) err << "trocar: its motors cannot hold this arm up\n";
}

PlantParameters chosen(const PlantOptionsGiven& options, std::string& what) {
  if (!options.plant.empty()) {
    if (options.seed || options.all) throw InputError("device plant: --plant FILE takes its seed from the file");
    const PlantFile file = load_plant(options.plant);
    what = plant_words(file);
    return file.parameters;
  }
  if (!options.seed) {
    if (options.all) throw InputError("device plant: --all needs a --seed to draw by");
    what = "nominal plant";
    return nominal_parameters();
  }
  what = "plant of seed " + std::to_string(*options.seed) + (options.all ? ", everything drawn" : "");
  return options.all ? draw_everything(*options.seed) : draw_parameters(*options.seed);
}

}  // namespace

int device_plant(const PlantOptionsGiven& options, std::ostream& out, std::ostream& err) {
  std::string what;
  const PlantParameters plant = chosen(options, what);
  const std::string text = plant_toml(plant, "Trocar: " + what + ". docs/plant.md explains every value.");
  if (options.out.empty()) {
    out << text;
  } else {
    write_file(options.out, text);
    err << "trocar: plant file " << options.out.string() << '\n';
  }
  report(plant, what, err);
  return 0;
}

void add_device_plant(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<PlantOptionsGiven>();
  PlantOptionsGiven& o = *given;
  CLI::App* plant = add_command(
      parent, "plant", "The simulated device as a plant file, every value with its source; or the check of one", chosen,
      [given] { return device_plant(*given, std::cout, std::cerr); });
  plant->add_option("--seed", o.seed, "The device that this seed draws (default: the nominal one)")
      ->check(seed_range());
  plant->add_flag("--all", o.all, "Draw also what seeds leave nominal");
  plant->add_option("--plant", o.plant, "Plant file: check it and print it complete")->check(file_name());
  plant->add_option("--out", o.out, "File instead of standard output")->check(writable_path());
}

}  // namespace trocar
