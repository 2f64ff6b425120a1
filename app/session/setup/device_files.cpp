#include "app/session/setup/device_files.h"

#include "app/session/calibration/calibration_file.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/device_file.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {
namespace {

std::optional<DeviceFile> read_file(const std::filesystem::path& path) {
  if (path.empty()) return std::nullopt;
  return DeviceFile{read_text_file(path.string()), path.filename().string()};
}

}  // namespace

DeviceFiles read_device_files(const std::filesystem::path& calibration, const std::filesystem::path& identified) {
  return {read_file(calibration), read_file(identified)};
}

DeviceModel device_model(const DeviceFiles& files) {
  DeviceModel model;
  if (files.identified) model = parse_device(files.identified->text, files.identified->name);
  if (files.calibration) model = calibrated(model, parse_calibration(files.calibration->text, files.calibration->name));
  return model;
}

DeviceModel device_model(const DeviceFiles& files, const std::string& backend,
                         const std::optional<HomingMethod>& asked_for) {
  DeviceModel model = device_model(files);
  HomingModel& homing = model.homing;
  if (is_real_device(backend)) {
    homing.see_dark = true;
    if (homing.method == HomingMethod::kLight) homing.method = HomingMethod::kEdges;
  }
  if (asked_for) homing.method = *asked_for;
  if (homing.method == HomingMethod::kIndex && !backend_abilities(backend).index)
    throw InputError("homing method index: the boards of --backend " + backend + " tell of no index pulse; take edges");
  return model;
}

std::string simulated_plant_words(const std::string& which) { return "simulated, " + which; }
std::string simulated_plant_words(std::uint64_t seed) { return simulated_plant_words("seed " + std::to_string(seed)); }

std::vector<std::string> device_doubts(const DeviceFiles& files, const std::string& plant) {
  std::vector<std::string> doubts;
  const auto compare = [&](const std::optional<DeviceFile>& file, const std::string& made_on, const char* what) {
    if (!file || made_on.empty() || made_on == plant) return;
    doubts.push_back(file->name + ": was " + what + " on another device (" + made_on + ") than this one (" + plant +
                     "); the loop takes it all the same");
  };
  std::string made_on;
  if (files.calibration) parse_calibration(files.calibration->text, files.calibration->name, &made_on);
  compare(files.calibration, made_on, "calibrated");
  made_on.clear();
  if (files.identified) parse_device(files.identified->text, files.identified->name, &made_on);
  compare(files.identified, made_on, "identified");
  return doubts;
}

}  // namespace trocar
