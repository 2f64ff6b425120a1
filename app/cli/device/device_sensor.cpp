// `trocar device sensor`: what a real force sensor says now, and what its line loses.
#include <chrono>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/session/interrupt.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/device_file.h"

namespace trocar {
namespace {

constexpr double kSensorLinesHz = 10;
constexpr int kSilent = 4;

struct SensorCommand {
  std::string sensor = {};
  double seconds = 5;
  bool bias = false, json = false;
  std::filesystem::path device = {};
};

int device_sensor(const SensorCommand& options, std::ostream& out, std::ostream& err) {
  InterruptWatch interrupt;  // before the sensor's thread
  const std::optional<SensorMount> mount = options.device.empty() ? std::nullopt : load_device(options.device).sensor;
  const std::unique_ptr<WrenchStream> sensor = make_force_sensor(options.sensor, mount);
  if (options.bias) sensor->bias();
  const WrenchCounts counts = sensor->link().counts;
  err << "trocar: " << (counts.doubt.empty() ? counts_words(counts) : counts.doubt) << '\n';
  int heard = 0;
  Vec3 mean = Vec3::Zero();
  const auto wait = std::chrono::duration<double>(1 / kSensorLinesHz);
  for (int k = 0; k < options.seconds * kSensorLinesHz && !interrupt.seen(); ++k) {
    std::this_thread::sleep_for(wait);
    const ForceSample sample = sensor->sample(Vec3::Zero());
    if (sample.valid) mean += sample.force, ++heard;
    if (options.json) continue;
    out << std::fixed << std::setprecision(3) << "force " << std::showpos << sample.force.transpose() << std::noshowpos
        << " N" << (sample.valid ? "" : "  not valid: silent, saturated or an error") << std::endl;
  }
  const WrenchLink link = sensor->link();
  if (heard > 0) mean /= heard;
  if (options.json)
    out << nlohmann::ordered_json{{"sensor", options.sensor},
                                  {"valid", heard},
                                  {"mean_n", {mean.x(), mean.y(), mean.z()}},
                                  {"records", link.records},
                                  {"lost", link.lost},
                                  {"out_of_order", link.out_of_order},
                                  {"malformed", link.malformed},
                                  {"unsound", link.unsound},
                                  {"begun", link.begun},
                                  {"taken_away", link.taken_away},
                                  {"counts_per_n", counts.per_n},
                                  {"counts_per_nm", counts.per_nm},
                                  {"counts_from", counts.from},
                                  {"counts_doubt", counts.doubt}}
               .dump(2)
        << '\n';
  err << "trocar: " << link_words(link) << '\n';
  return heard > 0 ? 0 : kSilent;
}

}  // namespace

void add_device_sensor(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<SensorCommand>();
  CLI::App* sensor =
      add_command(parent, "sensor", "What a real force sensor says now; 4 when it says nothing that holds", chosen,
                  [given] { return device_sensor(*given, std::cout, std::cerr); });
  sensor->add_option("sensor", given->sensor, "net-ft:ADDRESS, serial:/dev/ttyUSB0 or serial-binary:/dev/ttyUSB0")
      ->required();
  sensor->add_option("--seconds", given->seconds, "How long")->capture_default_str()->check(CLI::Range(0.1, 1e6));
  sensor
      ->add_option("--device", given->device,
                   "Device file whose [sensor] says how many counts a newton has; else a Net F/T box is asked")
      ->check(file_name());
  sensor->add_flag("--bias", given->bias, "Take the force at the beginning as zero");
  sensor->add_flag("--json", given->json, "As JSON");
}

}  // namespace trocar
