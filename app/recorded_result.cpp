#include "app/recorded_result.h"

#include <nlohmann/json.hpp>

#include "app/executor/state_hash.h"
#include "app/session.h"
#include "haptics/input_error.h"

namespace trocar {

std::string receipt_json(const DeviceReceipt& receipt) {
  nlohmann::ordered_json json = {{"backend", receipt.backend},
                               {"rate_hz", receipt.rate_hz},
                               {"ticks", receipt.ticks},
                               {"overruns", receipt.overruns},
                               {"min_energy_j", receipt.min_energy_j},
                               {"kappa", receipt.kappa},
                               {"fault", receipt.fault}};
  if (!receipt.force_sensor.empty()) json["force_sensor"] = nlohmann::ordered_json::parse(receipt.force_sensor);
  if (!receipt.realtime.empty()) json["realtime"] = nlohmann::ordered_json::parse(receipt.realtime);
  return json.dump();
}

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
    if (json.contains("realtime")) receipt.realtime = json.at("realtime").dump();
    return receipt;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(name + ": the device's receipt cannot be read: " + error.what());
  }
}

AttemptResult recorded_result(const Recording& recording, const std::filesystem::path& file) {
  const std::string name = file.empty() ? "recording" : file.string();
  AttemptResult result;
  result.grade = grade_recording(recording, name);
  if (result.grade.status == AttemptStatus::kVoid && !result.grade.caps.empty()) {
    result.integrity = result.grade.caps.front();
  }
  result.events = recording.events;
  if (!recording.receipt_json.empty()) result.device = parse_receipt(recording.receipt_json, name);
  fill_shares(recording, result.device);
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
