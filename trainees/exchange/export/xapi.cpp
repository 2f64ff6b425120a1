#include "trainees/exchange/export/xapi.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/exchange/export/named_uuid.h"
#include "trainees/exchange/export/xapi_terms.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;
using xapi::kCmi5;
using xapi::kOwn;

std::string iri(std::string_view base, const std::string& rest) { return std::string(base) + rest; }

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool graded(const AttemptResult& result) { return result.grade.score && std::isfinite(*result.grade.score); }
Verdict verdict(const XapiAttempt& attempt) {
  return verdict_of(attempt.result.grade.status, attempt.result.grade.passed, attempt.decision);
}
/// Whether it has a verdict at all: a score, or a decision that counts.
bool judged(const XapiAttempt& attempt) {
  const AttemptStatus status = attempt.result.grade.status;
  return graded(attempt.result) ||
         (attempt.decision && status != AttemptStatus::kFault && status != AttemptStatus::kVoid);
}
bool done(const AttemptResult& result) { return result.grade.status == AttemptStatus::kCompleted; }

Json account(const std::string& home_page, const std::string& name) {
  return {{"objectType", "Agent"}, {"account", {{"homePage", home_page}, {"name", name}}}};
}

Json verb(const std::string& name) { return {{"id", iri(xapi::kVerbs, name)}, {"display", {{"en", name}}}}; }

Json activity(const std::string& id) { return {{"objectType", "Activity"}, {"id", id}}; }

std::string exercise_iri(const AttemptResult& result) {
  return iri(kOwn, "exercise/" + xapi::path_part(result.exercise_id));
}

Json definition(const XapiAttempt& attempt) {
  const std::string name = attempt.title.empty() ? attempt.result.exercise_id : attempt.title;
  return {{"type", xapi::kSimulation}, {"name", {{"en", name}}}};
}

Json object(const XapiAttempt& attempt) {
  const AttemptResult& r = attempt.result;
  Json out = activity(exercise_iri(r) + "/" + xapi::path_part(r.exercise_version) + "/" + xapi::path_part(r.level));
  out["definition"] = definition(attempt);
  return out;
}

Json score(const AttemptResult& result) {
  const double raw = *result.grade.score;
  return {{"scaled", raw / 100}, {"raw", raw}, {"min", 0}, {"max", 100}};
}

/// The exercise's clock where it ran, otherwise how long the loop ran.
std::string duration(const AttemptResult& result) {
  double seconds = result.device.rate_hz > 0 ? static_cast<double>(result.device.ticks) / result.device.rate_hz : 0;
  for (const Metric& metric : result.grade.metrics) {
    if (metric.name == "time_s" && metric.value && std::isfinite(*metric.value)) seconds = *metric.value;
  }
  return xapi_duration(std::max(0.0, seconds));
}

void add_number(Json& json, const char* key, const std::optional<double>& value) {
  if (value && std::isfinite(*value)) json[key] = *value;
}

Json subscores(const AttemptResult& result) {
  Json list = Json::array();
  for (const Subscore& row : result.grade.subscores) {
    Json one = {{"name", row.name}, {"gate", row.gate}};
    add_number(one, "value", row.value);
    add_number(one, "weight", row.weight);
    add_number(one, "raw", row.raw);
    if (!row.unit.empty()) one["unit"] = row.unit;
    add_number(one, "full_at", row.full_at);
    add_number(one, "zero_at", row.zero_at);
    list.push_back(std::move(one));
  }
  return list;
}

Json events(const AttemptResult& result) {
  Json list = Json::array();
  for (const Event& event : result.events) {
    Json one = {{"type", event.type}, {"severity", severity_name(event.severity)}};
    add_number(one, "t_s", event.t_s);
    if (event.object >= 0) one["object"] = event.object;
    if (!event.unit.empty()) add_number(one, "value", event.value);
    if (!event.unit.empty()) one["unit"] = event.unit;
    list.push_back(std::move(one));
  }
  return list;
}

Json result_extensions(const XapiAttempt& attempt) {
  const AttemptResult& r = attempt.result;
  Json out = Json::object();
  const auto add = [&](const char* name, Json value) {
    out[iri(kOwn, std::string("extension/") + name)] = std::move(value);
  };
  const auto add_text = [&](const char* name, const std::string& text) {
    if (!text.empty()) add(name, text);
  };
  add("status", status_name(r.grade.status));
  add("subscores", subscores(r));
  add("caps", cap_sentences(r.grade.caps));
  add("events", events(r));
  add_text("integrity", r.integrity);
  add_text("ruleset-sha256", r.rubric_sha256);
  add_text("trace-sha256", r.recording_sha256);
  add_text("row-hash", attempt.row_hash);
  if (attempt.decision) {
    Json decision = {{"id", attempt.decision->uuid},
                     {"success", attempt.decision->passed},
                     {"success-by-score", r.grade.passed},
                     {"timestamp", attempt.decision->utc}};
    if (!attempt.decision->author.empty()) decision["authority"] = attempt.decision->author;
    add("decision", std::move(decision));
  }
  add("seed", r.seed);
  add("board", r.board);
  add_text("level", r.level);
  add_text("hand", r.hand);
  return out;
}

Json context_of(const XapiAttempt& attempt, const XapiSetting& setting) {
  const AttemptResult& r = attempt.result;
  Json out = {{"registration", named_uuid(attempt.trainee_uuid, exercise_iri(r))}};
  if (!attempt.instructor_uuid.empty()) out["instructor"] = account(setting.home_page, attempt.instructor_uuid);
  out["contextActivities"]["parent"] = Json::array({activity(exercise_iri(r))});
  if (!attempt.session_uuid.empty()) {
    out["contextActivities"]["grouping"] =
        Json::array({activity(iri(kOwn, "session/" + xapi::path_part(attempt.session_uuid)))});
  }
  if (!r.exercise_version.empty()) out["revision"] = r.exercise_version;
  out["platform"] = attempt.program.empty() ? std::string("Trocar") : "Trocar " + attempt.program;
  out["language"] = "en";
  if (graded(r) && attempt.pass_at) out["extensions"][iri(kCmi5, "extensions/masteryscore")] = *attempt.pass_at / 100;
  return out;
}

/// A name and its own page for everything that cmi5 defines.
Json cmi5_context(const XapiAttempt& attempt, const Cmi5Launch& launch) {
  Json out = {{"registration", launch.registration}};
  out["contextActivities"]["grouping"] = Json::array({activity(launch.publisher_id)});
  out["contextActivities"]["category"] =
      Json::array({activity(iri(kCmi5, "categories/cmi5")), activity(iri(kCmi5, "categories/moveon"))});
  out["platform"] = attempt.program.empty() ? std::string("Trocar") : "Trocar " + attempt.program;
  out["extensions"][iri(kCmi5, "extensions/sessionid")] = launch.session_id;
  return out;
}

Json cmi5_statement(const XapiAttempt& attempt, const Cmi5Launch& launch, const std::string& name, Json result) {
  result["duration"] = duration(attempt.result);
  Json target = activity(launch.activity_id);
  target["definition"] = definition(attempt);
  Json out = {{"id", named_uuid(attempt.result.uuid, launch.session_id + " " + name +
                                                         (attempt.decision ? " " + attempt.decision->uuid : ""))},
              {"actor", account(launch.home_page, launch.account)},
              {"verb", verb(name)},
              {"object", target},
              {"result", std::move(result)},
              {"context", cmi5_context(attempt, launch)},
              {"timestamp", attempt.finished_utc}};
  return out;
}

}  // namespace

std::string xapi_duration(double seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f", seconds);
  std::string digits = text;
  while (digits.ends_with('0')) digits.pop_back();
  if (digits.ends_with('.')) digits.pop_back();
  return "PT" + digits + "S";
}

std::string xapi_statement(const XapiAttempt& attempt, const XapiSetting& setting) {
  const AttemptResult& r = attempt.result;
  const std::string name = judged(attempt) ? (verdict(attempt).passed ? "passed" : "failed")
                           : done(r)       ? "completed"
                                           : "attempted";
  const std::string decided = attempt.decision ? " " + attempt.decision->uuid : "";
  Json result = Json::object();
  if (graded(r)) result["score"] = score(r);
  if (judged(attempt)) result["success"] = verdict(attempt).passed;
  result["completion"] = done(r);
  result["duration"] = duration(r);
  result["extensions"] = result_extensions(attempt);
  return dumped({{"id", named_uuid(r.uuid, iri(xapi::kVerbs, name) + decided)},
                 {"actor", account(setting.home_page, attempt.trainee_uuid)},
                 {"verb", verb(name)},
                 {"object", object(attempt)},
                 {"result", std::move(result)},
                 {"context", context_of(attempt, setting)},
                 {"timestamp", attempt.finished_utc}});
}

XapiStatement voiding_statement(const std::string& id, const std::string& author, const std::string& utc,
                                const XapiSetting& setting) {
  const std::string own_id = named_uuid(id, iri(xapi::kVerbs, "voided"));
  Json out = {{"id", own_id},
              {"actor", account(setting.home_page, author.empty() ? "trocar" : author)},
              {"verb", verb("voided")},
              {"object", {{"objectType", "StatementRef"}, {"id", id}}}};
  if (!utc.empty()) out["timestamp"] = utc;
  return {own_id, dumped(out)};
}

std::vector<std::string> cmi5_statements(const XapiAttempt& attempt, const Cmi5Launch& launch) {
  const AttemptResult& r = attempt.result;
  std::vector<std::string> out;
  if (done(r)) out.push_back(dumped(cmi5_statement(attempt, launch, "completed", {{"completion", true}})));
  if (!judged(attempt)) return out;
  const bool reached =
      graded(r) && (launch.mastery_score ? *r.grade.score / 100 >= *launch.mastery_score : r.grade.passed);
  const bool passed = attempt.decision ? verdict(attempt).passed : reached && r.grade.caps.empty();
  Json result = {{"success", passed}};
  if (graded(r) && passed == reached) result["score"] = score(r);
  Json statement = cmi5_statement(attempt, launch, passed ? "passed" : "failed", std::move(result));
  if (launch.mastery_score)
    statement["context"]["extensions"][iri(kCmi5, "extensions/masteryscore")] = *launch.mastery_score;
  out.push_back(dumped(statement));
  return out;
}

}  // namespace trocar
