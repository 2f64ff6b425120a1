#include "app/cli/device/device_calibrate.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/text_table.h"
#include "app/session/calibration/amplifier_calibration.h"
#include "app/session/calibration/calibration_file.h"
#include "app/session/setup/device_files.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/input_error.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

constexpr double kLargestGain = 10;  // a nominal gain ten times over drives 100 mN m at 1 V
constexpr double kRendered = 0.01;   // of the torque asked for

SimulatedDaqConfig calibrated_device(const CalibrateOptions& options) {
  if (!(options.gain >= 0 && options.gain <= kLargestGain))
    throw InputError("device calibrate: --gain lies in 0 to 10");
  SimulatedDaqConfig config;
  config.seed = options.seed;
  config.plant = true_plant(options.plant, options.seed).parameters;
  for (ChannelParameters& c : config.plant->channel) c.amplifier_gain *= options.gain;
  return config;
}

std::string plant_of(const CalibrateOptions& options) {
  std::ostringstream plant;
  plant << simulated_plant_words(true_plant(options.plant, options.seed).words);
  if (options.gain != 1) plant << ", amplifier gain times " << options.gain;
  return plant.str();
}

void print_amplifiers(const AmplifierCalibration& found, const DeviceModel& nominal, const ChannelVector& error,
                      std::ostream& out) {
  using Align = TextTable::Align;
  TextTable table({{"channel", Align::kLeft},
                   {"A/V", Align::kRight},
                   {"+-", Align::kRight},
                   {"of nominal", Align::kRight},
                   {"offset, mV", Align::kRight},
                   {"+-", Align::kRight},
                   {"stiction, mN m", Align::kRight},
                   {"torque off, %", Align::kRight}});
  for (int i = 0; i < kChannels; ++i) {
    const ChannelCalibration& c = found[static_cast<std::size_t>(i)];
    const double nominal_gain = nominal.transmission[static_cast<std::size_t>(i)].amps_per_volt;
    table.add({i == kPinchChannel ? "pinch" : "joint " + std::to_string(i + 1), cell(c.amps_per_volt, 4),
               cell(c.amps_per_volt_sd, 4), cell(c.amps_per_volt / nominal_gain, 4), cell(c.offset_v * 1e3, 2),
               cell(c.offset_sd_v * 1e3, 2), cell(c.stiction_nm * 1e3, 2), cell(error[i] * 100, 2)});
  }
  table.print(out);
}

}  // namespace

int device_calibrate(const CalibrateOptions& options, std::ostream& out, std::ostream& err) {
  TorqueRig rig(calibrated_device(options), {}, options.seed);
  const DeviceModel nominal;
  if (!options.check.empty() && !options.out.empty()) throw InputError("device calibrate: --check writes no --out");
  const AmplifierCalibration found =
      options.check.empty() ? calibrate_amplifiers(rig, nominal) : read_calibration(options.check);
  const ChannelVector error = rendering_error(rig, calibrated(nominal, found));
  const std::string json = calibration_json(found, nominal, plant_of(options));
  if (!options.out.empty()) {
    write_file(options.out, json);
    err << "trocar: calibration in " << options.out.string() << '\n';
  }
  if (options.json)
    out << json;
  else
    print_amplifiers(found, nominal, error, out);
  err << "trocar: on the simulated device of " << true_plant(options.plant, options.seed).words
      << "; the calibrated model renders torque to " << error.maxCoeff() * 100 << " %\n";
  return error.maxCoeff() <= kRendered ? 0 : 1;
}

void add_device_calibrate(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<CalibrateOptions>();
  CalibrateOptions& o = *given;
  CLI::App* calibrate = add_command(parent, "calibrate", "Gain and offset of the amplifiers, found on a bench rig",
                                    chosen, [given] { return device_calibrate(*given, std::cout, std::cerr); });
  calibrate->add_option("--seed", o.seed, "Of the simulated device and the rig")
      ->capture_default_str()
      ->check(seed_range());
  calibrate->add_option("--gain", o.gain, "Of the simulated amplifiers over nominal (the thesis': 5)")
      ->capture_default_str();
  calibrate->add_option("--out", o.out, "Calibration as JSON")->check(writable_path());
  calibrate->add_option("--check", o.check, "A calibration file: how well does it render on this device?");
  calibrate->add_option("--plant", o.plant, "Plant file of the device, instead of the seed's")->check(file_name());
  calibrate->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
