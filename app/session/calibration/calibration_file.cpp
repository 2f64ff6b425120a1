#include "app/session/calibration/calibration_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <span>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/files/doubled_keys.h"

namespace trocar {
namespace {

using Json = nlohmann::json;

constexpr double kLeastGain = 0.004, kLargestGain = 10;  // A/V; nominal 0.431, and a chain may be ten times off
constexpr double kLargestOffset = 1;                     // V: a tenth of the DAC's range is no offset any more

/// Of the file and of each of its channels.
constexpr std::array kFileKeys{"plant", "channels"};
constexpr std::array kChannelKeys{"channel",  "amps_per_volt", "amps_per_volt_sd", "gain_over_nominal",
                                  "offset_v", "offset_sd_v",   "stiction_nm",      "residual_nm"};

void require_known(const Json& object, std::span<const char* const> known, const std::string& where) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw InputError(where + ": unknown key \"" + key + "\"");
    }
  }
}

double number_of(const Json& channel, const char* key, const std::string& where) {
  const auto found = channel.find(key);
  if (found == channel.end()) throw InputError(where + ": no \"" + key + "\"");
  if (!found->is_number() || !std::isfinite(found->get<double>())) {
    throw InputError(where + "." + key + ": not a finite number");
  }
  return found->get<double>();
}

ChannelCalibration channel_of(const Json& channel, int index, const std::string& where) {
  if (!channel.is_object()) throw InputError(where + ": not an object");
  require_known(channel, kChannelKeys, where);
  const auto named = channel.find("channel");
  const std::string name = named != channel.end() && named->is_string() ? named->get<std::string>() : "";
  if (name != calibration_channel(index)) {
    throw InputError(where + ".channel: \"" + name + "\" where \"" + calibration_channel(index) + "\" belongs");
  }
  ChannelCalibration c;
  c.amps_per_volt = number_of(channel, "amps_per_volt", where);
  c.amps_per_volt_sd = number_of(channel, "amps_per_volt_sd", where);
  c.offset_v = number_of(channel, "offset_v", where);
  c.offset_sd_v = number_of(channel, "offset_sd_v", where);
  c.stiction_nm = number_of(channel, "stiction_nm", where);
  c.residual_nm = number_of(channel, "residual_nm", where);
  if (c.amps_per_volt <= 0) throw InputError(where + ".amps_per_volt: must be positive");
  if (c.amps_per_volt < kLeastGain || c.amps_per_volt > kLargestGain) {
    throw InputError(where + ".amps_per_volt: no amplifier of this device; 0.004 to 10 A/V");
  }
  if (std::abs(c.offset_v) >= kLargestOffset) throw InputError(where + ".offset_v: must be under 1 V");
  return c;
}

}  // namespace

const char* calibration_channel(int channel) {
  constexpr std::array kNames{"joint 1", "joint 2", "joint 3", "joint 4", "joint 5", "joint 6", "pinch"};
  return kNames[static_cast<std::size_t>(channel)];
}

std::string calibration_json(const AmplifierCalibration& found, const DeviceModel& nominal, const std::string& plant) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (!plant.empty()) json["plant"] = plant;
  json["channels"] = nlohmann::ordered_json::array();
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    const double nominal_gain = nominal.transmission[c].amps_per_volt;
    json["channels"].push_back({{"channel", calibration_channel(i)},
                                {"amps_per_volt", found[c].amps_per_volt},
                                {"amps_per_volt_sd", found[c].amps_per_volt_sd},
                                {"gain_over_nominal", found[c].amps_per_volt / nominal_gain},
                                {"offset_v", found[c].offset_v},
                                {"offset_sd_v", found[c].offset_sd_v},
                                {"stiction_nm", found[c].stiction_nm},
                                {"residual_nm", found[c].residual_nm}});
  }
  return json.dump(2) + "\n";
}

AmplifierCalibration read_calibration(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot be read (missing file or no permission)");
  return parse_calibration(std::string(std::istreambuf_iterator<char>(in), {}), file.string());
}

AmplifierCalibration parse_calibration(const std::string& text, const std::string& file, std::string* plant) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) throw InputError(file + ": no JSON object");
  if (const auto twice = doubled_keys(text); !twice.empty()) {
    throw InputError(file + ": key \"" + twice.front() + "\" comes twice in one object");
  }
  require_known(json, kFileKeys, file);
  if (json.contains("plant") && !json["plant"].is_string()) throw InputError(file + ": \"plant\" must be a text");
  if (plant) *plant = json.value("plant", "");
  const auto channels = json.find("channels");
  if (channels == json.end() || !channels->is_array() || channels->size() != kChannels) {
    throw InputError(file + ": \"channels\" must be an array of seven");
  }
  AmplifierCalibration found;
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    found[c] = channel_of((*channels)[c], i, file + ": channels[" + std::to_string(i) + "]");
  }
  return found;
}

}  // namespace trocar
