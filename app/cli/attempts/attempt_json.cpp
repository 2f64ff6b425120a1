#include "app/cli/attempts/attempt_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "scenarios/scoring/metrics.h"
#include "trainees/markup/pacing.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json subscores(const Grade& grade) {
  Json list = Json::array();
  for (const Subscore& row : grade.subscores) {
    list.push_back({{"name", row.name},
                    {"value", number(row.value)},
                    {"weight", number(row.weight)},
                    {"raw", number(row.raw)},
                    {"unit", row.unit},
                    {"full_at", number(row.full_at)},
                    {"zero_at", number(row.zero_at)},
                    {"gate", row.gate}});
  }
  return list;
}

Json events(const AttemptResult& result) {
  Json list = Json::array();
  for (const Event& event : result.events) {
    list.push_back({{"t_s", number(event.t_s)},
                    {"type", event.type},
                    {"severity", severity_name(event.severity)},
                    {"object", event.object < 0 ? Json(nullptr) : Json(event.object)},
                    {"value", number(event.value)},
                    {"unit", event.unit},
                    {"tip_m", {number(event.tip_T.x()), number(event.tip_T.y()), number(event.tip_T.z())}}});
  }
  return list;
}

Json metrics(const Grade& grade) {
  Json table = Json::object();
  for (const Metric& metric : grade.metrics) {
    table[metric.name] = {{"value", number(metric.value)}, {"unit", metric.unit}};
  }
  return table;
}

Json warnings(const RunReport& run_report) {
  Json list = Json::array();
  for (const DeviceWarning& w : run_report.warnings) {
    list.push_back({{"name", w.name}, {"first_s", number(w.first_s)}, {"ticks", w.ticks}});
  }
  return list;
}

Json transitions(const RunReport& run_report) {
  Json list = Json::array();
  for (const DeviceTransition& t : run_report.transitions) {
    list.push_back({{"t_s", number(t.t_s)}, {"from", t.from}, {"to", t.to}});
  }
  return list;
}

Json fault_detail(const RunReport& run_report) {
  if (run_report.fault.empty()) return nullptr;
  return {{"cause", run_report.fault},
          {"channel", run_report.fault_channel < 0 ? Json(nullptr) : Json(run_report.fault_channel)},
          {"first_s", number(run_report.fault_s)},
          {"value", number(run_report.fault_value)}};
}

void add_stiffness(Json& json, const StiffnessReport& stiffness) {
  const bool touched = stiffness.contact_ticks > 0;
  const auto measured = [&](double value) { return touched ? number(value) : Json(nullptr); };
  json["stiffness_clamp"] = stiffness.recorded ? Json(stiffness.clamped) : Json(nullptr);
  json["stiffness_contact_ticks"] = stiffness.recorded ? Json(stiffness.contact_ticks) : Json(nullptr);
  json["stiffness_asked_max_n_per_m"] = measured(stiffness.asked_max_n_per_m);
  json["k_max_min_n_per_m"] = measured(stiffness.k_max_min_n_per_m);
  json["k_max_max_n_per_m"] = measured(stiffness.k_max_max_n_per_m);
  json["stiffness_share_min"] = measured(stiffness.share_min);
  json["above_k_max_share"] = measured(stiffness.above_share);
}

Json device(const RunReport& run_report) {
  Json json = {{"backend", run_report.backend},
               {"rate_hz", number(run_report.rate_hz)},
               {"ticks", run_report.ticks},
               {"overruns", run_report.overruns},
               {"saturated_contact_share", number(run_report.saturated_contact_share)},
               {"force_not_rendered", run_report.force_not_rendered()},
               {"passivity_active_share", number(run_report.passivity_active_share)},
               {"min_energy_j", number(run_report.min_energy_j)},
               {"kappa", number(run_report.kappa)},
               {"fault", run_report.fault.empty() ? Json(nullptr) : Json(run_report.fault)},
               {"fault_detail", fault_detail(run_report)},
               {"warnings", warnings(run_report)},
               {"transitions", transitions(run_report)}};
  add_stiffness(json, run_report.stiffness);
  if (!run_report.force_sensor.empty()) json["force_sensor"] = Json::parse(run_report.force_sensor);
  if (!run_report.plant.empty()) json["plant"] = Json::parse(run_report.plant);
  if (!run_report.realtime.empty()) {
    json["realtime"] = Json::parse(run_report.realtime);
    json["soft_real_time"] = !soft_real_time(run_report).empty();
  }
  return json;
}

}  // namespace

std::string rubric_json(const Rubric& rubric) {
  Json subscores = Json::array();
  for (const SubscoreRule& rule : rubric.subscores) {
    const MetricDefinition* metric = find_metric(rule.metric);
    subscores.push_back({{"name", rule.name},
                         {"metric", rule.metric},
                         {"unit", metric ? metric->unit : ""},
                         {"weight", rule.weight},
                         {"full_at", rule.full_at},
                         {"zero_at", rule.zero_at},
                         {"gate", rule.gate},
                         {"gate_below", rule.gate ? Json(rule.gate_below) : Json()}});
  }
  const Json json = {{"pass_at", rubric.pass_at},
                     {"proficient_at", rubric.proficient_at},
                     {"expert_at", rubric.expert_at},
                     {"gate_cap", rubric.gate_cap},
                     {"critical_cap", rubric.critical_cap},
                     {"unfinished_cap", rubric.unfinished_cap},
                     {"caps", rubric.caps_scale ? "scale" : "cut"},
                     {"subscores", subscores}};
  return json.dump(2);
}

std::string attempt_json(const AttemptResult& result) {
  const Json json = {{"exercise",
                      {{"id", result.exercise_id},
                       {"version", result.exercise_version},
                       {"level", result.level},
                       {"seed", result.seed},
                       {"board", result.board}}},
                     {"trainee", result.trainee},
                     {"hand", result.hand},
                     {"assists", result.assists},
                     {"status", status_name(result.grade.status)},
                     {"score", number(result.grade.score)},
                     {"passed", result.grade.passed},
                     {"grade", result.grade.grade},
                     {"integrity", result.integrity.empty() ? Json(nullptr) : Json(result.integrity)},
                     {"subscores", subscores(result.grade)},
                     {"caps", cap_sentences(result.grade.caps)},
                     {"events", events(result)},
                     {"metrics", metrics(result.grade)},
                     {"device", device(result.device)},
                     {"organ",
                      {{"name", result.organ_name},
                       {"source", result.organ_source},
                       {"sha256", result.organ_sha256},
                       {"synthetic", result.organ_synthetic},
                       {"credit", result.organ_credit}}},
                     {"rubric_sha256", result.rubric_sha256},
                     {"recording_sha256", result.recording_sha256},
                     {"state_hash", result.state_hash},
                     {"attempt",
                      {{"uuid", result.uuid},
                       {"started_utc", result.started_utc},
                       {"recording", result.recording_path},
                       {"safety_log", result.safety_log_path.empty() ? Json(nullptr) : Json(result.safety_log_path)}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace trocar
