#include "app/session/grading/recorded_result.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/session/grading/stiffness_receipt.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/session.h"
#include "haptics/input_error.h"

namespace trocar {

std::string receipt_json(const DeviceReceipt& receipt) {
  nlohmann::ordered_json json = {{"backend", receipt.backend},
                                 {"rate_hz", receipt.rate_hz},
                                 {"ticks", receipt.ticks},
                                 {"overruns", receipt.overruns},
                                 {"min_energy_j", receipt.min_energy_j},
                                 {"kappa", receipt.kappa},
                                 {"fault", receipt.fault},
                                 {"fault_channel", receipt.fault_channel},
                                 {"fault_s", receipt.fault_s},
                                 {"fault_value", std::isfinite(receipt.fault_value) ? receipt.fault_value : 0},
                                 {"reason", receipt.reason},
                                 {"warnings", nlohmann::ordered_json::array()},
                                 {"transitions", nlohmann::ordered_json::array()}};
  for (const DeviceWarning& w : receipt.warnings) json["warnings"].push_back({w.name, w.first_s, w.ticks});
  for (const DeviceTransition& t : receipt.transitions) json["transitions"].push_back({t.t_s, t.from, t.to});
  if (!receipt.force_sensor.empty()) json["force_sensor"] = nlohmann::ordered_json::parse(receipt.force_sensor);
  if (!receipt.plant.empty()) json["plant"] = nlohmann::ordered_json::parse(receipt.plant);
  if (!receipt.realtime.empty()) json["realtime"] = nlohmann::ordered_json::parse(receipt.realtime);
  return json.dump();
}

namespace {

/// What older recordings do not say.
void read_stop(const nlohmann::ordered_json& json, DeviceReceipt& receipt) {
  if (!json.contains("reason")) return;
  receipt.fault_channel = json.at("fault_channel").get<int>();
  receipt.fault_s = json.at("fault_s").get<double>();
  receipt.fault_value = json.at("fault_value").get<double>();
  receipt.reason = json.at("reason").get<std::string>();
  for (const auto& w : json.at("warnings")) receipt.warnings.push_back({w.at(0), w.at(1), w.at(2)});
  for (const auto& t : json.at("transitions")) receipt.transitions.push_back({t.at(0), t.at(1), t.at(2)});
}

}  // namespace

DeviceReceipt parse_receipt(const std::string& text, const std::string& name) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    DeviceReceipt receipt;
    receipt.backend = json.at("backend").get<std::string>();
    receipt.rate_hz = json.at("rate_hz").get<double>();
    receipt.ticks = json.at("ticks").get<std::uint64_t>();
    receipt.overruns = json.at("overruns").get<std::uint64_t>();
    receipt.min_energy_j = json.at("min_energy_j").get<double>();
    receipt.kappa = json.at("kappa").get<double>();
    receipt.fault = json.at("fault").get<std::string>();
    if (json.contains("force_sensor")) receipt.force_sensor = json.at("force_sensor").dump();
    if (json.contains("plant")) receipt.plant = json.at("plant").dump();
    if (json.contains("realtime")) receipt.realtime = json.at("realtime").dump();
    read_stop(json, receipt);
    return receipt;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(name + ": the device's receipt cannot be read: " + error.what());
  }
}

void fill_stiffness(const Recording& recording, const std::string& name, DeviceReceipt& device) {
  const bool clamped = parse_scene_json(recording.session, name).setup.clamp_stiffness;
  device.stiffness = stiffness_receipt(recording.ticks, clamped);
}

AttemptResult recorded_result(const Recording& recording, const std::filesystem::path& file) {
  const std::string name = file.empty() ? "recording" : file.string();
  AttemptResult result;
  result.grade = grade_recording(recording, name);
  if (result.grade.status == AttemptStatus::kVoid && !result.grade.caps.empty()) {
    result.integrity = cap_sentence(result.grade.caps.front());
  }
  if (recording.end && result.grade.status == AttemptStatus::kAborted)
    result.integrity = "ended before the exercise did";
  result.events = recording.events;
  if (!recording.receipt_json.empty()) result.device = parse_receipt(recording.receipt_json, name);
  if (result.integrity.empty()) result.integrity = result.device.reason;
  fill_shares(recording, result.device);
  fill_stiffness(recording, name, result.device);
  result.recording_sha256 = recording.sha256;
  result.recording_path = file.string();
  if (recording.end) result.state_hash = StateHash(recording.end->state_hash).hex();
  return result;
}

std::optional<AttemptResult> regrade_file(const std::filesystem::path& file) {
  const Recording recording = read_recording(file);
  if (!recording.end) return std::nullopt;
  return recorded_result(recording, file);
}

}  // namespace trocar
