#include "app/cli/device/identify_command.h"

#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/session/calibration/calibration_file.h"
#include "app/session/setup/device_files.h"
#include "app/session/setup/true_plant.h"
#include "app/studies/device/drive_weighing.h"
#include "app/studies/device/identified_device.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/files/device_file.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

using nlohmann::ordered_json;

constexpr double kMostPayload_kg = 0.05;  // 0.13 N m at the shoulder beyond what the poses are chosen for

std::vector<double> value_list(const JointVector& v) { return {v.data(), v.data() + v.size()}; }

/// Weight that would stand at the stylus origin, by the second link's first moment.
double stylus_weight(const Identification& id) { return id.device.identified_gravity->link2.x() / kLink2; }

ordered_json drives_json(const DriveWeighing& drives, const std::string& sensor) {
  return {{"sensor", sensor},
          {"scale", value_list(drives.scale)},
          {"deviation", value_list(drives.deviation)},
          {"readings", drives.taken},
          {"left_out", drives.left_out}};
}

ordered_json identified_json(const Identification& id, const DriveWeighing* drives, const IdentifyOptions& options) {
  ordered_json json{{"plant", "simulated, " + std::string(options.plant.empty() ? "drawn by " : "") +
                                  true_plant(options.plant, options.seed).words},
                    {"seed", options.seed},
                    {"poses", id.request.poses},
                    {"payload_kg", options.payload_kg},
                    {"duration_s", id.duration_s},
                    {"hottest_winding_c", id.hottest_c},
                    {"condition_number", id.condition},
                    {"dropped", id.fit.dropped},
                    {"stylus_weight_n", stylus_weight(id)},
                    {"least_inertia_kg_m2", id.least_inertia},
                    {"doubts", id.doubts},
                    {"prediction_error", value_list(id.prediction_error)},
                    {"prediction_error_moving", value_list(id.moving_error)},
                    {"prediction_error_nominal", value_list(id.nominal_error)},
                    {"static",
                     {{"friction_n_m", value_list(id.poses.coulomb)},
                      {"friction_deviation_n_m", value_list(id.poses.coulomb_deviation)},
                      {"gravity_residual_n_m", value_list(id.poses.gravity_residual)},
                      {"nominal_residual_n_m", value_list(id.poses.nominal_residual)}}},
                    {"parameters", ordered_json::array()}};
  for (const FitParameter& p : id.fit.parameter) {
    json["parameters"].push_back(
        {{"name", p.name}, {"unit", p.unit}, {"value", p.value}, {"deviation", p.deviation}, {"used", p.used}});
  }
  json["drives"] = drives ? drives_json(*drives, options.sensor) : ordered_json(nullptr);
  return json;
}

void print_joints(std::ostream& out, const std::string& what, const JointVector& v, double scale, int decimals) {
  out << std::left << std::setw(44) << what << std::right << std::fixed << std::setprecision(decimals);
  for (int i = 0; i < kArmJoints; ++i) out << std::setw(9) << scale * v[i];
  out << '\n';
}

void print_drives(const DriveWeighing& drives, const std::string& sensor, std::ostream& out) {
  print_joints(out, "torque that came by " + sensor + ", % of the asked", drives.scale, 100, 2);
  print_joints(out, "  standard deviation", drives.deviation, 100, 2);
  out << "  of " << drives.taken << " readings, " << drives.left_out << " more left out\n";
}

void print_identified(const Identification& id, const DriveWeighing* drives, const IdentifyOptions& options,
                      std::ostream& out) {
  out << "On the simulated plant, " << true_plant(options.plant, options.seed).words << ": " << id.request.poses
      << " poses, " << id.request.trajectories << " trajectories, " << std::lround(id.duration_s)
      << " s of device time, hottest winding " << std::lround(id.hottest_c) << " C\nCondition number "
      << std::setprecision(3) << id.condition << ", "
      << id.fit.parameter.size() - static_cast<std::size_t>(id.fit.dropped) << " of " << id.fit.parameter.size()
      << " parameters told by the data\n\n";
  for (const FitParameter& p : id.fit.parameter) {
    out << std::left << std::setw(12) << p.name << std::right << std::scientific << std::setprecision(3)
        << std::setw(12) << p.value << " +- " << std::setw(10) << p.deviation << ' ' << p.unit
        << (p.used ? "" : "  (not told)") << '\n';
  }
  out << '\n' << std::left << std::setw(44) << "joint" << std::right;
  for (int i = 1; i <= kArmJoints; ++i) out << std::setw(9) << i;
  out << '\n';
  if (drives) print_drives(*drives, options.sensor, out);
  print_joints(out, "friction from the poses, mN m", id.poses.coulomb, 1e3, 2);
  print_joints(out, "weight left over in the poses, mN m", id.poses.gravity_residual, 1e3, 2);
  print_joints(out, "  by the nominal model, mN m", id.poses.nominal_residual, 1e3, 2);
  print_joints(out, "unseen trajectory, % rms", id.prediction_error, 100, 2);
  print_joints(out, "  while the joint moves, % rms", id.moving_error, 100, 2);
  print_joints(out, "  by the nominal weights and friction, % rms", id.nominal_error, 100, 2);
  out << "\nstylus weight " << std::setprecision(4) << stylus_weight(id)
      << " N; smallest eigenvalue of the inertia matrix " << std::scientific << std::setprecision(2) << id.least_inertia
      << " kg m2\n";
  for (const std::string& doubt : id.doubts) out << "doubtful: " << doubt << '\n';
}

/// What was identified, for the files that say so.
std::string plant_text(const IdentifyOptions& options) {
  std::ostringstream plant;
  plant << simulated_plant_words(true_plant(options.plant, options.seed).words);
  if (options.payload_kg > 0) plant << ", payload " << options.payload_kg << " kg";
  return plant.str();
}

void write_device(const std::filesystem::path& file, const Identification& id, const IdentifyOptions& options) {
  std::ostringstream comment;
  comment << "Identified on the simulated plant, " << true_plant(options.plant, options.seed).words << ", payload "
          << options.payload_kg << " kg, " << id.request.poses << " poses"
          << (options.sensor.empty() ? "" : ", drives weighed by a force sensor (" + options.sensor + ')')
          << ";\ntorques of an unseen trajectory are off by";
  for (int i = 0; i < kArmJoints; ++i)
    comment << ' ' << std::fixed << std::setprecision(1) << 100 * id.prediction_error[i];
  comment << " % rms (joints 1 to 6).";
  write_file(file, device_toml(id.device, comment.str(), plant_text(options)));
}

}  // namespace

int identify_command(const IdentifyOptions& options, std::ostream& out, std::ostream& err) {
  if (!(options.payload_kg >= 0 && options.payload_kg <= kMostPayload_kg)) {
    throw InputError("--payload: 0 to 0.05 kg, more would overload the motors");
  }
  if (!options.calibration_out.empty() && options.sensor.empty()) {
    throw InputError(
        "--calibration-out: the drives are known only with --sensor; trocar device calibrate writes the rig's");
  }
  // Half a minute of work for a file that cannot be written would be unkind.
  for (const std::filesystem::path& file : {options.out, options.calibration_out})
    if (!file.empty() && !std::ofstream(file, std::ios::binary | std::ios::app))
      throw EnvironmentError(file.string() + ": cannot be written");
  IdentifyRequest request = seeded_identification(options.seed, options.quick);
  if (!options.quick) request.poses = options.poses;
  request.span = options.span;
  const PlantParameters truth = with_payload(true_plant(options.plant, options.seed).parameters, options.payload_kg);
  std::optional<DriveWeighing> drives;
  if (!options.sensor.empty()) drives = weigh_drives(truth, {}, options.sensor, options.seed);
  const Identification id = identify_simulated(truth, request, drives ? weighed({}, *drives) : DeviceModel{});
  const DriveWeighing* shown = drives ? &*drives : nullptr;
  if (options.json)
    out << identified_json(id, shown, options).dump(2) << '\n';
  else
    print_identified(id, shown, options, out);
  if (!options.out.empty()) {
    write_device(options.out, id, options);
    err << "trocar: device file " << options.out.string() << '\n';
  }
  if (!options.calibration_out.empty()) {
    write_file(options.calibration_out, calibration_json(as_calibration(*drives, id), {}, plant_text(options)));
    err << "trocar: calibration " << options.calibration_out.string() << '\n';
  }
  return id.doubts.empty() ? 0 : 1;
}

void add_device_identify(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<IdentifyOptions>();
  IdentifyOptions& o = *given;
  CLI::App* identify =
      add_command(parent, "identify", "Weights, inertias and friction of a simulated device from its motion", chosen,
                  [given] { return identify_command(*given, std::cout, std::cerr); });
  identify->add_option("--seed", o.seed, "Of the simulated device, poses and trajectories")
      ->capture_default_str()
      ->check(seed_range());
  identify->add_option("--poses", o.poses, "Static poses")->capture_default_str()->check(CLI::Range(6, 1000));
  identify->add_option("--span", o.span, "Share of workspace and amplitude that is used")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1.0));
  identify->add_option("--payload", o.payload_kg, "Unknown mass on the stylus, kg")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.05));
  identify->add_option("--plant", o.plant, "Plant file of the device, instead of the seed's")->check(file_name());
  identify
      ->add_option(
          "--sensor", o.sensor,
          "Weigh the drives first, by a force sensor that holds the stylus, through its driver: SI instead of the "
          "device's own units")
      ->check(CLI::IsMember({"net-ft", "serial"}));
  identify
      ->add_option("--calibration-out", o.calibration_out,
                   "Gains and offsets so found, as device calibrate writes them")
      ->check(writable_path());
  identify->add_flag("--quick", o.quick, "20 poses and one trajectory");
  identify->add_option("--out", o.out, "Device file (TOML) to write")->check(writable_path());
  identify->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
