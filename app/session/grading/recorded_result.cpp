#include "app/session/grading/recorded_result.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/session/grading/stiffness_report.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/session.h"
#include "haptics/input_error.h"

namespace trocar {

std::string run_report_json(const RunReport& run_report) {
  nlohmann::ordered_json json = {{"backend", run_report.backend},
                                 {"rate_hz", run_report.rate_hz},
                                 {"ticks", run_report.ticks},
                                 {"overruns", run_report.overruns},
                                 {"min_energy_j", run_report.min_energy_j},
                                 {"kappa", run_report.kappa},
                                 {"fault", run_report.fault},
                                 {"fault_channel", run_report.fault_channel},
                                 {"fault_s", run_report.fault_s},
                                 {"fault_value", std::isfinite(run_report.fault_value) ? run_report.fault_value : 0},
                                 {"reason", run_report.reason},
                                 {"warnings", nlohmann::ordered_json::array()},
                                 {"transitions", nlohmann::ordered_json::array()}};
  for (const DeviceWarning& w : run_report.warnings) json["warnings"].push_back({w.name, w.first_s, w.ticks});
  for (const DeviceTransition& t : run_report.transitions) json["transitions"].push_back({t.t_s, t.from, t.to});
  if (!run_report.force_sensor.empty()) json["force_sensor"] = nlohmann::ordered_json::parse(run_report.force_sensor);
  if (!run_report.plant.empty()) json["plant"] = nlohmann::ordered_json::parse(run_report.plant);
  if (!run_report.realtime.empty()) json["realtime"] = nlohmann::ordered_json::parse(run_report.realtime);
  return json.dump();
}

namespace {

/// What older recordings do not say.
void read_stop(const nlohmann::ordered_json& json, RunReport& run_report) {
  if (!json.contains("reason")) return;
  run_report.fault_channel = json.at("fault_channel").get<int>();
  run_report.fault_s = json.at("fault_s").get<double>();
  run_report.fault_value = json.at("fault_value").get<double>();
  run_report.reason = json.at("reason").get<std::string>();
  for (const auto& w : json.at("warnings")) run_report.warnings.push_back({w.at(0), w.at(1), w.at(2)});
  for (const auto& t : json.at("transitions")) run_report.transitions.push_back({t.at(0), t.at(1), t.at(2)});
}

}  // namespace

RunReport parse_run_report(const std::string& text, const std::string& name) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    RunReport run_report;
    run_report.backend = json.at("backend").get<std::string>();
    run_report.rate_hz = json.at("rate_hz").get<double>();
    run_report.ticks = json.at("ticks").get<std::uint64_t>();
    run_report.overruns = json.at("overruns").get<std::uint64_t>();
    run_report.min_energy_j = json.at("min_energy_j").get<double>();
    run_report.kappa = json.at("kappa").get<double>();
    run_report.fault = json.at("fault").get<std::string>();
    if (json.contains("force_sensor")) run_report.force_sensor = json.at("force_sensor").dump();
    if (json.contains("plant")) run_report.plant = json.at("plant").dump();
    if (json.contains("realtime")) run_report.realtime = json.at("realtime").dump();
    read_stop(json, run_report);
    return run_report;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(name + ": the run report cannot be read: " + error.what());
  }
}

StiffnessReport recorded_stiffness(const Recording& recording, const std::string& name) {
  return stiffness_report(recording.ticks, parse_scene_json(recording.session, name).setup.clamp_stiffness);
}

AttemptResult recorded_result(const Recording& recording, const std::filesystem::path& file) {
  const std::string name = file.empty() ? "recording" : file.string();
  AttemptResult result;
  GradedRecording graded = grade_recording(recording, name);
  result.grade = std::move(graded.grade);
  result.events = std::move(graded.events);
  if (result.grade.status == AttemptStatus::kVoid && !result.grade.caps.empty()) {
    result.integrity = cap_sentence(result.grade.caps.front());
  }
  if (!recording.run_report_json.empty()) result.device = parse_run_report(recording.run_report_json, name);
  if (result.integrity.empty()) result.integrity = result.device.reason;
  if (result.integrity.empty() && recording.end && result.grade.status == AttemptStatus::kAborted)
    result.integrity = "ended before the exercise did";
  fill_shares(recording, result.device);
  result.device.stiffness = recorded_stiffness(recording, name);
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
